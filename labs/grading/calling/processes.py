"""Our side of a test's process: messages to it and from it, each with a deadline.

Threat: a process that never answers, answers without end, or stops reading. Every wait here has a deadline, and
what is read is limited before it is read.
"""

from __future__ import annotations

import contextlib
import math
import os
import select
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labs.grading.budget import SECONDS
from labs.grading.calling.own_time import Deadline, OwnTime, meter
from labs.grading.worker import messages
from labs.grading.worker.tier import Tier


@dataclass(frozen=True)
class Limits:
    """What a test may use. memory: bytes beyond NumPy's. printed: characters that are kept.

    call, test: s of a process's own time (`own_time`) for a call, and for all calls of a test. submission: s for all
    that is done with a file, see `budget`.
    """

    call: float = 5.0
    test: float = 20.0
    submission: float = SECONDS
    memory: int = 2**30
    printed: int = 10_000


@dataclass(frozen=True)
class Ended:
    """How a test's process ended: its exit code, or minus the signal; s of processor time, bytes, strays killed."""

    code: int
    seconds: float = 0.0
    memory: int = 0
    strays: int = 0


LOST = Ended(-9)
"""How a process ended whose host died: it was killed as well, and nothing more is known."""


class Host(Protocol):
    """Starts processes for tests and ends them.

    most: the tier that its processes can reach at most, whatever they say of themselves.
    """

    most: Tier

    def start(self, limits: Limits) -> Process: ...  # noqa: D102
    def end(self, process: Process) -> None: ...  # noqa: D102
    def wait(self, process: Process | None = None) -> None: ...  # noqa: D102
    def has_lost(self, process: Process) -> bool: ...  # noqa: D102
    def close(self) -> None: ...  # noqa: D102


class Process:
    """One test's process: messages to it and from it. It owns the two descriptors, and closes them.

    outcome: how the process ended; its host sets this when nothing of it is left.
    """

    def __init__(self, number: int, requests: int, answers: int, host: Host) -> None:
        self.number, self._requests, self._answers, self._host = number, requests, answers, host
        self._read = bytearray()
        self._over = False
        self._own = OwnTime()
        self.outcome: Ended | None = None
        if os.name == "posix":
            os.set_blocking(requests, False)
            os.set_blocking(answers, False)

    def measure(self, process: int, before: float) -> None:
        """Count only the process's own time from now on. before: s that it computed for us at first."""
        self._own = OwnTime(meter(process, before))

    @property
    def spent(self) -> float:
        """The process's own time in all exchanges so far, s."""
        return self._own.seconds

    def exchange(self, message: bytes, seconds: float, until: float = math.inf) -> bytes:
        """Send a message (or nothing) and return the answer without its header.

        Raises TimeoutError after so many seconds of the process's own time, `MachineBusy` at a time on the clock,
        OSError or EOFError when the process hung up, and `messages.Refused` for an answer that is too long.
        """
        with self._timed(seconds, until) as deadline:
            self._write(message, deadline)
            self._fill(messages.HEADER, deadline)
            end = messages.HEADER + messages.length(bytes(self._read[: messages.HEADER]))
            self._fill(end, deadline)
        answer = bytes(self._read[messages.HEADER : end])
        del self._read[:end]
        return answer

    def send(self, message: bytes, seconds: float, until: float = math.inf) -> None:
        """Send a message without waiting for an answer; raises as `exchange`."""
        with self._timed(seconds, until) as deadline:
            self._write(message, deadline)

    @contextlib.contextmanager
    def _timed(self, seconds: float, until: float) -> Iterator[Deadline]:
        """Count what happens within as an exchange; on systems where waiting has no limit, kill the process then."""
        self._own.begin()
        try:
            with self._killed_at(time.monotonic() + seconds):
                yield Deadline(self._own, seconds, until)
        finally:
            self._own.end()

    @property
    def gone(self) -> bool:
        """Whether the process can answer no more."""
        if self._host.has_lost(self):
            return True
        if os.name != "posix":
            return False
        poll = select.poll()
        poll.register(self._answers, select.POLLIN)
        return any(event & select.POLLHUP for _, event in poll.poll(0))

    def end(self) -> None:
        """Have the process killed with all that it started, without waiting for it; it answers no more calls."""
        if not self._over:
            self._over = True
            os.close(self._requests)
            os.close(self._answers)
            self._host.end(self)

    @property
    def ended(self) -> Ended:
        """How the process ended; ends it if that was not done, and waits until nothing of it is left."""
        self.end()
        self._host.wait(self)
        assert self.outcome is not None
        return self.outcome

    def _write(self, message: bytes, deadline: Deadline) -> None:
        rest = memoryview(message)
        while rest:
            try:
                rest = rest[os.write(self._requests, rest) :]
                if rest:
                    deadline.check()  # one that reads byte by byte always seems ready
            except BlockingIOError:
                self._wait(self._requests, "POLLOUT", deadline)

    def _fill(self, count: int, deadline: Deadline) -> None:
        """Read until there are so many bytes."""
        while len(self._read) < count:
            self._wait(self._answers, "POLLIN", deadline)
            part = os.read(self._answers, 2**18)
            if not part:
                raise EOFError
            self._read += part
            if len(self._read) < count:
                deadline.check()  # one that answers byte by byte always seems ready

    def _wait(self, descriptor: int, event: str, deadline: Deadline) -> None:
        """Wait until the pipe is ready; on Windows, where that cannot be asked, reading itself waits."""
        if os.name == "posix":
            poll = select.poll()
            poll.register(descriptor, getattr(select, event))
            while not poll.poll(deadline.pause() * 1000):
                deadline.check()

    @contextlib.contextmanager
    def _killed_at(self, until: float) -> Iterator[None]:
        """Kill the process at the deadline, on systems where waiting cannot be given one."""
        if os.name == "posix":
            yield
            return
        timer = threading.Timer(until - time.monotonic(), self._host.end, [self])
        timer.start()
        try:
            yield
        except (OSError, EOFError):
            raise (TimeoutError() if time.monotonic() >= until else EOFError()) from None
        finally:
            timer.cancel()
