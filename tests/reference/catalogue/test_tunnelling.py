"""A fast ball against a thin wall: how many pass, and that theory, derivation and both engines agree on it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from levels import in_turn

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.tunnelling import CAUGHT, SHOTS, SPREAD, passing_share
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.base import AT_STEP, EXACT, Method
from reference.prediction import passing
from reference.scene.settings import Settings

FAMILY = catalogue()["thin-wall"]


def brute_force_share(speed: float, timestep: float) -> float:
    """Share of many evenly spread phases at which no step ends between the first touch and the wall's middle."""
    phases = (np.arange(100_000) + 0.5) / 100_000
    first_end_after_touch = phases * speed * timestep
    return float(np.mean(first_end_after_touch > CAUGHT))


@pytest.mark.parametrize("timestep", [1 / 60, 1 / 240, 2e-3, 1e-3])
@pytest.mark.parametrize("speed", [5.0, 10.0, 20.0, 40.0])
def test_the_share_that_passes_agrees_with_counting_the_phases(speed, timestep):
    # 1e-5: one phase of the hundred thousand.
    assert passing_share(speed, timestep) == pytest.approx(brute_force_share(speed, timestep), abs=1.1e-5)


@pytest.mark.parametrize("timestep", [1 / 240, 4e-3, 2e-3, 1e-3, 1e-4])
@pytest.mark.parametrize("case", FAMILY.cases, ids=lambda case: case.name)
def test_shots_reach_the_wall_at_evenly_spread_phases_of_a_step(case, timestep):
    speed = case.parameters["speed"]
    times = np.array([(-CAUGHT - shot.body("ball").position[0]) / speed for shot in case.scenarios])
    phases = np.sort(times / timestep % 1)
    gaps = np.diff([*phases, phases[0] + 1])
    assert len(phases) == SHOTS
    # Rounding: flight times of 0.1 s, known to 1e-15 of that, over a step of 0.1 ms.
    np.testing.assert_allclose(gaps, 1 / SHOTS, atol=1e-10)


def test_exact_methods_let_nothing_pass_and_step_methods_the_derived_share():
    case = FAMILY.case("v=20")
    exact, at_step = (FAMILY.quantity("passed").expect(case, Settings(2e-3), Method(kind)) for kind in (EXACT, AT_STEP))
    assert (exact.value, exact.shift) == (0.0, 0.0)
    assert (at_step.value, at_step.shift) == (0.0, 20 / SHOTS)
    assert at_step.shift == pytest.approx(passing_share(20.0, 2e-3), abs=1 / SHOTS)  # less than one ball of them all


def test_the_share_that_passes_is_counted_where_all_shots_meet_the_wall_at_one_phase():
    """A shot follows the one before by a whole step: all are caught, where a third of those at all phases pass."""
    case = FAMILY.case("v=20")
    share = FAMILY.quantity("passed").expect(case, Settings(SPREAD / SHOTS), Method(AT_STEP)).shift
    assert share == 0.0
    assert passing_share(20.0, SPREAD / SHOTS) > 0.3


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
def test_by_hand_a_shot_comes_back_with_the_share_of_its_speed(restitution):
    engine, scenario = load_engine("handwritten"), FAMILY.case("v=20").scenarios[2]
    scenario = replace(scenario, pairs=(replace(scenario.pairs[0], restitution=restitution),))
    settings = engine.settings(scenario, "step")
    found = passing.predict(scenario, settings, engine.method(scenario, settings)).trajectory
    run = engine.run(scenario, settings)
    np.testing.assert_allclose(run.positions, found.positions, rtol=0, atol=1e-9)
    assert found.velocity("ball")[-1, 0] == pytest.approx(-20 * restitution)


ENGINES = ("pybullet", "mujoco", "dart")
SHOWN = ((20, 1e-3), (20, 2e-3), (10, 4e-3), (5, 4e-3), (20, 4e-3))
FEW = [("pybullet", 20, 1e-3), *((name, 20, 4e-3) for name in ENGINES)]


@pytest.mark.parametrize(("name", "speed", "timestep"), in_turn(ENGINES, SHOWN, FEW))
def test_an_engine_lets_the_derived_share_pass_at_a_coarse_timestep(name, speed, timestep, installed):
    engine, case = installed(name), FAMILY.case(f"v={speed}")
    settings = engine.settings(case.scenarios[0], "tuned").change(timestep=timestep)
    rows, _ = compare_case(FAMILY, case, engine, "tuned", settings)
    # Evenly spread phases: less than one ball off.
    assert rows[0].measured == pytest.approx(passing_share(speed, timestep), abs=1 / SHOTS)
    expected = Verdict.DISAGREES if passing_share(speed, timestep) else Verdict.PASS
    assert {row.verdict for row in rows} == {expected}


@pytest.mark.parametrize(("profile", "timestep", "share"), [("exact", 0.01, 0.0), ("step", 0.01, 0.5)])
def test_hand_written_code_lets_the_share_of_its_method_pass(profile, timestep, share):
    engine, case = load_engine("handwritten"), FAMILY.case("v=10")
    settings = engine.settings(case.scenarios[0], profile).change(timestep=timestep)
    rows, _ = compare_case(FAMILY, case, engine, profile, settings)
    # A step goes 0.1 m; by hand the ball is turned back wherever it overlaps the wall, on 0.05 m. One ball off at most.
    assert rows[0].measured == pytest.approx(share, abs=1 / SHOTS if share else 0)
    assert {row.verdict for row in rows} == {Verdict.DISAGREES if share else Verdict.PASS}
