"""What runs in a worker process: it answers one job after another until its parent closes the pipe.

A job arrives pickled, behind its length, and its answer leaves in the same way. `reference.running.isolate` starts
workers and talks to them.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import threading
import time
from collections.abc import Iterator
from typing import IO

from reference.errors import CollisionsError, RunFailed, WorkerTimeout, one_line, out_of_memory, place_of

_HEADER = 8
"""How many bytes hold a message's length."""
_PARENT_INTERVAL = 1.0
"""Time between two looks at whether the parent is still alive, s."""


def write_message(stream: IO[bytes], message: bytes) -> None:
    """Write a message behind its length."""
    stream.write(len(message).to_bytes(_HEADER, "big") + message)
    stream.flush()


def read_message(stream: IO[bytes]) -> bytes:
    """Read one message; `EOFError` where the other end has closed the pipe."""
    length = int.from_bytes(_read_exactly(stream, _HEADER), "big")
    return _read_exactly(stream, length)


def _read_exactly(stream: IO[bytes], length: int) -> bytes:
    data = stream.read(length)
    if len(data) < length:
        raise EOFError
    return data


def too_long(timeout: float) -> str:
    """What is said of a job that went past its limit, s."""
    return f"it took longer than {timeout:g} s and was stopped"


class _OutOfTime(BaseException):
    """Raised in Python code that has run for too long, wherever it is, past every `except Exception`."""


@contextlib.contextmanager
def _limited(seconds: float) -> Iterator[None]:
    """Leave the block with `_OutOfTime` when the time is up; where the system has no such timer, the parent kills."""
    if not hasattr(signal, "setitimer"):
        yield
        return

    def leave(*_: object) -> None:
        raise _OutOfTime

    signal.signal(signal.SIGALRM, leave)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def _serve() -> None:
    """Answer jobs until the parent closes the pipe."""
    jobs, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)  # code that asks for input must not read the jobs
    os.dup2(2, 1)  # an engine that prints must not write into the answers
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent decides when to stop
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    while True:
        try:
            message = read_message(jobs)
        except EOFError:
            return
        write_message(answers, _answered(message))


def _answered(message: bytes) -> bytes:
    """Run the job in a message; its value or its error, pickled, and which of the two it is."""
    try:
        function, arguments, named, timeout = pickle.loads(message)
        with _limited(timeout):
            value = function(*arguments, **named)
        return pickle.dumps((True, value))
    except _OutOfTime as error:
        return pickle.dumps((False, WorkerTimeout(too_long(timeout) + place_of(error.__traceback__))))
    except (Exception, KeyboardInterrupt) as error:  # SIGINT is ignored: the job's own code raised it
        return pickle.dumps((False, _portable(error)))


def _portable(error: BaseException) -> CollisionsError:
    """Return an error that can be pickled and raised in the parent."""
    if isinstance(error, CollisionsError):
        with contextlib.suppress(Exception):
            pickle.loads(pickle.dumps(error))
            return error
        return RunFailed(str(error))
    if isinstance(error, MemoryError):
        return out_of_memory(error)
    return RunFailed(one_line(error) + place_of(error.__traceback__))


def _end_with(parent: int) -> None:
    """End this process once its parent is gone, killed in the middle of a job, on a system that shows it (POSIX)."""
    while os.getppid() == parent:
        time.sleep(_PARENT_INTERVAL)
    os._exit(1)


if __name__ == "__main__":
    _serve()
