"""Every run of a lesson is recorded: who has no engine sees the numbers, curves and replays that the text speaks of."""

from __future__ import annotations

import ast
import functools
from dataclasses import replace
from types import SimpleNamespace

import live
import pytest
from agreeing import same, same_curve

from labs.building import lessons
from labs.desk import case_runs, display, sweep_picture, sweeps
from reference.comparison import curves
from reference.comparison.results import Job, JobResult
from reference.engines import load_engine
from reference.errors import EngineNotInstalled
from reference.recording.reading import recall
from reference.running.study import run_job

pytestmark = [pytest.mark.slow, pytest.mark.timeout(1200)]
RUNS = ("run", "watch", "sweep")
TOPICS = [topic for topic in lessons.lessons() if topic != "avoidance"]
"""The lessons whose cells run cases. That on avoidance steers bodies by loops of its own, beside recordings alone."""


def calls(topic: str) -> list[tuple[str, tuple, dict]]:
    """What the cells of a lesson ask for: `lab.run`, `lab.watch` or `lab.sweep`, and the arguments."""
    found = []
    caught = SimpleNamespace(
        **{name: lambda *given, _name=name, **named: found.append((_name, given, named)) for name in RUNS},
        show=lambda experiment, **_: experiment(),
    )
    code = [cell for cell in lessons.read(topic).cells if cell.code and cell.kind != "given"]
    for cell in (cell for cell in code if _runs(cell.text)):
        before = len(found)
        exec(compile(cell.text, topic, "exec"), {"lab": caught})
        assert len(found) >= before + _runs(cell.text)  # more in a loop
    return found


def _runs(text: str) -> int:
    """How many calls there are in a cell."""
    nodes = [node.func for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)]
    return sum(isinstance(node, ast.Attribute) and node.attr in RUNS for node in nodes)


@functools.cache
def live_run(job: Job) -> JobResult:
    """What a lesson's run gives in an installed engine: one of the live runs of the report, or one made here."""
    planned = live.planned()[job.family, job.engine, job.profile]
    if job.at or job.changes or (planned.cases and not set(job.cases) <= set(planned.cases)):
        return run_job(job)
    whole = live.result(job.family, job.engine, job.profile)
    curve = next(curves.unpack(track.curve) for track in whole.poses if track.key in job.cases)
    return replace(whole, job=job, rows=tuple(row for row in whole.rows if row.case in job.cases), series=curve)


def is_installed(engine: str) -> bool:
    try:
        load_engine(engine).module()
    except EngineNotInstalled:
        return False
    return True


@pytest.fixture
def asked(lab, monkeypatch):
    """Asks all that a lesson asks, with the solutions for the student's functions; what came, by the call."""
    code = lab._student_code
    monkeypatch.setattr(lab, "_student_code", lambda: replace(code(), source="solutions"))
    monkeypatch.setattr(sweeps, "slide", lambda _: None)
    monkeypatch.setattr(display, "pictures", lambda _: [])  # the tests of notebooks draw pictures
    monkeypatch.setattr(sweep_picture, "picture", lambda _: None)
    came, run_case = [], case_runs.run_case
    monkeypatch.setattr(case_runs, "run_case", lambda *given: came.append(run_case(*given)) or came[-1])

    def every(topic):
        lab.topic, found = topic, {}
        for name, given, named in calls(topic):
            came.clear()
            getattr(lab, name)(*given, **{key: value for key, value in named.items() if key != "predicted"})
            found[f"lab.{name}({given}, {named})"] = list(came)
        return found

    return every


def test_every_lesson_runs_cases_but_the_one_that_steers_bodies_itself():
    assert [topic for topic in lessons.lessons() if calls(topic)] == TOPICS


@pytest.mark.parametrize("topic", TOPICS)
def test_every_run_of_a_lesson_is_recorded_as_an_engine_runs_it(topic, asked, monkeypatch):
    here = [engine for engine in case_runs.ENGINES if is_installed(engine)]
    monkeypatch.setattr(case_runs, "run_all", lambda jobs, *_: (recall(job) or live_run(job) for job in jobs))
    for call, runs in asked(topic).items():
        assert runs, call
        for run in runs:
            assert run.snapped == "", call
            for result in run.results:
                whole(result, call)
                if result.job.engine in here:
                    as_live(result, call)


def whole(result: JobResult, call: str) -> None:
    """It is recorded unless it is by hand, and has all numbers, the curve and the replay."""
    assert bool(result.recording) == (result.job.engine != "handwritten"), (call, result.title)
    missing = {row.quantity: row.note for row in result.rows if row.measured is None}
    assert not missing, (call, result.title)
    assert result.series is not None, (call, result.title)
    assert result.poses, (call, result.title)


def as_live(then: JobResult, call: str) -> None:
    """The engine gives the same numbers and the same curve."""
    now = live_run(then.job)
    assert len(now.rows) == len(then.rows) > 0, call
    for row, kept in zip(now.rows, then.rows, strict=True):
        same(row, kept)
    same_curve(now.series, then.series)
