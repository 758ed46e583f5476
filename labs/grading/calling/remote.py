"""A submission's functions, called as if they were here, but run in a process that shuts them in.

    with Remote(submission) as remote, remote.fresh() as call:
        side = call("side_of_plane", -2.0, 0.5)

Each `fresh()` is a process of its own, so one test's crash, loop or patch costs that test only. Everything that a call
raises because of the submission is a `StudentError`, with a message for the student; `GraderFailed` is our own fault.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Collection, Iterator
from types import TracebackType
from typing import Self

from labs.grading.budget import Budget
from labs.grading.calling.calls import LOADING, Call
from labs.grading.calling.compiling import Beginning
from labs.grading.calling.hosts import LoneHost, NurseryHost
from labs.grading.calling.patience import Patience
from labs.grading.calling.processes import Host, Limits
from labs.grading.errors import GraderFailed, NotTried, OutOfTime, StudentError
from labs.grading.submission.reading import Complaint, Submission
from labs.grading.worker.tier import Tier

__all__ = ["Call", "Grader", "Limits", "Remote"]

_NOBODY = 65534
"""The id of the user `nobody` on Linux."""
_MOST_LEFT_OUT = 3
"""So many statements that never end are left out; each may have cost the time of a call."""


class Grader:
    """Runs tests: one grader for all submissions of a class.

    least: the tier below which nothing is graded. user: the id that tests run as if this is root. without: measures of
    the sandbox to leave out (`hosts.MEASURES`). sandboxed: whether to use the sandbox at all, which only Linux has.
    """

    def __init__(
        self,
        limits: Limits | None = None,
        *,
        least: Tier = Tier.PROCESS,
        user: int = _NOBODY,
        without: Collection[str] = (),
        sandboxed: bool = True,
    ) -> None:
        self.limits, self.least = limits or Limits(), least
        has_nursery = sandboxed and sys.platform == "linux"
        self.host: Host = NurseryHost(user, without) if has_nursery else LoneHost()

    def close(self) -> None:
        """End all processes."""
        self.host.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        self.close()


class Remote:
    """One submission's functions. Without a grader it makes its own, which `close` ends.

    budget: the time that is left to the submission; without one, it has the whole time of the grader's limits.
    complaints: what the student should know of loading, once a process was begun.
    """

    def __init__(self, submission: Submission, grader: Grader | None = None, budget: Budget | None = None) -> None:
        self.submission = submission
        self.grader = grader or Grader()
        self._own = grader is None
        self._unloadable: StudentError | None = None
        self.budget = budget or Budget(self.grader.limits.submission)
        self._patience = Patience(self.budget, submission.uses)
        self._beginning = Beginning(submission.text, self.grader.limits.printed, code=True)
        self._next: Call | None = None
        self.complaints: list[Complaint] = []
        self._complained, self._left_out = False, 0

    @property
    def slow(self) -> frozenset[str]:
        """The functions that ran out of time in a call, or have used up their share of the time."""
        return self._patience.slow

    @contextlib.contextmanager
    def fresh(self) -> Iterator[Call]:
        """A process for one test, which is told to end when the block ends; `close` waits until nothing is left.

        The process for the next test gets ready meanwhile, on another processor if there is one. If the submission does
        not even load, or its time is up, later tests are told so at once.
        """
        if not self.budget.left and self._unloadable is None:
            self._unloadable = NotTried(f"it was not tried to the end: {self.budget} are used up")
        call = self._begun()
        try:
            if self._unloadable is None:
                self._get_ready()
            yield call
        finally:
            call.end()

    def _begun(self) -> Call:
        """The process that got ready; a new one if there is none, or if it died with its nursery."""
        ready, self._next = self._next, None
        if ready is not None:
            with contextlib.suppress(GraderFailed):
                if self._begin(ready, self._unloadable) == self._unloadable and not ready.gone:
                    return ready
            ready.end()
        call = self._new()
        self._unloadable = self._begin(call, self._unloadable)
        while self._unloadable is not None and self._can_do_without(call, self._unloadable):
            call.end()
            call = self._new()
            self._unloadable = self._begin(call, None)
        if not self._complained:
            self._complained = True
            self.complaints += call.failed_within()
        return call

    def _can_do_without(self, call: Call, why: StudentError) -> bool:
        """Leave out the statement on which loading ended, if it is known; False if there is nothing to leave out."""
        if isinstance(why, NotTried) or self._left_out == _MOST_LEFT_OUT:
            return False
        line = (isinstance(why, OutOfTime) and self._patience.slowest_line()) or call.reached
        text = self.submission.without(self._beginning.text, line)
        if text is None:
            return False
        self._left_out += 1
        self.complaints.append(self.submission.left_out(line, str(why).removeprefix(LOADING).strip()))
        self._patience.forget(LOADING)
        self._beginning = Beginning(text, self.grader.limits.printed, code=True)
        return True

    def _begin(self, call: Call, unloadable: StudentError | None) -> StudentError | None:
        try:
            return call.begin(self.grader.host, self.grader.least, unloadable)
        except BaseException:
            call.end()
            raise

    def _new(self) -> Call:
        return Call(self.submission, self.grader.limits, self._patience, self.fresh, self._beginning)

    def _get_ready(self) -> None:
        if self._next is None:
            call = self._new()
            try:
                call.start(self.grader.host)
            except GraderFailed:  # the next test starts its own, and says so if that fails as well
                call.end()
            else:
                self._next = call

    def close(self) -> None:
        """End the process that got ready for another test; nothing of any test is left afterwards."""
        if self._next is not None:
            self._next.end()
            self._next = None
        self.grader.host.wait()
        if self._own:
            self.grader.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        self.close()
