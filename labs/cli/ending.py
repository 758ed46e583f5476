"""How every command ends: its exit code, and the last lines, which say what went wrong and what is kept.

Exit codes: 0 fine; 1 what was judged is not right, such as a verdict that counts; 2 usage; 3 could not compare or
write, or a fault of the lab; 130 interrupted.
"""

from __future__ import annotations

import logging
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from rich.markup import escape

from labs.cli.console import errors
from reference.errors import CannotWrite, CollisionsError, one_line
from reference.running.isolate import stop_workers
from reference.writable import reason_of

FINE, NOT_RIGHT, COULD_NOT_COMPARE, INTERRUPTED = 0, 1, CollisionsError.exit_code, 130
_END = ("SIGTERM", "SIGHUP")
"""Signals that ask a program to end: from a scheduler or `kill`, and from a terminal that is closed."""

_log = logging.getLogger(__name__)


def code_of(failed: bool, unanswered: bool = False) -> int:
    """The exit code after what was judged. unanswered: whether a run that counts is missing, or none gave a number."""
    if failed:
        return NOT_RIGHT
    return COULD_NOT_COMPARE if unanswered else FINE


@contextmanager
def told() -> Iterator[None]:
    """End the program with a line and an exit code instead of an error of the lab or the system, or an interrupt."""
    try:
        yield
    except CollisionsError as error:
        _end(error, error.exit_code, f"[bold red]Error:[/] {escape(str(error))}")
    except OSError as error:
        _log.info("where it was", exc_info=error)
        _end(error, CannotWrite.exit_code, f"[bold red]Error:[/] {escape(_of_the_system(error))}")
    except KeyboardInterrupt as error:
        stop_workers()
        by = f" by {error}" if str(error) else ""
        _end(error, INTERRUPTED, f"[bold]Interrupted{by}.[/]")


@contextmanager
def told_whatever_happens() -> Iterator[None]:
    """As `told`; any other exception is a fault of the lab, which must not end like a verdict that failed.

    Whoever presses Ctrl-C once more while the program ends need not see where it is by then.
    """
    try:
        with told():
            yield
    except Exception as error:
        errors.print_exception()
        _end(error, COULD_NOT_COMPARE, f"[bold red]A fault of the lab:[/] {escape(one_line(error))}")
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def let_signals_interrupt() -> None:
    """Let the signals that end a program interrupt it, as Ctrl-C does, so that it stops its workers and tidies up."""

    def interrupt(number: int, _: FrameType | None) -> None:
        raise KeyboardInterrupt(signal.Signals(number).name)

    for name in _END:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:  # nohup has one of them ignored
            signal.signal(number, interrupt)


def _of_the_system(error: OSError) -> str:
    where = f" {str(error.filename)!r}" if error.filename else ""
    return f"the system refuses a file{where}: {reason_of(error)}"


def _end(error: BaseException, code: int, line: str) -> None:
    errors.print(line, soft_wrap=True)
    for note in getattr(error, "__notes__", ()):
        errors.print(note, markup=False, soft_wrap=True)
    raise SystemExit(code) from None
