"""The time that a test's process takes for itself: what it computes and what it sleeps, but not what it waits in line.

Threat: on a machine that is busy with other programs, seconds of the clock say little about a function. A right one got
a tenth of the processor, ran out of time and lost its points. Processor time alone would let a function sleep for ever.
So we count the seconds of the clock while we wait for an answer, and subtract those in which the process, or we
ourselves, could have computed and other programs had the processors. Linux reports these in `schedstat`. Whatever is
subtracted, the processor time of the process counts in full, with all its threads. So neither a busy loop nor a sleep
gets more than it is allowed, and a function that waits in line loses nothing.

Where the system does not report it, all seconds of the clock count.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from functools import cache
from typing import Protocol

from labs.grading.errors import MachineBusy

_UNSETTLED = 0.005  # s on the clock that may be asleep or in line; below this we do not ask, which takes some 0.1 ms
_PAUSE = 0.02  # s between two exchanges in which we ourselves may have been in line
_NANO = 1e-9
_AGAIN = 0.01  # s: the shortest time after which we look again
_PROCESSOR_CLOCK = 2  # of a process, in the last bits of the number of its clock (CPUCLOCK_SCHED)


class Meter(Protocol):
    """What the system knows of a process."""

    def ran(self) -> float:
        """How long it has been computing, s."""

    def waited(self) -> float:
        """How long it, and the thread that calls this, could have computed and had no processor, s."""

    def is_runnable(self) -> bool:
        """Whether it computes now, or would if it had a processor."""


class NoMeter:
    """Of a process that the system says nothing about: everything on the clock is its own time."""

    def ran(self) -> float:
        """Unknown."""
        return 0.0

    def waited(self) -> float:
        """Unknown."""
        return 0.0

    def is_runnable(self) -> bool:
        """Unknown."""
        return False


class LinuxMeter:
    """Of a process of Linux; of one that has ended, what was read last. before: s that it ran for us at first."""

    def __init__(self, process: int, before: float) -> None:
        self._process, self._before = process, before
        self._clock = (~process << 3) | _PROCESSOR_CLOCK  # as clock_getcpuclockid(3) makes it
        self._last, self._in_line = 0.0, 0.0

    def ran(self) -> float:
        """How long it has been computing, all its threads together, s."""
        with contextlib.suppress(OSError):
            self._last = max(self._last, time.clock_gettime(self._clock) - self._before)
        return self._last

    def waited(self) -> float:
        """How long it and we waited in line, s."""
        self._in_line = max(self._in_line, _in_line(f"/proc/{self._process}/schedstat"))
        return self._in_line + _in_line("/proc/thread-self/schedstat")

    def is_runnable(self) -> bool:
        """Whether its state is R."""
        return _text(f"/proc/{self._process}/stat").rpartition(")")[2].split()[:1] == ["R"]


def _text(path: str) -> str:
    """What is in a small file of the system; nothing if it cannot be read. Read so, it takes half as long as `open`."""
    try:
        descriptor = os.open(path, os.O_RDONLY)
    except OSError:
        return ""
    try:
        return os.read(descriptor, 4096).decode("utf-8", "replace")
    except OSError:
        return ""
    finally:
        os.close(descriptor)


def _in_line(path: str) -> float:
    words = _text(path).split()
    return int(words[1]) * _NANO if len(words) > 1 else 0.0


def meter(process: int, before: float) -> Meter:
    """What the system offers for a process of this machine. before: s of processor time that it spent for us."""
    return LinuxMeter(process, before) if _is_reported() else NoMeter()


@cache
def _is_reported() -> bool:
    """Whether the system reports how long its processes wait in line; some kernels are built without, and say 0."""
    return sys.platform == "linux" and _text("/proc/thread-self/schedstat").split()[:1] not in ([], ["0"])


class OwnTime:
    """Adds up a process's own time over the exchanges with it.

    Between two exchanges the process may compute, since it works ahead, and this counts; but it may sleep.
    """

    def __init__(self, meter: Meter | None = None) -> None:
        self._meter = meter or NoMeter()
        self._settled = 0.0
        self._clock = 0.0  # s on the clock in exchanges since then
        self._ran, self._waited = 0.0, self._meter.waited()
        self._began: float | None = None
        self._ended = time.monotonic()

    def begin(self) -> None:
        """An exchange begins. What was in line before it must not be subtracted from what is asleep in it."""
        self._began = time.monotonic()
        if self._began - self._ended > _PAUSE:
            self._settle(self._meter.ran(), self._meter.waited(), asleep=0.0)

    def end(self) -> None:
        """An exchange ends."""
        assert self._began is not None
        self._ended = time.monotonic()
        self._clock += self._ended - self._began
        self._began = None
        ran = self._meter.ran()
        if self._clock - (ran - self._ran) > _UNSETTLED:
            waited = self._meter.waited()
            self._settle(ran, waited, self._clock - (ran - self._ran) - (waited - self._waited))

    def _settle(self, ran: float, waited: float, asleep: float) -> None:
        """Count what was computed and what was slept since the last time."""
        self._settled += ran - self._ran + max(0.0, asleep)
        self._clock, self._ran, self._waited = 0.0, ran, waited

    @property
    def seconds(self) -> float:
        """How much it is by now, s."""
        clock = self._clock + (0.0 if self._began is None else time.monotonic() - self._began)
        ran = self._meter.ran() - self._ran
        if clock - ran <= _UNSETTLED:
            return self._settled + ran
        return self._settled + max(ran, clock - (self._meter.waited() - self._waited))

    @property
    def ran(self) -> float:
        """How long the process has been computing, s."""
        return self._meter.ran()

    def is_runnable(self) -> bool:
        """Whether the process would compute now if it had a processor."""
        return self._meter.is_runnable()


class Deadline:
    """When to stop waiting in one exchange: after so many seconds of the process's own time, or at a time on the clock.

    until: that time, of `time.monotonic`. By then a process that computed or slept would have used up its own time.
    """

    def __init__(self, own: OwnTime, seconds: float, until: float) -> None:
        self._own, self._seconds, self._until = own, seconds, until
        self._at_first, self._ran = own.seconds, own.ran

    def pause(self) -> float:
        """How long to wait, at most, before we look whether it is time."""
        left = self._seconds - (self._own.seconds - self._at_first)
        return max(_AGAIN, min(left, self._until - time.monotonic()))

    def check(self) -> None:
        """Raise TimeoutError if the process's own time is over, and `MachineBusy` if that on the clock is.

        The system reports how long a process waited in line when it is its turn. So one that is in line is judged after
        its turn.
        """
        ran, self._ran = self._ran, self._own.ran
        if self._own.seconds - self._at_first >= self._seconds:
            in_line = self._ran == ran and self._own.is_runnable()
            if not in_line:
                raise TimeoutError
        if time.monotonic() >= self._until:
            raise MachineBusy
