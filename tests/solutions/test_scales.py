"""Numbers of any size: a change of the units by powers of two changes no digit of a result, however large it is."""

from __future__ import annotations

import importlib

import numpy as np
import pytest

from solutions.avoidance.directions import unit_or_zero
from solutions.detection import signed_distance, time_of_impact_exact
from solutions.forces import spheroid_shape_factors
from solutions.polyhedra import winding_number
from solutions.scaling import in_moderate_units, length_of, root_of_difference
from solutions.sweeping import ray_sphere, vertex_face_impact

RNG = np.random.default_rng(5)
COUNT = 6
L, M, T = np.eye(3, dtype=int)  # powers of length, mass and time
PURE = 0 * L
SPEED, FORCE = L - T, M + L - 2 * T
TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1.3, 0], [0.2, 0.1, 1.1]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
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


# For each function: its arguments, each with its unit, and the units of its results. None is a number that stays.
FALL = [(numbers(), L), (numbers() - 1, SPEED), (-numbers(), L - 2 * T)]
BALLS = [(AWAY, L), (-AWAY + vectors() / 10, SPEED), (vectors() / 10, L), (vectors() / 10, SPEED)]
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
            (unit_or_zero(vectors(4)[..., :2]), None),
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


def in_units(value, unit, change):
    """The value in other units: those of length, mass and time are smaller by powers of two."""
    with np.errstate(over="ignore"):
        return value if unit is None else np.ldexp(np.asarray(value, dtype=float), int(np.dot(unit, change)))


def representable(before, after):
    """Whether all numbers are still floats with all their digits."""
    return all(
        np.all((b == 0) | ~np.isfinite(b) | ((np.abs(a) > 1e-290) & (np.abs(a) < 1e300)))
        for a, b in zip(after, before, strict=True)
    )


def results(function, arguments, change):
    given = [in_units(value, unit, change) for value, unit in arguments]
    found = function(*given)
    return [np.asarray(part, dtype=float) for part in (found if isinstance(found, tuple) else (found,))]


CHANGES = [
    np.array(units) * sign * power
    for power in (300, 600)
    for sign in (1, -1)
    for units in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 0, -1))
]


@pytest.mark.parametrize(("name", "arguments", "units"), CASES, ids=[f"{k}-{case[0]}" for k, case in enumerate(CASES)])
def test_units_of_any_size_change_no_digit_of_a_result(name, arguments, units):
    topic, function = name.split(".")
    call = getattr(importlib.import_module(f"solutions.{topic}"), function)
    plain = results(call, arguments, (0, 0, 0))
    assert any(np.any(np.isfinite(part)) for part in plain)  # something is hit, so that there is something to lose
    tried = 0
    for change in CHANGES:
        scaled = [in_units(value, unit, change) for value, unit in arguments if unit is not None]
        expected = [in_units(value, unit, change) for value, unit in zip(plain, units, strict=True)]
        if representable([v for v, unit in arguments if unit is not None], scaled) and representable(plain, expected):
            tried += 1
            for found, right in zip(results(call, arguments, change), expected, strict=True):
                assert np.array_equal(found, right, equal_nan=True), change
    assert tried >= 4


@pytest.mark.statement(4, oracle="the distance of a plane whose normal is along an axis")
@pytest.mark.parametrize("size", [1e-300, 1e-200, 1e-160, 1e-50, 1e-14, 1e14, 1e50, 1e150, 1e200, 1e300])
def test_a_distance_does_not_depend_on_how_long_the_normal_is(size):
    assert signed_distance((1, 2, 7), (0, 0, size), -2 * size) == pytest.approx(5, rel=1e-15)
    for far in (1e-290, 1e290):  # the numbers of the normal and of the point are no floats when multiplied
        assert signed_distance((far, 2 * far, 7 * far), (0, 0, size), 0) == pytest.approx(7 * far, rel=1e-15, abs=0)
    both = signed_distance((1, 2, 7), [(0, 0, size), (0, 0, 2.0)], [-2 * size, -4.0])
    assert both == pytest.approx([5, 5], rel=1e-15)  # one normal needs another unit, its neighbour does not
    with pytest.raises(ValueError, match="normal is zero"):
        signed_distance((1, 2, 7), [(0, 0, size), (0, 0, 0)], 0)


@pytest.mark.parametrize("size", [1e-200, 1e-110, 1e110, 1e150, 1e200])
def test_rays_corners_and_winding_numbers_know_scenes_of_any_size(size):
    # three and a half radii away, off the centre by 0.6 radii
    assert ray_sphere((3.5 * size, 0.6 * size, 0), (-size, 0, 0), size) == pytest.approx(2.7, rel=1e-14)
    assert ray_sphere((3.5 * size, 0.6 * size, 0), (-1, 0, 0), size) == pytest.approx(2.7 * size, rel=1e-14)
    face = size * np.array([[0, 0, 0], [3, 0, 0], [0, 4, 0]])
    start, end = size * np.array([0.5, 1, 3]), size * np.array([0.5, 1, -1])
    assert vertex_face_impact(start, face, end, face, 1e-9 * size) == pytest.approx(0.75, abs=1e-9)
    points = size * np.array([[0.2, 0.3, 0.1], [0.2, 0.3, -0.1], [2, 0.3, 0.1]])
    assert winding_number(points, size * TETRAHEDRON, FACES) == pytest.approx([1, 0, 0], abs=1e-14)


def test_a_point_beyond_all_distances_is_outside():
    assert winding_number([[1e200, 0, 0], [0.2, 0.3, 0.1]], TETRAHEDRON, FACES) == pytest.approx([0, 1], abs=1e-14)
    assert winding_number([1e300, 1e300, 0], 1e-200 * TETRAHEDRON, FACES) == 0


@pytest.mark.parametrize(
    ("along", "across"), [(1e200, 1.0), (1e200, 1e-100), (1.0, 1e200), (3e-200, 3e-200), (3e200, 3e200)]
)
def test_needles_and_discs_of_any_size_have_their_drag(along, across):
    needle, disc = 4 * np.pi * along / (np.log(2 * along / across) - 0.5), 16 * across
    sphere = 6 * np.pi * along
    expected = needle if along > across else disc if along < across else sphere
    assert spheroid_shape_factors(along, across)[0] == pytest.approx(expected, rel=1e-12)  # terms of b²/a² are left out


def test_a_fall_of_any_length_takes_the_time_that_it_takes():
    # s = a t²/2, and a throw upwards that comes back after 2 u/a
    assert time_of_impact_exact(2e-200, 0.0, -1e-200) == pytest.approx(2, rel=1e-15)
    assert time_of_impact_exact(0.0, 1e-200, -1.0) == pytest.approx(2e-200, rel=1e-15)
    assert time_of_impact_exact(1.0, -1e200, -1.0) == pytest.approx(1e-200, rel=1e-15)
    assert time_of_impact_exact([1e200, 1.0], 1e200, -1e200) == pytest.approx([1 + 3**0.5, 2], rel=1e-15)


@pytest.mark.parametrize("others", [[], [[3.0, 4, 12]], [[0.0, 0, 0]]])
@pytest.mark.parametrize("size", [2.0**-1060, 2.0**-540, 2.0**540, 2.0**1018])
def test_lengths_of_any_size_are_exact(size, others):
    many = np.array([[3 * size, 4 * size, 12 * size], *others])
    assert length_of(many).tolist() == [13 * size, *np.linalg.norm(np.reshape(others, (-1, 3)), axis=-1)]
    vector, length, unit = in_moderate_units(many)
    assert np.array_equal(vector * unit[..., None], many)
    assert np.array_equal(length * unit, length_of(many))


def test_roots_of_differences_are_exact_and_nan_where_there_is_none():
    sizes = np.array([2.0**-900, 2.0**-500, 1.0, 2.0**500, 2.0**900])
    assert np.array_equal(root_of_difference(5 * sizes, 4 * sizes, 4 * sizes), 3 * sizes)
    assert np.array_equal(root_of_difference(0 * sizes, -sizes, 4 / sizes), 0 * sizes + 2)
    assert np.all(np.isnan(root_of_difference(sizes, 2 * sizes, sizes)))
    assert np.array_equal(root_of_difference(0 * sizes, sizes, 0 * sizes), 0 * sizes)
    assert length_of(np.zeros((0, 3))).shape == (0,)
