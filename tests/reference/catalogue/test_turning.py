"""Numbers of bodies that turn, against motions whose spin, slip and tilt are known."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from reference.catalogue import turning
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.25
SLOPE = math.radians(25)
NORMAL = (math.sin(SLOPE), 0.0, math.cos(SLOPE))
SEED = 11
GRAVITY = 9.81


def made(shape, times, positions, orientations=None, velocities=0.0, spins=0.0, normal=(0.0, 0.0, 1.0)) -> Trajectory:
    """A trajectory of one body over a plane; what is left out stands still, or is upright."""
    count = len(times)
    scenario = Scenario(
        "made", (Body("plane", HalfSpace(normal)), Body("body", shape, 2.0)), (Pair("body", "plane"),), 1.0
    )
    states = [np.zeros((count, 2, width)) for width in (3, 4, 3, 3)]
    states[1][..., 0] = 1.0
    for values, found in zip(states, (positions, orientations, velocities, spins), strict=True):
        if found is not None:
            values[:, 1] = found
    return Trajectory(scenario, Settings(1e-3), "made", np.array(times), *states)


def turned(axis, angle) -> np.ndarray:
    axis = np.array(axis) / np.linalg.norm(axis)
    return np.array([math.cos(angle / 2), *(math.sin(angle / 2) * axis)])


def product(left, right) -> np.ndarray:
    """Hamilton product: the turn `right`, then the turn `left`."""
    w, q, v, r = left[0], left[1:], right[0], right[1:]
    return np.array([w * v - q @ r, *(w * r + v * q + np.cross(q, r))])


# Slip


@pytest.mark.parametrize("normal", [(0.0, 0.0, 1.0), NORMAL, (0.0, -1.0, 0.0)])
def test_the_slip_is_the_speed_of_the_lowest_point_along_the_plane(normal):
    rng, normal = np.random.default_rng(SEED), np.array(normal)
    velocities, spins = rng.normal(size=(20, 3)), rng.normal(size=(20, 3))
    found = turning.slip(
        made(Sphere(RADIUS), np.arange(20.0), 0.0, None, velocities, spins, tuple(normal)), "body", "plane"
    )
    tiny = 1e-6
    for slip, velocity, spin in zip(found, velocities, spins, strict=True):
        # Where the material point is that was lowest, a little later: the ball has moved on and turned.
        turn = turned(spin, np.linalg.norm(spin) * tiny)
        moved = velocity * tiny + geometry.rotate(turn, -RADIUS * normal) + RADIUS * normal
        along = moved - (moved @ normal) * normal
        assert slip == pytest.approx(np.linalg.norm(along) / tiny, abs=1e-5)  # ω² r tiny/2 of a turning point


def test_a_rolling_ball_does_not_slip_and_backspin_doubles_the_slip():
    for spin, slip in ((2.0 / RADIUS, 0.0), (0.0, 2.0), (-2.0 / RADIUS, 4.0)):
        rolls = made(Sphere(RADIUS), [0.0, 1.0], 0.0, None, (2.0, 0.0, 0.0), (0.0, spin, 0.0))
        assert turning.slip(rolls, "body", "plane") == pytest.approx([slip, slip], abs=1e-15)


def test_spin_about_the_normal_and_speed_along_it_cause_no_slip():
    spins = made(Sphere(RADIUS), [0.0, 1.0], 0.0, None, 3.0 * np.array(NORMAL), 7.0 * np.array(NORMAL), NORMAL)
    assert turning.slip(spins, "body", "plane") == pytest.approx([0.0, 0.0], abs=1e-15)


def test_only_a_ball_slips_and_only_over_a_plane():
    with pytest.raises(RunFailed, match="body is a Box; only a sphere rolls"):
        turning.slip(made(Box((1.0, 1.0, 1.0)), [0.0, 1.0], 0.0), "body", "plane")
    with pytest.raises(RunFailed, match="body is a Sphere, not a half-space"):
        turning.slip(made(Sphere(1.0), [0.0, 1.0], 0.0), "body", "body")


# When it begins to roll


def slipping(times, slips) -> Trajectory:
    velocities = np.zeros((len(times), 3))
    velocities[:, 0] = slips
    return made(Sphere(RADIUS), times, 0.0, None, velocities)


@pytest.mark.parametrize("end", [0.401, 0.45, 0.4999, 0.7])
def test_rolling_begins_where_the_line_of_falling_slip_meets_zero(end):
    times = np.arange(11) / 10
    found = turning.rolling_time(slipping(times, np.maximum(0.0, 3.0 * (end - times))), "body", "plane")
    assert found == pytest.approx(end, abs=1e-14)  # rounding: a line is read from two of its points


def test_without_a_line_rolling_begins_at_the_first_sample_without_slip():
    times = [0.0, 0.1, 0.2, 0.3]
    for slips, expected in (
        ([0.0, 0.0, 0.0, 0.0], 0.0),  # it rolls from the start
        ([1.0, 0.0, 0.0, 0.0], 0.1),  # a single sample that slips
        ([0.5, 1.0, 0.0, 0.0], 0.2),  # slip that grew
        ([1.0, 1.0, 0.0, 0.0], 0.2),  # or stayed
        ([2.0, 1.9, 0.0, 0.0], 0.2),  # a line that would meet zero at 2.0 s, when it has long been over
    ):
        assert turning.rolling_time(slipping(times, slips), "body", "plane") == pytest.approx(expected, abs=1e-15)


def test_a_ball_that_slips_again_rolls_only_from_the_last_time_on():
    times, slips = np.arange(7) / 10, [1.0, 0.5, 0.0, 0.8, 0.6, 0.0, 0.0]
    # 2 m/s² from 0.6 m/s at 0.4 s would end at 0.7 s, after the first sample without slip: that sample it is.
    assert turning.rolling_time(slipping(times, slips), "body", "plane") == pytest.approx(0.5, abs=1e-15)
    slips[3:5] = [1.5, 0.5]  # 10 m/s²
    assert turning.rolling_time(slipping(times, slips), "body", "plane") == pytest.approx(0.45, abs=1e-15)


def test_a_ball_that_slips_to_the_end_never_rolls():
    assert turning.rolling_time(slipping([0.0, 0.1, 0.2], [2.0, 1.0, 0.5]), "body", "plane") == math.inf
    assert turning.rolling_time(slipping([0.0, 0.1, 0.2], [0.0, 0.0, 0.5]), "body", "plane") == math.inf


def test_slip_below_a_millimetre_a_second_counts_as_none():
    times = [0.0, 0.1, 0.2, 0.3]
    for slip, expected in ((1e-3, 0.0), (1.001e-3, math.inf)):
        assert turning.rolling_time(slipping(times, [slip] * 4), "body", "plane") == expected
    for last, expected in ((1e-3, 0.2), (1.1e-3, 0.2 + 1.1e-3 * 0.1 / (0.1 - 1.1e-3))):
        found = turning.rolling_time(slipping(times, [0.2, 0.1, last, 0.0]), "body", "plane")
        assert found == pytest.approx(expected, abs=1e-15)


@functools.cache
def integrated(speed, spin, friction=0.4, dt=2e-5, duration=0.5):
    """A ball set down on a floor with any speed and spin, in small explicit steps: a state every millisecond.

    The lowest point is at a = (0, 0, −r): it slips with v + ω × a, where ω × a = (−r ω_y, r ω_x, 0), and a push F
    there turns the ball with a × F = (r F_y, −r F_x, 0).
    """
    (vx, vy), (wx, wy, wz), x, y, states, start = speed, spin, 0.0, 0.0, [], None
    for step in range(round(duration / dt) + 1):
        if step % round(1e-3 / dt) == 0:
            states.append((x, y, RADIUS, vx, vy, 0.0, wx, wy, wz))
        slip_x, slip_y = vx - RADIUS * wy, vy + RADIUS * wx
        size = math.hypot(slip_x, slip_y)
        if size < 3.5 * friction * GRAVITY * dt:  # the next step would turn it round: it rolls
            start = step * dt if start is None else start
        else:
            push_x, push_y = (-friction * GRAVITY * slip / size * dt for slip in (slip_x, slip_y))
            vx, vy = vx + push_x, vy + push_y
            wx, wy = wx + push_y / (0.4 * RADIUS), wy - push_x / (0.4 * RADIUS)
        x, y = x + vx * dt, y + vy * dt
    return np.array(states), start


@pytest.mark.parametrize(
    ("speed", "spin"), [((2.0, 0.0), (0, 0, 0)), ((1.0, 0.5), (3, 9, -4)), ((0.5, 0.0), (0, -9, 0))]
)
@pytest.mark.parametrize("every", [1, 10])  # ms
def test_the_start_and_speed_of_rolling_agree_with_integration(every, speed, spin):
    states, start = integrated(speed, spin)
    places, velocities, spins = np.split(states[::every], 3, axis=1)
    trajectory = made(Sphere(RADIUS), 1e-3 * every * np.arange(len(places)), places, None, velocities, spins)
    assert 0.05 < start < 0.45
    # The slip falls along a straight line, also in two dimensions; a step of 2e-5 s, and 1e-3 m/s over 7/2 μ g.
    assert turning.rolling_time(trajectory, "body", "plane") == pytest.approx(start, abs=1e-4)
    # Angular momentum about a point of the floor: v + 2/5 r ω × ẑ is the same at the end, where r ω × ẑ is v.
    spin_part = 0.4 * RADIUS * np.cross(spin, (0, 0, 1))
    end = np.linalg.norm((np.array([*speed, 0.0]) + spin_part) / 1.4)
    assert turning.speed_along(trajectory, "body", "plane") == pytest.approx(
        end, abs=1e-4
    )  # a step of slip is left, 3e-4 m/s
    flat = trajectory.angular_velocity("body")[-1] * [1, 1, 0]
    assert np.linalg.norm(flat) * RADIUS == pytest.approx(end, abs=2e-4)


# Speeds at the end


def test_the_speed_along_a_plane_leaves_out_the_normal_part():
    along = np.array([math.cos(SLOPE), 0.0, -math.sin(SLOPE)])
    for across, expected in ((0.0, 3.0), (-5.0, 3.0), (2.0, 3.0)):
        velocities = np.array([[9.0, 9.0, 9.0], 3.0 * along + across * np.array(NORMAL)])
        trajectory = made(Sphere(RADIUS), [0.0, 1.0], 0.0, None, velocities, 0.0, NORMAL)
        assert turning.speed_along(trajectory, "body", "plane") == pytest.approx(expected, abs=1e-14)
    sideways = made(Sphere(RADIUS), [0.0, 1.0], 0.0, None, 3.0 * along + np.array([0.0, 4.0, 0.0]), 0.0, NORMAL)
    assert turning.speed_along(sideways, "body", "plane") == pytest.approx(5.0, abs=1e-14)


def test_the_speed_of_a_surface_is_the_radius_times_the_spin_at_the_end():
    trajectory = made(Sphere(RADIUS), [0.0, 1.0], 0.0, None, 0.0, [[1.0, 1.0, 1.0], [2.0, -3.0, 6.0]])
    assert turning.surface_speed(trajectory, "body") == pytest.approx(7 * RADIUS, rel=1e-15)


# Tilt and lean


BOX = Box((0.1, 0.2, 0.3))
ONTO_SLOPE = geometry.quaternion_between(np.array([0.0, 0.0, 1.0]), np.array(NORMAL))


def standing(turns, normal=(0.0, 0.0, 1.0)) -> Trajectory:
    return made(BOX, np.arange(float(len(turns))), 0.0, np.array(turns), normal=normal)


@pytest.mark.parametrize("axis", [(0.0, 1.0, 0.0), (1.0, 0.0, 0.0)])
def test_the_tilt_of_a_box_is_the_angle_from_its_nearest_face(axis):
    degrees = np.array([0.0, 10.0, 44.0, 45.0, 46.0, 80.0, 90.0, 100.0, 180.0, 260.0])
    found = turning.tilt(standing([turned(axis, math.radians(angle)) for angle in degrees]), "body", "plane")
    # Rounding of a cosine near 1 makes an angle of 1e-8 of nothing.
    assert np.degrees(found) == pytest.approx([0, 10, 44, 45, 44, 10, 0, 10, 0, 10], abs=2e-6)


def test_the_lean_of_a_box_is_the_angle_from_its_first_orientation():
    degrees = np.array([20.0, 20.0, 65.0, 110.0, 200.0, 230.0])
    found = turning.lean(standing([turned((0, 1, 0), math.radians(angle)) for angle in degrees]), "body", "plane")
    assert np.degrees(found) == pytest.approx([0, 0, 45, 90, 180, 150], abs=2e-6)


def test_turning_about_the_planes_normal_is_neither_tilt_nor_lean():
    turns = [product(turned(NORMAL, angle), ONTO_SLOPE) for angle in (0.0, 1.0, 2.0, 3.0)]
    trajectory = standing(turns, NORMAL)
    assert turning.tilt(trajectory, "body", "plane") == pytest.approx(np.zeros(4), abs=5e-8)  # √(1e-16), and a few
    assert turning.lean(trajectory, "body", "plane") == pytest.approx(np.zeros(4), abs=5e-8)


def test_the_tilt_of_a_box_is_relative_to_its_slope():
    upright = standing([turned((0, 1, 0), 0.0), ONTO_SLOPE], NORMAL)
    assert turning.tilt(upright, "body", "plane") == pytest.approx([SLOPE, 0.0], abs=5e-8)
    assert turning.lean(upright, "body", "plane") == pytest.approx([0.0, SLOPE], abs=5e-8)


@pytest.mark.parametrize(
    ("axis", "degrees", "face"),
    [
        ((0, 0, 1), 70, 3),  # as it was made: its lower z face is below
        ((1, 0, 0), 180, -3),
        ((0, 1, 0), 90, -1),  # z goes to x, and x to −z: its upper x face is below
        ((0, 1, 0), -90, 1),
        ((1, 0, 0), 90, 2),  # y goes to z: its lower y face is below
        ((1, 0, 0), -90, -2),
        ((0, 1, 0), 44, 3),
        ((0, 1, 0), 46, -1),
    ],
)
def test_the_face_below_is_named_by_its_own_axis_and_side(axis, degrees, face):
    turn = turned(axis, math.radians(degrees))
    assert turning.face_down(standing([turned((1, 0, 0), 2.0), turn]), "body", "plane") == face
    # And by brute force: of the centres of the six faces, the lowest.
    centres = np.concatenate([np.diag(BOX.half_extents), -np.diag(BOX.half_extents)])
    units = np.sign(centres)
    lowest = units[np.argmin(geometry.rotate(turn, units)[:, 2])]
    assert face == -int(lowest @ [1, 2, 3])


# Where it was


def test_a_position_between_two_samples_lies_on_the_line_between_them():
    places = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, -4.0], [1.0, 0.0, 0.0]])
    trajectory = made(Sphere(RADIUS), [0.0, 0.5, 1.5], places)
    for time, expected in (
        (0.0, (0, 0, 0)),
        (0.125, (0.25, 0.5, -1.0)),
        (0.5, (1, 2, -4)),
        (1.0, (1, 1, -2)),
        (1.5, (1, 0, 0)),
    ):
        assert turning.position_at(trajectory, "body", time) == pytest.approx(np.array(expected), abs=1e-15)
