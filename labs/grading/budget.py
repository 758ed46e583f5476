"""The time that one submission has in all: for reading its file, running its tests, and saying what is wrong with it.

Threat: limits for a call and for a test do not add up to a limit for a class of forty. A function that sleeps for 0.9 s
in each of two hundred calls stays within both. So one clock runs from before the file is opened until the last word is
written, no matter what spends the time: the submission, or the grader on what the submission made it do. When the time
is used up, no function is called again, the tests that remain say so, and the grade is written.
"""

from __future__ import annotations

import math
import time

from reference.errors import InvalidInput

SECONDS = 60.0
"""What a submission has unless somebody says otherwise; a right one of any lab needs a second or two."""
SHARE = 1 / 3
"""So much of it may one function use, so that a slow one leaves time for the others."""


class Budget:
    """A number of seconds that begin to run when this is made."""

    def __init__(self, seconds: float = SECONDS) -> None:
        if not 0 < seconds < math.inf:
            raise InvalidInput(f"a submission cannot have {seconds:g} s: give a number of seconds above 0")
        self.seconds = seconds
        self._until = time.monotonic() + seconds

    @property
    def left(self) -> float:
        """How many seconds are left, at least 0."""
        return max(0.0, self._until - time.monotonic())

    @property
    def share(self) -> float:
        """How many seconds the calls of one function may take together."""
        return self.seconds * SHARE

    def __str__(self) -> str:
        return f"the {self.seconds:.3g} s that the whole file has"
