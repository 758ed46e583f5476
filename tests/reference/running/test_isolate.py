from __future__ import annotations

import contextlib
import errno
import logging
import math
import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from reference import lecture
from reference.errors import (
    InvalidInput,
    OutOfMemory,
    RunFailed,
    UnknownName,
    WorkerCrashed,
    WorkerKilled,
    WorkerStopped,
    WorkerTimeout,
)
from reference.running import isolate
from reference.running.isolate import run_isolated, stop_workers

LIMIT = 60.0
"""Far longer than any job here takes: only a hang would meet it."""


@pytest.fixture(autouse=True, scope="module")
def _no_worker_outlives_these_tests():
    stop_workers()
    yield
    stop_workers()


def work(expression: str, timeout: float = LIMIT):
    """What an expression comes to in a worker process. `eval` and `exec` pickle, as a job must."""
    return run_isolated(eval, timeout, expression)


def worker_pid() -> int:
    return run_isolated(os.getpid, LIMIT)


def alive(pid: int) -> bool:
    """Whether a process runs; one that has ended but that nobody waited for does not."""
    state = subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True, check=False).stdout
    return bool(state.strip()) and not state.strip().startswith("Z")


@contextlib.contextmanager
def sleeper(folder: Path) -> Iterator[tuple[int, Future]]:
    """A job that would take ten minutes, in a worker that has begun it: the worker's process and the job's future."""
    started = folder / "started"
    asleep = f"open({str(started)!r}, 'x').write(str(__import__('os').getpid())), __import__('time').sleep(600)"
    with ThreadPoolExecutor(1) as executor:
        future = executor.submit(work, asleep)
        until(lambda: started.exists() and started.read_text())
        yield int(started.read_text()), future


def until(happened: Callable[[], object]) -> None:
    """Wait for what takes a moment on an idle machine."""
    deadline = time.monotonic() + LIMIT
    while not happened():
        assert time.monotonic() < deadline
        time.sleep(0.01)


# Answers


def test_a_job_gives_back_its_result():
    assert run_isolated(math.sqrt, LIMIT, 2.25) == 1.5
    assert run_isolated(sorted, LIMIT, [1, 3, 2], reverse=True) == [3, 2, 1]
    assert work("None") is None


def test_a_job_runs_in_another_process():
    assert worker_pid() != os.getpid()


def test_megabytes_go_both_ways():
    # 8 MB: more than a pipe holds, so the reader must read while the writer writes
    values = np.arange(1e6)
    assert np.array_equal(run_isolated(np.negative, LIMIT, values), -values)


def test_a_job_that_prints_does_not_garble_its_answer():
    assert work("(print('x' * 100_000), __import__('os').write(1, b'y'), 7)[-1]") == 7


def test_a_job_that_asks_for_input_gets_none():
    with pytest.raises(RunFailed, match="EOFError"):
        work("input()")
    assert work("1 + 1") == 2


def test_each_worker_has_one_thread_for_linear_algebra_and_no_screen():
    for name, value in [("OMP_NUM_THREADS", "1"), ("OPENBLAS_NUM_THREADS", "1"), ("MPLBACKEND", "Agg")]:
        assert work(f"__import__('os').environ[{name!r}]") == value


def test_a_worker_finds_what_its_parent_can_import(tmp_path, monkeypatch):
    (tmp_path / "only_here.py").write_text("VALUE = 7", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    stop_workers()  # the next one starts with this path
    assert work("__import__('only_here').VALUE") == 7
    stop_workers()


def test_a_worker_imports_no_module_from_its_current_folder(tmp_path, monkeypatch):
    (tmp_path / "mujoco.py").write_text("raise RuntimeError('not the engine')", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    stop_workers()  # the next one starts here
    assert work("__import__('os').getcwd()") == str(tmp_path)
    assert str(tmp_path) not in work("__import__('sys').path")
    stop_workers()


# Failures


def test_an_exception_arrives_as_a_failed_run_with_its_last_line():
    with pytest.raises(RunFailed) as caught:
        work("1 / 0")
    assert type(caught.value) is RunFailed
    assert str(caught.value) == "ZeroDivisionError: division by zero"


def test_an_error_of_the_lab_arrives_as_it_was_raised():
    with pytest.raises(UnknownName) as caught:
        run_isolated(lecture.function, LIMIT, "signed_distanse")
    assert (caught.value.kind, caught.value.value) == ("function", "signed_distanse")
    assert caught.value.choices == tuple(lecture.FUNCTIONS)
    assert "Did you mean 'signed_distance'?" in str(caught.value)


def test_an_unknown_name_survives_pickling():
    error = UnknownName("body", "bal", ["floor", "ball"])
    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is UnknownName
    assert str(copy) == str(error) == "unknown body 'bal'. Did you mean 'ball'? Choices: floor, ball."
    assert isinstance(copy, InvalidInput)


def test_an_error_that_cannot_be_pickled_arrives_as_a_failed_run():
    own = "from reference.errors import CollisionsError\nclass Own(CollisionsError): pass\nraise Own('lost its way')"
    with pytest.raises(RunFailed) as caught:
        run_isolated(exec, LIMIT, own, {})
    assert type(caught.value) is RunFailed
    assert str(caught.value) == "lost its way"


def test_a_result_that_cannot_be_pickled_is_a_failed_run():
    with pytest.raises(RunFailed, match="pickle"):
        work("lambda: 0")
    with pytest.raises(RunFailed, match="its answer cannot be read here: invalid literal"):
        work("type('Odd', (), {'__reduce__': lambda self: (int, ('nonsense',))})()")
    assert work("1 + 1") == 2


def test_a_job_that_does_not_pickle_is_refused_and_costs_no_worker():
    before = worker_pid()
    with pytest.raises((pickle.PicklingError, AttributeError)):
        run_isolated(lambda: 0, LIMIT)
    assert worker_pid() == before


@pytest.mark.parametrize(
    ("death", "how"),
    [
        ("__import__('os')._exit(3)", "exit code 3"),
        ("__import__('sys').exit(4)", "exit code 4"),
        ("__import__('os').abort()", "SIGABRT"),
        ("__import__('os').kill(__import__('os').getpid(), 11)", "SIGSEGV"),
    ],
)
def test_a_worker_that_dies_loses_its_job_and_reports_how(death, how):
    with pytest.raises(WorkerCrashed) as caught:
        work(death)
    assert str(caught.value) == f"its process died ({how})"
    assert work("1 + 1") == 2


def test_an_interrupt_that_a_job_raises_is_its_own_error():
    before = worker_pid()
    with pytest.raises(RunFailed, match="KeyboardInterrupt"):
        work("(_ for _ in ()).throw(KeyboardInterrupt)")
    assert worker_pid() == before


@pytest.mark.parametrize("name", ["SIGKILL", "SIGTERM", "SIGHUP"])
def test_a_worker_that_is_killed_from_outside_loses_its_job_without_blame(name):
    with pytest.raises(WorkerKilled, match=rf"its process was killed from outside \({name}\)"):
        work(f"__import__('os').kill(__import__('os').getpid(), __import__('signal').{name})")
    assert work("1 + 1") == 2


def test_a_job_without_enough_memory_is_lost_and_reports_what_it_wanted():
    for job in ("__import__('numpy').zeros(2**50)", "bytearray(2**60)"):
        with pytest.raises(OutOfMemory, match=r"it ran out of memory .*MemoryError"):
            work(job)
    assert work("1 + 1") == 2


def test_a_job_for_which_no_process_can_be_started_is_lost(monkeypatch):
    def refuse(*_, **__):
        raise BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable")

    stop_workers()
    monkeypatch.setattr(isolate.subprocess, "Popen", refuse)
    with pytest.raises(WorkerKilled, match="no process could be started for it: Resource temporarily unavailable"):
        work("1 + 1")


def test_a_job_past_its_limit_is_stopped_with_its_process():
    pid = worker_pid()
    start = time.monotonic()
    with pytest.raises(WorkerTimeout, match=r"it took longer than 0\.3 s and was stopped"):
        work("__import__('time').sleep(600)", timeout=0.3)
    assert 0.3 <= time.monotonic() - start < 30  # a busy machine may take seconds, the job ten minutes
    assert not alive(pid)
    assert work("1 + 1") == 2


def test_processes_started_by_a_stopped_job_are_stopped_too():
    child = work("__import__('subprocess').Popen(['sleep', '600']).pid")
    assert alive(child)
    with pytest.raises(WorkerTimeout):
        work("__import__('time').sleep(600)", timeout=0.3)
    deadline = time.monotonic() + 10  # the signal is sent at once; its effect may be a moment later
    while alive(child) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not alive(child)


# Reuse


def test_a_worker_serves_one_job_after_another():
    assert worker_pid() == worker_pid()


def test_a_worker_outlives_an_exception():
    before = worker_pid()
    with pytest.raises(RunFailed):
        work("1 / 0")
    with pytest.raises(UnknownName):
        run_isolated(lecture.topic, LIMIT, "nothing")
    assert worker_pid() == before


def test_a_worker_that_died_or_went_past_its_limit_is_replaced():
    first = worker_pid()
    with pytest.raises(WorkerCrashed):
        work("__import__('os')._exit(1)")
    second = worker_pid()
    with pytest.raises(WorkerTimeout):
        work("__import__('time').sleep(600)", timeout=0.3)
    third = worker_pid()
    assert len({first, second, third}) == 3


def test_a_worker_that_is_killed_while_it_waits_costs_no_job():
    before = worker_pid()
    os.kill(before, signal.SIGKILL)
    deadline = time.monotonic() + 10
    while alive(before) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert worker_pid() != before


def test_a_job_interrupted_half_way_ends_its_worker(monkeypatch):
    before = worker_pid()

    def interrupt(stream):
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(isolate, "read_message", interrupt)
        with pytest.raises(KeyboardInterrupt):
            work("1 + 1")
    assert not alive(before)
    assert worker_pid() != before  # and the next answer is not that of the interrupted job


def test_an_interrupt_from_the_keyboard_is_left_to_the_parent():
    assert work("__import__('os').kill(__import__('os').getpid(), 2) or 5") == 5


ORPHANED = """
import sys, time
from reference.running.isolate import run_isolated
run_isolated(exec, 300, "import os, time; open(%r, 'w').write(str(os.getpid())); time.sleep(300)" % sys.argv[1])
"""


@pytest.mark.skipif(os.name != "posix", reason="where a process can see that its parent is gone")
@pytest.mark.slow
def test_a_busy_worker_ends_when_its_parent_is_killed(tmp_path):
    written = tmp_path / "pid"
    parent = subprocess.Popen([sys.executable, "-c", ORPHANED, str(written)])
    until(lambda: written.exists() and written.read_text())
    worker = int(written.read_text())
    parent.kill()
    parent.wait()
    until(lambda: not alive(worker))


def test_jobs_of_several_threads_run_side_by_side():
    with ThreadPoolExecutor(2) as executor:
        pids = set(executor.map(work, ["__import__('time').sleep(0.5) or __import__('os').getpid()"] * 2))
    assert len(pids) == 2


def test_the_next_job_after_stopping_starts_a_new_worker():
    before = worker_pid()
    stop_workers()
    assert not alive(before)
    assert worker_pid() != before


def test_stopping_ends_a_busy_worker_and_its_job_at_once(tmp_path, caplog):
    caplog.set_level(logging.INFO, "reference.running.isolate")
    with sleeper(tmp_path) as (pid, future):
        start = time.monotonic()
        stop_workers()
        with pytest.raises(WorkerStopped, match="its process was stopped before it could answer"):
            future.result(LIMIT)
        assert time.monotonic() - start < 30  # a busy machine may take seconds, the job ten minutes
    assert not alive(pid)
    assert [record.levelname for record in caplog.records if "is lost" in record.message] == ["INFO"]  # as was wanted
    assert worker_pid() != pid


def test_a_worker_stopped_while_it_answers_takes_no_other_job(monkeypatch):
    before, answered = worker_pid(), isolate.read_message

    def stopped_just_then(stream):
        answer = answered(stream)
        stop_workers()
        return answer

    with monkeypatch.context() as patched:
        patched.setattr(isolate, "read_message", stopped_just_then)
        assert work("1 + 1") == 2
    assert isolate._workers == set()
    assert not alive(before)
    assert worker_pid() != before


def test_workers_that_were_stopped_are_forgotten():
    worker_pid()
    assert len(isolate._workers) >= 1
    stop_workers()
    assert isolate._workers == set()
    with pytest.raises(WorkerCrashed):
        work("__import__('os')._exit(1)")
    assert isolate._workers == set()


@pytest.mark.parametrize("limit", [0, 0.0, -1.0, math.nan, math.inf])
def test_an_impossible_time_limit_is_refused_and_starts_no_worker(limit):
    stop_workers()
    with pytest.raises(InvalidInput, match="timeout is"):
        work("1 + 1", timeout=limit)
    assert isolate._workers == set()


# The log


def test_the_log_says_when_a_worker_starts_and_why_one_was_lost(caplog):
    caplog.set_level(logging.INFO, "reference.running.isolate")
    stop_workers()
    first = worker_pid()
    with pytest.raises(WorkerCrashed):
        work("__import__('os')._exit(3)")
    second = worker_pid()
    with pytest.raises(WorkerTimeout):
        work("__import__('time').sleep(600)", timeout=0.3)
    third = worker_pid()
    os.kill(third, signal.SIGKILL)
    until(lambda: not alive(third))
    fourth = worker_pid()
    assert [(record.levelname, record.message) for record in caplog.records] == [
        ("INFO", f"worker {first} started"),
        ("WARNING", f"worker {first} is lost: its process died (exit code 3)"),
        ("INFO", f"worker {second} started"),
        ("WARNING", f"worker {second} is lost: it took longer than 0.3 s and was stopped"),
        ("INFO", f"worker {third} started"),
        ("WARNING", f"worker {third} died while it was idle"),
        ("INFO", f"worker {fourth} started"),
    ]


def test_a_job_past_its_limit_reports_the_line_of_hand_written_code(tmp_path):
    path = tmp_path / "slow.py"
    path.write_text(
        "def forever():\n    try:\n        while True:\n            pass\n    except Exception:\n        pass\n"
    )
    code = f"exec(compile(open({str(path)!r}).read(), {str(path)!r}, 'exec'), names := {{}}) or names['forever']()"
    told = r"it took longer than 0\.5 s and was stopped, at line [34] of slow\.py, in forever"
    with pytest.raises(WorkerTimeout, match=told):
        work(code, timeout=0.5)
    assert work("1 + 1") == 2


def test_a_job_that_ignores_signals_is_stopped_anyway():
    block = "(s := __import__('signal')).pthread_sigmask(s.SIG_BLOCK, {s.SIGALRM}) or __import__('time').sleep(600)"
    with pytest.raises(WorkerTimeout, match=r"it took longer than 0\.3 s and was stopped"):
        work(block, timeout=0.3)
    assert work("1 + 1") == 2
