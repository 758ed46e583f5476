"""How much longer we wait for a submission: what is left of its budget, and how its functions have used it so far."""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass, field

from labs.grading.budget import Budget

_SHORTENED = 5.0  # each time that a function runs out of time, we wait so many times less long for its next call
_SHORTEST = 0.2  # s; a thousand times what a call takes


@dataclass
class Patience:
    """How much longer a submission is waited for.

    budget: what it has in all. timeouts: how often each function ran out of the time for a call. It is called again,
    because one slow call says little about the next, but we wait less long for it. spent: s that the calls of each
    function have taken together.
    """

    budget: Budget
    timeouts: Counter[str] = field(default_factory=Counter)
    spent: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))

    def for_call(self, name: str, whole: float) -> float:
        """How long to wait for a function's answer, of the whole time that a call has."""
        return max(whole / _SHORTENED ** self.timeouts[name], min(whole, _SHORTEST))

    def share_left(self, name: str) -> float:
        """How many seconds the calls of a function may still take, whatever is left of the budget."""
        return max(0.0, self.budget.share - self.spent[name])

    @property
    def slow(self) -> frozenset[str]:
        """The functions that ran out of time in a call, or have used up their share."""
        return frozenset(self.timeouts) | {name for name in self.spent if not self.share_left(name)}
