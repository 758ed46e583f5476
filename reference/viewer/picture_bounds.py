"""What of space a clip shows, and from which side: where the bodies of the first run come, and a bit of the rest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.scene import geometry
from reference.scene.scenario import HalfSpace
from reference.viewer import camera
from reference.viewer.clip import Clip, Run, Solid
from reference.viewer.shapes import vertices_of

GROWN = 0.5
"""All the rest may enlarge the picture by this share on each side: an engine that throws its ball away must not make
everything small."""


def framed(clip: Clip) -> Clip:
    """The clip with the view and the bounds that suit it."""
    first = next((run for run in clip.runs if run.count), None)
    moving = first.bodies if first else ()
    normals = [solid.shape.normal for solid in clip.solids if isinstance(solid.shape, HalfSpace)]
    places, turns = _motion(clip, first)
    own = _box([*_reach(clip, first)] if first else [])
    if own is None:
        own = _box([corners for solid in clip.solids for corners in _still(solid)]) or (-np.ones(3), np.ones(3))
    others = [reach for run in clip.runs if run is not first for reach in _reach(clip, run)]
    still = [reach for solid in clip.solids if solid.name not in moving for reach in _still(solid)]
    low, high = _widened(own, others + still)
    low, high = _widened((low, high), [_foot(solid, (low + high) / 2) for solid in clip.solids])
    return replace(clip, view=camera.default_view(places, normals, turns), low=low, high=high)


def seen_into(clip: Clip) -> Clip:
    """The clip as one sees it from obliquely above, with all that stands still in the picture, such as a whole bowl.

    Of what moves only the start has to be in it.
    """
    moving = {name for run in clip.runs for name in run.bodies}
    still = [reach for solid in clip.solids if solid.name not in moving for reach in _still(solid)]
    start = [reach for solid in clip.solids if solid.name in moving for reach in _still(solid)]
    low, high = _box([*still, *start]) or (clip.low, clip.high)
    return replace(clip, view=camera.INTO, low=low, high=high)


def _motion(clip: Clip, run: Run | None) -> tuple[Array, Array]:
    """Where the bodies come, (n, 3), m, and the turns that they make, (m, 3), vector parts."""
    still = [solid.position for solid in clip.solids if not isinstance(solid.shape, HalfSpace)]
    if run is None:
        return np.array(still).reshape(-1, 3), np.zeros((0, 3))
    fixed = [
        solid.position
        for solid in clip.solids
        if solid.name not in run.bodies and not isinstance(solid.shape, HalfSpace)
    ]
    places = np.concatenate(
        [np.array(fixed).reshape(-1, 3), *(run.poses[..., :3].reshape(-1, 3), run.points.reshape(-1, 3))]
    )
    turns = run.poses[..., 3:]
    made = turns[..., 1:] * turns[:1, :, :1] - turns[..., :1] * turns[:1, :, 1:]
    made = made - np.cross(turns[..., 1:], np.broadcast_to(turns[:1, :, 1:], turns[..., 1:].shape))
    return places, made.reshape(-1, 3)


def _reach(clip: Clip, run: Run) -> Iterator[Array]:
    """Lowest and highest corner, (2, 3), m, of where each body of a run comes."""
    solids = {solid.name: solid for solid in clip.solids}
    for at, name in enumerate(run.bodies if run.count else ()):
        points, radius = vertices_of(solids[name].shape)
        poses = run.poses[:, at, None]
        yield _around(poses[..., :3] + geometry.rotate(poses[..., 3:], points), radius)
    if run.points.size:
        yield _around(run.points, 0.0)


def _still(solid: Solid) -> Iterator[Array]:
    points, radius = vertices_of(solid.shape)
    if len(points):
        yield _around(np.array(solid.position) + geometry.rotate(np.array(solid.orientation), points), radius)


def _around(points: Array, radius: float) -> Array:
    points = points.reshape(-1, 3)
    return np.stack([points.min(axis=0) - radius, points.max(axis=0) + radius])


def _foot(solid: Solid, middle: Array) -> Array:
    """The point of a half-space's surface that is nearest to the middle, twice; the middle itself for other shapes."""
    if not isinstance(solid.shape, HalfSpace):
        return np.stack([middle, middle])
    normal = np.array(solid.shape.normal)
    foot = middle - normal * ((middle - solid.position) @ normal)
    return np.stack([foot, foot])


def _box(reaches: list[Array]) -> tuple[Array, Array] | None:
    if not reaches:
        return None
    return np.min([each[0] for each in reaches], axis=0), np.max([each[1] for each in reaches], axis=0)


def _widened(box: tuple[Array, Array], reaches: list[Array]) -> tuple[Array, Array]:
    """A box that holds other ones too, as far as they are near."""
    low, high = box
    most = GROWN * float(np.max(high - low))
    found = _box([np.clip(each, low - most, high + most) for each in reaches])
    return (low, high) if found is None else (np.minimum(low, found[0]), np.maximum(high, found[1]))
