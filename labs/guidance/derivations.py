"""One missing line of a derivation: whether a student's line is right in whatever form, and where it is not.

A line is compared with the right one by numbers: at round values, and at random ones that are the same every time.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from labs.grading.diagnosis.words import listed
from labs.guidance.expressions import Expression, Values, expression
from reference.errors import InvalidInput

POINTS = 40
"""Random values at which a line is tried."""
TOLERANCE = 1e-9
"""Relative to the right value, or to its typical size if that is larger. Two forms of one formula differ by rounding
alone, some 1e-16 times the digits that cancel; a term that is missing changes a value by far more than this."""
_SAME = 1e-6
"""Ratios that differ by less than this share are one constant factor."""
_SEED = 20
_MOST_ROUND = 4096
"""The most combinations of round values that are tried."""
_SIMPLE = (1.0, 2.0, 0.5, 3.0, 4.0, 5.0, 10.0, 0.2, 0.25, 0.1, 6.0, 8.0, 0.0)
"""Round numbers, the simplest first; a quantity has them times a power of ten."""


@dataclass(frozen=True)
class Quantity:
    """A quantity of a line. meaning: what it is, with its unit. low, high: the values at which lines are tried.

    follows: its value from quantities that come before it, if it is not free; a range has no meaning then.
    """

    name: str
    meaning: str
    low: float = 0.0
    high: float = 0.0
    follows: Expression | None = None


@dataclass(frozen=True)
class Derivation:
    """A line to be found. left: what it gives, a name. right: the expression. asked: what that is, with its unit."""

    left: str
    right: Expression
    quantities: tuple[Quantity, ...]
    asked: str = ""

    @property
    def names(self) -> list[str]:
        """The names that a line may use."""
        return [each.name for each in self.quantities]

    @property
    def free(self) -> list[Quantity]:
        """The quantities that do not follow from others."""
        return [each for each in self.quantities if each.follows is None]

    def read(self, line: str) -> Expression:
        """A student's line, with or without its left side; raises `InvalidInput` if it cannot be understood."""
        left, equals, right = line.partition("=")
        return expression(right if equals and left.strip() == self.left else line, self.names)

    def difference(self, line: Expression) -> str:
        """Where a line differs from the right one, in words; empty if it is right.

        The right value at one point is told, the right expression never.
        """
        tried = {name: np.append(self.round[name], self.random[name]) for name in self.names}
        needed, given = self.right.at(tried), line.at(tried)
        scale = np.maximum(np.abs(needed), np.nanmean(np.abs(np.where(np.isfinite(needed), needed, np.nan))))
        with np.errstate(invalid="ignore"):
            wrong = np.isfinite(needed) & ~(np.abs(given - needed) <= TOLERANCE * scale)
        if not wrong.any():
            return ""
        first = int(np.argmax(wrong))  # round values come first, the roundest of them first of all
        where = listed([f"{name} = {_digits(tried[name][first])}" for name in self.names])
        value = _digits(given[first]) if np.isfinite(given[first]) else "no number"
        said = f"At {where} your line gives {value}; the equation holds for {_digits(needed[first])}."
        return " ".join([said, _slip(given, needed)]).strip()

    @cached_property
    def random(self) -> dict[str, Values]:
        """The random values of each quantity, the same every time."""
        draw = np.random.default_rng(_SEED)
        return self.complete({each.name: draw.uniform(each.low, each.high, POINTS) for each in self.free})

    def complete(self, values: dict[str, Values]) -> dict[str, Values]:
        """Values of the free quantities, and with them those of all others."""
        found = dict(values)
        for each in self.quantities:
            if each.follows is not None:
                found[each.name] = each.follows.at(found)
        return found

    @cached_property
    def round(self) -> dict[str, Values]:
        """The round values of each quantity in all combinations, the simplest first."""
        most = max(2, int(_MOST_ROUND ** (1 / len(self.free))))
        each = [list(enumerate(_round_values(quantity)[:most])) for quantity in self.free]
        every = sorted(itertools.product(*each), key=_complexity)
        columns = zip(*([value for _, value in point] for point in every), strict=True)
        return self.complete(
            {quantity.name: np.array(column) for quantity, column in zip(self.free, columns, strict=True)}
        )


def _round_values(quantity: Quantity) -> list[float]:
    """Round numbers in the range of a quantity, the simplest first; its ends and its middle if there are none."""
    low, high = quantity.low, quantity.high
    unit = 10.0 ** math.floor(math.log10(max(abs(low), abs(high))))
    signs = (1, -1) if high >= -low else (-1, 1)  # that of the longer side of the range first
    found = [float(f"{sign * each * unit:.6g}") for each in _SIMPLE for sign in signs]
    inside = [value for value in dict.fromkeys(found) if low <= value <= high]
    return inside or [low, (low + high) / 2, high]


def _complexity(point: Sequence[tuple[int, float]]) -> tuple[int, list[int]]:
    """How far a combination is from the simplest: equal sizes tell less, since factors change places unseen."""
    sizes = [abs(value) for _, value in point]
    places = [place for place, _ in point]
    return sum(places) + 2 * (len(sizes) - len(set(sizes))), places


def _slip(given: Values, needed: Values) -> str:
    """A common slip in words: a sign or a factor, if the line is off by the same one everywhere."""
    there, zero = np.isfinite(needed) & (needed != 0), needed == 0
    if not there.any() or not np.isfinite(given[there]).all() or (given[zero] != 0).any():
        return ""
    ratios = given[there] / needed[there]
    ratio = float(ratios[0])
    if ratio == 0 or np.ptp(ratios) > _SAME * abs(ratio):
        return ""
    if abs(ratio + 1) < _SAME:
        return "Yours is −1 times what is needed, whatever the numbers: look for a sign."
    return f"Yours is {_digits(ratio)} times what is needed, whatever the numbers: look for a factor."


def _digits(value: float) -> str:
    return f"{value + 0.0:.4g}".replace("-", "−")


def check_range(derivation: Derivation) -> None:
    """Raise if the right side has no value somewhere in the ranges of its quantities."""
    values = derivation.right.at(derivation.random)
    if not np.all(np.isfinite(values)):
        raise InvalidInput(f"{derivation.left} = {derivation.right.text} has no value somewhere in the ranges given")
