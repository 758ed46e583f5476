"""Where the commands write: tables to the standard output, progress and errors to the standard error."""

from __future__ import annotations

import os
import sys
from typing import Any, TextIO

from rich.console import Console

from reference.errors import CannotWrite

output = Console(highlight=False)
errors = Console(stderr=True, highlight=False)


class Stream:
    """One of the program's own streams. A reader that has gone, as `head` does, wants no more and is no error.

    Where the output cannot be written for another reason, `CannotWrite` says so once; what is said of errors is lost.
    """

    def __init__(self, stream: TextIO, name: str = "") -> None:
        self._stream, self._name = stream, name

    def write(self, text: str) -> int:
        """Write a text, or nothing once the stream is refused."""
        try:
            return self._stream.write(text)
        except OSError as error:
            return self._refused(error, len(text))

    def flush(self) -> None:
        """Write what is waiting to be written."""
        try:
            self._stream.flush()
        except OSError as error:
            self._refused(error, 0)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def _refused(self, error: OSError, length: int) -> int:
        """Let everything else go nowhere, also what Python writes as it ends."""
        os.dup2(os.open(os.devnull, os.O_WRONLY), self._stream.fileno())
        if self._name and not isinstance(error, BrokenPipeError):
            raise CannotWrite(f"cannot write {self._name}: {error.strerror}") from None
        return length


def own_streams() -> None:
    """Let both streams be closed, and carry μ and θ even where the system's own encoding cannot.

    Where a caller has closed one, Python has none: then what is written there goes nowhere.
    """
    sys.stdout, sys.stderr = (each or open(os.devnull, "w") for each in (sys.stdout, sys.stderr))  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")
    sys.stdout, sys.stderr = Stream(sys.stdout, "the output"), Stream(sys.stderr)
