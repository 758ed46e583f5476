"""Each implementation against each: whether two of them measured the same, and if not, whether that is explained.

Theory is no party here. Two numbers of one case and quantity are compared with each other, and that also where theory
has no figure, or where both are away from it.
"""

from __future__ import annotations

import itertools
import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

from reference.catalogue.apart import why_apart
from reference.comparison.verdicts import Row, Verdict

SHARE, LEAST = 1e-3, 1e-6
"""Where theory has no figure, two numbers are alike within this share of the larger, or so much in their unit."""
ROUNDING = 1e-12
"""What rounding alone may leave between two numbers, in their unit."""
EXPLAINED = (Verdict.PASS, Verdict.KNOWN_DEVIATION, Verdict.DISAGREES)
"""Verdicts of numbers that theory and the method account for: whatever is between two such numbers is accounted for."""
Name = tuple[str, str]
"""An implementation: engine and profile."""


class Relation(StrEnum):
    """How two numbers of one case and quantity lie to each other.

    ALIKE: no farther apart than both may be from theory. EXPLAINED: farther, but both are what theory and their methods
    say. APART: farther, and at least one of them is not what its method must give, or neither theory nor a prediction
    says what it must be; such a pair is marked, with the reason.
    """

    ALIKE = "alike"
    EXPLAINED = "explained"
    APART = "apart"


@dataclass(frozen=True)
class Pair:
    """Two implementations in one case and quantity.

    difference: of the first less the second, in `unit`; None where one of them has no number. near: within which they
    are alike. why: for a pair that is apart, the reason for each of the two that nothing accounts for.
    """

    family: str
    case: str
    quantity: str
    unit: str
    first: Name
    second: Name
    difference: float | None
    near: float
    relation: Relation
    why: tuple[str, ...] = ()


@dataclass(frozen=True)
class Agreement:
    """All pairs of two implementations in one family."""

    pairs: tuple[Pair, ...]

    def count(self, relation: Relation) -> int:
        """How many of the pairs have this relation."""
        return sum(pair.relation is relation for pair in self.pairs)

    @property
    def relation(self) -> Relation:
        """The worst relation of any pair."""
        return max((pair.relation for pair in self.pairs), key=list(Relation).index)

    @property
    def worst(self) -> Pair:
        """The pair that is farthest apart in its measure, among those with the worst relation."""
        return max((pair for pair in self.pairs if pair.relation is self.relation), key=_distance)

    @property
    def whys(self) -> tuple[str, ...]:
        """Why pairs are apart, each reason once."""
        return tuple(dict.fromkeys(why for pair in self.pairs for why in pair.why))


def pairs(rows: Iterable[Row]) -> Iterator[Pair]:
    """Every pair of implementations, in every case and quantity in which both were to give a number."""
    met: dict[tuple[str, str, str], list[Row]] = defaultdict(list)
    for row in rows:
        if row.measured is not None or row.verdict is Verdict.FAIL:
            met[row.family, row.case, row.quantity].append(row)
    for alike in met.values():
        for one, other in itertools.combinations(alike, 2):
            yield _pair(one, other)


def agreements(rows: Iterable[Row]) -> dict[str, dict[tuple[Name, Name], Agreement]]:
    """By family, the pairs of each two implementations, in the order in which the rows name them."""
    gathered: dict[str, dict[tuple[Name, Name], list[Pair]]] = defaultdict(lambda: defaultdict(list))
    for pair in pairs(rows):
        gathered[pair.family][pair.first, pair.second].append(pair)
    return {
        family: {names: Agreement(tuple(found)) for names, found in both.items()} for family, both in gathered.items()
    }


def _distance(pair: Pair) -> float:
    return math.inf if pair.difference is None else abs(pair.difference) / pair.near


def _pair(one: Row, other: Row) -> Pair:
    difference, near = None, _near(one, other)
    if one.measured is not None and other.measured is not None:
        difference = one.measured - other.measured
    if difference is not None and abs(difference) <= near:
        relation = Relation.ALIKE
    elif one.verdict in EXPLAINED and other.verdict in EXPLAINED:
        relation = Relation.EXPLAINED
    else:
        relation = Relation.APART
    first, second = (one.engine, one.profile), (other.engine, other.profile)
    why = _why((one, other)) if relation is Relation.APART else ()
    return Pair(one.family, one.case, one.quantity, one.unit, first, second, difference, near, relation, why)


def _near(one: Row, other: Row) -> float:
    """Within which two numbers are alike: what both may be from theory, or a thousandth where theory has no figure."""
    if one.tolerance is not None and other.tolerance is not None:
        return max(one.tolerance + other.tolerance, ROUNDING)
    return max(LEAST, *(SHARE * abs(row.measured or 0.0) for row in (one, other)))


def _why(both: Sequence[Row]) -> tuple[str, ...]:
    """The reasons of those numbers that nothing accounts for: the engine's own, or why theory is silent about them."""
    found = []
    for row in both:
        if row.verdict not in EXPLAINED:
            silent = why_apart(row.family) if row.verdict is Verdict.SHOWN else ""
            found += [silent, why_apart(row.family, row.engine, row.profile)]
    return tuple(dict.fromkeys(filter(None, found)))
