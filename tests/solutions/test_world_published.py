"""Published cases that need a whole world: elastic balls, a pushed plate of balls, a box that tumbles freely."""

from __future__ import annotations

import numpy as np
import pytest
from world_scenes import FLOOR, Thing, energy, momentum, scene

from reference.published.theirs import published
from solutions.impulse import rotation_matrix
from solutions.world.rules import Rules
from solutions.world.run import run_world

P1, P2, P14 = (published(name) for name in ("P1", "P2", "P14"))

AT_THE_STEP = {"ode": False, "bullet": True}
"""Which engine answers with the speed that includes the step's gain of weight."""


def elastic_balls(dt, with_weight, steps):
    """The states before each step of 490 kg of elastic balls, three of unequal mass beside one another."""
    radius, height = P1.values("radius", "height")
    mass = P1.value("mass") * np.array([10, 15, 24])
    balls = [Thing(("sphere", radius), each, (1.3 * x, x * x, height)) for x, each in enumerate(mass)]
    bodies, start = scene([FLOOR, *balls], restitution=1.0)
    rules = Rules(rest_speed=0.0, margin=0.0, recovery=0.0, with_weight=with_weight)
    return bodies, run_world(bodies, start, (0, 0, -P1.value("gravity")), dt, steps - 1, rules)


def ten_lines(dt, with_weight, steps):
    """Height and speed of such a ball before each step, (steps, 2), by the loop that gives the published figures."""
    (radius, height), gravity = P1.values("radius", "height"), P1.value("gravity")
    z, v, states = height, 0.0, []
    for _ in range(steps):
        states.append((z, v))
        weight = gravity * dt
        v = -(v - weight * with_weight) if z <= radius and v < 0 else v - weight
        z += v * dt
    return np.array(states)


def mean_squared_error(energies):
    return float(np.mean((energies - energies[0]) ** 2))


@pytest.mark.parametrize("engine", AT_THE_STEP)
def test_elastic_balls_step_as_the_loop_of_the_published_energies(engine):
    """The loop gives the printed digits at all five timesteps, and the world steps like it, down from 5 m and up."""
    total, gravity = P1.value("balls") * P1.value("mass"), P1.value("gravity")
    printed = zip(P1.numbers("timesteps"), P1.expected[engine], P1.tolerance[engine], strict=True)
    for dt, figure, half_a_digit in printed:
        z, v = ten_lines(dt, AT_THE_STEP[engine], round(P1.value("duration") / dt)).T
        assert mean_squared_error(total * (v**2 / 2 + gravity * z)) == pytest.approx(figure, abs=half_a_digit)
    _, run = elastic_balls(1e-2, AT_THE_STEP[engine], 210)
    expected = ten_lines(1e-2, AT_THE_STEP[engine], 210)
    for ball in (1, 2, 3):
        np.testing.assert_allclose(run.position[:, ball, 2], expected[:, 0], atol=1e-12)
        np.testing.assert_allclose(run.velocity[:, ball, 2], expected[:, 1], atol=1e-12)


@pytest.mark.parametrize("place", [pytest.param(0, marks=pytest.mark.slow), pytest.param(1, marks=pytest.mark.weekly)])
@pytest.mark.parametrize("engine", AT_THE_STEP)
def test_energy_of_elastic_balls_errs_by_the_published_figure(engine, place):
    dt = P1.numbers("timesteps")[place]
    bodies, run = elastic_balls(dt, AT_THE_STEP[engine], round(P1.value("duration") / dt))
    found = mean_squared_error(np.sum(energy(bodies, run, P1.value("gravity")), axis=-1))
    assert found == pytest.approx(P1.expected[engine][place], abs=P1.tolerance[engine][place])


def pushed_plate(dt):
    """Speeds of the plate (steps + 1,) and of the balls (steps + 1, 25), m/s, and the last state."""
    size, radius, gravity = np.array(P2.numbers("box_size")), P2.value("ball_radius"), P2.value("gravity")
    places = np.linspace(-4, 4, 5)  # they roll 3.3 m towards the rear edge
    plate = Thing(("box", size / 2), P2.value("box_mass"), (0, 0, size[2] / 2))
    balls = [Thing(("sphere", radius), P2.value("ball_mass"), (x, y, size[2] + radius)) for x in places for y in places]
    friction = np.zeros((3, 3))
    friction[0, 1] = friction[1, 0] = P2.value("ground_friction")
    friction[1, 2] = friction[2, 1] = P2.value("ball_friction")
    bodies, start = scene([FLOOR, plate, *balls], friction=friction, material=[0, 1] + 25 * [2])
    angle, force = np.radians(P2.value("push_angle")), np.zeros((27, 3))
    force[1, :2] = P2.value("push") * np.array([np.cos(angle), np.sin(angle)])
    steps = round(P2.value("duration") / dt)
    run = run_world(bodies, start, (0, 0, -gravity), dt, steps, forces=[lambda _: (force, np.zeros((27, 3)))])
    speed = np.linalg.norm(run.velocity, axis=-1)
    return speed[:, 1], speed[:, 2:], run


@pytest.mark.parametrize("dt", [0.2, pytest.param(0.02, marks=pytest.mark.slow)])
def test_pushed_plate_and_its_balls_move_as_published(dt):
    """Constant forces give semi-implicit steps the exact speeds. Ball and plate roll on each other from the start."""
    plate, balls, run = pushed_plate(dt)
    duration = P2.value("duration")
    assert plate[-1] == pytest.approx(P2.expected["box_speed"], abs=P2.tolerance["box_speed"])
    assert plate[-1] / duration == pytest.approx(P2.expected["box_acceleration"], abs=P2.tolerance["box_acceleration"])
    np.testing.assert_allclose(balls[-1], P2.expected["ball_speed"], atol=P2.tolerance["ball_speed"])
    np.testing.assert_allclose(balls[-1] / duration, P2.expected["ball_acceleration"], atol=5e-5)
    assert np.arctan2(*run.velocity[-1, 1, 1::-1]) == pytest.approx(np.radians(60), abs=1e-4)
    contact = run.velocity[-1, 2:] - np.cross(run.angular_velocity[-1, 2:], (0, 0, P2.value("ball_radius")))
    np.testing.assert_allclose(contact, np.tile(run.velocity[-1, 1], (25, 1)), atol=1e-4)  # they roll


@pytest.mark.parametrize("dt", [0.05, pytest.param(1e-3, marks=pytest.mark.slow)])
def test_a_free_tumbling_box_errs_by_half_a_step_of_weight(dt):
    """Gazebo's benchmark of boxes: velocity (−2, 2, 8) m/s, spin (0.1, 5, 0.1) rad/s, g = 9.8 m/s², 10 s.

    Semi-implicit Euler falls by g T (T + dt)/2, which is g dt T/2 = 0.049 m too far at 1 ms. Free of torque, the box
    keeps its angular momentum, and its spin is a constant energy.
    """
    duration, gravity = P14.value("duration"), -P14.numbers("gravity")[2]
    velocity, spin = P14.numbers("velocity"), (0.1, 5.0, 0.1)
    box = Thing(("box", (0.2, 0.1, 0.05)), 1.4, (3.0, -1.0, 2.0), velocity=velocity, spin=spin)
    bodies, state = scene([box])
    run = run_world(bodies, state, (0, 0, -gravity), dt, round(duration / dt), every=round(duration / dt) // 10)
    exact = np.array([3.0 - 2 * duration, -1.0 + 2 * duration, 2 + 8 * duration - gravity * duration**2 / 2])
    if dt == P14.value("timestep"):
        assert gravity * dt * duration / 2 == pytest.approx(P14.expected["position_error"])
    np.testing.assert_allclose(run.position[-1, 0] - exact, (0, 0, -gravity * dt * duration / 2), atol=1e-9)
    about_centre = momentum(bodies, run._replace(position=np.zeros_like(run.position)))[1]
    np.testing.assert_allclose(about_centre, np.tile(about_centre[0], (11, 1)), atol=1e-11)  # 10⁴ roundings
    own = np.vecmat(run.angular_velocity[:, 0], rotation_matrix(run.orientation[:, 0]))
    spinning = np.vecdot(bodies.moments[0] * own, own) / 2
    # An error of the order (ω dt)², without a drift.
    np.testing.assert_allclose(spinning, spinning[0], rtol=(5 * dt) ** 2)
    assert np.ptp(own[:, 0]) > 0.05  # it tumbles: the spin wanders in the body
