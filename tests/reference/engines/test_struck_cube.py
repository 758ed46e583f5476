"""A ball strikes a cube off its centre: each implementation follows the law of restitution that it is said to."""

from __future__ import annotations

from dataclasses import replace

import pytest
from mujoco_off_centre import Attempt, tried

from reference.catalogue.scenarios import find
from reference.comparison.compare import compare_case, judged, measured
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput
from reference.impact_truth import DISSIPATIVE, NEWTON, POISSON, STRONGE

FAMILY, _ = find("struck-cube")
TURNS_ROUND, GOES_ON = FAMILY.cases[0], FAMILY.cases[-1]
LAWS = {"exact": NEWTON, DISSIPATIVE: DISSIPATIVE, POISSON: POISSON, STRONGE: STRONGE}


def by_hand():
    return type(load_engine("handwritten"))(Implementation("solutions"))


def verdicts(case, profile, law):
    """Verdicts on a run by hand with a profile, judged as if it followed a law."""
    engine = by_hand()
    settings = engine.settings(case.scenarios[0], profile)
    trajectories = engine.run_many(case.scenarios, settings)
    method = replace(engine.method(case.scenarios[0], settings), law=law)
    numbers = {quantity.name: measured(quantity, trajectories) for quantity in FAMILY.quantities}
    rows = judged(FAMILY, case, engine.name, profile, settings, method, numbers)
    return {row.quantity: row.verdict for row in rows}


@pytest.mark.parametrize("profile", LAWS)
def test_by_hand_each_profile_follows_its_own_law_and_no_other(profile):
    for law in LAWS.values():
        found = verdicts(TURNS_ROUND, profile, law)
        assert (set(found.values()) == {Verdict.PASS}) == (law == LAWS[profile]), law
        assert set(verdicts(GOES_ON, profile, law).values()) == {Verdict.PASS}  # one law where the slip goes on


@pytest.mark.parametrize("profile", LAWS)
def test_by_hand_every_case_passes_under_every_law(profile):
    engine = by_hand()
    for case in FAMILY.cases:
        rows, _ = compare_case(FAMILY, case, engine, profile, engine.settings(case.scenarios[0], profile))
        assert {row.verdict for row in rows} == {Verdict.PASS}, case.name
        assert len(rows) == len(FAMILY.quantities)


def test_only_where_a_body_may_turn_are_there_profiles_for_the_laws():
    engine = by_hand()
    for name in ("two-balls", "spinning-ball", "struck-rod", "thin-wall"):
        family, _ = find(name)
        scenario = family.cases[0].scenarios[0]
        assert not set(engine.profiles(scenario)) & {DISSIPATIVE, POISSON, STRONGE}, name
        assert "impact_law" not in engine.settings(scenario, "exact").options, name


def test_an_unknown_law_of_impacts_is_refused_with_those_that_there_are():
    engine, scenario = by_hand(), TURNS_ROUND.scenarios[0]
    settings = engine.settings(scenario, "exact").change(impact_law="huygens")
    with pytest.raises(
        InvalidInput, match="impact_law is 'huygens'; here it is one of newton, dissipative, poisson, stronge"
    ):
        engine.run(scenario, settings)


def test_mujoco_would_keep_the_normal_impulse_without_friction(installed):
    installed("mujoco")
    scenario = TURNS_ROUND.scenarios[0]
    (restitution, *_) = (quantity.measure(tried(scenario, Attempt())) for quantity in FAMILY.quantities)
    assert restitution == pytest.approx(0.5784, abs=2e-3)  # (1 + e) u/k along the normal, and friction after it
