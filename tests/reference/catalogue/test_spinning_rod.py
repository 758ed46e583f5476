"""A spinning rod that strikes a ball: the share that it passes, by theory, by counting and in each implementation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference import sweeping_truth
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.spinning_rods import (
    BALL,
    DISTANCE,
    HALF_LENGTH,
    HALF_THICKNESS,
    PASSES,
    REACH,
    RESTITUTION,
    ROD,
    impulse,
)
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.errors import NeedsFunction
from reference.scene.scenario import Box, Scenario

FAMILY = catalogue()["spinning-rod"]
SPIN = "ω=100"


def rows_of(name: str, profile: str, case: str = SPIN, **changes):
    engine, found = load_engine(name), FAMILY.case(case)
    settings = engine.settings(found.scenarios[0], profile).change(**changes)
    rows, _ = compare_case(FAMILY, found, engine, profile, settings)
    return {row.quantity: row for row in rows}


@pytest.mark.parametrize("turn", [0.004, 0.02, 0.1, 0.7])
def test_the_share_that_a_rod_passes_is_that_of_phases_drawn_by_chance(turn):
    """The rod is a strip, seen at angles a turn apart. A strike is an overlap before the strip's middle line."""
    phases = np.random.default_rng(9).uniform(size=20_000) * turn
    angles = phases[:, None] - turn * np.arange(1 + int(0.02 / turn) + 1)  # from the ball back to the rod, rad
    height, way = DISTANCE * np.sin(angles), DISTANCE * np.cos(angles)
    strikes = np.any((np.abs(height) < REACH) & (angles > 0) & (way < HALF_LENGTH), axis=1)
    # Behind angles of 0.02 rad nothing overlaps any more: asin(c/d) is half of that.
    assert sweeping_truth.unturned_hands(turn, REACH, DISTANCE) == pytest.approx(1 - np.mean(strikes), abs=0.015)


def test_the_impulse_keeps_both_momenta_and_restores_e_times_the_approach():
    """The rod along x, the ball above it: four equations for the velocities of both, the spin and the impulse."""
    spin, arm = 7.0, np.sqrt(DISTANCE**2 - REACH**2)
    inertia = ROD * (HALF_LENGTH**2 + HALF_THICKNESS**2) / 3
    equations = np.array(
        [
            [ROD, 0.0, 0.0, 1.0],  # M V = −j
            [0.0, inertia, 0.0, arm],  # I ω⁺ = I ω − j a
            [0.0, 0.0, BALL, -1.0],  # m v = j
            [-1.0, -arm, 1.0, 0.0],  # v − V − ω⁺ a = e ω a
        ]
    )
    *_, found = np.linalg.solve(equations, [0.0, inertia * spin, 0.0, RESTITUTION * spin * arm])
    assert impulse(spin) == pytest.approx(found)


REST = [("pybullet", SPIN, 2e-4), ("dart", SPIN, 2e-4), ("mujoco", "ω=20", 1e-3), ("pybullet", "ω=300", 1e-4)]


@pytest.mark.parametrize(
    ("name", "case", "timestep"),
    [("mujoco", SPIN, 2e-4), *(pytest.param(*each, marks=pytest.mark.slow) for each in REST)],
)
def test_an_engine_passes_the_balls_whose_angle_is_less_than_a_steps(name, case, timestep, installed):
    installed(name)
    rows = rows_of(name, "tuned", case, timestep=timestep)
    share = sweeping_truth.unturned_hands(float(case.removeprefix("ω=")) * timestep, REACH, DISTANCE)
    assert share > 0.4
    assert rows["passed"].measured == pytest.approx(share, abs=1 / PASSES)  # evenly spread phases
    assert rows["gained"].measured == pytest.approx(1 - rows["passed"].measured, abs=1e-3)
    assert {row.verdict for row in rows.values()} == {Verdict.DISAGREES, Verdict.KNOWN_DEVIATION}


@pytest.mark.parametrize("timestep", [1e-3, pytest.param(5e-3, marks=pytest.mark.slow)])
def test_conservative_advancement_passes_no_ball_at_any_timestep(timestep):
    rows = rows_of("handwritten", "exact", "ω=300", timestep=timestep)
    assert {row.verdict for row in rows.values()} == {Verdict.PASS}
    assert rows["gained"].measured == pytest.approx(1, abs=1e-9)


def test_a_rod_one_percent_thinner_is_not_as_predicted(installed):
    engine, scenario = installed("mujoco"), FAMILY.case(SPIN).scenarios[0]
    rod, ball = scenario.bodies
    thinner = Box((HALF_LENGTH, 0.99 * HALF_THICKNESS, rod.shape.half_extents[2]))
    other = replace(scenario, bodies=(replace(rod, shape=thinner, inertia=rod.moments_of_inertia()), ball))
    settings = engine.settings(scenario, "tuned")
    gained = FAMILY.quantity("gained").measure
    ran = gained(replace(engine.run(other, settings), scenario=scenario))
    prediction = FAMILY.predict(scenario, settings, engine.method(scenario, settings))
    expected = gained(prediction.trajectory)
    assert abs(ran - expected) > 100 * prediction.band(expected)


def test_a_ball_that_the_end_of_a_rod_meets_needs_a_rigid_body_world():
    scenario = FAMILY.case(SPIN).scenarios[0]
    rod, ball = scenario.bodies
    outwards = np.array(ball.position) / DISTANCE
    at_the_end = replace(ball, position=tuple((HALF_LENGTH + 0.001) * outwards))
    beside: Scenario = replace(scenario, bodies=(rod, at_the_end))
    engine = load_engine("handwritten")
    with pytest.raises(NeedsFunction, match="needs a rigid-body world"):
        engine.run(beside, engine.settings(beside, "exact"))
