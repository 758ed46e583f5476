"""Rest, distances, gaps, energy and momentum, read from made-up trajectories."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from made_up import HEIGHT, RADIUS, G, bouncing, scenario, trajectory, upright

from reference.catalogue import measure
from reference.errors import RunFailed
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

# Rest


def slowing(times, stop=0.6, speed=3.0):
    """A body that slides along x and stops at `stop` s: positions and velocities."""
    moving = np.minimum(times, stop)
    way = speed * (moving - moving**2 / (2 * stop))
    velocity = np.where(times < stop, speed * (1 - times / stop), 0.0)
    return np.stack((way, 0 * way, 0 * way + RADIUS), axis=1), velocity[:, None] * (1.0, 0.0, 0.0)


TIMES = np.arange(0, 1.001, 0.01)


def test_the_time_of_rest_is_the_first_sample_that_stays_still():
    assert measure.rest_time(trajectory(TIMES, *slowing(TIMES, stop=0.605)), "ball") == pytest.approx(0.61, abs=1e-12)


def test_a_body_slower_than_a_millimetre_a_second_rests():
    position, velocity = slowing(TIMES, stop=0.6)
    velocity[70, 1] = 0.999e-3
    assert measure.rest_time(trajectory(TIMES, position, velocity), "ball") == pytest.approx(0.6, abs=1e-12)
    velocity[70, 1] = 1.001e-3
    assert measure.rest_time(trajectory(TIMES, position, velocity), "ball") == pytest.approx(0.71, abs=1e-12)
    assert measure.rest_time(trajectory(TIMES, position, velocity), "ball", speed=0.5) == pytest.approx(0.5, abs=1e-12)


def test_a_body_that_is_slow_for_a_moment_does_not_rest():
    velocity = np.cos(np.pi * TIMES)[:, None] * (1.0, 0.0, 0.0)  # it turns round at 0.5 s
    made = trajectory(TIMES, np.sin(np.pi * TIMES)[:, None] * (1.0, 0.0, 0.0), velocity)
    assert measure.rest_time(made, "ball") == math.inf


def test_a_body_that_never_moved_rests_from_the_start():
    assert measure.rest_time(trajectory(TIMES + 0.5, upright(0 * TIMES), (0.0, 0.0, 0.0)), "ball") == 0.5


@pytest.mark.parametrize("kind", ["rest", "stop"])
def test_an_instant_of_rest_that_was_solved_for_is_used_unchanged(kind):
    events = [Event(0.1, "impact", "ball"), Event(0.2, kind, "other"), Event(0.605, kind, "ball")]
    made = trajectory(TIMES, *slowing(TIMES, stop=0.605), events=events)
    assert measure.rest_time(made, "ball") == 0.605


def test_an_event_of_rest_counts_though_its_sample_still_moves():
    velocity = np.where(np.arange(len(TIMES)) <= 40, 1.0, 0.0)[:, None] * (1.0, 0.0, 0.0)
    made = trajectory(TIMES, upright(0 * TIMES), velocity, events=[Event(float(TIMES[40]), "rest", "ball")])
    assert measure.rest_time(made, "ball") == TIMES[40]


def test_a_stop_after_which_the_body_moves_again_is_no_rest():
    velocity = (0.6 - TIMES)[:, None] * (1.0, 0.0, 0.0)  # up a slope and back down
    made = trajectory(TIMES, upright(0 * TIMES), velocity, events=[Event(0.6, "stop", "ball")])
    assert measure.rest_time(made, "ball") == math.inf
    position, velocity = slowing(TIMES, stop=0.8)
    made = trajectory(TIMES, position, velocity, events=[Event(0.3, "rest", "ball"), Event(0.8, "stop", "ball")])
    assert measure.rest_time(made, "ball") == 0.8


def test_the_height_at_rest_is_the_last_gap_above_or_below_the_plane():
    for last in (0.0, 0.25, -0.125):
        gap = np.append(np.linspace(1.0, 0.5, len(TIMES) - 1), last)
        made = trajectory(TIMES, upright(gap), (0.0, 0.0, 0.0))
        assert measure.rest_height(made, "ball", "floor") == pytest.approx(last, abs=1e-15)


def test_the_residual_speed_is_the_largest_within_the_window():
    times = np.arange(11) / 10
    velocity = np.zeros((11, 3))
    velocity[[3, 5, 8]] = (0.0, 7.0, 0.0), (3.0, 4.0, 0.0), (0.0, 0.0, -2.0)
    made = trajectory(times, upright(0 * times), velocity)
    assert measure.residual_speed(made, "ball", 0.5) == 5.0  # the window's first sample belongs to it, rounded or not
    assert measure.residual_speed(made, "ball", 0.45) == 2.0
    assert measure.residual_speed(made, "ball", 0.15) == 0.0
    assert measure.residual_speed(made, "ball", 9.0) == 7.0


def test_the_drift_is_the_largest_distance_from_the_windows_start():
    times = np.arange(11) / 10
    position = np.zeros((11, 3))
    position[:, 0] = [0, 9, 1, 1, 1, 1, 2, 4, 0, 1, 1]
    made = trajectory(times, position, (0.0, 0.0, 0.0))
    assert measure.drift(made, "ball", 0.5) == 3.0  # from 1 to 4, though it comes back
    assert measure.drift(made, "ball", 0.3) == 4.0  # from 4 to 0
    assert measure.drift(made, "ball", 0.1) == 0.0


def test_the_displacement_is_the_straight_line_from_start_to_end():
    position = np.array([[1.0, 1.0, 1.0], [9.0, 9.0, 9.0], [3.0, 2.0, -1.0]])
    assert measure.displacement(trajectory([0, 0.5, 1], position, (1.0, 0.0, 0.0)), "ball") == 3.0


def test_the_end_is_that_of_the_scenario_where_the_last_sample_is_later():
    """Under a force that grows evenly; the samples are 7 ms apart and 1 s is no multiple of that."""
    times = 7e-3 * np.arange(144)
    line = np.array([0.6, 0.0, -0.8])
    way, speed = 0.3 * times + 0.7 * times**2 - 0.2 * times**3, 0.3 + 1.4 * times - 0.6 * times**2
    made = trajectory(times, way[:, None] * line, speed[:, None] * line)
    place, velocity = measure.at_end(made, "ball")
    np.testing.assert_allclose(place, 0.8 * line, rtol=1e-13)
    np.testing.assert_allclose(velocity, 1.1 * line, rtol=1e-12)
    assert measure.displacement(made, "ball") == pytest.approx(0.8, rel=1e-13)


def test_the_stopping_distance_is_measured_along_the_plane():
    position, velocity = slowing(TIMES)
    made = trajectory(TIMES, position, velocity)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(3.0 * 0.6 / 2, abs=1e-14)
    creeping = position.copy()
    creeping[-1, 0] += 1e-3
    made = trajectory(TIMES, creeping, velocity)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(0.901, abs=1e-14)
    sinking = position - np.linspace(0, 0.1, len(TIMES))[:, None] * (0.0, 0.0, 1.0)
    made = trajectory(TIMES, sinking, velocity)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(0.9, abs=1e-14)
    slope = scenario(normal=(0.6, 0.0, 0.8))
    made = trajectory(TIMES, position, velocity, made=slope)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(0.9 * 0.8, abs=1e-14)


def test_a_body_still_moving_at_the_end_has_no_stopping_distance():
    made = trajectory(TIMES, *slowing(TIMES, stop=1.5))
    with pytest.raises(RunFailed, match="ball still moves at the end: it has no stopping distance"):
        measure.stopping_distance(made, "ball", "floor")


def test_the_deepest_penetration_is_the_largest_overlap_and_never_negative():
    made = trajectory([0, 1, 2, 3], upright([0.5, -0.25, -0.125, 0.5]), (0.0, 0.0, 0.0))
    assert measure.deepest_penetration(made, "ball", "floor") == pytest.approx(0.25, abs=1e-15)
    made = trajectory([0, 1], upright([0.5, 0.25]), (0.0, 0.0, 0.0))
    assert measure.deepest_penetration(made, "ball", "floor") == 0.0


def test_the_gap_of_a_turned_box_is_read_from_its_poses():
    turns = [(1.0, 0.0, 0.0, 0.0), (math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0)]  # lying, then on its side
    made = scenario(Box((0.1, 0.2, 0.3)))
    gaps = measure.separation(trajectory([0, 1], (0, 0, 1), (0, 0, 0), made=made, orientation=turns), "ball", "floor")
    assert gaps == pytest.approx([0.7, 0.8], abs=1e-15)


# Energy and momentum


def points_of(half_extents):
    """Eight points that a box of the same mass cannot be told from by its inertia: at its half lengths over √3."""
    return np.array(list(itertools.product((-1, 1), repeat=3))) * np.array(half_extents) / math.sqrt(3)


def test_the_energy_of_a_spinning_box_is_that_of_its_points():
    rng = np.random.default_rng(4)
    half, mass, gravity = (0.1, 0.2, 0.4), 3.0, (1.0, -2.0, -G)
    count = 20
    position, velocity, spin = rng.normal(size=(3, count, 3))
    turn = rng.normal(size=(count, 4))
    turn /= np.linalg.norm(turn, axis=1, keepdims=True)
    made = scenario(Box(half), gravity=gravity, mass=mass)
    energies = measure.energy(trajectory(np.arange(count), position, velocity, (), made, turn, spin), "ball")
    for at in range(count):
        w, x, y, z = turn[at]
        columns = [
            [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
            [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
        ]
        arms = points_of(half) @ np.array(columns)
        speeds = velocity[at] + np.cross(spin[at], arms)
        kinetic = np.sum(speeds**2) * mass / 8 / 2
        potential = -np.sum((position[at] + arms) @ np.array(gravity)) * mass / 8
        assert energies[at] == pytest.approx(kinetic + potential, abs=1e-12)  # some 30 J, rounded a few dozen times


def test_a_spinning_ball_has_two_fifths_of_its_rims_kinetic_energy():
    made = scenario(Sphere(0.5), mass=2.0, gravity=(0.0, 0.0, 0.0))
    spinning = trajectory([0, 1], (0, 0, 1), (0, 0, 0), made=made, spin=(0.0, 6.0, 0.0))
    moving = trajectory([0, 1], (0, 0, 1), (3, 0, 0), made=made)
    assert measure.energy(moving, "ball").tolist() == [9.0, 9.0]
    assert measure.energy(spinning, "ball") == pytest.approx([3.6, 3.6], abs=1e-15)


def test_a_falling_ball_keeps_its_energy():
    made, _ = bouncing(np.linspace(0, 1, 100), 1.0)
    # m g (h + r) above the origin, rounded a few times
    assert measure.energy(made, "ball") == pytest.approx(np.full(100, G * (HEIGHT + RADIUS)), abs=1e-13)


def test_immovable_bodies_have_no_energy():
    made = trajectory([0, 1], (0, 0, 1), (0, 0, 0))
    with pytest.raises(RunFailed, match="floor is immovable: it has no energy to measure"):
        measure.energy(made, "floor")
    pillar = Scenario("pillar", (Body("floor", HalfSpace()), Body("pillar", Sphere(1.0))), (), 1.0)
    with pytest.raises(RunFailed, match="pillar is immovable: it has no energy to measure"):
        measure.energy(trajectory([0, 1], (0, 0, 1), (0, 0, 0), made=pillar), "pillar")


def test_momentum_adds_up_over_the_bodies_that_can_move():
    bodies = (
        Body("floor", HalfSpace()),
        Body("light", Sphere(0.1), mass=2.0),
        Body("heavy", Sphere(0.1), mass=3.0),
    )
    made = Scenario("two", bodies, (), 1.0)
    velocity = np.zeros((2, 3, 3))
    velocity[:, 1] = (1.0, 0.0, -1.0), (2.0, 0.0, 0.0)
    velocity[:, 2] = (0.0, 1.0, 1.0), (-1.0, 0.0, 0.0)
    still, identity = np.zeros((2, 3, 3)), np.tile([1.0, 0, 0, 0], (2, 3, 1))
    run = Trajectory(made, Settings(1e-3), "made up", np.array([0.0, 1.0]), still, identity, velocity, still)
    assert measure.momentum(run).tolist() == [[2.0, 3.0, 1.0], [1.0, 0.0, 0.0]]
