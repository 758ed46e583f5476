"""Many runs: what is planned, what comes back, and that a job which fails costs that job and nothing else."""

from __future__ import annotations

import itertools
import logging
import os
import pickle
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison.convergence import order_of
from reference.comparison.curves import Series
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Verdict
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput, UnknownName
from reference.recording import files
from reference.running import isolate
from reference.running.isolate import stop_workers
from reference.running.jobs import run_all, run_one
from reference.running.study import SCENARIOS, longest_first, plan, run_job

DROPPED, SLIDING = catalogue()["dropped-ball"], catalogue()["sliding-slab"]
GOOD = Job("sliding-slab", "handwritten", "tuned", ("μ=0.7,v=1",))
STUDIED = Job("parting-ball", "handwritten", "tuned", ("v=0.1",), with_studies=True)
"""A job with everything that a result can hold: rows, curve, convergence and split; a quick one."""
ENOUGH = 60.0  # s: any honest job here takes one, on a busy machine too

ENGINE_FILE = """
import os, signal, sys, threading, time

from reference.engines.base import Engine, Method
from reference.errors import CannotExpress
from reference.scene.settings import Settings
from reference.scene.trajectory import Recorder


class Odd(Engine):
    name = "odd"
    title = "an odd one"
    package = {package!r}

    def settings(self, scenario, profile):
        self.check_profile(scenario, profile)
        return Settings(0.01)

    def method(self, scenario, settings):
        return Method("at step")

    def run(self, scenario, settings):
        recorder = Recorder(self.name, scenario, settings)
        state = [n for b in scenario.bodies for n in (*b.position, *b.orientation, *b.velocity, *b.angular_velocity)]
        steps = self.check_settings(scenario, settings)
{body}
        return recorder.trajectory()


ENGINE = Odd
"""


def engine_file(folder: Path, name: str, body: str = "pass", package: str | None = None) -> str:
    """Write an engine to a file of its own; `body` is what its run does before it hands in its samples."""
    path = folder / f"{name}.py"
    path.write_text(ENGINE_FILE.format(body=textwrap.indent(textwrap.dedent(body), " " * 8), package=package))
    return str(path)


def results_of(jobs: list[Job], timeout: float = ENOUGH) -> dict[Job, JobResult]:
    with ThreadPoolExecutor(2) as executor:
        return {result.job: result for result in run_all(jobs, SCENARIOS, executor, timeout)}


# Planning


def planned(jobs: list[Job]) -> list[tuple[str, str, str]]:
    return [(job.family, job.engine, job.profile) for job in jobs]


def test_without_named_profiles_an_engine_runs_all_of_them():
    assert planned(plan([DROPPED], engine_names())) == [
        ("dropped-ball", "handwritten", "tuned"),
        ("dropped-ball", "handwritten", "slide"),
        ("dropped-ball", "handwritten", "stock"),
        ("dropped-ball", "pybullet", "tuned"),
        ("dropped-ball", "pybullet", "stock"),
        ("dropped-ball", "mujoco", "tuned"),
        ("dropped-ball", "mujoco", "spring"),
        ("dropped-ball", "mujoco", "stock"),
        ("dropped-ball", "dart", "tuned"),
        ("dropped-ball", "dart", "stock"),
    ]


def test_a_plan_of_everything_has_every_family_engine_and_profile():
    jobs = planned(plan(catalogue().values(), engine_names()))
    assert len(set(jobs)) == len(jobs)
    for name in engine_names():
        for family in catalogue().values():
            for profile in load_engine(name).profiles(family.cases[0].scenarios[0]):
                assert (family.name, name, profile) in jobs


def test_a_profile_of_one_engine_is_planned_for_that_engine():
    jobs = plan([DROPPED], engine_names(), ["spring", "tuned"])
    assert planned(jobs) == [
        ("dropped-ball", "handwritten", "tuned"),
        ("dropped-ball", "pybullet", "tuned"),
        ("dropped-ball", "mujoco", "spring"),
        ("dropped-ball", "mujoco", "tuned"),
        ("dropped-ball", "dart", "tuned"),
    ]


def test_a_profile_of_one_family_is_planned_for_that_family():
    assert planned(plan([SLIDING, DROPPED], ["handwritten"], ["slide"])) == [("dropped-ball", "handwritten", "slide")]


def test_families_may_come_from_a_generator():
    jobs = plan((family for family in (DROPPED, SLIDING)), ["handwritten"], ["tuned"])
    assert [job.family for job in jobs] == ["dropped-ball", "sliding-slab"]


@pytest.mark.parametrize(
    ("arguments", "wrong", "choice"),
    [
        ({"profiles": ["tunde"]}, "tunde", "tuned"),
        ({"engines": ["pybulet"]}, "pybulet", "pybullet"),
        ({"profiles": ["tuned"], "changes": {"polcy": "at_step"}}, "polcy", "policy"),
        ({"cases": {"dropped-ball": ("e=0.7",)}}, "e=0.7", "e=0.5"),
    ],
)
def test_an_unknown_name_in_a_plan_is_refused_with_the_known_ones(arguments, wrong, choice):
    with pytest.raises(UnknownName) as refused:
        plan(**({"families": [DROPPED], "engines": ["handwritten"]} | arguments))
    assert refused.value.value == wrong
    assert choice in refused.value.choices


def test_a_profile_of_no_planned_engine_is_refused():
    with pytest.raises(UnknownName):
        plan([DROPPED], ["handwritten", "pybullet"], ["spring"])


def test_a_timestep_longer_than_a_case_is_refused_when_planned():
    shortest, longest = DROPPED.cases[0], DROPPED.cases[-1]
    between = (shortest.scenarios[0].duration + longest.scenarios[0].duration) / 2
    for cases in ({"dropped-ball": (shortest.name,)}, {}):
        with pytest.raises(InvalidInput, match="longer than"):
            plan([DROPPED], ["handwritten"], ["tuned"], cases, changes={"timestep": between})
    assert plan([DROPPED], ["handwritten"], ["tuned"], {"dropped-ball": (longest.name,)}, changes={"timestep": between})


def test_a_family_or_engine_named_twice_is_planned_once():
    twice = plan(
        [DROPPED, SLIDING, DROPPED],
        ["handwritten", "pybullet", "handwritten"],
        ["tuned", "stock", "tuned"],
        {"dropped-ball": ("e=1", "e=0.5", "e=1")},
    )
    once = plan([DROPPED, SLIDING], ["handwritten", "pybullet"], ["tuned", "stock"], {"dropped-ball": ("e=1", "e=0.5")})
    assert twice == once
    assert len(once) == 8
    assert once[0].cases == ("e=1", "e=0.5")


def test_no_profiles_or_cases_mean_all_and_no_engines_mean_none():
    everything = plan([DROPPED], ["handwritten"])
    assert plan([DROPPED], ["handwritten"], []) == everything
    assert plan([DROPPED], ["handwritten"], (), {}) == everything
    assert plan([DROPPED], ["handwritten"], (), {"dropped-ball": ()}) == everything
    assert [job.cases for job in everything] == [()] * 3
    assert plan([DROPPED], []) == plan([], ["handwritten"]) == []


def test_a_plan_passes_cases_changes_and_implementation_to_every_job():
    changes = {"timestep": 2e-3, "sample_every": 2}
    jobs = plan(
        [DROPPED, SLIDING],
        ["handwritten", "pybullet"],
        ["tuned"],
        cases={"dropped-ball": ("e=0.5", "e=1")},
        implementation="mine.py",
        changes=changes,
        with_studies=True,
    )
    assert [job.cases for job in jobs] == [("e=0.5", "e=1")] * 2 + [()] * 2
    assert all(dict(job.changes) == changes for job in jobs)
    assert all(job.implementation == "mine.py" and job.with_studies for job in jobs)


# One job


def test_a_job_runs_the_cases_that_it_names_or_else_all():
    family = catalogue()["parting-ball"]
    all_cases = run_job(replace(STUDIED, cases=(), with_studies=False)).rows
    assert [row.case for row in all_cases if row.quantity == "first"] == [case.name for case in family.cases]
    two = run_job(replace(STUDIED, cases=("v=0.5", "v=0.1"), with_studies=False)).rows
    assert set(two) == {row for row in all_cases if row.case in ("v=0.1", "v=0.5")}


def test_a_job_runs_with_the_settings_that_it_changes():
    plain = run_job(Job("dropped-ball", "handwritten", "stock", ("e=0.5",)))
    coarse = run_job(Job("dropped-ball", "handwritten", "stock", ("e=0.5",), changes=(("timestep", 4e-3),)))
    (fine_row, _), (coarse_row, _) = plain.rows, coarse.rows
    assert "timestep 0.004 s" in coarse.settings
    assert coarse_row.error == pytest.approx(4 * fine_row.error, rel=0.02)  # first order, up to a term of second


def test_a_job_says_what_ran_and_how_long():
    result = run_job(GOOD)
    assert result.title == "hand-written"
    assert result.description == "exact root"
    assert result.version
    assert result.seconds > 0
    assert "policy exact_root" in result.settings
    assert {row.verdict for row in result.rows} == {Verdict.PASS}


def test_a_job_has_a_curve_for_the_plotted_case_or_on_request(monkeypatch):
    curve, single = DROPPED.curve, [replace(case, scenarios=case.scenarios[:1]) for case in DROPPED.cases]
    monkeypatch.setitem(catalogue(), "dropped-ball", replace(DROPPED, cases=tuple(single)))
    other = Job("dropped-ball", "handwritten", "tuned", ("e=1",))
    assert run_job(other).series is None
    assert run_job(replace(other, with_curve=True)).series.values[-1] > 0.9  # it rises again to where it came from
    series = run_job(Job("dropped-ball", "handwritten", "tuned", (curve.case,))).series
    assert len(series.times) == len(series.values)
    assert 30 <= len(series.times) <= 200  # a fall and a rise: enough for a smooth line, few enough to be kept
    assert series.times[0] == 0
    assert series.values[0] == pytest.approx(1.0, abs=1e-6)  # the gap at the start; curves are rounded to 1e-7 m
    until = catalogue()["ball-to-rest"].curve.until
    assert run_job(Job("ball-to-rest", "handwritten", "tuned", ("e=0.8",))).series.times[-1] <= until


def test_a_curve_has_a_gap_where_its_value_is_not_finite():
    engine, scenario = load_engine("handwritten"), DROPPED.case(DROPPED.curve.case).scenarios[0]
    trajectory = engine.run(scenario, engine.settings(scenario, "tuned").change(timestep=0.01))
    values = np.where(trajectory.times < 0.105, np.inf, 1.0)
    curve = Series.of(replace(DROPPED, curve=replace(DROPPED.curve, values=lambda _: values)), trajectory)
    assert curve.times == pytest.approx(trajectory.times[[11, -1]])  # and straight on from there
    assert set(curve.values) == {1.0}


def test_convergence_is_studied_only_on_request():
    assert run_job(replace(STUDIED, with_studies=False)).convergence is None
    found = run_job(replace(STUDIED, profile="stock")).convergence
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


# Order of convergence


@pytest.mark.parametrize("order", [0.5, 1, 2, 4])
def test_the_order_is_the_slope_of_error_against_timestep(order):
    steps = [4e-3, 2e-3, 1e-3, 5e-4]
    assert order_of(steps, [1e5 * dt**order for dt in steps], 1.0) == pytest.approx(order)  # a line: rounding only


def test_errors_of_rounding_have_no_order():
    assert order_of([4e-3, 2e-3, 1e-3], [1e-16, 3e-16, 2e-16], 1.0) is None
    assert order_of([4e-3, 2e-3, 1e-3], [0.0, 0.0, 0.0], 0.0) is None


def test_the_order_is_read_from_the_errors_above_rounding():
    steps = [4e-3, 2e-3, 1e-3, 5e-4]
    assert order_of(steps, [1.6e-7, 4e-8, 1e-8, 1e-13], 1.0) == pytest.approx(2)
    assert order_of(steps, [1.6e-7, 1e-13, 1e-13, 1e-13], 1.0) is None, "one point makes no line"
    assert order_of([1e-3], [1e-3], 1.0) is None


def test_errors_that_grow_as_the_timestep_shrinks_have_a_negative_order():
    assert order_of([4e-3, 2e-3, 1e-3], [1.0, 2.0, 4.0], 1.0) == pytest.approx(-1)


# Jobs that fail

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


def test_a_job_that_fails_gives_one_row_and_the_others_finish(tmp_path):
    odd = {
        Job("dropped-ball", engine_file(tmp_path, name, body), "tuned", ("e=0.5",)): note
        for name, (body, note) in DEATHS.items()
    }
    results = results_of([GOOD, *odd, replace(GOOD, profile="stock")])
    assert len(results) == len(odd) + 2
    for job, note in odd.items():
        (row,) = results[job].rows
        assert row.verdict is Verdict.CRASHED, note
        assert note in row.note
        assert (row.family, row.engine, row.profile) == ("dropped-ball", "odd", "tuned")
        assert row.case in (ALL_CASES, "e=0.5")
        assert row.measured is None
        assert results[job].title == "an odd one"
        assert results[job].description == "says what the scenario means"
    for job in (GOOD, replace(GOOD, profile="stock")):
        assert results[job].rows == run_job(job).rows


def test_a_job_that_hangs_is_stopped_and_the_others_finish(tmp_path):
    hung = Job("dropped-ball", engine_file(tmp_path, "hung", "threading.Event().wait()"), "tuned", ("e=0.5",))
    results = results_of([hung, GOOD], timeout=8.0)  # s: the good one takes one or two, its process's start included
    (row,) = results[hung].rows
    assert row.verdict is Verdict.CRASHED
    assert "no answer within 8 s" in row.note
    assert results[hung].seconds >= 8
    assert [row.verdict for row in results[GOOD].rows] == [Verdict.PASS] * 4


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
    short = Job("ball-to-rest", "handwritten", "tuned", ("e=0.5",))
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
def test_leaving_early_waits_for_no_job_and_leaves_no_worker(error, tmp_path):
    job, begun = asleep(tmp_path)
    with ThreadPoolExecutor(2) as executor:
        results = run_all([GOOD, job, replace(job, profile="stock"), GOOD], SCENARIOS, executor, 2 * ENOUGH)
        assert next(results).job == GOOD
        pid, start = process_in(begun), time.monotonic()
        with pytest.raises(error):
            results.throw(error)
        assert time.monotonic() - start < PROMPTLY
        assert isolate._workers == set()
    assert time.monotonic() - start < PROMPTLY
    assert not alive(pid)


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
    assert said[0] == "sliding-slab in handwritten, tuned: started"
    assert re.fullmatch(r"sliding-slab in handwritten, tuned: finished after \d+\.\d s", said[1])
    assert re.fullmatch(r"dropped-ball in .*bad\.py, stock: started", said[2])
    assert re.fullmatch(r"dropped-ball in .*bad\.py, stock: finished after \d+\.\d s", said[3])


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
def test_an_engine_that_cannot_be_imported_answers_from_its_recording(
    name, package, tmp_path, monkeypatch
):
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
    assert f'pip install -e ".[{name}]"' in without.note


# Hand-written code that is not finished

EVERYTHING = "".join(f"from solutions.{topic} import *\n" for topic in ("detection", "response", "forces", "friction"))


@pytest.mark.parametrize(
    "missing", ["del kinematic_response\n", "def kinematic_response(*arguments):\n    raise NotImplementedError\n"]
)
def test_an_unwritten_function_is_named_in_one_row_and_others_finish(missing, tmp_path):
    path = tmp_path / "homework.py"
    path.write_text(EVERYTHING + missing)
    unfinished = Job("dropped-ball", "handwritten", "tuned", ("e=0.5",), str(path))
    not_needed = replace(GOOD, implementation=str(path))
    results = results_of([unfinished, not_needed, GOOD])
    (row,) = results[unfinished].rows
    assert (row.verdict, row.note) == (Verdict.NEEDS, "needs kinematic_response (response, step 1)")
    for job in (not_needed, GOOD):
        assert {row.verdict for row in results[job].rows} == {Verdict.PASS}


def test_a_complete_file_of_functions_gives_the_rows_of_the_solutions(tmp_path):
    path = tmp_path / "homework.py"
    path.write_text(EVERYTHING)
    assert run_one(replace(GOOD, implementation=str(path)), SCENARIOS, ENOUGH).rows == run_job(GOOD).rows


def test_hand_written_bugs_crash_and_wrong_signs_fail(tmp_path):
    broken, wrong = tmp_path / "broken.py", tmp_path / "wrong.py"
    broken.write_text(EVERYTHING + "def kinematic_response(v, n, e):\n    return v[1000000]\n")
    wrong.write_text(
        EVERYTHING + "def kinematic_response(v, n, e):\n    return v - 2 * (v * n).sum(-1, keepdims=True) * n\n"
    )
    jobs = [Job("dropped-ball", "handwritten", "tuned", ("e=0.5",), str(path)) for path in (broken, wrong)]
    results = results_of(jobs)
    (row,) = results[jobs[0]].rows
    assert row.verdict is Verdict.CRASHED
    assert "IndexError" in row.note
    rebound = next(row for row in results[jobs[1]].rows if row.quantity == "rebound")
    assert rebound.verdict is Verdict.FAIL
    assert rebound.measured == pytest.approx(1.0, abs=1e-9)  # the slide's formula is the case e = 1
    assert np.isfinite(rebound.error)


def test_a_missing_implementation_is_the_callers_mistake():
    with pytest.raises(InvalidInput, match="no such file"):
        run_one(replace(GOOD, implementation="no/such/homework.py"), SCENARIOS, ENOUGH)
