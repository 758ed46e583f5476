"""Numbers from 1e-60 to 1e60: a change of the units by powers of two changes no digit of a result."""

from __future__ import annotations

from functools import partial
from importlib import import_module

import numpy as np
import pytest

import solutions.meshes
from solutions.vectors import direction

RNG = np.random.default_rng(5)
COUNT = 6
L, M, T = np.eye(3, dtype=int)  # powers of length, mass and time
PURE = 0 * L
SPEED, FORCE = L - T, M + L - 2 * T
TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1.3, 0], [0.2, 0.1, 1.1]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
SOFT, EDGES = solutions.meshes.lattice(2, 2, 2, 1.0)
BOX = np.stack(np.meshgrid([-1, 1.3], [-0.8, 1], [-1.2, 0.9]), axis=-1).reshape(-1, 3)


def vectors(*shape):
    return RNG.normal(size=(COUNT, *shape, 3))


def numbers(*shape):
    return RNG.uniform(0.5, 2, (COUNT, *shape))


def directions():
    return vectors() / np.linalg.norm(vectors(), axis=-1, keepdims=True)


NORMAL = vectors()
NORMAL /= np.linalg.norm(NORMAL, axis=-1, keepdims=True)
TRIANGLE = vectors(3)
MIDDLE = TRIANGLE.mean(axis=1)
AWAY = vectors() + 4


def along_surface(vector):
    return vector - np.vecdot(vector, NORMAL)[..., None] * NORMAL


def cloth(step, rest, position, velocity, gravity, stiffness, damping, mass, dt):
    """One step of a block of springs with a corner that is pinned."""
    mesh = solutions.meshes.spring_mesh(rest, EDGES, stiffness, damping, mass, pinned=[3])
    return getattr(solutions.meshes, step)(mesh, position, velocity, gravity, dt)


# For each function: its arguments, each with its unit, and the units of its results. None is a number that stays.
FALL = [(numbers(), L), (numbers() - 1, SPEED), (-numbers(), L - 2 * T)]
BALLS = [(AWAY, L), (-AWAY + vectors() / 10, SPEED), (vectors() / 10, L), (vectors() / 10, SPEED)]
MESH = [
    (SOFT, L),
    (SOFT + 0.2 * vectors(8), L),
    (vectors(8), SPEED),
    (np.array([0, 0, -9.81]), L - 2 * T),
    (10.0, FORCE - L),
    (0.1, FORCE - SPEED),
    (1.0, M),
    (0.1, T),
]
ROOTS = RNG.normal(size=(COUNT, 3, 3))
IMPACT = [
    (vectors() - 3 * NORMAL, SPEED),
    (NORMAL, None),
    (ROOTS @ np.swapaxes(ROOTS, 1, 2) + np.eye(3), -M),
    (numbers() / 2, None),
    (numbers() / 2, None),
]
CASES = [
    ("detection.signed_distance", [(vectors(), L), (vectors(), PURE), (numbers(), L)], [L]),
    ("detection.signed_distance", [(vectors(), PURE), (vectors(), L), (numbers(), L)], [PURE]),
    ("detection.time_of_impact_exact", FALL, [T]),
    ("response.time_until_rest", [*FALL, (numbers() / 2, None)], [T]),
    (
        "response.bounce_along_normal",
        [*FALL, (numbers() / 2, None), (3 * numbers(), T)],
        [L, SPEED, PURE, T],
    ),
    ("friction.holds", [(vectors(), FORCE), (numbers(), FORCE), (numbers(), None)], [PURE]),
    (
        "friction.friction_force",
        [(vectors(), FORCE), (vectors(), SPEED), (numbers(), FORCE), (numbers() + 1, None), (numbers() / 2, None)],
        [FORCE],
    ),
    ("friction.clamp_to_circle", [(vectors(), FORCE), (numbers() / 2, FORCE)], [FORCE]),
    (
        "friction.sliding_motion",
        [
            (vectors(), L),
            (along_surface(vectors()), SPEED),
            (along_surface(vectors()), FORCE),
            (numbers(), FORCE),
            (numbers() + 1, None),
            (numbers() / 2, None),
            (numbers(), M),
            (numbers(), T),
        ],
        [L, SPEED, T],
    ),
    (
        "friction.break_away_time",
        [(-5 * NORMAL + vectors() / 9, FORCE), (vectors(), FORCE - T), (NORMAL, None), (numbers(), None)],
        [T],
    ),
    *((f"friction.{law}_impulse", IMPACT, [M + SPEED]) for law in ("friction", "dissipative", "poisson", "stronge")),
    *((f"meshes.{step}", MESH, [L, SPEED]) for step in ("mesh_step", "implicit_mesh_step")),
    ("impulse.point_plane_normal", [(vectors(), L), (vectors(), L), (vectors(), L)], [PURE]),
    ("impulse.edge_edge_normal", [(vectors(), L), (vectors(), L), (vectors(), L), (vectors(), L)], [PURE]),
    ("polyhedra.face_planes", [(TETRAHEDRON, L), (FACES, None)], [PURE, L]),
    ("polyhedra.convex_separation", [(vectors(), L), (TETRAHEDRON, L), (FACES, None)], [L, PURE]),
    ("polyhedra.winding_number", [(numbers(3) / 9, L), (TETRAHEDRON, L), (FACES, None)], [PURE]),
    ("polyhedra.inside_by_parity", [(numbers(3) / 9, L), (TETRAHEDRON, L), (FACES, None)], [PURE]),
    ("polyhedra.segment_triangle", [(MIDDLE + 3 * NORMAL, L), (MIDDLE - NORMAL, L), (TRIANGLE, L)], [PURE, PURE]),
    ("sweeping.ray_sphere", [*BALLS[:2], (numbers() / 2, L)], [T]),
    ("sweeping.ray_capsule", [*BALLS[:2], (vectors(), L), (-vectors(), L), (numbers(), L)], [T]),
    ("sweeping.ray_box", [*BALLS[:2], (np.abs(vectors()), L)], [T, T]),
    (
        "sweeping.sweep_sphere_plane",
        [
            (vectors(), L),
            (vectors(), SPEED),
            (numbers() / 9, L),
            (vectors(), PURE),
            (numbers() + 3, L),
            (99 * numbers(), T),
        ],
        [T],
    ),
    ("sweeping.nearest_on_triangle", [(vectors(), L), (TRIANGLE, L)], [PURE]),
    ("sweeping.separation_of_hulls", [(BOX, L), (vectors(4) + 5, L)], [L, PURE]),
    (
        "sweeping.vertex_face_impact",
        [(5 * AWAY, L), (TRIANGLE, L), (-5 * AWAY, L), (TRIANGLE, L), (1e-6 * numbers(), L)],
        [PURE],
    ),
    ("sweeping.motion_bound", [(vectors(), SPEED), (vectors(), -T), (numbers(), L), (NORMAL, None)], [SPEED]),
    ("forces.surface_gravity", [(numbers(), M), (numbers(), L)], [M - 2 * L]),
    (
        "forces.universal_gravity",
        [(numbers(), M), (numbers(), M), (vectors(), L), (vectors(), L), (numbers(), L)],
        [2 * M - 2 * L],
    ),
    ("forces.spring_force", [(vectors(), L), (vectors(), L), (numbers(), FORCE - L), (numbers(), L)], [FORCE]),
    ("forces.damping_ratio", [(numbers(), FORCE - L), (numbers(), FORCE - SPEED), (numbers(), M)], [PURE]),
    ("forces.spheroid_shape_factors", [(numbers(), L), (numbers(), L)], [L]),
    (
        "forces.wind_force",
        [(vectors(), SPEED), (vectors(), SPEED), (numbers(), 2 * L), (numbers(), None), (numbers(), M - 3 * L)],
        [FORCE],
    ),
    ("avoidance.nearest_approach", BALLS, [T, L]),
    ("avoidance.tangent_point", [(vectors(), L), (vectors(), SPEED), (vectors(), L), (numbers() / 2, L)], [L]),
    ("avoidance.is_in_the_way", [(vectors(), L), (vectors(), L), (vectors(), L), (numbers(), L)], [PURE]),
    ("avoidance.limited", [(vectors(), SPEED), (numbers() / 2, SPEED)], [SPEED]),
    (
        "friction.sphere_impact",
        [
            (vectors() - 2 * NORMAL, SPEED),
            (vectors(), -T),
            (NORMAL, None),
            (numbers(), L),
            (numbers() / 2, None),
            (numbers() / 9, None),
        ],
        [SPEED, -T],
    ),
    (
        "response.tangential_spring",
        [
            (vectors(), L),
            (vectors(), SPEED),
            (NORMAL, None),
            (numbers(), FORCE),
            (numbers(), None),
            (numbers(), FORCE - L),
            (numbers(), FORCE - SPEED),
            (numbers(), T),
        ],
        [FORCE, L],
    ),
    (
        "avoidance.permitted_velocity",
        [
            (vectors()[:, :2], SPEED),
            (numbers() * 2, SPEED),
            (vectors(4)[..., :2] / 2, SPEED),
            (direction(vectors(4)[..., :2]), None),
        ],
        [SPEED],
    ),
    (
        "avoidance.crowd_step",
        [
            (vectors()[:, :2], L),
            (vectors()[:, :2], SPEED),
            (vectors()[:, :2], SPEED),
            (numbers() / 9, L),
            (numbers() * 2, SPEED),
            (2.0, T),
            (0.5, T),
            (2 * numbers(), L),
            (3, None),
        ],
        [L, SPEED],
    ),
    (
        "avoidance.orca_half_plane",
        [
            (vectors()[:, :2], L),
            (vectors()[:, :2], SPEED),
            (numbers() / 9, L),
            (vectors()[:, :2], L),
            (vectors()[:, :2], SPEED),
            (numbers() / 9, L),
            (numbers(), T),
            (numbers(), T),
        ],
        [SPEED, PURE],
    ),
]


CHANGES = [
    np.array(units) * sign * power
    for power in (66, 133, 190)  # some 1e20, 1e40 and 1e57
    for sign in (1, -1)
    for units in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 0, -1))
]


def in_units(value, unit, change):
    """The value in other units: those of length, mass and time are smaller by powers of two."""
    return value if unit is None else np.ldexp(np.asarray(value, dtype=float), int(np.dot(unit, change)))


def in_range(values):
    """Whether all numbers that are not 0 or infinite are from 1e-60 to 1e60."""
    sizes = [np.abs(value) for value in values]
    return all(np.all((s == 0) | ~np.isfinite(s) | ((s > 1e-60) & (s < 1e60))) for s in sizes)


def results(function, arguments, change):
    found = function(*(in_units(value, unit, change) for value, unit in arguments))
    return [np.asarray(part, dtype=float) for part in (found if isinstance(found, tuple) else (found,))]


@pytest.mark.parametrize(("name", "arguments", "units"), CASES, ids=[f"{k}-{case[0]}" for k, case in enumerate(CASES)])
def test_other_units_change_no_digit_of_a_result(name, arguments, units):
    topic, function = name.split(".")
    call = partial(cloth, function) if topic == "meshes" else getattr(import_module(f"solutions.{topic}"), function)
    plain = results(call, arguments, (0, 0, 0))
    assert any(np.any(np.isfinite(part)) for part in plain)  # something is hit, so that there is something to lose
    tried = 0
    for change in CHANGES:
        scaled = [in_units(value, unit, change) for value, unit in arguments if unit is not None]
        expected = [in_units(value, unit, change) for value, unit in zip(plain, units, strict=True)]
        if in_range(scaled) and in_range(expected):
            tried += 1
            for found, right in zip(results(call, arguments, change), expected, strict=True):
                assert np.array_equal(found, right, equal_nan=True), change
    assert tried >= 4
