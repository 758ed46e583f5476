"""How long it takes to know what is inside: a hundred thousand points and a thousand faces, by three ways."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions.polyhedra import (
    convex_separation,
    inside_by_parity,
    mesh_report,
    polyhedra_intersect,
    winding_number,
)

COUNT = 100_000


def _grid(radius_u: int, radius_v: int) -> np.ndarray:
    """Triangles of a torus's net of u × v quads."""
    u, v = np.meshgrid(np.arange(radius_u), np.arange(radius_v), indexing="ij")
    a, b = u * radius_v + v, (u + 1) % radius_u * radius_v + v
    c, d = (u + 1) % radius_u * radius_v + (v + 1) % radius_v, u * radius_v + (v + 1) % radius_v
    return np.concatenate([np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([a, c, d], axis=-1).reshape(-1, 3)])


def _torus() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A torus of a thousand faces, which is concave, and points in its box."""
    u, v = np.meshgrid(np.arange(25) * 2 * np.pi / 25, np.arange(20) * 2 * np.pi / 20, indexing="ij")
    out = 2 + 0.7 * np.cos(v)
    vertices = np.stack([out * np.cos(u), out * np.sin(u), 0.7 * np.sin(v)], axis=-1).reshape(-1, 3)
    return np.random.default_rng(1).uniform(-1, 1, (COUNT, 3)) * [2.7, 2.7, 0.7], vertices, _grid(25, 20)


def parity() -> Callable[[], object]:
    """Rays with exact signs."""
    point, vertices, faces = _torus()
    return lambda: inside_by_parity(point, vertices, faces)


def parity_on_a_grid() -> Callable[[], object]:
    """The same on coordinates in steps of 1/16: many rays meet vertices and edges, where floats do not decide."""
    point, vertices, faces = _torus()
    return lambda: inside_by_parity(np.round(point * 16) / 16, np.round(vertices * 16) / 16, faces)


def winding() -> Callable[[], object]:
    """Solid angles."""
    point, vertices, faces = _torus()
    return lambda: winding_number(point, vertices, faces)


def winding_of_libigl() -> Callable[[], object]:
    """Its C++, with all cores."""
    import igl  # noqa: PLC0415 - a rival that may be missing

    point, vertices, faces = _torus()
    return lambda: igl.winding_number(vertices, faces, point)


def contains_of_trimesh() -> Callable[[], object]:
    """Its rays in NumPy with a tree of boxes."""
    import rtree  # noqa: F401, PLC0415 - what it looks up boxes in, and may be missing
    import trimesh  # noqa: PLC0415

    point, vertices, faces = _torus()
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    return lambda: mesh.contains(point)


def convex() -> Callable[[], object]:
    """The planes of a double cone of a thousand faces."""
    turns = np.arange(500) * 2 * np.pi / 500
    rim = np.stack([np.cos(turns), np.sin(turns), np.zeros(500)], axis=-1)
    vertices = np.concatenate([rim, [[0, 0, 1], [0, 0, -1]]])
    k, ahead = np.arange(500), (np.arange(500) + 1) % 500
    faces = np.concatenate(
        [np.stack([k, ahead, np.full(500, 500)], axis=1), np.stack([ahead, k, np.full(500, 501)], axis=1)]
    )
    point = np.random.default_rng(1).uniform(-1, 1, (COUNT, 3))
    return lambda: convex_separation(point, vertices, faces)


def two_solids() -> Callable[[], object]:
    """Two tori hooked into each other like links of a chain, which do not touch."""
    _, vertices, faces = _torus()
    return lambda: polyhedra_intersect(vertices, faces, vertices[:, [0, 2, 1]] + [2, 0, 0], faces[:, ::-1])


def report() -> Callable[[], object]:
    """All faults of the torus."""
    _, vertices, faces = _torus()
    return lambda: mesh_report(vertices, faces)


BENCHES = (
    Bench(
        "inside-parity",
        "a hundred thousand points in a torus of a thousand faces: parity of a ray",
        parity,
        {"trimesh contains": contains_of_trimesh},
        10,
    ),
    Bench("inside-parity-grid", "the same where rays meet vertices and edges", parity_on_a_grid, {}, 10),
    Bench("inside-winding", "the same: winding number", winding, {"libigl": winding_of_libigl}, 10),
    Bench("inside-convex", "a hundred thousand points in a convex solid of a thousand faces: depth", convex, {}, 2),
    Bench("two-polyhedra", "two solids of a thousand faces each: do they intersect", two_solids, {}, 1),
    Bench("mesh-report", "all faults of a mesh of a thousand faces", report, {}, 1),
)
