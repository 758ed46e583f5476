"""The recordings that the lab comes with: whole, of what is asked today, and what a live engine measures again."""

from __future__ import annotations

import math

import pytest

from reference.compare import Verdict
from reference.engines import engine_names, load_engine
from reference.published import recorded
from reference.published.running import plan
from reference.recording import FOLDER, recall
from reference.results import Job
from reference.scenarios import catalogue
from reference.study import profiles_of, run_job

ENGINES = tuple(name for name in engine_names() if load_engine(name).package is not None)
JOBS = [
    Job(family.name, name, profile, with_studies=True)
    for name in ENGINES
    for family in catalogue().values()
    for profile in profiles_of(load_engine(name), family)
]
PUBLISHED = {f"{name}/{recorded.FILE}" for name in ENGINES}
MOST_BYTES = 10_000_000


@pytest.mark.parametrize("job", JOBS, ids=str)
def test_every_run_is_recorded_and_none_of_it_is_stale(job):
    found = recall(job)
    assert found is not None, "not recorded; collisions record does it"
    stale = {row.case: row.note for row in found.rows if row.verdict is Verdict.NOT_AVAILABLE}
    assert not stale, "collisions record makes a new one"
    assert {row.case for row in found.rows} == {case.name for case in catalogue()[job.family].cases}
    assert found.series is not None or Verdict.CANNOT_EXPRESS in {row.verdict for row in found.rows}


def test_the_recordings_are_small_and_hold_no_run_that_there_is_not():
    files = {path.relative_to(FOLDER) for path in FOLDER.rglob("*") if path.is_file()}
    assert {str(path) for path in files} - PUBLISHED == {f"{job.engine}/{job.family}.json" for job in JOBS}
    assert sum((FOLDER / path).stat().st_size for path in files) < MOST_BYTES


@pytest.mark.parametrize("name", [name for name in ENGINES if (FOLDER / name / recorded.FILE).exists()])
def test_every_published_case_is_recorded_and_none_is_stale_or_fails(name):
    results = [recorded.recall(job) for job in plan((), (name,))]
    verdicts = {row.case: (row.verdict, row.note) for result in results for row in result.rows}
    wrong = (Verdict.NOT_AVAILABLE, Verdict.FAIL, Verdict.CRASHED)
    assert not {case: note for case, (verdict, note) in verdicts.items() if verdict in wrong}


def test_recorded_tuned_numbers_agree_with_theory_as_live_ones_do():
    rows = [row for job in JOBS if job.profile == "tuned" for row in recall(job).rows]
    assert not [row for row in rows if row.verdict in (Verdict.FAIL, Verdict.CRASHED)]


@pytest.mark.slow
@pytest.mark.parametrize("job", [job for job in JOBS if job.profile == "tuned"], ids=str)
def test_a_live_engine_measures_what_was_recorded(job, installed):
    installed(job.engine)
    live, recorded = run_job(job), recall(job)
    for now, then in zip(live.rows, recorded.rows, strict=True):
        assert (now.case, now.quantity, now.verdict) == (then.case, then.quantity, then.verdict)
        if now.measured is None:
            assert then.measured is None
            continue
        # Another processor rounds differently, and thousands of steps add that up: far below what is judged by.
        near = max(1e-6 * abs(then.measured), 0.01 * (then.tolerance or 0.0), 1e-9)
        assert math.isclose(now.measured, then.measured, rel_tol=0, abs_tol=near), (now.case, now.quantity)
