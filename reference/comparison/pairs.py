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
from reference.catalogue.scenarios import catalogue
from reference.comparison.verdicts import AS_IT_MUST, Row, Verdict

SHARE, LEAST = 1e-3, 1e-6
"""Two numbers are alike at least within this share of what theory says. Where theory has no figure, they are alike
within this share of the larger one, or within so much in their unit."""
NO_REASON = "It is not as its method must be, and the lab has no reason for that."
ROUNDING = 1e-12
"""What rounding alone may leave between two numbers, in their unit."""
Name = tuple[str, str]
"""An implementation: engine and profile."""


class Relation(StrEnum):
    """How two numbers of one case and quantity lie to each other.

    ALIKE: no farther apart than the number that theory binds more tightly may be from it. EXPLAINED: farther, but both
    are what theory and their methods say. APART: farther, and at least one of them is not what its method must give, or
    neither theory nor a prediction says what it must be; such a pair is marked, with the reason.
    """

    ALIKE = "alike"
    EXPLAINED = "explained"
    APART = "apart"


@dataclass(frozen=True)
class Reason:
    """Why a number is apart from others. whose: the implementation; None where theory is silent about all of them."""

    whose: Name | None
    said: str


@dataclass(frozen=True)
class Pair:
    """Two implementations in one case and quantity.

    difference: of the first less the second, in `unit`; None where one of them has no number. near: within which they
    are alike. why: for a pair that is apart, the reason for each of the two that nothing accounts for, with its name.
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
    why: tuple[Reason, ...] = ()


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
        """The pair that is farthest apart, among those with the worst relation, of the first quantity that has one."""
        relation = self.relation
        worst = [pair for pair in self.pairs if pair.relation is relation]
        return max((pair for pair in worst if pair.quantity == worst[0].quantity), key=_distance)

    @property
    def whys(self) -> tuple[Reason, ...]:
        """Why pairs are apart, each reason once."""
        return tuple(dict.fromkeys(why for pair in self.pairs for why in pair.why))


def pairs(rows: Iterable[Row]) -> Iterator[Pair]:
    """Every pair of implementations, in every case and quantity in which both were to give a number, but in no cost.

    The first of a pair is the one that the rows name first, in every case alike.
    """
    met: dict[tuple[str, str, str], dict[Name, Row]] = defaultdict(dict)
    places: dict[Name, int] = {}
    for row in rows:
        if _is_a_cost(row):
            continue
        if row.measured is not None or row.verdict in (Verdict.FAIL, Verdict.DISAGREES):
            name = row.engine, row.profile
            places.setdefault(name, len(places))
            met[row.family, row.case, row.quantity][name] = row
    for of_each in met.values():
        for one, other in itertools.combinations(sorted(of_each, key=places.__getitem__), 2):
            yield _pair(of_each[one], of_each[other])


def _is_a_cost(row: Row) -> bool:
    """Whether a number says what a run takes."""
    family = catalogue().get(row.family)
    return family is not None and any(each.cost for each in family.quantities if each.name == row.quantity)


def agreements(every: Iterable[Pair]) -> dict[str, dict[tuple[Name, Name], Agreement]]:
    """By family, the pairs of each two implementations, in the order in which they are given."""
    gathered: dict[str, dict[tuple[Name, Name], list[Pair]]] = defaultdict(lambda: defaultdict(list))
    for pair in every:
        gathered[pair.family][pair.first, pair.second].append(pair)
    return {
        family: {names: Agreement(tuple(found)) for names, found in both.items()} for family, both in gathered.items()
    }


def _distance(pair: Pair) -> float:
    return math.inf if pair.difference is None else abs(pair.difference)


def _pair(one: Row, other: Row) -> Pair:
    difference, near = None, _near(one, other)
    if one.measured is not None and other.measured is not None:
        subtracted = one.measured - other.measured
        difference = subtracted if math.isfinite(subtracted) else None
    if difference is not None and abs(difference) <= near:
        relation = Relation.ALIKE
    elif one.verdict in AS_IT_MUST and other.verdict in AS_IT_MUST:
        relation = Relation.EXPLAINED
    else:
        relation = Relation.APART
    first, second = (one.engine, one.profile), (other.engine, other.profile)
    why = _why((one, other)) if relation is Relation.APART else ()
    return Pair(one.family, one.case, one.quantity, one.unit, first, second, difference, near, relation, why)


def _near(one: Row, other: Row) -> float:
    """Within which two numbers are alike: the smaller of what they may be from theory, or a thousandth of its value."""
    if one.tolerance is not None and other.tolerance is not None:
        expected = max(abs(row.expected or 0.0) for row in (one, other))
        return max(min(one.tolerance, other.tolerance), SHARE * expected, ROUNDING)
    return max(LEAST, *(SHARE * abs(row.measured or 0.0) for row in (one, other)))


def _why(both: Sequence[Row]) -> tuple[Reason, ...]:
    """The reasons for those numbers that nothing accounts for: the engine's own, or why theory is silent about them."""
    found = []
    for row in both:
        if row.verdict in AS_IT_MUST:
            continue
        own = why_apart(row.family, row.engine, row.profile)
        if row.verdict is Verdict.SHOWN and (silent := why_apart(row.family)):
            found.append(Reason(None, silent))
        elif not own:
            own = row.note or NO_REASON
        if own:
            found.append(Reason((row.engine, row.profile), own))
    return tuple(dict.fromkeys(found))
