"""Our own functions on bounces that other people published."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.published import published
from solutions.detection import side_of_plane, signed_distance, time_of_impact_exact
from solutions.forces import ballistic_motion, semi_implicit_euler
from solutions.response import (
    bounce_along_normal,
    bounce_through_step,
    kinematic_response,
    penalty_damping,
    penalty_force,
    penalty_restitution,
    time_until_rest,
)

UP = np.array([0.0, 0.0, 1.0])


@pytest.mark.statement(6, oracle="P1: ODE and Bullet as published by SimBenchmark")
def test_p1_balls_answered_at_the_step_gain_and_lose_the_energy_that_two_engines_do():
    case = published("P1")
    setup = case.setup
    pull, weight = -setup["gravity"] * UP, setup["balls"] * setup["mass"]
    for place, dt in enumerate(setup["timesteps"]):
        z, v = np.full((2, 3), setup["height"] * UP), np.zeros((2, 3))  # one ball like ODE, one like Bullet
        energies = []
        for _ in range(round(setup["duration"] / dt)):
            energies.append(weight * (setup["gravity"] * z[:, 2] + v[:, 2] ** 2 / 2))
            struck = (side_of_plane(signed_distance(z, UP, -setup["radius"])) <= 0) & (v[:, 2] < 0)
            before = v + pull * dt * np.array([[0.0], [1.0]])  # Bullet adds the weight first
            answered = kinematic_response(before, UP, 1.0)
            v = np.where(struck[:, None], answered, v + pull * dt)
            z = z + v * dt
        mean = np.mean((np.array(energies) - energies[0]) ** 2, axis=0)
        assert mean[0] == pytest.approx(case.expected["ode"][place], rel=case.tolerance["ode"])
        assert mean[1] == pytest.approx(case.expected["bullet"][place], rel=case.tolerance["bullet"])


def granular(case, adhesive):
    """Positions and velocities at the published steps, by velocity Verlet."""
    setup = case.setup
    mass, radius = setup["density"] * math.pi * setup["diameter"] ** 3 / 6, setup["diameter"] / 2
    damping, dt = penalty_damping(setup["restitution"], mass, setup["stiffness"], adhesive=True), setup["timestep"]

    def acceleration(z, v):
        force = penalty_force(z - radius, v, UP, setup["stiffness"], damping, adhesive)
        return force[2] / mass - setup["gravity"]

    z, v, found = setup["height"], 0.0, []
    a = acceleration(z, v)
    for step in range(1, int(max(setup["steps"])) + 1):
        v = v + a * dt / 2
        z = z + v * dt
        a = acceleration(z, v)
        v = v + a * dt / 2
        if step in setup["steps"]:
            found.append((z, v))
    return np.array(found).T


@pytest.mark.statement(8, oracle="P3: LAMMPS")
def test_p3_the_adhesive_dashpot_moves_a_ball_as_in_lammps():
    case = published("P3")
    position, velocity = granular(case, adhesive=True)
    assert position[0] == pytest.approx(case.expected["position"][0], abs=case.tolerance["position"])
    assert position[1:] == pytest.approx(case.expected["position"][1:], abs=1e-9)
    assert velocity[1:] == pytest.approx(case.expected["velocity"], abs=case.tolerance["velocity"])


def test_p3_with_the_clamp_the_same_dashpot_leaves_more_speed():
    case = published("P3")
    position, _ = granular(case, adhesive=False)
    assert position[1] == pytest.approx(0.17994, abs=5e-6)
    mass = case.setup["density"] * math.pi * case.setup["diameter"] ** 3 / 6
    damping = penalty_damping(0.9, mass, case.setup["stiffness"], adhesive=True)
    assert penalty_restitution(mass, case.setup["stiffness"], damping) == pytest.approx(0.902, abs=5e-4)


def bounces(height, restitution, gravity, count):
    """Instants of the first impacts, and the apexes after them, from impact to impact."""
    z, v, pull, time, impacts, apexes = height * UP, np.zeros(3), -gravity * UP, 0.0, [], []
    for _ in range(count):
        fall = time_of_impact_exact(z[2], v[2], -gravity)
        z, v = ballistic_motion(z, v, pull, fall)
        v, time = kinematic_response(v, UP, restitution), time + fall
        impacts.append(time)
        apexes.append(ballistic_motion(z, v, pull, v[2] / gravity)[0][2])
    return impacts, apexes


@pytest.mark.statement(7, oracle="P5: MFiX")
def test_p5_the_apexes_of_a_bouncing_ball():
    case = published("P5")
    setup = case.setup
    _, found = bounces(setup["height"] - setup["radius"], setup["restitution"], setup["gravity"], 3)
    assert found == pytest.approx(case.expected["apexes"], abs=case.tolerance["apexes"])


@pytest.mark.statement(3, oracle="P6: Newton's own validation")
def test_p6_the_first_rebound_is_the_square_of_the_restitution():
    case = published("P6")
    setup = case.setup
    drop = setup["height"] - setup["radius"]
    for e, expected in zip(setup["restitution"], case.expected["ratio"], strict=True):
        z, v, highest, bounced = setup["height"] * UP, np.zeros(3), 0.0, False
        for _ in range(800):  # 0.8 s: down in 0.44, and past the top of the rebound
            z, v, impacts, _ = bounce_through_step(
                z, v, -setup["gravity"] * UP, UP, -setup["radius"], e, setup["timestep"]
            )
            bounced = bounced or impacts > 0
            highest = max(highest, z[2] - setup["radius"]) if bounced else 0.0
        assert highest / drop == pytest.approx(expected, rel=case.tolerance["ratio"])
        assert highest / drop == pytest.approx(expected, abs=2e-6)  # a sample is at most g (dt/2)²/2 below the top


@pytest.mark.statement(6, oracle="P12: Jolt")
def test_p12_a_thousand_steps_of_a_ball_that_is_answered_at_the_step():
    case = published("P12")
    setup = case.setup
    z, v, dt, pull = setup["height"] * UP, np.zeros(3), setup["timestep"], -setup["gravity"] * UP
    for _ in range(int(setup["steps"])):
        touches = side_of_plane(signed_distance(z, UP, -setup["radius"]), setup["slop"]) <= 0
        if touches and v[2] < 0:
            v = kinematic_response(v, UP, setup["restitution"])
            z = z + v * dt
        else:
            z, v = semi_implicit_euler(z, v, pull, dt)
    assert z[2] == pytest.approx(case.expected["height"], abs=case.tolerance["height"])
    assert v[2] == pytest.approx(case.expected["velocity"], abs=case.tolerance["velocity"])


@pytest.mark.statement(3, oracle="P15: Siconos")
def test_p15_the_impacts_the_apexes_and_the_end_of_a_bouncing_ball():
    case = published("P15")
    height, e, g = (case.setup[name] for name in ("height", "restitution", "gravity"))
    impacts, apexes = bounces(height, e, g, 6)
    assert impacts == pytest.approx(case.expected["impacts"], abs=case.tolerance["impacts"])
    assert apexes[:4] == pytest.approx(case.expected["apexes"], abs=case.tolerance["apexes"])
    assert time_until_rest(height, 0.0, -g, e) == pytest.approx(case.expected["rest"], abs=case.tolerance["rest"])
    for shift, count in ((-1e-5, 5), (1e-5, 6)):  # the whole motion in one step, to either side of the last impact
        assert bounce_along_normal(height, 0.0, -g, e, case.expected["impacts"][-1] + shift)[2] == count
    assert bounce_along_normal(height, 0.0, -g, e, case.expected["rest"] - 1e-5)[2] < math.inf
    assert bounce_along_normal(height, 0.0, -g, e, case.expected["rest"] + 1e-5)[2] == math.inf


@pytest.mark.statement(8, oracle="P18: Siconos")
def test_p18_a_ball_on_an_undamped_spring_turns_where_its_energy_is_in_the_spring():
    case = published("P18")
    mass, stiffness, g = (case.setup[name] for name in ("mass", "stiffness", "gravity"))
    dt, z, v, lowest, fastest = 1e-4, case.setup["height"] * UP, np.zeros(3), math.inf, 0.0
    for _ in range(7000):  # 0.7 s: 0.43 s of fall and a good quarter of a swing
        force = penalty_force(z[2] - case.setup["contact"], v[2], UP, stiffness)
        middle = v + (force / mass - g * UP) * dt / 2
        z = z + middle * dt
        force = penalty_force(z[2] - case.setup["contact"], middle[2], UP, stiffness)
        v = middle + (force / mass - g * UP) * dt / 2
        lowest, fastest = min(lowest, z[2]), max(fastest, abs(v[2]))
    # Verlet's own error: the contact begins within a step, k d dt at d = v dt, 4e-6 m/s; then (ω dt)² = 1e-6
    assert lowest == pytest.approx(case.expected["lowest"], abs=case.tolerance["lowest"])
    assert fastest == pytest.approx(case.expected["fastest"], abs=case.tolerance["fastest"])


def test_p26_balls_with_the_apparent_restitution_rebound_as_the_rules_ask():
    case = published("P26")
    for place, (drop, e) in enumerate(zip(case.setup["drop"], case.setup["restitution"], strict=True)):
        _, apexes = bounces(drop, e, 9.81, 1)
        assert apexes[0] == pytest.approx(case.expected["rebound"][place], abs=case.tolerance["rebound"])
