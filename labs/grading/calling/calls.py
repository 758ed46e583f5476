"""The calls of one test: functions of a submission are called by name, in one process, within the test's time.

Threat: answers that are forged, stale or of no plain type, and errors whose text is the student's own. Every answer is
matched part by part, with the number of its call. Every text is made fit to be shown. Anything odd ends the process.
"""

from __future__ import annotations

import contextlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any

from labs.grading.calling import endings
from labs.grading.calling.compiling import Beginning
from labs.grading.calling.load_failures import Failures, is_line
from labs.grading.calling.patience import Patience
from labs.grading.calling.processes import LOST, Ended, Host, Limits, Process
from labs.grading.errors import (
    FunctionMissing,
    FunctionRaised,
    GraderFailed,
    MachineBusy,
    NoAnswer,
    NotSteady,
    ProcessDied,
    StudentError,
    WrongType,
)
from labs.grading.phrases import needs
from labs.grading.safe_text import one_line, plain
from labs.grading.submission.reading import Complaint, Submission
from labs.grading.worker import messages
from labs.grading.worker.loading import MOST_TOLD
from labs.grading.worker.sandbox import Sealing
from labs.grading.worker.tier import Tier
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, NeedsFunction

LOADING = "the submission, on loading,"
"""Stands for a function's name while the text is run."""
_TIERS = frozenset(Tier)
_MOST_FAILED = 20  # so many statements that failed on loading are named
_AHEAD = 2**15  # bytes of requests that a pipe holds whether or not they are read, half of what Linux gives it
_STARTING = 120.0  # s on the clock for the process itself, before it has seen the submission; it needs some 0.01 s


class Call:
    """Calls functions of the submission in one process.

    Of the last call: printed, what it printed; changed, which of its arguments it wrote to, by position. Of all calls:
    answered, how many had an answer, be it an exception. Of the process: sealing, how far it is shut in, None before it
    says so; ended, how it ended and what it used.
    """

    def __init__(
        self,
        submission: Submission,
        limits: Limits,
        patience: Patience,
        fresh: Callable[[], AbstractContextManager[Call]],
        beginning: Beginning | None = None,
    ) -> None:
        self._submission, self._limits, self._patience, self._fresh = submission, limits, patience, fresh
        self._beginning = beginning or Beginning(submission.text, limits.printed)
        self._process: Process | None = None
        self._asks_for_code = False
        self._left = limits.test  # s of its process's own time that are left to this test
        self._number = 0
        self._ahead: deque[tuple[int, str, tuple[Any, ...]]] = deque()  # calls sent whose answers are not read yet
        self._lost: StudentError | None = None
        self._names: frozenset[str] = frozenset()
        self._failures = Failures()
        self.reached: int | None = None  # the line of the last statement that began on loading
        self.printed = ""
        self.changed: tuple[int, ...] = ()
        self.answered = 0
        self.asked: set[str] = set()
        self.sealing: Sealing | None = None

    def start(self, host: Host) -> None:
        """Start the process and send it the text, which it runs at once; `begin` reads whether it could be loaded."""
        self._process = host.start(self._limits)
        self._asks_for_code = self._beginning.asks
        with self._starting():
            self._process.send(self._beginning.message(), _STARTING)

    def begin(self, host: Host, least: Tier, unloadable: StudentError | None = None) -> StudentError | None:
        """Have the process run the submission's text; returns why it cannot be loaded, which every call then raises.

        least: the tier below which it is not run. unloadable: the reason that was found in an earlier process.
        """
        self._lost = unloadable
        if unloadable is None:
            if self._process is None:
                self.start(host)
            self._seal(least, host.most)
            try:
                self._load()
            except StudentError as error:
                return error
        return unloadable

    def _seal(self, least: Tier, most: Tier) -> None:
        """Read how far the process is shut in; it reports this before it runs any of the text.

        most: the tier that we have arranged. A process that claims more runs code that somebody has changed.
        """
        assert self._process is not None
        with self._starting():
            match messages.unpack(self._process.exchange(b"", _STARTING)):
                case ("sealed", int(tier), list(missing), list(lacking), int(process), float(before)) if tier in _TIERS:
                    self._process.measure(process, before)
                    if tier > most:
                        missing.append(f"its process claims {Tier(tier).title!r}, which this machine cannot provide")
                    self.sealing = Sealing(min(Tier(tier), most), tuple(missing), tuple(lacking))
                case _:
                    raise messages.Refused("it does not say how far it is shut in")
        if self.sealing.tier < least:
            offered, without = self.sealing.tier.title, "; ".join(self.sealing.missing)
            raise GraderFailed(f"this machine offers {offered!r}, below {least.title!r}: {without}")
        if self.sealing.lacking:
            raise GraderFailed(endings.cannot_open(self.sealing.lacking))

    @contextlib.contextmanager
    def _starting(self) -> Iterator[None]:
        try:
            yield
        except (OSError, EOFError, messages.Refused) as error:
            assert self._process is not None
            why = str(error) or endings.reason(self._process.ended)
            raise GraderFailed(f"a test's process did not start: {why}") from None

    def _load(self) -> None:
        forged = "the submission wrote into the grader's pipe on loading"
        if self._asks_for_code:  # the process sends it before it runs any of the submission
            match self._exchange(LOADING, b""):
                case (str(), code):
                    self._beginning.keep(code)
                case _:
                    raise self._lose(NoAnswer(forged))
        for _ in range(MOST_TOLD + 1):
            with self._patience.counted_for(self.reached, LOADING):
                said = self._exchange(LOADING, b"")
            match said:
                case (str(kind), line) if kind == "begins" and (line is None or is_line(line)):
                    self.reached = line
                case (str(), list(names), list(failures), list(inner)):
                    self._names = frozenset(name for name in names if isinstance(name, str))
                    self._failures = Failures(failures, inner)
                    return
                case _:
                    break
        raise self._lose(NoAnswer(forged))

    @property
    def gone(self) -> bool:
        """Whether the process has ended by itself."""
        return self._process is None or self._process.gone

    def __call__(self, name: str, /, *arguments: Any, **named: Any) -> Any:
        """Call a function; raises a `StudentError` if it does not answer with plain values.

        Arguments and answers are None, bool, int, float, str, tuples and lists of these, NumPy arrays and scalars.
        """
        if self._lost is not None:
            raise self._lost
        self.asked.add(name)
        self.printed, self.changed = "", ()
        foreseen = self._was_foreseen(name, arguments, named)
        asked, message = (foreseen, b"") if foreseen else self._request(name, arguments, named)
        match self._exchange(name, message):
            case (str(), int(number), str(outcome), *rest, str(printed)) if number == asked:
                self.printed = plain(printed, self._limits.printed)
                return self._judged(name, outcome, rest, len(arguments) + len(named))
        raise self._lose(NoAnswer(f"{name} wrote into the grader's pipe instead of answering"))

    def foresee(self, name: str, several: Iterable[tuple[Any, ...]]) -> None:
        """Send the calls of a function that come next, in this order, so that the process works ahead of us."""
        if self._lost is not None or self._ahead:
            return
        requests = b""
        for arguments in several:
            number, request = self._request(name, arguments, {})
            if len(requests + request) > _AHEAD:
                break
            self._ahead.append((number, name, arguments))
            requests += request
        assert self._process is not None
        with self._counted(name) as (_, allowed), contextlib.suppress(OSError):  # no answer will show it
            self._process.send(requests, allowed, self._patience.budget.until)

    def _was_foreseen(self, name: str, arguments: tuple[Any, ...], named: dict[str, Any]) -> int | None:
        """The call's number if it is the next that was foreseen; otherwise skips the answers to all foreseen calls."""
        while self._ahead:
            number, ahead, given = self._ahead.popleft()
            if name == ahead and not named and [*map(id, arguments)] == [*map(id, given)]:
                return number
            self._exchange(ahead, b"")
        return None

    def _request(self, name: str, arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[int, bytes]:
        self._number += 1
        try:
            return self._number, messages.pack(("call", self._number, name, arguments, list(named.items())))
        except messages.Refused as refused:
            raise InvalidInput(f"{name} cannot be called with {refused}") from None

    def _judged(self, name: str, outcome: str, rest: list[Any], arguments: int) -> Any:
        """The value of an answer. Types are matched before any comparison: a compared array has no truth value."""
        self.answered += 1
        match rest:
            case [float(), list(changed), value] if outcome == "value":
                written = {place for place in changed if isinstance(place, int) and 0 <= place < arguments}
                self.changed = tuple(sorted(written))
                return value
            case [str(kind), str(text), line, list(through)] if outcome == "raised":
                passed = tuple(each for each in through if isinstance(each, str))
                raise self._raised(name, kind, text, line if is_line(line) else None, passed)
            case [str(why)] if outcome == "refused":
                allowed = "a number, text, an array or a tuple of these"
                raise WrongType(f"{name} gave {one_line(why)}; an answer is {allowed}")
            case [] if outcome == "missing":
                raise self._missing(name)
        raise self._lose(NoAnswer(f"{name} wrote into the grader's pipe instead of answering"))

    def steady(self, name: str, /, *arguments: Any, **named: Any) -> Any:
        """Call a function here and in a fresh process; raises `NotSteady` unless both answers agree bit by bit."""
        value = self(name, *arguments, **named)
        with self._fresh() as other:
            again = other(name, *arguments, **named)
        if messages.pack(value) != messages.pack(again):
            raise NotSteady(f"{name} answered the same call otherwise in a fresh process; only the arguments may count")
        return value

    def failed_within(self) -> list[Complaint]:
        """The statements that failed and may have filled a table; those after them were run all the same."""
        told = {failure[3]: failure for failure in reversed(self._failures.every)}
        return [
            Complaint(
                f"{self._submission.where(line)}: this statement failed on loading: {self._said(kind, text, None)}"
            )
            for names, kind, text, line in list(reversed(told.values()))[:_MOST_FAILED]
            if line and (not names or self._submission.is_compound(line))
        ]

    def defines(self, name: str) -> bool:
        """Whether the submission has a function of that name."""
        return name in self._names

    def implementation(self) -> RemoteImplementation:
        """These functions as the implementation that the drivers of scenarios call."""
        return RemoteImplementation("submission", self)

    def end(self) -> None:
        """Have the process killed with all that it started."""
        if self._process is not None:
            self._process.end()

    @property
    def ended(self) -> Ended | None:
        """How the process ended and what it used; None if there was no process. Nothing of it is left afterwards."""
        return None if self._process is None else self._process.ended

    def _exchange(self, name: str, message: bytes) -> Any:
        """Send a message and read the answer within the time that is left; any failure ends the process."""
        assert self._process is not None
        with self._counted(name) as (for_call, allowed):
            if allowed == 0:
                raise self._lose(self._patience.used_up(name, self._limits.test))
            self._patience.calls[name] += 1
            return self._answered(name, message, for_call, allowed)

    @contextlib.contextmanager
    def _counted(self, name: str) -> Iterator[tuple[float, float]]:
        """How long a call may take, and how long is left for it; afterwards test and submission have that much less.

        All of it is own time of the process.
        """
        assert self._process is not None
        budget = self._patience.budget
        budget.refuse_if_overdue()
        before, for_call = self._process.spent, self._patience.for_call(name, self._limits.call)
        try:
            whole, share = budget.left, self._patience.share_left(name)
            yield for_call, max(0.0, min(for_call, self._left, whole, share))
        finally:
            spent = self._process.spent - before
            self._left -= spent
            self._patience.spent[name] += spent
            budget.spend(spent)

    def _answered(self, name: str, message: bytes, for_call: float, allowed: float) -> Any:
        assert self._process is not None
        try:
            return messages.unpack(self._process.exchange(message, allowed, self._patience.budget.until))
        except MachineBusy:
            self.end()
            self._patience.budget.refuse_if_overdue()
            raise
        except TimeoutError:
            raise self._lose(self._patience.ran_out(name, allowed, for_call, self._limits)) from None
        except (OSError, EOFError):
            if self._process.ended is LOST:
                raise GraderFailed("the nursery, of which a test's process is part, was stopped meanwhile") from None
            raise self._lose(ProcessDied(f"{name} gave no answer: {endings.reason(self._process.ended)}")) from None
        except messages.Refused as refused:
            raise self._lose(NoAnswer(f"{name} gave no answer: {one_line(str(refused))}")) from None

    def _lose(self, error: StudentError) -> StudentError:
        self._lost = error
        self.end()
        return error

    def _missing(self, name: str) -> StudentError:
        if failure := self._failures.of(name):
            _, kind, text, line = failure
            return FunctionRaised(f"{name} could not be defined: {self._said(kind, text, line)}", kind, line)
        return FunctionMissing(f"{needs(name)}: it is not in the submission")

    def _raised(self, name: str, kind: str, text: str, line: int | None, through: tuple[str, ...]) -> StudentError:
        if kind == "NotImplementedError":
            stub = self._submission.function_at(line) or name
            return FunctionMissing(f"{f'{name} ' * (stub != name)}{needs(stub)}: it is not written yet")
        message = f"{name} raised {self._said(kind, text, line)}"
        if kind == "NameError" and (failure := self._failures.behind(text)):
            message += f". On loading: {self._said(*failure[1:])}"
        return FunctionRaised(message, one_line(kind), line, through)

    def _said(self, kind: str, text: str, line: int | None) -> str:
        where = f" ({self._submission.where(line)})" if line else ""
        return f"{one_line(kind, 100)}{': ' * bool(text)}{one_line(text)}{where}"


@dataclass(frozen=True)
class RemoteImplementation(Implementation):
    """A submission as an implementation: drivers and trajectory stay here, and the functions run in their process."""

    call: Call | None = None

    def function(self, name: str) -> Callable[..., Any]:
        """Return a proxy of the function; raises `NeedsFunction` if it is not written yet."""
        call = self.call
        if call is None or not call.defines(name):
            raise NeedsFunction(needs(name))
        return lambda *arguments, **named: call(name, *arguments, **named)
