"""Continuous collision: our conservative advancement beside ipctk's tight inclusion, and rays beside pymunk's."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions.sweeping import edge_edge_impact, ray_capsule, sweep_convex, vertex_face_impact

QUERIES, RAYS, BODIES = 2_000, 10_000, 100
CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def steps(*shapes: tuple[int, ...]) -> list[np.ndarray]:
    """Features at the start and at the end of random steps in a cube of 2 m."""
    rng = np.random.default_rng(1)
    return [rng.uniform(-1, 1, (QUERIES, *shape)) for shape in shapes * 2]


def our_corners() -> Callable[[], object]:
    query = steps((3,), (3, 3))
    return lambda: vertex_face_impact(*query)


def our_edges() -> Callable[[], object]:
    query = steps((2, 3), (2, 3))
    return lambda: edge_edge_impact(*query)


def ipctk_corners() -> Callable[[], object]:
    import ipctk  # noqa: PLC0415 a rival may be missing

    rows = list(zip(*steps((3,), (3, 3)), strict=True))
    ask = ipctk.TightInclusionCCD().point_triangle_ccd
    return lambda: [ask(p, *t, q, *u) for p, t, q, u in rows]


def ipctk_edges() -> Callable[[], object]:
    import ipctk  # noqa: PLC0415 a rival may be missing

    rows = list(zip(*steps((2, 3), (2, 3)), strict=True))
    ask = ipctk.TightInclusionCCD().edge_edge_ccd
    return lambda: [ask(*a, *b, *c, *d) for a, b, c, d in rows]


def rays() -> tuple[np.ndarray, ...]:
    """Rays and segments in the plane z = 0."""
    rng = np.random.default_rng(1)
    return tuple(rng.uniform(-2, 2, (RAYS, 3)) * [1, 1, 0] for _ in range(4))


def our_rays() -> Callable[[], object]:
    origin, way, start, end = rays()
    return lambda: ray_capsule(origin, way, start, end, 0.1)


def pymunk_rays() -> Callable[[], object]:
    import pymunk  # noqa: PLC0415 a rival may be missing

    body = pymunk.Space().static_body
    rows = []
    for origin, way, start, end in zip(*rays(), strict=True):
        shape = pymunk.Segment(body, tuple(start[:2]), tuple(end[:2]), 0.1)
        shape.cache_bb()
        rows.append((shape, tuple(origin[:2]), tuple((origin + way)[:2])))
    return lambda: [shape.segment_query(first, last, 0) for shape, first, last in rows]


def our_boxes() -> Callable[[], object]:
    rng = np.random.default_rng(1)
    still, spin = np.zeros(3), rng.normal(size=(BODIES, 3))
    place = rng.uniform(1.5, 2.5, (BODIES, 3))
    return lambda: sweep_convex(CUBE, still, still, spin, 0.0, CUBE, place, -place, -spin, 0.0, 1.0)


BENCHES = (
    Bench(
        "corner-face",
        f"{QUERIES} steps of a corner against a face; ipctk is asked one by one from Python",
        our_corners,
        {"ipctk": ipctk_corners},
    ),
    Bench(
        "edge-edge",
        f"{QUERIES} steps of two edges; ipctk is asked one by one from Python",
        our_edges,
        {"ipctk": ipctk_edges},
    ),
    Bench(
        "ray-capsule",
        f"{RAYS} rays, each against its capsule; pymunk is asked one by one from Python, in the plane",
        our_rays,
        {"pymunk": pymunk_rays},
    ),
    Bench("turning-boxes", f"time of impact of {BODIES} pairs of cubes that fly and turn", our_boxes),
)
