"""Two fast balls that meet at random offsets: how many pass, by theory, by counting and in every implementation."""

from __future__ import annotations

import functools
from dataclasses import replace

import numpy as np
import pytest

from reference import sweeping_truth
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.passing_balls import MEETINGS, NEAR_THE_MEAN, REACH
from reference.comparison.compare import compare_case, measured
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.base import AT_STEP, Method
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

FAMILY = catalogue()["passing-balls"]
NEAR = NEAR_THE_MEAN / MEETINGS


def approach(scenario) -> tuple[float, float, float]:
    """Relative speed, m/s, distance at which the centres pass, m, and the instant of that, s, if nothing turns them."""
    heavy, light = (scenario.body(name) for name in ("heavy", "light"))
    between, velocity = np.subtract(heavy.position, light.position), np.subtract(heavy.velocity, light.velocity)
    speed = float(np.linalg.norm(velocity))
    nearest = -float(between @ velocity) / speed**2
    return speed, float(np.linalg.norm(between + nearest * velocity)), nearest


@functools.cache
def counted(case: str, timestep: float) -> tuple[float, float]:
    """Share of the meetings of a case in which no step ends in overlap, and in overlap while the balls approach."""
    unseen = unturned = 0
    for scenario in FAMILY.case(case).scenarios:
        speed, offset, nearest = approach(scenario)
        half = np.sqrt(REACH**2 - offset**2)
        way = speed * (np.arange(int(scenario.duration / timestep) + 2) * timestep - nearest)
        unseen += not np.any(np.abs(way) < half)
        unturned += not np.any((way > -half) & (way < 0))
    return unseen / MEETINGS, unturned / MEETINGS


@pytest.mark.parametrize("timestep", [1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 1 / 240])
@pytest.mark.parametrize("case", [case.name for case in FAMILY.cases])
def test_meetings_stand_for_all_phases_and_offsets(case, timestep):
    way = FAMILY.case(case).parameters["speed"] * timestep
    unseen, unturned = counted(case, timestep)
    assert unseen == pytest.approx(sweeping_truth.missed_balls(way, REACH), abs=NEAR)
    assert unturned == pytest.approx(sweeping_truth.unturned_balls(way, REACH), abs=NEAR)


def test_the_two_balls_of_every_meeting_touch_in_time():
    for case in FAMILY.cases:
        for scenario in case.scenarios:
            speed, offset, nearest = approach(scenario)
            assert offset < REACH
            assert 0 < nearest - np.sqrt(REACH**2 - offset**2) / speed < scenario.duration


def overlapped(trajectory: Trajectory) -> bool:
    between = trajectory.position("heavy") - trajectory.position("light")
    return bool(np.any(np.linalg.norm(between, axis=1) < REACH))


@pytest.mark.parametrize(
    ("name", "profile"), [("handwritten", "step"), *((n, "tuned") for n in ("pybullet", "mujoco"))]
)
def test_two_thirds_pass_where_a_step_is_twice_the_sum_of_the_radii(name, profile, installed):
    engine, case = installed(name), FAMILY.case("v=40")
    settings = engine.settings(case.scenarios[0], profile).change(timestep=1e-3)  # so that D = 2R, and all is sampled
    rows, trajectories = compare_case(FAMILY, case, engine, profile, settings)
    unseen = 1 - np.mean([overlapped(each) for each in trajectories])
    assert (unseen, rows[0].measured) == pytest.approx(counted("v=40", 1e-3))
    assert (unseen, rows[0].measured) == pytest.approx((1 / 3, 2 / 3), abs=NEAR)
    assert {row.quantity: row.verdict for row in rows} == {
        "passed": Verdict.DISAGREES,
        "exchanged": Verdict.KNOWN_DEVIATION,
    }


@pytest.mark.parametrize("case", ["v=10", "v=120"])
def test_a_swept_ball_finds_every_meeting_at_any_timestep(case):
    engine, case = load_engine("handwritten"), FAMILY.case(case)
    settings = engine.settings(case.scenarios[0], "exact").change(timestep=0.01)
    rows, _ = compare_case(FAMILY, case, engine, "exact", settings)
    assert {row.verdict for row in rows} == {Verdict.PASS}


def test_balls_that_start_a_hair_nearer_are_not_as_predicted(installed):
    """A tenth of a millimetre decides for some meetings whether a step notices them, and for all how late."""
    engine, case = installed("pybullet"), FAMILY.case("v=10")
    scenarios = case.scenarios[:11]
    settings = engine.settings(scenarios[0], "tuned")
    moved = []
    for scenario in scenarios:
        heavy, light = scenario.bodies
        nearer = np.array(heavy.position) + 1e-4 * np.array(heavy.velocity) / np.linalg.norm(heavy.velocity)
        moved.append(replace(scenario, bodies=(replace(heavy, position=tuple(nearer)), light)))
    ran = engine.run_many(moved, settings)
    told = [replace(trajectory, scenario=true) for trajectory, true in zip(ran, scenarios, strict=True)]
    quantity = FAMILY.quantity("exchanged")
    method = engine.method(scenarios[0], settings)
    predicted = [FAMILY.predict(scenario, settings, method).trajectory for scenario in scenarios]
    off = np.subtract(measured(quantity, told).values, measured(quantity, predicted).values)
    assert np.count_nonzero(np.abs(off) > 1e-3) >= 6


def test_the_shift_of_a_share_leaves_room_for_the_spread_of_the_meetings():
    quantity = FAMILY.quantity("passed")
    found = quantity.expect(FAMILY.case("v=40"), Settings(1e-3), Method(AT_STEP))
    assert found.shift == pytest.approx(2 / 3)
    assert found.shift_tolerance == pytest.approx(NEAR)
