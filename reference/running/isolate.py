"""One job in a worker process with a time limit: a crash or a hang costs that job and nothing else.

`run_isolated` is called from the threads of any `concurrent.futures.Executor`, which only schedules. Each call takes
an idle worker process, or starts one; a worker that died or went past its limit is replaced by a new one. Jobs and
results are pickled over the worker's own pipes. So this is for code that may fail, not for code that may attack us;
`reference.running.worker` is what runs in the process.
"""

from __future__ import annotations

import atexit
import contextlib
import logging
import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

from reference import checks
from reference.errors import RunFailed, WorkerCrashed, WorkerKilled, WorkerStopped, WorkerTimeout
from reference.running.worker import read_message, too_long, write_message

P = ParamSpec("P")
T = TypeVar("T")

_THREAD_LIMITS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""Environment variables that keep linear algebra to one thread in each worker."""
_FROM_OUTSIDE = ("SIGKILL", "SIGTERM", "SIGHUP", "SIGINT", "SIGQUIT", "SIGXCPU")
"""Signals that a process gets from the system or a person, and not for something that it has done."""
_GRACE = 1.0
"""How long a worker past its limit has to say where it was, before it is killed, s."""

_log = logging.getLogger(__name__)
_workers: set[_Worker] = set()
_idle: list[_Worker] = []
_lock = threading.Lock()


def run_isolated(function: Callable[P, T], timeout: float, *arguments: P.args, **named: P.kwargs) -> T:
    """Run an importable function in a worker process and return its result.

    Parameters
    ----------
    function : a function that pickles, so one at module level
    timeout : s of wall-clock time, above zero

    Raises
    ------
    InvalidInput
        If the limit is no time.
    WorkerTimeout
        If the job went past its limit.
    WorkerCrashed
        If the process died.
    WorkerKilled, WorkerStopped
        If the process was killed from outside, or could not be started; if `stop_workers` stopped it.
    CollisionsError
        As the function raised it. Any other exception arrives as `RunFailed` with its last line.
    """
    checks.positive("timeout", timeout)
    worker = _take()
    result: T
    try:
        result = worker.call(function, arguments, named, timeout)
    except (WorkerCrashed, WorkerKilled, WorkerTimeout) as error:
        _log.log(logging.INFO if worker.unwanted else logging.WARNING, "worker %d is lost: %s", worker.pid, error)
        worker.stop()
        if worker.unwanted:
            raise WorkerStopped(str(error)) from None
        raise
    except BaseException:
        _return(worker)
        raise
    _return(worker)
    return result


def stop_workers() -> None:
    """Stop every worker process, idle or busy; the job of a busy one fails with `WorkerStopped`."""
    with _lock:
        idle, _idle[:] = list(_idle), []
        for worker in _workers:
            worker.unwanted = True
            worker.kill()  # the thread that waits for a busy one's answer sees it end, and does the rest
    for worker in idle:
        worker.stop()


atexit.register(stop_workers)


def _take() -> _Worker:
    while (worker := _pop_idle()) is not None:
        if worker.alive:
            return worker
        _log.warning("worker %d died while it was idle", worker.pid)
        worker.stop()
    try:
        worker = _Worker()
    except OSError as error:  # no memory, no process number or no file descriptor is left
        raise WorkerKilled(f"no process could be started for it: {error.strerror}") from None
    with _lock:
        _workers.add(worker)
    _log.info("worker %d started", worker.pid)
    return worker


def _pop_idle() -> _Worker | None:
    with _lock:
        return _idle.pop() if _idle else None


def _return(worker: _Worker) -> None:
    with _lock:
        usable = worker.between_jobs and not worker.unwanted
        if usable:
            _idle.append(worker)
    if not usable:  # interrupted in the middle of a message, or killed at the end of its job
        worker.stop()


class _Worker:
    """A child process that answers one job after another."""

    def __init__(self) -> None:
        environment = os.environ | dict.fromkeys(_THREAD_LIMITS, "1") | {"MPLBACKEND": "Agg"}
        environment["PYTHONPATH"] = os.pathsep.join(path for path in sys.path if path)
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "reference.running.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
            start_new_session=os.name == "posix",
        )
        self.between_jobs = True
        self.unwanted = False

    @property
    def pid(self) -> int:
        return self._process.pid

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    def call(self, function: Callable[..., Any], arguments: Any, named: Any, timeout: float) -> Any:
        message = pickle.dumps((function, arguments, named, timeout))
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        expired = threading.Event()

        def expire() -> None:
            expired.set()
            self.kill()

        timer = threading.Timer(timeout + _GRACE, expire)
        timer.daemon = True
        timer.start()
        self.between_jobs = False
        try:
            write_message(self._process.stdin, message)
            answer = read_message(self._process.stdout)
        except (OSError, EOFError):
            answer = None
        finally:
            timer.cancel()
            timer.join()  # it fires before this line or never: an idle worker must not be killed
        if expired.is_set():
            raise WorkerTimeout(too_long(timeout))
        if answer is None and self.unwanted:
            raise WorkerKilled("its process was stopped before it could answer")
        if answer is None:
            raise _ended(self._process.wait())
        self.between_jobs = True
        try:
            succeeded, value = pickle.loads(answer)
        except Exception as error:
            raise RunFailed(f"its answer cannot be read here: {error}") from None
        if succeeded:
            return value
        raise value

    def stop(self) -> None:
        self.kill()
        with _lock:
            _workers.discard(self)
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with contextlib.suppress(OSError):
                    stream.close()

    def kill(self) -> None:
        with contextlib.suppress(OSError):
            if os.name == "posix":
                os.killpg(self._process.pid, signal.SIGKILL)  # and whatever it started
            else:
                self._process.kill()


def _ended(code: int) -> RunFailed:
    """What is said of a process that ended before it had answered."""
    how = f"exit code {code}"
    if code < 0:
        with contextlib.suppress(ValueError):
            how = signal.Signals(-code).name
    if how in _FROM_OUTSIDE:
        return WorkerKilled(f"its process was killed from outside ({how}), as a system does that runs out of memory")
    return WorkerCrashed(f"its process died ({how})")
