"""The smallest fault that a verdict notices: found, confirmed by a run, and as large as the verdicts are coarse."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison import sensitivity
from reference.comparison.faults import FAULTS
from reference.comparison.sensitivity import Finding, Outcome, Sensitivity, Subject, chosen
from reference.engines import load_engine
from reference.errors import CannotExpress
from reference.prediction.bands import Term
from reference.recording import sensitivity as kept

HAND = load_engine("handwritten")
FAULT = {fault.name: fault for fault in FAULTS}
DROPS = catalogue()["dropped-ball"]


def with_bands(family, factor):
    """The same family, with a judge so many times as coarse."""

    def predict(*asked):
        found = family.predict(*asked)
        return replace(found, terms=(*found.terms, Term("coarser", (factor - 1) * found.near)))

    return replace(family, predict=predict)


def found_in(family, case, profile, fault):
    return Subject.of(family, family.case(case), HAND, profile).finding(FAULT[fault])


@pytest.mark.parametrize("fault", ["restitution", "timestep"])
def test_a_judge_that_is_coarser_notices_only_larger_faults(fault):
    sharp, coarse = (found_in(with_bands(DROPS, factor), "e=0.5", "step", fault) for factor in (1.0, 100.0))
    assert sharp.outcome is Outcome.NOTICED
    assert coarse.size == pytest.approx(100 * sharp.size, rel=0.2)


def test_the_size_of_a_restitution_is_what_the_band_allows():
    """A rebound of e² of 1 m changes by 2 e² of the share by which e changes."""
    found, case = found_in(DROPS, "e=0.5", "slide", "restitution"), DROPS.case("e=0.5")
    settings = HAND.settings(case.scenarios[0], "slide")
    near = DROPS.predict(case.scenarios[0], settings, HAND.method(case.scenarios[0], settings)).near
    assert (found.case, found.quantity) == ("e=0.5", "rebound")
    assert near / 0.5 < found.size < 1.1 * near / 0.5


def test_a_restitution_of_one_can_only_be_too_small():
    assert found_in(DROPS, "e=1", "slide", "restitution").outcome is Outcome.NOTICED


@pytest.mark.slow
def test_what_physics_does_not_depend_on_has_no_effect():
    for fault in ("mass", "inertia", "sample"):
        assert found_in(DROPS, "e=0.5", "slide", fault).outcome is Outcome.NO_EFFECT


@pytest.mark.slow
def test_a_judge_that_accepts_everything_notices_nothing():
    blind = with_bands(DROPS, 1e12)
    assert found_in(blind, "e=0.5", "slide", "restitution").outcome is Outcome.NOT_NOTICED
    assert found_in(blind, "e=0.5", "slide", "sign").outcome is Outcome.NOT_NOTICED


def test_faults_without_a_size_are_noticed_or_not():
    rest = catalogue()["ball-to-rest"]
    assert found_in(rest, "e=0.5", "slide", "sample") == Finding("sample", Outcome.NOTICED, None, "e=0.5", "rest_time")
    assert found_in(DROPS, "e=0.5", "slide", "sign").outcome is Outcome.NOTICED


@pytest.mark.slow
def test_a_step_that_falls_elsewhere_is_found_by_trying():
    """The time of rest is a whole number of steps: no slope says where it changes."""
    rest = catalogue()["ball-to-rest"]
    found = found_in(replace(rest, quantities=rest.quantities[:1]), "e=0.5", "step", "gravity")
    assert found.quantity == "rest_time"
    assert 1e-5 < found.size < 0.01


def test_a_case_that_has_the_coefficient_is_chosen_too():
    drops = replace(DROPS, convergence=replace(DROPS.convergence, case="e=0"))
    assert [case.name for case in chosen(DROPS)] == ["e=0.5"]
    assert [case.name for case in chosen(drops)] == ["e=0", "e=0.2"]


@pytest.mark.slow
def test_friction_is_tried_in_the_case_where_it_matters():
    """In the studied case the cube grips, and more friction changes nothing; elsewhere it slips."""
    found, _ = sensitivity.sensitivity(catalogue()["struck-cube"], HAND, "exact")
    assert found.finding("friction").case == "x=0.08,ω=40,μ=0.1"
    assert found.finding("timestep") is None, "the exact root has no timestep"


class _Choosy(type(HAND)):
    """Hand-written code that has no words for the studied case of the three balls."""

    def run_many(self, scenarios, settings):
        if "v=0.1" in scenarios[0].name:
            raise self.cannot(scenarios[0], "it is too slow")
        return super().run_many(scenarios, settings)


def test_another_case_is_tried_where_the_studied_one_cannot_be_run():
    family = catalogue()["parting-ball"]
    found, rows = sensitivity.sensitivity(family, _Choosy(), "exact")
    assert found.finding("restitution").case == rows[0].case == "v=0.3"
    with pytest.raises(CannotExpress, match="too slow"):
        sensitivity.sensitivity(replace(family, cases=family.cases[:1]), _Choosy(), "exact")


def test_what_is_kept_is_read_again_and_a_new_run_replaces_it(tmp_path):
    file = tmp_path / "kept.json"
    noticed = Finding("gravity", Outcome.NOTICED, 1.5e-9, "e=0.5", "sink")
    old = Sensitivity(
        "dropped-ball", "pybullet", "PyBullet", "tuned", True, (noticed, Finding("mass", Outcome.NO_EFFECT))
    )
    other = replace(old, engine="mujoco", title="MuJoCo")
    kept.keep([other, old, replace(old, family="a family that is no more")], file)
    assert kept.read(file) == (old, other)
    better = replace(old, findings=(replace(noticed, size=1e-9),))
    kept.keep([better], file)
    assert kept.read(file) == (better, other)
