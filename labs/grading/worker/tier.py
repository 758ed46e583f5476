"""How far a test's process was shut in. Every result states it, since not every system offers the same."""

from __future__ import annotations

import enum


class Tier(enum.IntEnum):
    """From the least protection to the most; each includes those before it.

    PROCESS: a process of its own that is killed when its time is over; off Linux there is no more than this.
    LIMITS: memory, processor time, processes and written bytes are limited, strays are found and killed.
    FILES: no file can be written, and only the interpreter's own and NumPy's can be read.
    NETWORK: no other machine or process can be reached either.
    """

    PROCESS = 0
    LIMITS = 1
    FILES = 2
    NETWORK = 3

    @property
    def title(self) -> str:
        """In words."""
        return ("process and timeout", "limits", "files sealed", "files and network sealed")[self]
