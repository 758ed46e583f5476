"""One line that says what is being done, for anything that takes longer than a moment. It disappears at the end."""

from __future__ import annotations

import contextlib
import sys
import threading
import time
from types import TracebackType
from typing import Any, Self

_AFTER = 1.0
"""s before anything is said."""
_EVERY = 0.5
"""s between two updates of the line."""


class Progress:
    """`with Progress("running") as progress: progress.done(1, 3, "MuJoCo")`."""

    def __init__(self, doing: str, of: int = 0) -> None:
        self._doing, self._said = doing, f"{doing}: 0 of {of}" if of else f"{doing} …"
        self._over = threading.Event()
        self._line = _NotebookLine() if _in_notebook() else _TerminalLine()
        self._thread = threading.Thread(target=self._speak, daemon=True)

    def done(self, count: int, of: int, label: str) -> None:
        """Note that so many are done, and which one was the last."""
        self._said = f"{self._doing}: {count} of {of}, {label}"

    def _speak(self) -> None:
        began, waits = time.monotonic(), _AFTER
        while not self._over.wait(waits):
            with contextlib.suppress(Exception):  # a line that cannot be shown must not stop the work that it reports
                self._line.write(f"{self._said}, {time.monotonic() - began:.0f} s")
            waits = _EVERY

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        self._over.set()
        self._thread.join()
        self._line.write("")


class _TerminalLine:
    """A line that is overwritten in a terminal; nothing if the output goes to a file."""

    def __init__(self) -> None:
        self._width = 0

    def write(self, text: str) -> None:
        if sys.stderr.isatty() and (text or self._width):
            sys.stderr.write("\r" + text.ljust(self._width) + ("" if text else "\r"))
            sys.stderr.flush()
            self._width = len(text)


class _NotebookLine:
    """An output that is updated in place, and empty at the end."""

    def __init__(self) -> None:
        self._handle: Any = None

    def write(self, text: str) -> None:
        from IPython.display import display  # noqa: PLC0415

        shown = {"text/plain": text}
        if self._handle is not None:
            self._handle.update(shown, raw=True)
        elif text:
            self._handle = display(shown, raw=True, display_id=True)  # type: ignore[no-untyped-call]


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    found = shell.get_ipython() if shell is not None else None
    return found is not None and hasattr(found, "kernel")
