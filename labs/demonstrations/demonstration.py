"""What a demonstration is: a question for a lecture hall, a few runs that answer it, and what they teach."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

from labs.demonstrations.lesson import Line, Measured, Number, Predicted
from reference.errors import UnknownName

Profiles = Mapping[str, tuple[str, ...]]
"""Engine → its profiles."""


@dataclass(frozen=True)
class Demonstration:
    """One question, asked in one case of a family, or in several cases or timesteps side by side.

    name, title: in the command and as a heading. look: what the class should watch. lesson: what the runs teach.
    family, cases: which runs; each case under the label that it has here, the plotted one among them. profiles: those
    of each engine. timesteps: in s, by their labels, in place of each profile's own. quantity: what is compared with
    theory. heading: its name in the table. beside: further quantities whose values are shown, with their headings.
    percent: whether the quantity is a share that is shown in percent. words: what its values are called. predicted:
    what the method must give, as a function of the timestep in s.

    Raises
    ------
    UnknownName
        If the lesson asks for a number that none of these runs gives.
    """

    name: str
    title: str
    question: str
    look: str
    lesson: tuple[Line, ...]
    family: str
    cases: Mapping[str, str]
    profiles: Profiles
    quantity: str
    heading: str
    beside: Mapping[str, str] = field(default_factory=dict)
    timesteps: Mapping[str, float] = field(default_factory=dict)
    percent: bool = False
    words: Mapping[float, str] = field(default_factory=dict)
    predicted: Callable[[float], float] | None = None

    def __post_init__(self) -> None:
        for line in self.lesson:
            for number in line.numbers:
                self._check(number)

    @property
    def labels(self) -> tuple[str, ...]:
        """The rows of the table if they are cases or timesteps; empty if they are implementations."""
        several = self.timesteps or (self.cases if len(self.cases) > 1 else {})
        return tuple(several)

    def _check(self, number: Number) -> None:
        if isinstance(number, Measured):
            self._require("engine", number.engine, self.profiles)
            self._require(f"profile of {number.engine}", number.profile, self.profiles[number.engine])
        if isinstance(number, Predicted):
            self._require("timestep", number.at, self.timesteps)
        else:
            self._require("case or timestep", number.at, self.labels or ("",))

    def _require(self, kind: str, name: str, known: Collection[str]) -> None:
        if name not in known:
            raise UnknownName(f"{kind} in the lesson of {self.name!r}", name, known)
