"""A body's own moments of inertia, in every engine: how it spins freely, and what an impact makes of it."""

from __future__ import annotations

import contextlib
import functools
from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import counted
from engine_grid import FLOOR, TURNED, thrown

from reference.catalogue import measure
from reference.catalogue.scenarios import catalogue
from reference.engines import load_engine
from reference.errors import CannotExpress
from reference.scene import geometry
from reference.scene.scenario import Body, Box, Pair, Scenario, Sphere
from reference.scene.trajectory import Trajectory

MOMENTS = np.array([0.05, 0.02, 0.04])
"""Unequal, in no order of size, and not those of the shape, kg m²."""
SPIN = (3.0, -4.0, 2.0)
"""About no principal axis of the body, rad/s."""
BALL = Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 1.0))


def tumbling() -> Scenario:
    """A box with moments of its own that spins freely, turned and far from the origin."""
    scenario = thrown("tumbling-box", Box((0.1, 0.2, 0.3)), TURNED, SPIN)
    return replace(scenario, bodies=(FLOOR, replace(scenario.body("thrown"), inertia=tuple(MOMENTS))))


def tumbled(name: str, profile: str = "tuned", **changes) -> Trajectory:
    engine = load_engine(name)
    settings = engine.settings(tumbling(), profile).change(**changes)
    return engine.run(tumbling(), settings)


# Euler's equations without torque, in the body's own axes: I ω′ = (I ω) × ω


def explicit_step(spin, dt):
    """One step of Euler's method."""
    return spin + dt * np.cross(MOMENTS * spin, spin) / MOMENTS


def implicit_step(spin, dt):
    """One step of Newton's method towards the backward Euler step."""
    residual = dt * np.cross(spin, MOMENTS * spin)
    jacobian = np.diag(MOMENTS) + dt * (crossing(spin) * MOMENTS - crossing(MOMENTS * spin))
    return spin - np.linalg.solve(jacobian, residual)


def crossing(vector):
    """The matrix of the cross product with a vector."""
    x, y, z = vector
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def into_body(orientation, vector):
    return geometry.rotate(geometry.opposite(orientation), vector)


@functools.cache
def stepped(rule, dt: float, duration: float):
    """Orientation and spin, rad/s, after steps by a rule, which turn the body with the new spin."""
    orientation, spin = np.array(TURNED), np.array(SPIN)
    for _ in range(round(duration / dt)):
        own = rule(into_body(orientation, spin), dt)
        spin = geometry.rotate(orientation, own)
        orientation = geometry.turned(orientation, spin * dt)
        if rule is explicit_step:  # it keeps the new spin in the body's axes, which have turned by now
            spin = geometry.rotate(orientation, own)
    return orientation, spin


@functools.cache
def solved(duration: float, steps: int = 300):
    """Orientation and spin by Runge and Kutta's method of fourth order."""

    def rates(state):
        w, q, spin = state[0], state[1:4], state[4:]
        turning = np.concatenate([[-q @ spin], w * spin + np.cross(q, spin)]) / 2
        return np.concatenate([turning, np.cross(MOMENTS * spin, spin) / MOMENTS])

    state, dt = np.concatenate([TURNED, into_body(np.array(TURNED), np.array(SPIN))]), duration / steps
    for _ in range(steps):
        first = rates(state)
        second = rates(state + dt / 2 * first)
        third = rates(state + dt / 2 * second)
        fourth = rates(state + dt * third)
        state = state + dt / 6 * (first + 2 * second + 2 * third + fourth)
    return state[:4], geometry.rotate(state[:4], state[4:])


def check_end(trajectory: Trajectory, orientation, spin, near: float) -> None:
    np.testing.assert_allclose(trajectory.angular_velocity("thrown")[-1], spin, atol=near)
    end = trajectory.orientation("thrown")[-1]
    assert min(np.abs(end - sign * orientation).max() for sign in (1, -1)) < near


@pytest.mark.parametrize(
    ("name", "changes", "rule"),
    [
        ("pybullet", {"coordinates": "maximal"}, implicit_step),
        ("pybullet", {"coordinates": "multibody"}, explicit_step),
        ("mujoco", {"timestep": 1e-3}, explicit_step),
        ("dart", {"timestep": 1e-3}, explicit_step),
    ],
)
def test_a_body_tumbles_by_its_own_moments_and_the_engines_rule(name, changes, rule, installed):
    installed(name)
    trajectory = tumbled(name, **changes)
    end = float(trajectory.times[-1])
    orientation, spin = stepped(rule, 1e-3, end)
    check_end(trajectory, orientation, spin, 1e-9)  # rounding of 300 steps
    # The rules are of first order: at 1 ms they leave some 9 mrad/s of 5.4 rad/s, with the shape's moments 1.6 rad/s.
    check_end(trajectory, *solved(end), near=1e-2)


def test_mujocos_spring_profile_solves_eulers_equations(installed):
    installed("mujoco")
    trajectory = tumbled("mujoco", "spring")
    check_end(trajectory, *solved(float(trajectory.times[-1])), near=1e-9)
    energy = measure.energy(trajectory, "thrown")
    # The box has 0.6 J of spin, and 1000 J in all.
    np.testing.assert_allclose(energy, energy[0], atol=1e-9)


@pytest.mark.parametrize(
    ("name", "near"), [("handwritten", 1e-12), ("pybullet", 1e-12), ("mujoco", 1e-3), ("dart", 1e-3)]
)
def test_a_hollow_ball_takes_two_fifths_of_its_surface_speed(name, near, installed):
    engine, case = installed(name), catalogue()["spinning-ball"].case("ω=5,μ=0.3,e=0.5")
    floor, ball = case.scenarios[0].bodies
    moment = 2 / 3 * ball.mass * ball.shape.radius**2
    scenario = replace(case.scenarios[0], bodies=(floor, replace(ball, inertia=(moment,) * 3)))
    trajectory = engine.run(scenario, engine.settings(scenario, counted(name)))
    # An impact that ends the slip: v = (I/m r²)/(1 + I/m r²) r ω, 2/7 for a solid ball. MuJoCo and DART let friction
    # act inside the ball, up to 0.4 % nearer to its centre.
    assert trajectory.velocity("ball")[-1, 0] == pytest.approx(2 / 5 * 0.1 * 5, rel=near)


@pytest.mark.parametrize(("coordinates", "runs"), [("maximal", False), ("multibody", True)])
def test_pybullet_refuses_an_own_inertia_that_its_first_step_needs(coordinates, runs, installed):
    engine = installed("pybullet")
    ball = replace(BALL, position=(0.0, 0.0, 0.1), inertia=(0.005, 0.005, 0.005))
    scenario = Scenario("a ball that lies", (FLOOR, ball), (Pair("ball", "floor", 0.5),), 0.1)
    settings = engine.settings(scenario, "tuned").change(coordinates=coordinates)
    with contextlib.nullcontext() if runs else pytest.raises(CannotExpress, match="touch in the first step"):
        engine.run(scenario, settings)


def two_balls_and_a_floor() -> list[Scenario]:
    other = replace(BALL, name="other", position=(0.0, 0.0, 2.0))
    third = replace(BALL, name="third", position=(0.0, 0.0, 3.0))
    moving = replace(BALL, velocity=(0.0, 0.0, 1.0), inertia=(0.005, 0.004, 0.003))
    falling = replace(moving, velocity=(1.0, 0.0, -1.0))
    rough = {"restitution": 0.5, "kinetic_friction": 0.3}
    return [
        Scenario("two balls", (other, moving), (Pair("ball", "other", **rough),), 0.1, (0, 0, 0)),
        Scenario("a ball on a floor", (FLOOR, falling), (Pair("ball", "floor", **rough),), 0.1),
        Scenario("a row", (moving, other, third), (Pair("ball", "other"), Pair("other", "third")), 0.1, (0, 0, 0)),
    ]


@pytest.mark.parametrize("scenario", two_balls_and_a_floor(), ids=lambda scenario: scenario.name)
def test_by_hand_a_ball_with_unequal_moments_runs_in_the_world_alone(scenario):
    engine = load_engine("handwritten")
    equal = replace(scenario, bodies=[replace(body, inertia=()) for body in scenario.bodies])
    assert next(iter(engine.profiles(equal))) == "exact"
    assert list(engine.profiles(scenario)) == ["world"]


def flying_cube(inertia, spin):
    cube = Body("cube", Box((0.1, 0.1, 0.1)), 1.0, (0, 0, 0.5), TURNED, (0, 0, -1), spin, inertia)
    return Scenario("a cube that flies", (FLOOR, cube), (Pair("cube", "floor", 0.5, 0.3),), 0.1, (0, 0, 0))


def test_by_hand_a_cube_with_unequal_moments_of_its_own_runs_in_the_world_alone():
    assert list(load_engine("handwritten").profiles(flying_cube(tuple(MOMENTS), SPIN))) == ["world"]


def test_by_hand_a_box_whose_own_moments_are_equal_keeps_its_spin():
    engine, scenario = load_engine("handwritten"), flying_cube((0.01, 0.01, 0.01), SPIN)
    long = replace(scenario.body("cube"), shape=Box((0.2, 0.05, 0.05)))
    scenario = replace(scenario, bodies=(FLOOR, long))
    trajectory = engine.run(scenario, engine.settings(scenario, "exact"))
    assert trajectory.angular_velocity("cube")[-1] == pytest.approx(SPIN, rel=1e-12)
