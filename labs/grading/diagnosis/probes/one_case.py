"""What each function takes and gives for one case, read from its probes: axes of arguments, shapes of answers."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import Any

import numpy as np

from labs.grading.calling.cases import AsLongAs, Length, OneCase
from labs.grading.diagnosis.fingerprints.reading import known
from labs.grading.diagnosis.output_names import axes_before
from labs.grading.diagnosis.probes import probes
from reference.errors import UnknownName

SINGLE = ("usual", "edge")
"""The groups of probes with a single case."""


@functools.cache
def one_case(function: str) -> OneCase | None:
    """What a function takes and gives for one case; None for a function without probes, which is taken as it is."""
    try:
        answers, cases = known(function).right, probes(function)
    except UnknownName:
        return None
    rows = [(case.arguments, right) for case, right in zip(cases, answers, strict=True) if case.group in SINGLE]
    single = [arguments for arguments, _ in rows]
    longest = max(map(len, single))
    axes = tuple(_most([given[place] for given in single if place < len(given)]) for place in range(longest))
    given = [[np.shape(value) for value in OneCase(axes).leaves(arguments)] for arguments in single]
    outputs = zip(*(right.outputs for _, right in rows if right), strict=True)
    shapes = tuple(
        tuple(_length(lengths, given) for lengths in zip(*map(np.shape, of_one), strict=True)) for of_one in outputs
    )
    return OneCase(axes, len(shapes), axes_before(function), shapes)


def _length(lengths: Sequence[int], given: Sequence[Sequence[tuple[int, ...]]]) -> Length:
    """The length of an axis of an answer in all cases, or the first axis of an argument that is always as long.

    lengths: in each case. given: the shapes of the arguments of each case.
    """
    if len({*lengths}) == 1:
        return lengths[0]
    for place in range(min(map(len, given))):
        for axis in range(min(len(shapes[place]) for shapes in given)):
            if all(shapes[place][axis] == length for shapes, length in zip(given, lengths, strict=True)):
                return AsLongAs(place, axis)
    return None


def _most(values: list[Any]) -> Any:
    """The most axes of an argument: one mass may stand for those of a whole row of balls."""
    if isinstance(values[0], tuple):
        return tuple(_most([value[at] for value in values]) for at in range(len(values[0])))
    return max(np.ndim(value) for value in values)
