"""The mark of one notebook in one lab: what can be counted, and what a person marks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from labs.assessment.shares import CODE, INPUTS, PREDICTIONS, QUESTIONS, SHARES
from reference.errors import InvalidInput


@dataclass(frozen=True)
class Count:
    """So many of so many; reached is None where a person has yet to mark."""

    reached: float | None
    possible: float


@dataclass(frozen=True)
class Marks:
    """What a notebook reached in each kind of work."""

    counts: Mapping[str, Count]

    def points(self, kind: str) -> float | None:
        """Points of a hundred that a kind of work gives; None where a person has yet to mark.

        A kind that a lab has nothing of gives its points to everybody.
        """
        count = self.counts[kind]
        if count.reached is None:
            return None
        return SHARES[kind] * (count.reached / count.possible if count.possible else 1.0)

    @property
    def total(self) -> float:
        """Points of a hundred so far."""
        return sum(self.points(kind) or 0.0 for kind in self.counts)

    @property
    def open(self) -> float:
        """Points of a hundred that a person has yet to give."""
        return sum(SHARES[kind] for kind in self.counts if self.points(kind) is None)


def marks(
    code: tuple[float, float],
    inputs: Mapping[str, bool],
    predictions: tuple[int, int],
    questions: tuple[float | None, float],
) -> Marks:
    """The marks from what was counted: points of the tests, inputs found, predictions made, points of questions.

    Raises
    ------
    InvalidInput
        If more points are given for the questions than they have, or fewer than none.
    """
    given, possible = questions
    if given is not None and not 0 <= given <= possible:
        raise InvalidInput(f"the questions have {possible:g} points, so {given:g} cannot be given for them")
    return Marks(
        {
            CODE: Count(*code),
            QUESTIONS: Count(given, possible),
            INPUTS: Count(sum(inputs.values()), len(inputs)),
            PREDICTIONS: Count(*predictions),
        }
    )
