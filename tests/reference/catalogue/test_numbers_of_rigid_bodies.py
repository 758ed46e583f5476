"""What the families of walls, boxes and rolling balls measure, on trajectories made up so that the number is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.engines.base import AT_STEP, Method
from reference.errors import RunFailed
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

G = 9.81


def made(name: str, case: str, times, **changes) -> tuple[Trajectory, dict[str, float]]:
    """A trajectory in which all stays as the scenario has it, but for what `changes` says, and what is measured of it.

    changes: `positions`, `orientations`, `velocities`, `angular_velocities`, each a body's name → values, (n, …).
    """
    family = catalogue()[name]
    scenario = family.case(case).scenarios[0]
    start = [(body.position, body.orientation, body.velocity, body.angular_velocity) for body in scenario.bodies]
    names = ("positions", "orientations", "velocities", "angular_velocities")
    states = {
        kind: np.tile(np.array([state[place] for state in start]), (len(times), 1, 1))
        for place, kind in enumerate(names)
    }
    for kind, bodies in changes.items():
        for body, values in bodies.items():
            states[kind][:, scenario.index(body)] = values
    trajectory = Trajectory(scenario, Settings(1e-3), "made", np.array(times, dtype=float), **states)
    return trajectory, {quantity.name: quantity.measure for quantity in family.quantities}


def about_y(degrees) -> np.ndarray:
    half = np.radians(np.array(degrees)) / 2
    return np.stack([np.cos(half), 0 * half, np.sin(half), 0 * half], axis=-1)


# Stacks


def test_the_height_of_a_stack_is_the_largest_move_of_its_top():
    for moves, expected in (((0, 2e-3, -3e-3, 0), -3e-3), ((0, 4e-3, -3e-3, 1e-3), 4e-3), ((0, 0, 0, 0), 0.0)):
        heights = np.array([[0.0, 0.0, 0.9 + move] for move in moves])
        trajectory, measure = made("stack", "boxes=5", [0, 3, 6, 10], positions={"cube 5": heights})
        assert measure["height"](trajectory) == pytest.approx(expected, abs=1e-15)


def test_the_drift_of_a_stack_is_its_farthest_box_along_the_floor():
    places = np.array([[0, 0, 0.5], [3e-3, 4e-3, 0.4], [1e-3, 0, 0.5], [0, 0, 0.5]])
    trajectory, measure = made("stack", "boxes=5", [0, 3, 6, 10], positions={"cube 3": places})
    assert measure["drift"](trajectory) == pytest.approx(5e-3, rel=1e-12)


def test_the_speed_of_a_stack_is_the_largest_of_any_box_in_the_last_second():
    velocities = np.array([[0, 0, 0], [9, 9, 9], [0.0, 0.3, 0.4], [0, 0, 0.1]])
    trajectory, measure = made("stack", "boxes=5", [0, 8.9, 9.1, 10], velocities={"cube 2": velocities})
    assert measure["speed"](trajectory) == pytest.approx(0.5, rel=1e-12)


# A box on an edge


def test_a_box_on_an_edge_is_judged_by_final_face_tilt_and_energy():
    heights = np.array([[0, 0, 0.4], [0, 0, 0.2], [0, 0, 0.1]])
    for end, face, tilt in ((2.0, 3, 2.0), (92.0, -1, 2.0), (-88.0, 1, 2.0), (180.0, -3, 0.0)):
        turns = about_y([10.0, 60.0, end])
        trajectory, measure = made(
            "box-on-edge", "tilt=10°", [0, 1, 3], positions={"cube": heights}, orientations={"cube": turns}
        )
        assert measure["face"](trajectory) == face
        assert math.degrees(measure["tilt"](trajectory)) == pytest.approx(tilt, abs=2e-6)  # a cosine near 1
        assert measure["energy"](trajectory) == pytest.approx(G * 0.1, rel=1e-14)


def test_energy_gained_is_the_most_above_the_start_at_any_time():
    heights = np.array([[0, 0, 0.4], [0, 0, 0.4], [0, 0, 0.1]])
    speeds, spins = np.array([[0, 0, 0], [2, 0, 0], [0, 0, 0]]), np.array([[0, 0, 0], [0, 3, 0], [0, 0, 0]])
    trajectory, measure = made(
        "box-on-edge",
        "tilt=10°",
        [0, 1, 3],
        positions={"cube": heights},
        velocities={"cube": speeds},
        angular_velocities={"cube": spins},
    )
    # m v²/2, and I ω²/2 with (0.1² + 0.1²)/3 for a cube of 1 kg.
    assert measure["gain"](trajectory) == pytest.approx(2.0 + 0.02 / 3 * 9 / 2, rel=1e-12)


# A box on a slope


@pytest.mark.parametrize(
    ("lean", "way", "outcome"), [(0, 0.9e-3, 0), (9.9, 0.9e-3, 0), (0, 1.1e-3, 1), (10.1, 0, 2), (40, 1.0, 2)]
)
def test_a_box_holds_within_a_millimetre_and_tips_beyond_ten_degrees(lean, way, outcome):
    case, slope = "h=0.1,μ=0.5,θ=20°", math.radians(20)
    start = np.array(catalogue()["tipping-box"].case(case).scenarios[0].body("box").position)
    downhill = np.array([math.cos(slope), 0, -math.sin(slope)])
    places = start + np.outer([0, way / 2, way], downhill)
    # It leans in between and stands again: what has tipped has tipped.
    turns = about_y([20.0, 20.0 + lean, 20.0])
    trajectory, measure = made(
        "tipping-box", case, [0, 0.5, 1.0], positions={"box": places}, orientations={"box": turns}
    )
    assert measure["outcome"](trajectory) == outcome
    assert measure["way"](trajectory) == pytest.approx(way, abs=1e-15)


def test_the_way_of_a_box_is_that_of_exactly_one_second():
    case, slope = "h=0.1,μ=0.5,θ=35°", math.radians(35)
    start = np.array(catalogue()["tipping-box"].case(case).scenarios[0].body("box").position)
    times = np.array([0, 0.51, 1.02])
    downhill = np.array([math.cos(slope), 0, -math.sin(slope)])
    places, speeds = start + np.outer(1.5 * times**2, downhill), np.outer(3 * times, downhill)  # 3 m/s² from rest
    trajectory, measure = made("tipping-box", case, times, positions={"box": places}, velocities={"box": speeds})
    assert measure["way"](trajectory) == pytest.approx(1.5, rel=1e-12)


# A box dropped flat


def test_a_box_dropped_flat_is_judged_by_its_largest_lean_and_shift():
    places = np.array([[0, 0, 1.1], [3e-3, -4e-3, 0.5], [0, 0, 0.3]])
    trajectory, measure = made(
        "box-flat", "e=0.5", [0, 0.3, 0.6], positions={"cube": places}, orientations={"cube": about_y([0, -7, 1])}
    )
    assert math.degrees(measure["lean"](trajectory)) == pytest.approx(7, abs=1e-9)
    assert measure["aside"](trajectory) == pytest.approx(5e-3, rel=1e-12)


# Walls


def between(restitution: float, interval: float, late: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """To and fro over 0.8 m at 2 m/s, each impact late by so many seconds; times, places and velocities of samples."""
    corners, place, velocity, time = [(0.0, 0.1)], 0.1, 2.0, 0.0
    for _ in range(6):
        wall = 0.9 if velocity > 0 else 0.1
        time += (wall - place) / velocity + late
        place = wall + velocity * late
        corners.append((time, place))
        velocity *= -restitution
    knots, places = np.array(corners).T
    times = np.arange(0.0, knots[5] + 0.1, interval)
    speeds = np.diff(places) / np.diff(knots)
    return times, np.interp(times, knots, places), speeds[np.searchsorted(knots, times, side="right") - 1]


@pytest.mark.parametrize("interval", [1e-3, 0.0137])
@pytest.mark.parametrize(("case", "restitution"), [("e=0.5", 0.5), ("e=0.8", 0.8), ("e=1", 1.0)])
def test_the_last_impact_between_walls_is_read_from_the_flight_before(case, restitution, interval):
    times, places, speeds = between(restitution, interval)
    along = np.array([1.0, 0.0, 0.0])
    trajectory, measure = made(
        "two-walls",
        case,
        times,
        positions={"ball": np.outer(places, along)},
        velocities={"ball": np.outer(speeds, along)},
    )
    fifth = 0.4 * sum(restitution**-crossing for crossing in range(5))
    assert measure["last_impact"](trajectory) == pytest.approx(fifth, abs=1e-11)  # rounding of straight lines
    assert measure["speed_left"](trajectory) == pytest.approx(2 * restitution**5, rel=1e-9)


def test_late_impacts_delay_the_last_one_by_their_way_back_too():
    times, places, speeds = between(0.5, 1e-3, late=2e-4)
    along = np.array([1.0, 0.0, 0.0])
    trajectory, measure = made(
        "two-walls",
        "e=0.5",
        times,
        positions={"ball": np.outer(places, along)},
        velocities={"ball": np.outer(speeds, along)},
    )
    # Four impacts before it: 0.2 ms late each, and twice that for the way back at half the speed.
    assert measure["last_impact"](trajectory) - 12.4 == pytest.approx(4 * 2e-4 * (1 + 1 / 0.5), abs=1e-9)


def test_a_ball_that_meets_the_walls_too_seldom_has_no_fifth_impact():
    times, places, speeds = between(0.5, 1e-3)
    along, kept = np.array([1.0, 0.0, 0.0]), times < 6.0  # the fourth is at 6 s
    trajectory, measure = made(
        "two-walls",
        "e=0.5",
        times[kept],
        positions={"ball": np.outer(places[kept], along)},
        velocities={"ball": np.outer(speeds[kept], along)},
    )
    for quantity in ("last_impact", "speed_left"):
        with pytest.raises(RunFailed, match="met the walls 3 times, not 5"):
            measure[quantity](trajectory)


def in_steps(restitution: float, dt: float) -> float:
    """The fifth impact, by the flight before it, of a ball that turns at the first step behind a wall, s."""
    place, velocity, time, met = 0.0, 2.0, 0.0, 0
    while True:
        wall = 0.8 if velocity > 0 else 0.0
        if (place - wall) * velocity >= 0 and time > 0:
            met += 1
            if met == 5:
                return time - (place - wall) / velocity
            velocity = -restitution * velocity
        place, time = place + velocity * dt, time + dt


@pytest.mark.parametrize("left", [0.0, 1e-8, -1e-8])
def test_a_ball_that_stays_at_a_wall_has_met_it(left):
    times = np.array([0, 0.4, 1.2, 2.8, 6.0, 12.4, 12.5])
    speeds = np.array([2, -1, 0.5, -0.25, 0.125, left, left])
    x = np.array([0.1, 0.9, 0.1, 0.9, 0.1, 0.9, 0.9])
    velocities, positions = np.zeros((7, 3)), np.zeros((7, 3))
    velocities[:, 0], positions[:, 0] = speeds, x
    trajectory, measure = made(
        "two-walls", "e=0.5", times, positions={"ball": positions}, velocities={"ball": velocities}
    )
    assert measure["last_impact"](trajectory) == pytest.approx(12.4, rel=1e-15)
    assert measure["speed_left"](trajectory) == abs(left)


@pytest.mark.parametrize(("case", "restitution"), [("e=0.5", 0.5), ("e=0.8", 0.8), ("e=1", 1.0)])
def test_the_accepted_delay_is_the_most_that_steps_can_cause(case, restitution):
    family, true = catalogue()["two-walls"], 0.4 * sum(restitution**-crossing for crossing in range(5))
    expect, shares = family.quantity("last_impact").expect, []
    for dt in np.linspace(4e-3, 6e-3, 150):  # so that impacts fall anywhere in a step
        accepted = 2 * expect(family.case(case), Settings(float(dt)), Method(AT_STEP)).shift
        shares.append((in_steps(restitution, float(dt)) - true) / accepted)
    # Four delays, each even between none and all: the most of 150 comes near to all, never beyond it.
    assert min(shares) > -1e-9
    assert 0.8 < max(shares) <= 1


def test_the_speed_kept_in_a_corner_is_given_for_each_wall():
    velocities = np.array([[-2.0, 0, -2.0], [1.0, 0, 1.6]])
    trajectory, measure = made("corner", "e=0.8", [0, 0.6], velocities={"ball": velocities})
    assert (measure["kept_by_floor"](trajectory), measure["kept_by_wall"](trajectory)) == (0.8, 0.5)


# Rolling


def test_the_way_of_a_sliding_ball_is_that_at_the_scenarios_end():
    end = catalogue()["sliding-ball"].case("μ=0.3,v=2").scenarios[0].duration
    times = np.array([0.0, end - 0.25, end + 0.25])
    places = np.array([[0, 0, 0.1], [1.0, 0, 0.1], [2.0, 0, 0.1]])
    trajectory, measure = made("sliding-ball", "μ=0.3,v=2", times, positions={"ball": places})
    assert measure["way"](trajectory) == pytest.approx(1.5, rel=1e-12)


def test_slip_and_ratio_of_a_ball_are_those_of_the_end():
    velocities, spins = np.array([[2.0, 0, 0], [1.0, 0, 0]]), np.array([[0, 0, 0], [0, 9.0, 0]])
    trajectory, measure = made(
        "sliding-ball", "μ=0.3,v=2", [0, 0.6], velocities={"ball": velocities}, angular_velocities={"ball": spins}
    )
    assert measure["slip"](trajectory) == pytest.approx(0.1, abs=1e-15)
    trajectory, measure = made(
        "rolling-ball",
        "μ=0.1,θ=20°",
        [0, 2.0],
        velocities={"ball": velocities * [math.cos(math.radians(20)), 1, 1]},
        angular_velocities={"ball": spins},
    )
    # 0.9 m/s of surface; of 1 m/s level speed cos² 20° lies along the slope.
    assert measure["ratio"](trajectory) == pytest.approx(0.9 / math.cos(math.radians(20)) ** 2, rel=1e-12)
