"""One line that says what is being done, for anything that takes longer than a moment; it goes when it is done."""

from __future__ import annotations

import sys
import threading
import time
from types import TracebackType
from typing import Self

_AFTER = 1.0
"""s before anything is said."""
_EVERY = 0.5


class Progress:
    """`with Progress("running") as progress: progress.done(1, 3, "MuJoCo")`."""

    def __init__(self, doing: str, of: int = 0) -> None:
        self._doing, self._said = doing, f"{doing} …" if not of else f"{doing}: 0 of {of}"
        self._over = threading.Event()
        self._width = 0
        self._thread = threading.Thread(target=self._speak, daemon=True)

    def done(self, count: int, of: int, label: str) -> None:
        """So many of all are done; the last of them was this."""
        self._said = f"{self._doing}: {count} of {of}, {label}"

    def _speak(self) -> None:
        began = time.monotonic()
        if self._over.wait(_AFTER):
            return
        while True:
            self._write(f"{self._said}, {time.monotonic() - began:.0f} s")
            if self._over.wait(_EVERY):
                self._write("")
                return

    def _write(self, text: str) -> None:
        sys.stderr.write("\r" + text.ljust(self._width) + ("" if text else "\r"))
        sys.stderr.flush()
        self._width = len(text)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        self._over.set()
        self._thread.join()
