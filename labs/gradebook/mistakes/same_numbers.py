"""Whether two wrong functions make the same mistake: they return the same numbers on the probes.

Two numbers are the same within the tolerance by which the bank of known mistakes recognises one, which is what some
hundred roundings in single precision may add up to. Where one function gives no number, the other must fail alike: both
raise an error or give infinity or NaN, both return another shape, or both return something that is no number. A right
answer is like a right answer alone.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from labs.grading.diagnosis.deviations import TOLERANCE
from labs.grading.diagnosis.unnamed import WORDS, Value, is_enough, probe_keys
from reference.arrays import Array

SHARED = 3, 4
"""So many of the probes, three of four, must be the same if numbers of different years are compared."""
_UNKNOWN, _RIGHT, _NUMBER = -1, 0, 1


@dataclass(frozen=True)
class Numbers:
    """What a wrong function returned. values: how far each answer deviates, by the key of the probe."""

    function: str
    values: Mapping[str, Value]

    def text(self) -> str:
        """All numbers in one line, as a file keeps them."""
        return ", ".join(f"{key} {value}" for key, value in self.values.items())

    @classmethod
    def read(cls, function: str, text: str) -> Numbers:
        """The numbers of such a line.

        Raises
        ------
        ValueError
            If a part of it is no key with a number or a word, or the numbers are too few to recognise a mistake by.
        """
        values: dict[str, Value] = {}
        for part in text.split(","):
            key, _, said = part.strip().partition(" ")
            values[key] = _value(said, part.strip())
        if not is_enough(list(values.values())):
            raise ValueError("they are right or too few to recognise a mistake by")
        return cls(function, values)


def _value(said: str, part: str) -> Value:
    if said in WORDS:
        return said
    try:
        number = float(said)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{part!r} is no key with a number or one of {', '.join(WORDS)}")
    return number or 0


def numbers_in(function: Mapping[str, Any]) -> Numbers | None:
    """What a function of a grade returned; None if its mistake has a name, or the grade is from other probes."""
    found = function.get("unnamed")
    if found is None or len(keys := probe_keys(function["name"])) != len(found["numbers"]):
        return None
    return Numbers(function["name"], dict(zip(keys, found["numbers"], strict=True)))


class Shelf:
    """Numbers of one function side by side, in which the like of others are found."""

    def __init__(self, function: str, known: Sequence[Numbers] = ()) -> None:
        self._keys = probe_keys(function)
        self._kinds, self._totals = np.empty((0, len(self._keys)), int), np.empty((0, len(self._keys)))
        self._counts = np.empty(0, int)
        for each in known:
            self.add(each)

    def add(self, numbers: Numbers) -> None:
        """Put more numbers at the end."""
        kinds, totals = self._row(numbers)
        self._kinds, self._totals = np.vstack([self._kinds, kinds]), np.vstack([self._totals, totals])
        self._counts = np.append(self._counts, len(numbers.values))

    def nearest(self, numbers: Numbers) -> int | None:
        """The place of those that are the same, and of several the nearest; None if none are."""
        kinds, totals = self._row(numbers)
        both = (kinds != _UNKNOWN) & (self._kinds != _UNKNOWN)
        size = 1 + np.maximum(np.abs(totals), np.abs(self._totals))
        apart = np.where(both, np.abs(totals - self._totals) / size, 0.0)
        alike = np.all(~both | ((kinds == self._kinds) & (apart <= TOLERANCE)), axis=1)
        alike &= both.sum(axis=1) * SHARED[1] >= SHARED[0] * np.maximum(self._counts, len(numbers.values))
        found = [at for at in np.flatnonzero(alike) if self._is_enough(both[at], numbers)]
        return min(map(int, found), key=lambda at: float(apart[at].max(initial=0.0)), default=None)

    def is_of_today(self, place: int) -> bool:
        """Whether the lab still has enough of the probes from which those numbers are."""
        return bool((self._kinds[place] != _UNKNOWN).sum() * SHARED[1] >= SHARED[0] * self._counts[place])

    def _is_enough(self, both: Array, numbers: Numbers) -> bool:
        """Whether the probes that both have show a mistake."""
        return is_enough([numbers.values[key] for key, known in zip(self._keys, both, strict=True) if known])

    def _row(self, numbers: Numbers) -> tuple[Array, Array]:
        values = [numbers.values.get(key) for key in self._keys]
        return np.array([*map(_kind, values)]), np.array([0.0 if _is_word(value) else value for value in values], float)


def _is_word(value: Value | None) -> bool:
    return value is None or isinstance(value, str)


def _kind(value: Value | None) -> int:
    if value is None:
        return _UNKNOWN
    if isinstance(value, str):
        return _NUMBER + 1 + WORDS.index(value)
    return _NUMBER if value else _RIGHT
