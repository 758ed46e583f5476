"""One job: its rows, its curve, its convergence, and what breaks one case or one timestep alone."""

from __future__ import annotations

import pickle
import re
from dataclasses import replace

import numpy as np
import pytest
from odd_engines import GOOD, STUDIED, engine_file

from reference.catalogue.scenarios import catalogue
from reference.comparison.curves import Series
from reference.comparison.results import Job
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.running.jobs import run_one
from reference.running.study import SCENARIOS, run_job

DROPPED, SLIDING = catalogue()["dropped-ball"], catalogue()["sliding-slab"]


def test_a_job_runs_the_cases_that_it_names_or_else_all():
    family = catalogue()["parting-ball"]
    all_cases = run_job(replace(STUDIED, cases=(), with_studies=False)).rows
    assert [row.case for row in all_cases if row.quantity == "first"] == [case.name for case in family.cases]
    two = run_job(replace(STUDIED, cases=("v=0.5", "v=0.1"), with_studies=False)).rows
    assert set(two) == {row for row in all_cases if row.case in ("v=0.1", "v=0.5")}


def test_a_job_runs_with_the_settings_that_it_changes():
    plain = run_job(Job("dropped-ball", "handwritten", "step", ("e=0.5",)))
    coarse = run_job(Job("dropped-ball", "handwritten", "step", ("e=0.5",), changes=(("timestep", 4e-3),)))
    (fine_row, _), (coarse_row, _) = plain.rows, coarse.rows
    assert "timestep 0.004 s" in coarse.settings
    assert coarse_row.error == pytest.approx(4 * fine_row.error, rel=1 / 6)  # first order; a sawtooth over 13 drops


def test_a_job_says_what_ran_and_how_long():
    result = run_job(GOOD)
    assert result.title == "hand-written"
    assert result.description == "exact root"
    assert result.version
    assert result.seconds > 0
    assert "policy exact_root" in result.settings
    assert {row.verdict for row in result.rows} == {Verdict.PASS}


@pytest.mark.slow
def test_a_job_has_a_curve_for_the_plotted_case_or_on_request(monkeypatch):
    curve, single = DROPPED.curve, [replace(case, scenarios=case.scenarios[:1]) for case in DROPPED.cases]
    monkeypatch.setitem(catalogue(), "dropped-ball", replace(DROPPED, cases=tuple(single)))
    other = Job("dropped-ball", "handwritten", "exact", ("e=1",))
    assert run_job(other).series is None
    assert run_job(replace(other, with_curve=True)).series.values[-1] > 0.9  # it rises again to where it came from
    series = run_job(Job("dropped-ball", "handwritten", "exact", (curve.case,))).series
    assert len(series.times) == len(series.values)
    assert 30 <= len(series.times) <= 200  # a fall and a rise: enough for a smooth line, few enough to be kept
    assert series.times[0] == 0
    assert series.values[0] == pytest.approx(1.0, abs=1e-6)  # the gap at the start; curves are rounded to 1e-7 m
    until = catalogue()["ball-to-rest"].curve.until
    assert run_job(Job("ball-to-rest", "handwritten", "exact", ("e=0.8",))).series.times[-1] <= until


def test_a_curve_has_a_gap_where_its_value_is_not_finite():
    engine, scenario = load_engine("handwritten"), DROPPED.case(DROPPED.curve.case).scenarios[0]
    trajectory = engine.run(scenario, engine.settings(scenario, "exact").change(timestep=0.01))
    values = np.where(trajectory.times < 0.105, np.inf, 1.0)
    curve = Series.of(replace(DROPPED, curve=replace(DROPPED.curve, values=lambda _: values)), trajectory)
    assert curve.times == pytest.approx(trajectory.times[[11, -1]])  # and straight on from there
    assert set(curve.values) == {1.0}


def test_convergence_is_studied_only_on_request():
    assert run_job(replace(STUDIED, with_studies=False)).convergence is None
    found = run_job(replace(STUDIED, profile="step")).convergence
    assert found.timesteps == pytest.approx([4e-3, 2e-3, 1e-3, 5e-4])
    assert len(found.errors) == 4


def test_a_refused_timestep_leaves_a_gap_in_the_convergence(tmp_path):
    picky = engine_file(tmp_path, "picky", "if settings.timestep > 0.02: raise CannotExpress('too coarse')\n" + FALLING)
    found = run_job(Job("dropped-ball", picky, "tuned", ("e=0.5",), with_studies=True)).convergence
    assert found.timesteps == pytest.approx([0.02, 0.01, 0.005])


def test_a_timestep_that_breaks_leaves_a_gap_in_the_convergence(tmp_path):
    broken = engine_file(tmp_path, "broken", "1 / (settings.timestep > 0.01)\n" + FALLING)
    found = run_job(Job("dropped-ball", broken, "tuned", ("e=0.5",), with_studies=True)).convergence
    assert found.timesteps == pytest.approx([0.04, 0.02])
    lift = (
        "state[15] *= 1e150 if settings.timestep > 0.02 else 1\n    recorder.sample"  # the apex has no square in floats
    )
    huge = engine_file(tmp_path, "huge", FALLING.replace("recorder.sample", lift))
    found = run_job(Job("dropped-ball", huge, "tuned", ("e=0.5",), with_studies=True)).convergence
    assert found.timesteps == pytest.approx([0.02, 0.01, 0.005])
    assert np.isfinite(found.errors).all()


def test_a_case_that_breaks_an_engine_costs_that_case_alone(tmp_path):
    odd = engine_file(tmp_path, "odd", "1 / (scenario.pairs[0].restitution != 0.5)\n" + FALLING)
    result = run_job(Job("dropped-ball", odd, "tuned", ("e=0.2", "e=0.5", "e=0.8")))
    (crashed,) = (row for row in result.rows if row.case == "e=0.5")
    assert crashed.verdict is Verdict.CRASHED
    assert re.fullmatch(r"ZeroDivisionError: division by zero, at line \d+ of odd\.py, in \w+", crashed.note)
    others = [row for row in result.rows if row.case != "e=0.5"]
    assert [(row.case, row.quantity) for row in others] == [
        (case, quantity) for case in ("e=0.2", "e=0.8") for quantity in ("rebound", "sink")
    ]
    assert all(row.measured is not None for row in others)
    assert result.series is None  # the plotted case is the one that crashed


FALLING = """
z = state[15]  # the ball is the second body: 13 numbers of the floor, then x, y, z
for number in range(steps + 1):
    t = number * settings.timestep
    fall, down = (2 * (z - 0.1) / 9.81) ** 0.5, 9.81 * t
    height = z - 9.81 * t * t / 2 if t < fall else 0.1 + 4.429 * 0.5 * (t - fall) - 9.81 * (t - fall) ** 2 / 2
    state[15], state[22] = height, (-down if t < fall else 4.429 * 0.5 - 9.81 * (t - fall))
    recorder.sample(list(state))
"""


def test_an_isolated_job_gives_the_same_rows_as_one_in_this_process():
    here, isolated = run_job(GOOD), run_one(GOOD, SCENARIOS)
    assert isolated == here
    assert [row.measured for row in isolated.rows] == [row.measured for row in here.rows]


def test_a_result_can_be_pickled():
    result = run_job(STUDIED)
    assert None not in (result.series, result.convergence, result.split)
    assert pickle.loads(pickle.dumps(result)) == result
