"""The time that one submission has in all: for reading its file, running its tests, and saying what is wrong with it.

Threat: limits for a call and for a test do not add up to a limit for a class of forty. A function that sleeps for 0.9 s
in each of two hundred calls stays within both. So one budget begins before the file is opened and ends when the last
word is written, no matter what spends it: the submission, or the grader on what the submission made it do. When it is
used up, no function is called again, the tests that remain say so, and the grade is written.

A budget counts the processor time of this thread, and the own time of the submission's processes
(`calling.own_time`). Neither grows while other programs have the processors. So that nobody waits for ever on such a
machine, there is a limit on the clock as well, many times as long. If it is reached, the submission is not graded, and
no point is lost: `MachineBusy` says so, and the next run grades it again.
"""

from __future__ import annotations

import math
import time

from labs.grading.errors import MachineBusy
from reference.errors import InvalidInput

SECONDS = 60.0
"""What a submission has unless somebody says otherwise; a right one of any lab needs a second or two."""
SHARE = 1 / 3
"""So much of it may one function use, so that a slow one leaves time for the others."""
ON_THE_CLOCK = 20.0
"""So many times as long may all of it take on the clock: for a machine with twenty programs for each processor."""


class Budget:
    """A number of seconds that begin to run when this is made, in the thread that grades."""

    def __init__(self, seconds: float = SECONDS) -> None:
        if not 0 < seconds < math.inf:
            raise InvalidInput(f"a submission cannot have {seconds:g} s: give a number of seconds above 0")
        self.seconds = seconds
        self.until = time.monotonic() + seconds * ON_THE_CLOCK
        self._began, self._spent = time.thread_time(), 0.0
        self._cut = False

    def spend(self, seconds: float) -> None:
        """Take away what a process of the submission has used."""
        self._spent += seconds

    @property
    def left(self) -> float:
        """How many seconds are left, at least 0."""
        return max(0.0, self.seconds - self._spent - (time.thread_time() - self._began))

    @property
    def share(self) -> float:
        """How many seconds the calls of one function may take together."""
        return self.seconds * SHARE

    def refuse_if_overdue(self) -> None:
        """Raise `MachineBusy` if the time on the clock is over, and something is still to be done."""
        if time.monotonic() >= self.until:
            self._cut = True
            raise MachineBusy

    def refuse_if_cut(self) -> None:
        """Raise `MachineBusy` if anything was left out because the time on the clock was over."""
        if self._cut:
            raise MachineBusy

    def __str__(self) -> str:
        return f"the {self.seconds:.3g} s that the whole file has"
