"""Balls that meet nothing, by hand: the closed form is the limit of many short steps, and each part is used."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.engines import load_engine
from reference.errors import InvalidInput
from reference.prediction import loaded
from reference.scene.forces import Fluid, Force, OscillatingForce, Spring
from reference.scene.scenario import Body, Box, Scenario, Sphere
from reference.scene.settings import Settings

HEAVY = Body("heavy", Sphere(0.2), 3.0, (0.4, -0.2, 1.0), velocity=(0.3, -0.5, 0.2))
LIGHT = Body("light", Sphere(0.1), 0.5, (-0.7, 0.5, 1.6), velocity=(-1.0, 0.4, 0.0))
BODIES = HEAVY, Body("post", Box((0.1, 0.1, 0.1)), position=(0.0, 0.0, 3.0)), LIGHT
PUSHED = Scenario("flight", BODIES, (), 0.25, forces=(Force("light", (1.0, 2.0, -0.5)),))
POST = (0.2, -0.1, 2.0)
HUNG = Body("hung", Sphere(0.1), 0.8, (0.8, -0.1, 1.2), velocity=(0.6, 0.0, -0.8))
TILTED = replace(
    PUSHED,
    bodies=(BODIES[1], HUNG),
    forces=(Force("hung", (3.0, 0.0, -4.0)),),
    gravity=(0.6 * 9.81, 0.0, -0.8 * 9.81),
)
FLIGHTS = {
    "throw": PUSHED,
    "lifted": replace(PUSHED, fluid=Fluid(density=20.0)),
    "slowed": replace(PUSHED, fluid=Fluid(1.2, 8.0, (0.5, 0.0, -1.0))),
    "on a spring": replace(TILTED, springs=(Spring("", "hung", 30.0, 0.8, 2.0, POST),)),
    "two on a spring": replace(
        PUSHED,
        bodies=(HEAVY, replace(LIGHT, velocity=(-0.8, 0.2, 0.8))),
        forces=(Force("heavy", (6.0, 0.0, 0.0)), Force("light", (1.0, 0.0, 0.0))),
        springs=(Spring("heavy", "light", 25.0, 1.0, 1.0),),
    ),
}
"""Two unequal balls and a post, each with a force more."""
HANDWRITTEN = load_engine("handwritten")
each_flight = pytest.mark.parametrize("scenario", list(FLIGHTS.values()), ids=list(FLIGHTS))


@each_flight
def test_the_closed_form_of_a_flight_is_the_limit_of_short_steps(scenario):
    exact = HANDWRITTEN.run(scenario, HANDWRITTEN.settings(scenario, "exact"))
    settings = HANDWRITTEN.settings(scenario, "step")
    ends = []
    for factor in (1.0, 0.5):  # an error of first order is gone from twice the second less the first
        each = replace(settings, timestep=1e-3 * factor, sample_every=1)
        found = loaded.predict(scenario, each, HANDWRITTEN.method(scenario, each)).trajectory
        ends.append(np.concatenate([found.positions[-1], found.velocities[-1]]))
    limit = 2 * ends[1] - ends[0]
    last = np.concatenate([exact.positions[-1], exact.velocities[-1]])
    np.testing.assert_allclose(last, limit, atol=1e-4)  # τ v (dt/τ)², with τ = 33 ms of the slowed ball


@each_flight
def test_steps_of_a_flight_by_hand_follow_the_recurrence(scenario):
    settings = HANDWRITTEN.settings(scenario, "step")
    run = HANDWRITTEN.run(scenario, settings)
    expected = loaded.predict(scenario, settings, HANDWRITTEN.method(scenario, settings)).trajectory
    np.testing.assert_allclose(run.positions, expected.positions, atol=1e-12)
    np.testing.assert_allclose(run.velocities, expected.velocities, atol=1e-12)


def test_a_spinning_ball_that_nothing_slows_turns_evenly_in_closed_form():
    spinning = replace(HEAVY, angular_velocity=(0.0, 0.0, 2.0))
    scenario = Scenario("spin", (spinning,), (), 0.5)
    run = HANDWRITTEN.run(scenario, HANDWRITTEN.settings(scenario, "exact"))
    np.testing.assert_allclose(run.orientations[-1, 0], [np.cos(0.5), 0.0, 0.0, np.sin(0.5)], atol=1e-12)
    drowned = replace(scenario, fluid=Fluid(viscosity=1.0))
    assert list(HANDWRITTEN.profiles(drowned)) == ["world"]  # its spin decays, for which the lecture has no closed form


def test_a_flight_has_no_instant_to_solve_for():
    with pytest.raises(InvalidInput, match="policy is 'exact_root'; here it is one of semi_implicit"):
        HANDWRITTEN.run(PUSHED, Settings(1e-3, options={"policy": "exact_root"}))


ON_A_SPRING = FLIGHTS["on a spring"]


@pytest.mark.parametrize(
    "scenario",
    [
        replace(ON_A_SPRING, gravity=(0.0, 0.0, -9.81)),  # it swings to the side as well
        replace(ON_A_SPRING, springs=(replace(ON_A_SPRING.springs[0], point_b=(0.05, 0.0, 0.0)),)),  # and is turned
        replace(ON_A_SPRING, bodies=(BODIES[1], replace(HUNG, velocity=(6.0, 0.0, -8.0)))),  # and passes its end
        replace(ON_A_SPRING, springs=ON_A_SPRING.springs * 2),
        replace(ON_A_SPRING, fluid=Fluid(viscosity=1.0)),
        replace(ON_A_SPRING, forces=(OscillatingForce("hung", (0.0, 1.0, 0.0), 3.0),)),
    ],
    ids=["weight aside", "off its centre", "too short", "two springs", "in a fluid", "pushed aside"],
)
def test_a_spring_that_does_not_swing_in_a_line_runs_in_the_world_alone(scenario):
    assert list(HANDWRITTEN.profiles(scenario)) == ["world"]


def test_a_driven_spring_is_the_limit_of_short_steps_either_way():
    for amplitude in ((3.0, 0.0, -4.0), (-3.0, 0.0, 4.0)):
        drive = OscillatingForce("hung", amplitude, 3.0, 0.4)
        scenario = replace(ON_A_SPRING, forces=(*ON_A_SPRING.forces, drive), duration=0.2)
        ends = []
        for factor in (1.0, 0.5):
            settings = replace(HANDWRITTEN.settings(scenario, "step"), timestep=1e-3 * factor)
            ends.append(HANDWRITTEN.run(scenario, settings).positions[-1])
        exact = HANDWRITTEN.run(scenario, HANDWRITTEN.settings(scenario, "exact")).positions[-1]
        np.testing.assert_allclose(exact, 2 * ends[1] - ends[0], atol=1e-5)  # (ω dt)² of 1 m
