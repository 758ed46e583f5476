"""A bowl of four slanting walls, and what a ball that falls into it meets: its inner faces, or the lid of its hull."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.checks import Vector
from reference.engines import pybullet_settings
from reference.engines.base import DART, MUJOCO_ONE_STEP, Method
from reference.engines.surveying import CONTACTS_OF, HULL
from reference.prediction import bands, loaded, striking
from reference.prediction.predicted import Prediction
from reference.scene import geometry
from reference.scene.polyhedron import Polyhedron, Triangle
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RIM = 0.5
"""Height of the rim above the underside, m: the same all round, so that the hull's lid is level."""
OUTER = ((-0.875, 0.6875), (-0.625, 0.75))
"""Outer sides of the walls along x and y, m."""
WALLS = ((0.25, 0.1875), (0.125, 0.3125))
"""Widths of the same walls at the rim, m."""
TAPER = 1.25
"""How much wider each wall is at the floor."""
SIZE = 1.5625
"""Of the bowl, from side to side, m."""
FLAT = 1e-9
"""m; a length below this is zero."""


def _ring(wider: float, height: float) -> tuple[Vector, ...]:
    """The corners of a level rectangle, so many widths of the walls from the outer sides: (4, 3), m."""
    (left, right), (front, back) = (
        (low + wider * first, high - wider * second) for (low, high), (first, second) in zip(OUTER, WALLS, strict=True)
    )
    return tuple((x, y, height) for x, y in ((left, front), (right, front), (right, back), (left, back)))


def bowl(depth: float) -> Polyhedron:
    """A bowl whose floor lies so far below the rim, m. Its convex pieces are the floor and the four walls.

    Outer side, rim and floor of each corner lie in one vertical plane, so that two walls meet in a flat face.
    """
    vertices = (*_ring(0, 0.0), *_ring(0, RIM), *_ring(1, RIM), *_ring(TAPER, RIM - depth))
    faces = [*_quad(3, 2, 1, 0), *_quad(12, 13, 14, 15)]
    pieces: list[tuple[int, ...]] = [(0, 1, 2, 3, 12, 13, 14, 15)]
    for corner in range(4):
        after = (corner + 1) % 4
        for ring in (0, 4, 8):
            faces += _quad(ring + corner, ring + after, ring + 4 + after, ring + 4 + corner)
        pieces.append(tuple(ring + each for ring in (0, 4, 8, 12) for each in (corner, after)))
    return Polyhedron(vertices, tuple(faces), tuple(pieces))


def block() -> Polyhedron:
    """The hull of the bowl: what is left if its pocket is filled up to the rim."""
    faces = [*_quad(3, 2, 1, 0), *_quad(4, 5, 6, 7)]
    for corner in range(4):
        after = (corner + 1) % 4
        faces += _quad(corner, after, 4 + after, 4 + corner)
    return Polyhedron((*_ring(0, 0.0), *_ring(0, RIM)), tuple(faces))


def _quad(a: int, b: int, c: int, d: int) -> tuple[Triangle, Triangle]:
    return (a, b, c), (a, c, d)


def levels(shape: Polyhedron) -> list[float]:
    """Heights of the level faces that a ball from above may rest on, m: the floor and the rim, or the rim alone."""
    return [RIM - depth_of(shape), RIM] if depth_of(shape) else [RIM]


def depth_of(shape: Polyhedron) -> float:
    """How far the floor lies below the rim, m; 0 for a block."""
    return RIM - float(shape.points[-1, 2])


def inner_faces(shape: Polyhedron) -> Iterator[tuple[Array, Array]]:
    """A corner and the unit normal, in the solid's own axes, of each face that does not lie on its hull."""
    seen = set()
    for a, b, c in shape.triangles:
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal)
        key = (*np.round(normal, 9), round(float(normal @ a), 9))
        if np.any((shape.points - a) @ normal > FLAT) and key not in seen:
            seen.add(key)
            yield a, normal


# What a method must give


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The recurrence of the method for a ball that meets the flat faces that the solid has for it."""
    solid, ball = scenario.body("solid"), scenario.body("ball")
    faces = [_half_space(solid, number, *face) for number, face in enumerate(_met(solid, settings, method))]
    restitution = scenario.pairs[0].restitution
    pairs = tuple(Pair("ball", face.name, restitution) for face in faces)
    flat = Scenario(scenario.name, (ball, *faces), pairs, scenario.duration, scenario.gravity)
    found = striking.predict(flat, settings, method) if faces else loaded.predict(flat, settings, method)
    if found is None:
        return None
    found = replace(found, trajectory=told_of(scenario, found.trajectory))
    if method.rule in (MUJOCO_ONE_STEP, DART):
        assert isinstance(solid.shape, Polyhedron)
        return replace(found, terms=(*found.terms, bands.mesh_in_single(solid.shape)))
    return found


def _met(solid: Body, settings: Settings, method: Method) -> list[tuple[Array, Array]]:
    """A point and the normal of each face that the method has for a ball from above, in the solid's own axes."""
    assert isinstance(solid.shape, Polyhedron)
    if falls_through(settings, method):
        return []
    if settings.options.get(CONTACTS_OF) == HULL or not depth_of(solid.shape):
        return [(np.array([0.0, 0.0, RIM + margin_of(settings)]), np.array([0.0, 0.0, 1.0]))]
    return list(inner_faces(solid.shape))


def falls_through(settings: Settings, method: Method) -> bool:
    """Whether no mesh holds a ball: in DART with the Flexible Collision Library, which is its default.

    That library gives the depth of a ball in a mesh as a negative number. DART leaves such contacts out.
    """
    return method.rule == DART and settings.options.get("detector", "fcl") == "fcl"


def margin_of(settings: Settings) -> float:
    """By how much Bullet makes a hull thicker, m."""
    is_hull = settings.options.get(CONTACTS_OF) == HULL and "coordinates" in settings.options
    return pybullet_settings.MARGIN if is_hull else 0.0


def _half_space(solid: Body, number: int, place: Array, normal: Array) -> Body:
    turn = np.array(solid.orientation)
    x, y, z = (float(each) for each in np.array(solid.position) + geometry.rotate(turn, place))
    a, b, c = (float(each) for each in geometry.rotate(turn, normal))
    return Body(f"face {number}", HalfSpace((a, b, c)), position=(x, y, z))


def told_of(scenario: Scenario, trajectory: Trajectory) -> Trajectory:
    """A trajectory of the same ball as one of another scenario, whose other bodies stay where they are."""
    states = np.tile(np.array([body.state() for body in scenario.bodies]), (len(trajectory.times), 1, 1))
    for place, body in enumerate(scenario.bodies):
        if any(body.name == known.name for known in trajectory.scenario.bodies):
            parts = trajectory.position, trajectory.orientation, trajectory.velocity, trajectory.angular_velocity
            states[:, place] = np.concatenate([part(body.name) for part in parts], axis=-1)
    position, orientation, velocity, spin = np.split(states, (3, 7, 10), axis=-1)
    return Trajectory(
        scenario, trajectory.settings, trajectory.engine, trajectory.times, position, orientation, velocity, spin,
        events=trajectory.events,
    )  # fmt: skip
