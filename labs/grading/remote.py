"""A submission's functions, called as if they were here, run in a process that shuts them in.

    with Remote(submission) as remote, remote.fresh() as call:
        speed = call("rebound_velocity", -2.0, 0.5)

Each `fresh()` is a process of its own, so one test's crash, loop or patch costs that test. All that a call raises
because of the submission is a `StudentError`, with a message for the student; `GraderFailed` is ours.
"""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Self

from labs.grading import deaths, messages
from labs.grading.errors import (
    FunctionMissing,
    FunctionRaised,
    GraderFailed,
    NoAnswer,
    NotSteady,
    OutOfTime,
    ProcessDied,
    StudentError,
    WrongType,
)
from labs.grading.hosts import LoneHost, NurseryHost
from labs.grading.plain import one_line, plain
from labs.grading.processes import Ended, Host, Limits, Process
from labs.grading.submission import Submission
from labs.grading.worker.sandbox import Sealing
from labs.grading.worker.tier import Tier
from reference import lecture
from reference.errors import NeedsFunction
from reference.implementation import Implementation

_NOBODY = 65534
_STARTING = 10.0  # s for the process itself, before it has seen the submission


class Grader:
    """What runs tests: one for all submissions of a class.

    least: the tier below which nothing is graded. user: the id that tests run as when this is root, `nobody` unless
    said otherwise. without: measures to leave out (`hosts.MEASURES`), or "nursery" for what other systems offer.
    """

    def __init__(
        self,
        limits: Limits | None = None,
        *,
        least: Tier = Tier.PROCESS,
        user: int = _NOBODY,
        without: Collection[str] = (),
    ) -> None:
        self.limits, self.least = limits or Limits(), least
        nursery = sys.platform == "linux" and "nursery" not in without
        self.host: Host = NurseryHost(user, without) if nursery else LoneHost()

    def close(self) -> None:
        """End all processes."""
        self.host.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        self.close()


class Remote:
    """One submission's functions. Without a grader it has one of its own, which `close` ends."""

    def __init__(self, submission: Submission, grader: Grader | None = None) -> None:
        self.submission = submission
        self.grader = grader or Grader()
        self._own = grader is None

    @contextlib.contextmanager
    def fresh(self) -> Iterator[Call]:
        """A process for one test; at the end of the block nothing of it is left."""
        call = Call(self)
        try:
            call.begin()
            yield call
        finally:
            call.end()

    def close(self) -> None:
        """End the grader, where it is our own."""
        if self._own:
            self.grader.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        self.close()


class Call:
    """Calls functions of the submission in one process.

    Of the last call: printed, what it printed; changed, which of its arguments it wrote to, by place. Of the process:
    sealing, how far it is shut in; ended, once it has, how that was and what it used.
    """

    def __init__(self, remote: Remote) -> None:
        self._remote, self._limits = remote, remote.grader.limits
        self._process: Process = remote.grader.host.start(self._limits)
        self._left = self._limits.test  # s of waiting that are left to this test
        self._number = 0
        self._lost: StudentError | None = None
        self._names: frozenset[str] = frozenset()
        self._failures: list[Any] = []
        self.printed = ""
        self.changed: tuple[int, ...] = ()
        self.sealing = Sealing(Tier.PROCESS)
        self.ended: Ended | None = None

    def begin(self) -> None:
        """Learn how far the process is shut in, and have it run the submission's text."""
        load = messages.pack(("load", self._remote.submission.text, self._limits.printed))
        try:
            match messages.unpack(self._process.exchange(load, _STARTING)):
                case ("sealed", int(tier), list(missing)):
                    self.sealing = Sealing(Tier(tier), tuple(missing))
        except (OSError, EOFError, messages.Refused) as error:
            raise GraderFailed(f"a test's process did not start: {error or deaths.reason(self.end())}") from None
        if self.sealing.tier < self._remote.grader.least:
            raise GraderFailed(
                f"this machine offers {self.sealing.tier.title!r}, below {self._remote.grader.least.title!r}: "
                + "; ".join(self.sealing.missing)
            )
        with contextlib.suppress(StudentError):  # it is told at every call
            match self._exchange("the submission, on loading,", b""):
                case ("loaded", list(names), list(failures)):
                    self._names, self._failures = frozenset(filter(_is_text, names)), failures
                case _:
                    self._lose(NoAnswer("the submission wrote into the grader's pipe on loading"))

    def __call__(self, name: str, /, *arguments: Any, **named: Any) -> Any:
        """Call a function; raises a `StudentError` where it does not answer with plain values.

        Arguments and answers are None, bool, int, float, str, tuples and lists of these, NumPy arrays and scalars.
        """
        if self._lost is not None:
            raise self._lost
        self._number += 1
        self.printed, self.changed = "", ()
        message = messages.pack(("call", self._number, name, arguments, list(named.items())))
        match self._exchange(name, message):
            case ("answer", self._number, "value", float(), list(changed), value, str(printed)):
                self.printed = plain(printed, self._limits.printed)
                self.changed = tuple(place for place in changed if isinstance(place, int))
                return value
            case ("answer", self._number, "raised", str(kind), str(text), line, str(printed)):
                self.printed = plain(printed, self._limits.printed)
                raise self._raised(name, kind, text, line if isinstance(line, int) else None)
            case ("answer", self._number, "refused", str(why), str(printed)):
                self.printed = plain(printed, self._limits.printed)
                raise WrongType(
                    f"{name} gave {one_line(why)}; an answer is a number, text, an array or a tuple of these"
                )
            case ("answer", self._number, "missing", str()):
                raise self._missing(name)
        raise self._lose(NoAnswer(f"{name} wrote into the grader's pipe instead of answering"))

    def steady(self, name: str, /, *arguments: Any, **named: Any) -> Any:
        """Call a function here and in a fresh process; raises `NotSteady` unless both give the same, bit by bit."""
        value = self(name, *arguments, **named)
        with self._remote.fresh() as other:
            again = other(name, *arguments, **named)
        if messages.pack(value) != messages.pack(again):
            raise NotSteady(f"{name} answered the same call otherwise in a fresh process; only the arguments may count")
        return value

    def defines(self, name: str) -> bool:
        """Whether the submission has a function of that name."""
        return name in self._names

    def implementation(self) -> RemoteImplementation:
        """These functions as what the drivers of scenarios call."""
        return RemoteImplementation("submission", self)

    def end(self) -> Ended:
        """Kill the process with all that it started."""
        self.ended = self._process.end()
        return self.ended

    def _exchange(self, name: str, message: bytes) -> Any:
        """Send a message and read the answer, within what time is left; whatever goes wrong ends the process."""
        allowed, began = min(self._limits.call, self._left), time.monotonic()
        try:
            answer = messages.unpack(self._process.exchange(message, allowed))
        except TimeoutError:
            limit = f"{allowed:.3g} s" + (" (the test's time is up)" if allowed < self._limits.call else "")
            raise self._lose(OutOfTime(f"{name} gave no answer within {limit} and was stopped")) from None
        except (OSError, EOFError):
            raise self._lose(ProcessDied(f"{name} gave no answer: {deaths.reason(self.end())}")) from None
        except messages.Refused as refused:
            raise self._lose(NoAnswer(f"{name} gave no answer: {one_line(str(refused))}")) from None
        self._left -= time.monotonic() - began
        return answer

    def _lose(self, error: StudentError) -> StudentError:
        self._lost = error
        self.end()
        return error

    def _missing(self, name: str) -> StudentError:
        for names, kind, text, line in self._failures:
            if name in names or not names:
                return FunctionRaised(f"{name} could not be defined: {self._said(kind, text, line)}", kind, line)
        return FunctionMissing(f"{_needs(name)}: it is not in the submission")

    def _raised(self, name: str, kind: str, text: str, line: int | None) -> StudentError:
        if kind == "NotImplementedError":
            return FunctionMissing(f"{_needs(name)}: it is not written yet")
        message = f"{name} raised {self._said(kind, text, line)}"
        if kind == "NameError":
            message += "".join(
                f". On loading: {self._said(why, said, where)}"
                for names, why, said, where in self._failures
                if any(f"'{each}'" in text for each in names)
            )
        return FunctionRaised(message, one_line(kind), line)

    def _said(self, kind: str, text: str, line: int | None) -> str:
        where = f" ({self._remote.submission.where(line)})" if line else ""
        return f"{one_line(kind, 100)}{': ' * bool(text)}{one_line(text)}{where}"


@dataclass(frozen=True)
class RemoteImplementation(Implementation):
    """A submission as what drivers call: they and the trajectory stay here, the functions run over there."""

    call: Call | None = None

    def function(self, name: str) -> Callable[..., Any]:
        """Return a proxy of the function; where it is not written yet, raise `NeedsFunction`."""
        call = self.call
        if call is None or not call.defines(name):
            raise NeedsFunction(_needs(name))
        return lambda *arguments, **named: call(name, *arguments, **named)


def _needs(name: str) -> str:
    entry = lecture.FUNCTIONS.get(name)
    return f"needs {name} ({entry.topic}, step {entry.step})" if entry else f"needs {name}"


def _is_text(name: object) -> bool:
    return isinstance(name, str)
