"""How much longer we wait for a submission: what is left of its budget, and how its functions have used it so far.

All seconds here are own time of the submission's processes (`own_time`).

One slow function makes all functions slow that call it. If each of these used a share of its own, nothing would be left
for the others. So functions that call a slow one share what one function may use, and each is told which one it is.
"""

from __future__ import annotations

import contextlib
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, field

from labs.grading.budget import Budget
from labs.grading.calling.processes import Limits
from labs.grading.errors import NotTried, OutOfTime

_SHORTENED = 5.0  # each time that a function runs out of time, we wait so many times less long for its next call
_SHORTEST = 0.2  # s; a thousand times what a call takes
_NOTHING = 0.01  # s that we may compute ourselves while a call runs
_SLOW = 1 / 400  # of a share; a function is called a few dozen times, and those that call it do so several times each


def _nothing(_name: str) -> Collection[str]:
    return ()


@dataclass
class Patience:
    """How much longer a submission is waited for.

    budget: what it has in all. uses: which functions of the submission one of them calls itself. timeouts: how often
    each function ran out of the time for a call. It is called again, because one slow call says little about the next,
    but we wait less long for it. spent: s that the calls of each function have taken together. calls: how many.
    lines: s that statements have taken on loading in all processes together, by their line.
    """

    budget: Budget
    uses: Callable[[str], Collection[str]] = _nothing
    timeouts: Counter[str] = field(default_factory=Counter)
    spent: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))
    calls: Counter[str] = field(default_factory=Counter)
    lines: defaultdict[int, float] = field(default_factory=lambda: defaultdict(float))
    _beneath: dict[str, frozenset[str]] = field(default_factory=dict)

    def for_call(self, name: str, whole: float) -> float:
        """How long to wait for a function's answer, of the whole time that a call has."""
        timeouts = max(self.timeouts[each] for each in (name, *self._behind(name)))
        return max(whole / _SHORTENED**timeouts, min(whole, _SHORTEST))

    def share_left(self, name: str) -> float:
        """How many seconds the calls of a function may still take, whatever is left of the budget."""
        most = max([self.spent[name], *map(self._spent_on, self._behind(name))])
        return max(0.0, self.budget.share - most)

    def ran_out(self, name: str, allowed: float, for_call: float, limits: Limits) -> OutOfTime:
        """Why a call was stopped. One that had the full time of a call counts as slow.

        allowed: s that it had. for_call: s for any call of this function now.
        """
        if allowed < for_call:
            return self.used_up(name, limits.test, allowed)
        before = self.timeouts[name]
        self.timeouts[name] += 1
        less = allowed != limits.call
        why = f" ({(not before and self._too_slow(name)) or 'it ran out of time before'})" if less else ""
        return OutOfTime(f"{name} gave no answer within {allowed:.3g} s{why} and was stopped")

    def used_up(self, name: str, test: float, allowed: float = 0.0) -> OutOfTime:
        """Which time is used up: before a call, or during one that was allowed so many s. test: s that a test has.

        The words are the same in both cases. A few milliseconds decide between them, and the same file has the same
        grade byte for byte.
        """
        if self.budget.left <= allowed + _NOTHING:
            return NotTried(f"it was not tried to the end: {self.budget} are used up")
        if self.share_left(name) <= allowed:
            if why := self._too_slow(name):
                return OutOfTime(f"{name} gave no answer: {why}")
            return OutOfTime(
                f"{name} gave no answer: it has taken {self.budget.share:.3g} s in all, which is its share of"
                f" {self.budget}"
            )
        return OutOfTime(f"{name} gave no answer: the {test:.3g} s of this test are used up")

    def forget(self, name: str) -> None:
        """Wait as long as at first for what has run out of time before, because it is not the same any more."""
        self.timeouts.pop(name, None)
        self.spent.pop(name, None)

    @contextlib.contextmanager
    def counted_for(self, line: int | None, name: str) -> Iterator[None]:
        """Count what is spent on a name for a line as well."""
        before = self.spent[name]
        try:
            yield
        finally:
            if line:
                self.lines[line] += self.spent[name] - before

    def slowest_line(self) -> int | None:
        """The line of the statement that has taken longest on loading, which is forgotten; None if none is known."""
        line = max(self.lines, key=self.lines.__getitem__, default=None)
        if line is not None:
            del self.lines[line]
        return line

    @property
    def slow(self) -> frozenset[str]:
        """The functions that ran out of time in a call, or have used up their share, and slow ones that call these."""
        spent = {name for name in (*self.spent,) if not self.share_left(name)} | {*self.timeouts}
        return frozenset(
            spent | {name for name in self.calls if any(self.timeouts[each] for each in self._behind(name))}
        )

    def _too_slow(self, name: str) -> str:
        """Which function has taken the time of one that calls it; nothing if it has its time to itself."""
        slow = max(self._behind(name), key=self._spent_on, default=None)
        return f"it calls your {slow}, which is too slow" if slow else ""

    def _behind(self, name: str) -> list[str]:
        """The slow functions that a function calls, directly or through others, unless it is known to be fast."""
        if self.calls[name] and not self._is_slow(name):
            return []
        return [each for each in (*self.calls,) if self._is_slow(each) and each in self._called_by(name)]

    def _is_slow(self, name: str) -> bool:
        return self.spent[name] > self.calls[name] * _SLOW * self.budget.share

    def _spent_on(self, slow: str) -> float:
        """How many seconds a slow function and those that call it have taken together."""
        return self.spent[slow] + sum(self.spent[each] for each in (*self.spent,) if slow in self._called_by(each))

    def _called_by(self, name: str) -> frozenset[str]:
        """The other functions that a function calls, directly or through others."""
        if name not in self._beneath:
            found, waiting = {name}, [name]
            while waiting:
                new = {*self.uses(waiting.pop())} - found
                found |= new
                waiting += new
            self._beneath[name] = frozenset(found - {name})
        return self._beneath[name]
