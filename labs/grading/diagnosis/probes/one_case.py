"""What each function takes for one case, read from its probes: how many axes each argument has."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from labs.grading.calling.cases import OneCase
from labs.grading.diagnosis.fingerprints.reading import known
from labs.grading.diagnosis.output_names import axes_before
from labs.grading.diagnosis.probes import probes
from reference.errors import UnknownName


@functools.cache
def one_case(function: str) -> OneCase | None:
    """What a function takes and gives for one case; None for a function without probes, which is taken as it is."""
    try:
        answers, cases = known(function).right, probes(function)
    except UnknownName:
        return None
    single = [probe.arguments for probe in cases if probe.group in ("usual", "edge")]
    longest = max(map(len, single))
    axes = tuple(_most([given[place] for given in single if place < len(given)]) for place in range(longest))
    return OneCase(axes, next(len(right.outputs) for right in answers if right), axes_before(function))


def _most(values: list[Any]) -> Any:
    """The most axes of an argument: one mass may stand for those of a whole row of balls."""
    if isinstance(values[0], tuple):
        return tuple(_most([value[at] for value in values]) for at in range(len(values[0])))
    return max(np.ndim(value) for value in values)
