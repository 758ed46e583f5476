"""Files that one process at a time may hold: two people do not write into one folder at once."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from reference.errors import InvalidInput


@contextlib.contextmanager
def locked(path: Path, busy: str = "") -> Iterator[None]:
    """Hold a lock. busy: what is said if somebody else holds it; without it, wait until they are done.

    Raises
    ------
    InvalidInput
        If somebody else holds it, or this is Windows, which has no such locks.
    """
    try:
        import fcntl  # noqa: PLC0415 - Windows has none
    except ImportError:
        raise InvalidInput("a class is graded on Linux or a Mac; on Windows use its Linux (WSL)") from None
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    with open(path, "w", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | (fcntl.LOCK_NB if busy else 0))
        except OSError:
            raise InvalidInput(busy) from None
        yield
