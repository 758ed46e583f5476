"""How far a function's answer to a probe deviates from the right answer, as one number per probe.

The deviations of all numbers of an answer from the right ones, in units of the probe's scale, are weighted and added
up. Zero is right. Two functions whose sums agree at every probe compute the same formula, however each is written. The
sums do not reveal the formula.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from labs.grading.diagnosis.probes import Probe
from labs.grading.errors import GraderFailed
from reference.arrays import Array
from reference.errors import CollisionsError, NeedsFunction, one_line

Failure = Literal["", "error", "shape", "kind", "unwritten"]
TOLERANCE = 3e-5
"""In units of the scale: what some hundred roundings in single precision, 6e-8 each, may add up to."""
AGAINST_INFINITY, INFINITE, NO_NUMBER = 11.0, 17.0, 29.0
"""These stand in for a deviation if one of the two numbers is not finite. They differ from each other, and all are far
beyond the scale."""
_TOO_MANY, _MISSING = 5.0, 7.0
"""These are added to the numbers of a row that should not be there, or is missing, which may be zero."""
FARTHEST = 1e100
"""Larger deviations count as this one, so that their sums stay finite."""
_GOLDEN = (5**0.5 - 1) / 2
"""The weights step by it: no two of them are equal, so that swapped numbers have another sum."""


@dataclass(frozen=True)
class Answer:
    """What came back from one probe.

    value: what was returned. error: the exception that was raised instead, in words. unwritten: whether that exception
    says that the function is still the stub. changed: whether the call has changed its input. printed: what the call
    printed.
    """

    value: Any = None
    error: str = ""
    unwritten: bool = False
    changed: bool = False
    printed: str = ""


@dataclass(frozen=True)
class Right:
    """The right answer to a probe. outputs: one array for each thing returned. scales: the size of each one's numbers.

    The scale is the largest number of the output, or more where the numbers cancel: what an error in the input of some
    part of it does to the output, over that part. rows: the places of the outputs with a row for each thing that is
    found, such as a pair: the description does not say how many there are, so that another number of rows is a wrong
    answer in the right shape. thing: what has a row.
    """

    outputs: tuple[Array, ...]
    scales: tuple[float, ...]
    rows: tuple[int, ...] = ()
    thing: str = "row"


@dataclass(frozen=True)
class Deviation:
    """How far one answer is from the right one.

    total: the weighted sum of the deviations of all its numbers, zero if all are right. spread: the same sum of
    absolute values, which limits how well rounding lets the total be known. failure: why there is no number to compare.
    finite: whether no number is infinite or NaN that should be another.
    """

    total: float = 0.0
    spread: float = 0.0
    failure: Failure = ""
    finite: bool = True

    @property
    def right(self) -> bool:
        """Whether nothing deviates."""
        return not self.failure and self.spread == 0

    def agrees(self, known: Deviation) -> bool:
        """Whether it equals a known deviation, except for rounding."""
        if self.failure or known.failure:
            return self.failure == known.failure
        if self.right or known.right:
            return self.right and known.right
        return abs(self.total - known.total) <= TOLERANCE * (1 + max(self.spread, abs(known.total)))


def ask(call: Callable[..., Any], function: str, probes: Sequence[Probe]) -> list[Answer]:
    """Put all probes of a function to `call(name, *arguments)`, each with inputs of its own.

    A `call` that runs elsewhere cannot write to these inputs. It says in `call.changed` which arguments the function
    has written to, and in `call.printed` what it printed. It is told which calls come next, `call.foresee`, so that it
    can work ahead.
    """
    foresee = getattr(call, "foresee", None)
    given = [probe.arguments if foresee else copied(probe.arguments) for probe in probes]
    answers = []
    for at, probe in enumerate(probes):
        if foresee:
            foresee(function, given[at:])
        answers.append(_asked(call, function, given[at], probe))
    return answers


def _asked(call: Callable[..., Any], function: str, arguments: tuple[Any, ...], probe: Probe) -> Answer:
    try:
        value = call(function, *arguments)
    except GraderFailed:
        raise
    except Exception as error:
        unwritten = isinstance(error, NotImplementedError | NeedsFunction)
        return Answer(error=str(error) if isinstance(error, CollisionsError) else one_line(error), unwritten=unwritten)
    changed = bool(getattr(call, "changed", ())) or (
        arguments is not probe.arguments and not _same(arguments, probe.arguments)
    )
    return Answer(value, changed=changed, printed=getattr(call, "printed", ""))


def copied(value: Any) -> Any:
    """Arguments that a function may write to."""
    if isinstance(value, tuple):
        return tuple(copied(item) for item in value)
    return value.copy() if isinstance(value, np.ndarray) else value


def _same(left: Any, right: Any) -> bool:
    if isinstance(left, tuple):
        return all(map(_same, left, right))
    return np.array_equal(left, right, equal_nan=True) if isinstance(left, np.ndarray) else True


def outputs(value: Any, count: int) -> tuple[Array, ...] | None:
    """What was returned as `count` float arrays; None if it is not numbers, or not so many things."""
    if count > 1 and not isinstance(value, list | tuple | np.ndarray):
        return None
    try:
        if count > 1 and len(value) != count:  # asked first, as it may have millions of rows
            return None
        return tuple(_numbers(part) for part in ([value] if count == 1 else value))
    except (TypeError, ValueError):  # a ragged list, a 0-dimensional array for several things
        return None


def _numbers(value: Any) -> Array:
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"no numbers: {array.dtype}")
    with np.errstate(over="ignore"):  # of wider floats: what is beyond ours is infinite
        return array.astype(float)


def fitted(value: Any, right: Right, leading: tuple[int, ...]) -> Any:
    """An answer for several contacts with each output as short as the right one, if it repeats the same numbers.

    An output that does not depend on the first argument may be given for each of its contacts, or once for all.
    leading: the axes along which the contacts of the call lie.
    """
    found = outputs(value, len(right.outputs))
    if found is None or all(mine.shape == theirs.shape for mine, theirs in zip(found, right.outputs, strict=True)):
        return value
    short = tuple(_once(*pair, leading) for pair in zip(found, right.outputs, strict=True))
    return short if len(short) > 1 else short[0]


def spread(value: Any, right: Right) -> Any:
    """An answer for several contacts with each output repeated for all of them, where that gives the right shape.

    A function that ignores an argument gives no number of its own for each value of it.
    """
    found = outputs(value, len(right.outputs))
    if found is None:
        return value
    try:
        full = tuple(np.broadcast_to(*pair) for pair in zip(found, [each.shape for each in right.outputs], strict=True))
    except ValueError:
        return value
    return full if len(full) > 1 else full[0]


def _once(mine: Array, theirs: Array, leading: tuple[int, ...]) -> Array:
    sizes = (*(1,) * (mine.ndim - theirs.ndim), *theirs.shape)
    if mine.shape[: len(leading)] != leading or len(sizes) != mine.ndim:
        return mine
    first = mine[tuple(slice(size) for size in sizes)]
    repeats = first.shape == sizes and all(size in (1, whole) for size, whole in zip(sizes, mine.shape, strict=True))
    same = repeats and np.array_equal(np.broadcast_to(first, mine.shape), mine, equal_nan=True)
    return first.reshape(theirs.shape) if same else mine


def deviation_of(answer: Answer, right: Right) -> Deviation:
    """Compare an answer with the right one."""
    if answer.error:
        return Deviation(failure="unwritten" if answer.unwritten else "error")
    found = outputs(answer.value, len(right.outputs))
    if found is None:
        return Deviation(failure="kind")
    given = [answer.value] if len(found) == 1 else answer.value
    # A list without rows says nothing about how long they would be; an array does, and its user may ask for a column
    found = tuple(
        theirs if isinstance(own, list | tuple) and mine.shape == (0,) and not theirs.size else mine
        for own, mine, theirs in zip(given, found, right.outputs, strict=True)
    )
    if rows_too_many(found, right):
        return _other_rows(found, right)
    if any(mine.shape != theirs.shape for mine, theirs in zip(found, right.outputs, strict=True)):
        return Deviation(failure="shape")
    if all(_near(*entry) for entry in zip(found, right.outputs, right.scales, strict=True)):
        return Deviation()
    parts = [_deviations(*entry) for entry in zip(found, right.outputs, right.scales, strict=True)]
    off = np.concatenate([part.ravel() for part in parts])
    if not np.any(np.abs(off) > TOLERANCE):
        return Deviation()
    mine = np.concatenate([array.ravel() for array in found])
    return _summed(off, finite=not np.any(~np.isfinite(mine) & (off != 0)))


def _summed(off: Array, finite: bool = True) -> Deviation:
    weights = 0.5 + (np.arange(1, len(off) + 1) * _GOLDEN) % 1
    return Deviation(float(weights @ off), float(weights @ np.abs(off)), finite=finite)


def rows_too_many(found: Sequence[Array], right: Right) -> int:
    """How many rows an answer has too many, or fewer than none if some are missing, where this is all that differs.

    It is 0 if the shapes are the same, or differ in another way.
    """
    more = set()
    for place, (mine, theirs) in enumerate(zip(found, right.outputs, strict=True)):
        if place not in right.rows:
            if mine.shape != theirs.shape:
                return 0
        elif mine.ndim != theirs.ndim or mine.shape[1:] != theirs.shape[1:]:
            return 0
        else:
            more.add(len(mine) - len(theirs))
    return more.pop() if len(more) == 1 else 0


def _other_rows(found: Sequence[Array], right: Right) -> Deviation:
    """The deviation of an answer with too many rows, or too few.

    The rows that both have are compared in order; each of the others counts as it is, beside a stand-in.
    """
    parts = []
    for mine, theirs, scale in zip(found, right.outputs, right.scales, strict=True):
        both = min(len(mine), len(theirs)) if mine.ndim else None
        parts.append(_deviations(mine[:both], theirs[:both], scale) if mine.ndim else _deviations(mine, theirs, scale))
        if mine.ndim:
            parts.append(_TOO_MANY + _deviations(mine[both:], np.zeros_like(mine[both:]), scale))
            parts.append(-_MISSING - _deviations(theirs[both:], np.zeros_like(theirs[both:]), scale))
    off = np.concatenate([part.ravel() for part in parts])
    return _summed(off, finite=all(np.isfinite(array).all() for array in found))


def _near(mine: Array, theirs: Array, scale: float) -> bool:
    """Whether all are finite numbers, and no two differ by more than rounding: the usual case, told quickly."""
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.all(np.abs(mine - theirs) <= TOLERANCE * scale))


def _against_infinity(off: Array) -> Array:
    """Where something else than a number is right: never so near to zero that it would count as that."""
    shifted = off + AGAINST_INFINITY
    return np.where(np.abs(shifted) <= TOLERANCE, AGAINST_INFINITY, shifted)


def _deviations(mine: Array, theirs: Array, scale: float) -> Array:
    """In units of the scale; where one of the two is not finite, a stand-in."""
    known, finite = np.isfinite(theirs), np.isfinite(mine)
    both = known & finite
    with np.errstate(over="ignore"):
        off = (np.where(finite, mine, 0.0) - np.where(both, theirs, 0.0)) / scale
    off = np.clip(off, -FARTHEST, FARTHEST)
    off = np.where(finite & ~known, _against_infinity(off), off)
    off = np.where(np.isinf(mine), np.sign(np.where(finite, 0.0, mine)) * INFINITE, off)
    off = np.where(np.isnan(mine), NO_NUMBER, off)
    return np.where((mine == theirs) | (np.isnan(mine) & np.isnan(theirs)), 0.0, off)
