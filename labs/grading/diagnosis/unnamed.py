"""What a function with a mistake that the lab does not know returned, in a form in which a class can be compared.

Only the probes with a single case count. Code that is written for one case gives no numbers for several in one call,
or other ones, and its mistake is the same. The numbers are deviations from the right answers, as in the files of
fingerprints: they contain neither the inputs nor the expected values.
"""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from labs.grading.diagnosis.deviations import Answer, Deviation, Right
from labs.grading.diagnosis.findings import LEAST, Counterexample, Unnamed
from labs.grading.diagnosis.fingerprints.reading import Known, known
from labs.grading.diagnosis.probes import Probe, probes

Word = Literal["none", "shape", "kind"]
Value = float | Word
"""How far an answer deviates, 0 if it is right; or why there is no number. `none`: an error was raised, or some number
is infinite or NaN. Plain Python raises an error where NumPy gives infinity, and the mistake is the same."""
WORDS: tuple[Word, ...] = ("none", "shape", "kind")
DECIMALS, DIGITS = 7, 7
"""Numbers are kept to so many decimals, and so many significant digits: far closer than the tolerance by which they are
compared, and far coarser than the last digits, in which two machines differ."""
SINGLE = ("usual", "edge")
_KEY = 6


def unnamed(
    knowledge_of: str,
    answered: Sequence[tuple[Probe, Right, Answer]],
    deviations: Sequence[Deviation],
    parameters: tuple[str, ...],
) -> Unnamed | None:
    """What a function returned whose mistake has no name; None if that is too little to recognise a mistake by."""
    rows = [(each, value_of(own)) for each, own in zip(answered, deviations, strict=True) if each[0].group in SINGLE]
    numbers = tuple(value for _, value in rows)
    if not is_enough(numbers):
        return None
    wrong = [at for at, value in enumerate(numbers) if value and not isinstance(value, str)]
    place = min(wrong, key=lambda at: not rows[at][0][0].note)
    probe, right, answer = rows[place][0]
    return Unnamed(numbers, place, Counterexample(knowledge_of, probe, parameters, answer, right))


def value_of(deviation: Deviation) -> Value:
    """A deviation as it is kept."""
    if deviation.failure in ("shape", "kind"):
        return deviation.failure
    if deviation.failure or not deviation.finite:
        return "none"
    return float(f"{round(deviation.total, DECIMALS):.{DIGITS}g}") or 0


def is_enough(numbers: Sequence[Value]) -> bool:
    """Whether a mistake can be recognised by these: the rule by which known mistakes are recognised.

    One wrong number will do if there is a number everywhere, since all the others are right or wrong in their own way.
    If some cases give no number, it takes as many wrong numbers as a known mistake needs then.
    """
    wrong = sum(bool(value) and not isinstance(value, str) for value in numbers)
    return wrong >= (LEAST if any(isinstance(value, str) for value in numbers) else 1)


@functools.cache
def single_cases(function: str) -> tuple[tuple[Probe, Right], ...]:
    """The probes of a function with a single case, with their right answers, in the order of `Unnamed.numbers`."""
    rows = zip(probes(function), known(function).right, strict=True)
    return tuple((probe, right) for probe, right in rows if right and probe.group in SINGLE)


def known_numbers(function: str, mistake: Known) -> tuple[Value, ...]:
    """What a known mistake of a function gives on these probes."""
    groups = [probe.group for probe, right in zip(probes(function), known(function).right, strict=True) if right]
    pairs = zip(groups, mistake.deviations, strict=True)
    return tuple(value_of(deviation) for group, deviation in pairs if group in SINGLE)


@functools.cache
def probe_keys(function: str) -> tuple[str, ...]:
    """A short name for each of these probes, made of its input and its right answer.

    It stays the same when other probes come and go. What was kept in another year is compared by it.
    """
    keys = []
    for probe, right in single_cases(function):
        text = json.dumps([_plain(probe.arguments), [_plain(array) for array in right.outputs], right.scales])
        keys.append(hashlib.sha256(text.encode()).hexdigest()[:_KEY])
    return tuple(keys)


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    array = np.asarray(value, dtype=float)
    return [list(array.shape), [f"{number + 0.0:.9g}" for number in array.ravel()]]
