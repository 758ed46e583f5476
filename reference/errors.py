"""The errors that the lab raises on purpose. Each names the refused value, and the choices if there are any."""

from __future__ import annotations

import contextlib
import difflib
import sysconfig
import traceback
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path
from types import TracebackType


class CollisionsError(Exception):
    """Anything the lab refuses or fails to do; `exit_code` is what the command line ends with."""

    exit_code = 3


class InvalidInput(CollisionsError, ValueError):
    """A value that cannot be used: a negative mass, a restitution above one, an unknown name."""

    exit_code = 2


class UnknownName(InvalidInput):
    """A name that is not among the choices. One of them is suggested: the one that was surely meant, or the closest."""

    def __init__(self, kind: str, value: object, choices: Iterable[str], meant: str = "") -> None:
        self.kind, self.value, self.choices, self.meant = kind, value, tuple(choices), meant
        between = "; " if any("," in choice for choice in self.choices) else ", "
        close = [meant] if meant in self.choices else difflib.get_close_matches(str(value), self.choices, 1, 0.5)
        hint = f" Did you mean {close[0]!r}?" if close else ""
        super().__init__(f"unknown {kind} {str(value)!r}.{hint} Choices: {between.join(self.choices) or 'none'}.")

    def __reduce__(self) -> tuple[object, ...]:
        return UnknownName, (self.kind, self.value, self.choices, self.meant)


class CannotWrite(CollisionsError):
    """The system refuses to write, and another path on the same disk would not help: the disk is full, or broken."""


class EngineNotInstalled(CollisionsError):
    """The engine's package is missing on this machine; the message says how to get it."""


class EngineBroken(EngineNotInstalled):
    """The engine's package is there and cannot be imported; the message says why."""


class NotRecorded(CollisionsError):
    """Nothing of this run was recorded, or its recording is stale; the message says which."""


class NoWords(CollisionsError):
    """The lab has no words yet for what a case needs, such as a fluid in a scenario. No engine is to blame."""


class CannotExpress(CollisionsError):
    """The engine has no words for this scenario; the message says which part and why."""


class NeedsFunction(CollisionsError):
    """The hand-written code lacks a function that the scenario needs."""


class StillRunning(CollisionsError):
    """The run has not ended yet: a page that is written before the end says so instead of giving a number."""


class RunFailed(CollisionsError):
    """The run gave no usable answer: an exception, a non-finite state, a function that failed."""


class NotAsTold(RunFailed):
    """The engine says something else of its world than it was told: a fault of the lab, found before the first step."""


class Undecided(RunFailed):
    """Rounding decides what a number is, so that a recurrence cannot have it."""


class Unforeseen(RunFailed):
    """An exception that the lab did not foresee, from an engine, hand-written code or a measurement."""


class WorkerCrashed(RunFailed):
    """The worker process died of what the job did, such as a segmentation fault."""


class RunLost(RunFailed):
    """The run was lost to what surrounds it, such as load or short memory; what it would have given is unknown."""


class WorkerKilled(RunLost):
    """The worker process was killed from outside, or could not be started."""


class WorkerStopped(RunLost):
    """Nobody waits for the job any more, and its worker process was stopped."""


class WorkerTimeout(RunLost):
    """The job went past its time limit and its worker process was stopped."""


class OutOfMemory(RunLost):
    """There was not enough memory for the job."""


@contextlib.contextmanager
def as_failed_run() -> Iterator[None]:
    """Let the lab's own errors pass, and turn any other exception into `Unforeseen`, or `OutOfMemory`."""
    try:
        yield
    except CollisionsError:
        raise
    except MemoryError as error:
        raise out_of_memory(error) from error
    except Exception as error:
        raise Unforeseen(one_line(error) + place_of(error.__traceback__)) from error


def out_of_memory(error: MemoryError) -> OutOfMemory:
    """What is said of a job for which there was not enough memory, and where in hand-written code."""
    return OutOfMemory(f"it ran out of memory{place_of(error.__traceback__)} ({one_line(error)})")


def listed(words: Sequence[str]) -> str:
    """Words in a sentence: `PyBullet, MuJoCo and DART`."""
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def one_line(error: BaseException) -> str:
    """The exception's type and message, as Python prints them last: `ZeroDivisionError: division by zero`."""
    return " ".join(traceback.format_exception_only(error)[-1].split())


def place_of(trace: TracebackType | None) -> str:
    """Where an error arose in hand-written code: `, at line 3 of lab.py, in unit, for collide`; empty if not in any.

    It names the innermost place that is neither ours nor a library's, and the function through which it was reached.
    """
    frames = [frame for frame in traceback.extract_tb(trace) if _is_handwritten(frame.filename)]
    if not frames:
        return ""
    asked, last = frames[0].name, frames[-1]
    place = f", at line {last.lineno} of {Path(last.filename).name}, in {last.name}"
    return place if asked == last.name else f"{place}, for {asked}"


@cache
def _is_handwritten(file: str) -> bool:
    ours = Path(__file__).resolve().parents[1]
    libraries = [Path(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib", "purelib", "platlib")]
    path = Path(file).resolve()
    return path.is_file() and not any(
        path.is_relative_to(place) for place in (ours / "reference", ours / "labs", *libraries)
    )
