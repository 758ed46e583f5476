"""What is said of jobs before they have run: cached, recorded, or still running."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Verdict
from reference.errors import InvalidInput
from reference.running import interim
from reference.running.cache import Cache
from reference.running.interim import before_the_runs
from reference.running.study import SCENARIOS

CASE = ("v=0.1",)
BY_HAND, TUNED, STOCK = (
    Job("parting-ball", engine, profile, CASE)
    for engine, profile in (("handwritten", "exact"), ("mujoco", "tuned"), ("mujoco", "stock"))
)
HERE = JobResult(TUNED, "MuJoCo", "as cached", ())


@pytest.fixture(autouse=True)
def in_process(monkeypatch):
    """Recordings are read within the test's own process, and MuJoCo is installed."""
    monkeypatch.setattr(interim, "each_isolated", lambda function, jobs, workers: [function(job) for job in jobs])
    monkeypatch.setattr(interim, "absent", lambda engine: False)


def test_an_engine_is_shown_as_recorded_and_hand_written_code_as_running():
    by_hand, recorded = before_the_runs([BY_HAND, TUNED], SCENARIOS, [], Cache(), 1)
    assert [(row.verdict, row.measured) for row in by_hand.rows] == [(Verdict.RUNNING, None)]
    assert by_hand.title == "hand-written"
    assert all(row.recorded_on for row in recorded.rows)
    assert "its runs here have not ended yet" in recorded.recording


def test_an_engine_that_is_missing_is_not_said_to_be_running(monkeypatch):
    monkeypatch.setattr(interim, "absent", lambda engine: True)
    (recorded,) = before_the_runs([TUNED], SCENARIOS, [], Cache(), 1)
    assert recorded.recording.endswith("it is not run here")


def test_an_engine_with_one_run_to_make_is_recorded_in_all_its_jobs():
    shown = before_the_runs([TUNED, STOCK], SCENARIOS, [HERE], Cache(), 1)
    assert {result.title for result in shown} == {"MuJoCo*"}
    assert before_the_runs([TUNED, BY_HAND], SCENARIOS, [HERE], Cache(), 1)[0] == HERE


def test_what_was_not_recorded_of_an_engine_is_running():
    moved = replace(TUNED, changes=(("timestep", 0.0123),))
    (result,) = before_the_runs([moved], SCENARIOS, [], Cache(), 1)
    assert {(row.verdict, row.note) for row in result.rows} == {(Verdict.RUNNING, interim.STILL)}


def test_a_recording_is_read_once_and_a_damaged_one_is_running():
    def refuse(job: Job) -> None:
        raise InvalidInput("the recording was changed")

    damaged = replace(SCENARIOS, recorded=refuse)
    (without,) = before_the_runs([TUNED], damaged, [], Cache(), 1)
    assert without.rows[0].verdict is Verdict.RUNNING
    before = before_the_runs([TUNED], SCENARIOS, [], Cache(), 1)
    assert before_the_runs([TUNED], damaged, [], Cache(), 1) == before
