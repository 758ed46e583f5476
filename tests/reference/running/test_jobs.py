"""Many jobs: one that fails costs its own row and nothing else, and stopping them leaves no worker behind."""

from __future__ import annotations

import itertools
import logging
import os
import re
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from pathlib import Path

import pytest
from odd_engines import ENOUGH, GOOD, engine_file, results_of

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.comparison.verdicts import ALL_CASES, Verdict
from reference.errors import InvalidInput, WorkerKilled
from reference.recording import files
from reference.running import isolate
from reference.running.isolate import stop_workers
from reference.running.jobs import run_all, run_one
from reference.running.study import SCENARIOS, longest_first, run_job

DEATHS = {
    "exits": ("os._exit(3)", "exit code 3"),
    "raises": ("raise ZeroDivisionError('by the moon')", "ZeroDivisionError: by the moon"),
    "nan": (
        "recorder.sample(state)\nrecorder.sample([float('nan')] * len(state))",
        "positions are not finite from t = 0.01 s on",
    ),
}
if os.name == "posix":  # where a process can be killed by a signal
    DEATHS["killed"] = ("os.kill(os.getpid(), signal.SIGKILL)", "SIGKILL")
LOST = ("killed",)
"""Those of the deaths that say nothing of the engine."""


def test_a_job_that_fails_gives_one_row_and_the_others_finish(tmp_path):
    odd = {
        Job("dropped-ball", engine_file(tmp_path, name, body), "tuned", ("e=0.5",)): note
        for name, (body, note) in DEATHS.items()
    }
    results = results_of([GOOD, *odd, replace(GOOD, profile="step")])
    assert len(results) == len(odd) + 2
    for job, note in odd.items():
        (row,) = results[job].rows
        assert row.verdict is (Verdict.LOST if Path(job.engine).stem in LOST else Verdict.CRASHED), note
        assert note in row.note
        assert (row.family, row.engine, row.profile) == ("dropped-ball", "odd", "tuned")
        assert row.case in (ALL_CASES, "e=0.5")
        assert row.measured is None
        assert results[job].title == "an odd one"
        assert results[job].description == "says what the scenario means"
    for job in (GOOD, replace(GOOD, profile="step")):
        assert results[job].rows == run_job(job).rows


@pytest.mark.slow
def test_a_job_that_hangs_is_stopped_and_the_others_finish(tmp_path):
    hung = Job("dropped-ball", engine_file(tmp_path, "hung", "threading.Event().wait()"), "tuned", ("e=0.5",))
    results = results_of([hung, GOOD], timeout=8.0)  # s: the good one takes one or two, its process's start included
    (row,) = results[hung].rows
    assert row.verdict is Verdict.LOST
    assert "it took longer than 8 s and was stopped" in row.note
    assert results[hung].seconds >= 8
    assert [row.verdict for row in results[GOOD].rows] == [Verdict.PASS] * 4


DIES, HANGS = ("os._exit(7)", "exit code 7"), ("threading.Event().wait()", "it took longer than 6 s")


@pytest.mark.parametrize(
    ("ending", "note"), [pytest.param(*DIES, id="dies"), pytest.param(*HANGS, id="hangs", marks=pytest.mark.slow)]
)
def test_a_case_that_hangs_or_dies_costs_no_other_case_its_numbers(ending, note, tmp_path):
    body = f"if scenario.pairs[0].restitution == 0.8:\n    {ending}\nfor _ in range(steps + 1): recorder.sample(state)"
    engine, cases = engine_file(tmp_path, "uneven", body), ("e=0.8", "e=0.5", "e=0.2")
    job = Job("dropped-ball", engine, "tuned", cases, with_studies=True)
    result = run_one(job, SCENARIOS, 6.0 * len(cases))
    lost = [row for row in result.rows if row.verdict in (Verdict.CRASHED, Verdict.LOST)]
    assert [row.case for row in lost] == ["e=0.8"]
    assert note in lost[0].note
    assert {row.case for row in result.rows if row.measured is not None} == {"e=0.5", "e=0.2"}
    assert (result.job, result.convergence) == (job, None)
    assert result.series is not None


@pytest.mark.slow
def test_a_process_that_dies_in_a_study_leaves_the_cases_their_numbers_and_a_row_that_tells(tmp_path):
    body = "if settings.timestep != 0.01: os._exit(7)\nfor _ in range(steps + 1): recorder.sample(state)"
    job = Job("dropped-ball", engine_file(tmp_path, "studied", body), "tuned", with_studies=True)
    result = run_one(job, SCENARIOS, ENOUGH)
    cases = [case.name for case in job.chosen(catalogue()[job.family])]
    *ran, lost = result.rows
    assert [*dict.fromkeys(row.case for row in ran)] == cases
    assert {row.case for row in ran if row.measured is not None} == set(cases)
    assert all(row.verdict is not Verdict.CRASHED for row in ran)
    assert (lost.case, lost.quantity, lost.verdict) == ("e=0.5", "", Verdict.CRASHED)
    assert lost.note == "its process died (exit code 7) in a study of e=0.5, not in a run of its own"
    assert (result.job, result.convergence, result.version != "") == (job, None, True)


def test_a_job_whose_process_was_killed_runs_again_case_by_case_and_nothing_is_lost(monkeypatch):
    calls = []

    def killed_at_first(run, timeout, job):
        calls.append((job.cases, timeout))
        if len(calls) == 1:
            raise WorkerKilled("SIGKILL")
        return run(job)

    monkeypatch.setattr("reference.running.jobs.run_isolated", killed_at_first)
    job = replace(GOOD, cases=("μ=0.1,v=1", "μ=0.7,v=1"))
    assert run_one(job, SCENARIOS, 8.0).rows == run_job(job).rows
    assert calls[1:] == [((case,), 4.0) for case in job.cases]
    calls.clear()
    *_, lost = run_one(replace(job, with_studies=True), SCENARIOS, 8.0).rows
    assert (lost.verdict, lost.note) == (Verdict.LOST, "SIGKILL; its studies are missing")


def test_a_job_that_its_executor_loses_is_a_row_and_no_end_of_the_others():
    class Losing(ThreadPoolExecutor):
        def submit(self, function, /, job, *arguments, **named) -> Future:
            if job == GOOD:
                return super().submit(function, job, *arguments, **named)
            future: Future = Future()
            future.set_exception(BrokenProcessPool("a machine is gone"))
            return future

    with Losing(1) as executor:
        other = replace(GOOD, profile="step")
        found = {result.job: result for result in run_all([other, GOOD], SCENARIOS, executor, ENOUGH)}
    (row,) = found[other].rows
    assert (row.verdict, "BrokenProcessPool: a machine is gone" in row.note) == (Verdict.LOST, True)
    assert {row.verdict for row in found[GOOD].rows} == {Verdict.PASS}


@pytest.mark.slow
def test_a_worker_that_was_given_up_leaves_no_trace_in_the_next_job(tmp_path):
    bad = Job("dropped-ball", engine_file(tmp_path, "bad", "os._exit(1)"), "tuned", ("e=0.5",))
    assert run_one(bad, SCENARIOS, ENOUGH).rows[0].verdict is Verdict.CRASHED
    assert {row.verdict for row in run_one(GOOD, SCENARIOS, ENOUGH).rows} == {Verdict.PASS}


def test_results_come_as_they_are_ready(tmp_path):
    first, order = tmp_path / "first", []
    body = f"while not os.path.exists({str(first)!r}): time.sleep(0.01)\nos._exit(0)"
    slow = Job("dropped-ball", engine_file(tmp_path, "slow", body), "tuned", ("e=0.5",))
    with ThreadPoolExecutor(2) as executor:
        for result in run_all([slow, GOOD], SCENARIOS, executor, ENOUGH):
            order.append(result.job)
            first.touch()  # the slow job ends only once another result has come
    assert order == [GOOD, slow]


def test_jobs_that_nobody_waits_for_are_not_started():
    started = []

    class Counting(ThreadPoolExecutor):
        def submit(self, function, /, *arguments, **named) -> Future:
            def counted() -> object:
                started.append(arguments)
                return function(*arguments, **named)

            return super().submit(counted)

    with Counting(1) as executor:
        results = run_all([GOOD] * 5, SCENARIOS, executor, ENOUGH)
        next(results)
        results.close()
    assert len(started) < 5


def test_the_longest_jobs_are_started_first(tmp_path):
    short = Job("ball-to-rest", "handwritten", "exact", ("e=0.5",))
    whole, fine = replace(short, cases=()), replace(short, changes=(("timestep", 1e-5),))
    broken = replace(short, engine=engine_file(tmp_path, "broken", "raise OSError"), profile="no such")
    for jobs in itertools.permutations((short, whole, fine, broken)):
        # 100 times the steps, then the several cases of the family, of which this is the shortest.
        assert longest_first(jobs) == [fine, whole, short, broken]


def asleep(folder: Path) -> tuple[Job, Path]:
    """A job that would take a minute, and the file in which its worker says its process number once it has begun."""
    begun = folder / "begun"
    body = f"open({str(begun)!r}, 'w').write(str(os.getpid()))\ntime.sleep(60)"
    return Job("dropped-ball", engine_file(folder, "asleep", body), "tuned", ("e=0.5",)), begun


def process_in(begun: Path) -> int:
    deadline = time.monotonic() + ENOUGH
    while not (begun.exists() and begun.read_text()):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    return int(begun.read_text())


def alive(pid: int) -> bool:
    state = subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True, check=False).stdout
    return bool(state.strip()) and not state.strip().startswith("Z")


PROMPTLY = 30.0  # s: on a busy machine some seconds, and half of what the job would take


@pytest.mark.parametrize("error", [GeneratorExit, pytest.param(KeyboardInterrupt, marks=pytest.mark.slow)])
@pytest.mark.slow
def test_leaving_early_waits_for_no_job_and_leaves_no_worker(error, tmp_path):
    job, begun = asleep(tmp_path)
    with ThreadPoolExecutor(2) as executor:
        results = run_all([GOOD, job, replace(job, profile="step"), GOOD], SCENARIOS, executor, 2 * ENOUGH)
        assert next(results).job == GOOD
        pid, start = process_in(begun), time.monotonic()
        with pytest.raises(error):
            results.throw(error)
        assert time.monotonic() - start < PROMPTLY
        assert isolate._workers == set()
    assert time.monotonic() - start < PROMPTLY
    assert not alive(pid)


@pytest.mark.slow
def test_a_worker_that_starts_during_a_stop_is_stopped_too(tmp_path, monkeypatch):
    job, begun = asleep(tmp_path)
    take, stop, stopping = isolate._take, isolate.stop_workers, threading.Event()
    run_one(GOOD, SCENARIOS)  # so that a worker is there already

    def take_late() -> object:
        if threading.current_thread() in late:
            stopping.wait(ENOUGH)
        return take()

    def stop_and_say() -> None:
        stop()
        stopping.set()

    class LastIsLate(ThreadPoolExecutor):
        def submit(self, function, /, *arguments) -> Future:
            def run() -> object:
                if arguments[0] is job:
                    late.append(threading.current_thread())
                return function(*arguments)

            return super().submit(run)

    late: list[threading.Thread] = []
    monkeypatch.setattr(isolate, "_take", take_late)
    monkeypatch.setattr("reference.running.jobs.stop_workers", stop_and_say)
    with LastIsLate(2) as executor:
        results = run_all([job, GOOD], SCENARIOS, executor, 2 * ENOUGH)
        assert next(results).job == GOOD
        start = time.monotonic()
        results.close()
        assert time.monotonic() - start < PROMPTLY
    assert len(late) == 1
    assert isolate._workers == set()
    assert not (begun.exists() and alive(process_in(begun)))


INTERRUPTED = """
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from reference.comparison.results import Job
from reference.running.jobs import run_all
from reference.running.study import SCENARIOS

signal.signal(signal.SIGINT, signal.default_int_handler)  # some shells have it ignored
jobs = [Job("dropped-ball", sys.argv[1], profile, ("e=0.5",)) for profile in ("tuned", "stock")]
with ThreadPoolExecutor(1) as executor:
    for result in run_all(jobs, SCENARIOS, executor):
        pass
"""


@pytest.mark.skipif(os.name != "posix", reason="where a process can be interrupted by a signal")
@pytest.mark.slow
def test_an_interrupt_from_the_keyboard_ends_the_study_promptly(tmp_path):
    job, begun = asleep(tmp_path)
    study = subprocess.Popen([sys.executable, "-c", INTERRUPTED, job.engine], stderr=subprocess.PIPE, text=True)
    pid, start = process_in(begun), time.monotonic()
    study.send_signal(signal.SIGINT)
    _, said = study.communicate(timeout=ENOUGH)
    assert time.monotonic() - start < PROMPTLY
    assert study.returncode == -signal.SIGINT  # as Python ends that nobody keeps from it
    assert said.strip().endswith("KeyboardInterrupt")
    assert not alive(pid)


def test_idle_workers_stay_for_the_next_study():
    results_of([GOOD])
    kept = set(isolate._workers)
    assert kept
    results_of([GOOD])
    assert kept & isolate._workers


@pytest.mark.parametrize("timeout", [0.0, -1.0])
def test_an_impossible_time_limit_is_the_callers_mistake(timeout):
    with pytest.raises(InvalidInput, match="timeout is"), ThreadPoolExecutor(1) as executor:
        list(run_all([GOOD], SCENARIOS, executor, timeout))


def test_the_log_says_when_a_job_starts_and_how_long_it_took(tmp_path, caplog):
    caplog.set_level(logging.INFO, "reference.running.jobs")
    run_one(GOOD, SCENARIOS)
    run_one(Job("dropped-ball", engine_file(tmp_path, "bad", "os._exit(3)"), "stock", ("e=0.5",)), SCENARIOS)
    assert [record.levelname for record in caplog.records if record.name == "reference.running.jobs"] == ["INFO"] * 4
    said = [record.message for record in caplog.records if record.name == "reference.running.jobs"]
    assert said[0] == "sliding-slab in handwritten, exact: started"
    assert re.fullmatch(r"sliding-slab in handwritten, exact: finished after \d+\.\d s", said[1])
    assert re.fullmatch(r"dropped-ball in .*bad\.py, stock: started", said[2])
    assert re.fullmatch(r"dropped-ball in .*bad\.py, stock: finished after \d+\.\d s", said[3])


@pytest.mark.slow
def test_any_executor_can_run_the_jobs():
    class AtOnce(Executor):
        def submit(self, function, /, *arguments) -> Future:
            future: Future = Future()
            future.set_result(function(*arguments))
            return future

    assert list(run_all([GOOD], SCENARIOS, AtOnce(), ENOUGH)) == [run_job(GOOD)]


def test_an_engine_without_its_package_gives_one_row_with_the_remedy(tmp_path):
    missing = Job("dropped-ball", engine_file(tmp_path, "missing", package="no_such_package"), "tuned")
    results = results_of([missing, GOOD])
    (row,) = results[missing].rows
    assert (row.verdict, row.case) == (Verdict.NOT_AVAILABLE, ALL_CASES)
    assert "an odd one is not installed here" in row.note
    assert "pip install no_such_package" in row.note
    assert {row.verdict for row in results[GOOD].rows} == {Verdict.PASS}


@pytest.mark.parametrize(
    ("name", "package"),
    [
        pytest.param("pybullet", "pybullet", marks=pytest.mark.slow),
        pytest.param("mujoco", "mujoco", marks=pytest.mark.slow),
        ("dart", "dartpy"),
    ],
)
def test_an_engine_that_cannot_be_imported_answers_from_its_recording(name, package, tmp_path, monkeypatch):
    (tmp_path / f"{package}.py").write_text("raise ImportError('a library of it is missing')\n")
    monkeypatch.syspath_prepend(tmp_path)  # workers get this path too
    stop_workers()  # those that are idle have the old one
    job = Job("dropped-ball", name, "tuned", ("e=0.5",))
    try:
        recorded = run_one(job, SCENARIOS, ENOUGH)
        monkeypatch.setattr(files, "FOLDER", tmp_path)  # nothing of the kind
        (without,) = run_one(job, SCENARIOS, ENOUGH).rows
    finally:
        stop_workers()
    assert "it is not run here" in recorded.recording
    assert recorded.rows[0].measured is not None
    assert without.verdict is Verdict.NOT_AVAILABLE
    assert "cannot be imported: a library of it is missing" in without.note
