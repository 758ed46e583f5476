"""Mistakes that a function inherits: it is right itself, but goes wrong because a function that it uses is wrong."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from labs.grading.diagnosis.deviations import Deviation, Right
from labs.grading.diagnosis.misconceptions import Misconception
from labs.grading.diagnosis.probes import Probe

Function = Callable[..., Any]
Measure = Callable[[Function, str, Sequence[Probe], Sequence[Right | None]], list[Deviation]]


@contextlib.contextmanager
def replaced(function: Function, other: Function) -> Iterator[None]:
    """Put another function in its place, in every loaded module of its package."""
    package = function.__module__.partition(".")[0]
    places = [
        (module, name)
        for key, module in list(sys.modules.items())
        if key.partition(".")[0] == package
        for name, value in list(getattr(module, "__dict__", {}).items())
        if value is function
    ]
    try:
        for module, name in places:
            setattr(module, name, other)
        yield
    finally:
        for module, name in places:
            setattr(module, name, function)


def uses(function: Function, other: Function, cases: Sequence[Probe]) -> bool:
    """Whether a function calls another one on any good probe."""
    called = False

    def noticed(*arguments: Any, **named: Any) -> Any:
        nonlocal called
        called = True
        return other(*arguments, **named)

    with replaced(other, noticed):
        for probe in cases:
            if probe.group == "usual":
                function(*probe.arguments)
    return called


def inherited(
    name: str,
    right: Function,
    earlier: Mapping[str, tuple[Function, Sequence[Misconception]]],
    cases: Sequence[Probe],
    answers: Sequence[Right | None],
    own: Sequence[Sequence[Deviation]],
    measure: Measure,
) -> list[tuple[list[str], list[Deviation]]]:
    """Deviations of a function with each known mistake of the functions that it uses.

    Equal deviations are listed once, with all their origins. Those that a known mistake of its own gives as well are
    left to that mistake.
    """
    found: list[tuple[list[str], list[Deviation]]] = []
    for other, bank in earlier.values():
        if other is right or not uses(right, other, cases):
            continue
        for entry in bank:
            with replaced(other, entry.formula):
                deviations = measure(right, name, cases, answers)
            told = any(_same(deviations, known) for known in own)
            if told or all(each.right for each in deviations) or all(each.failure for each in deviations):
                continue
            twin = next((ids for ids, known in found if _same(deviations, known)), None)
            if twin is None:
                found.append(([entry.id], deviations))
            else:
                twin.append(entry.id)
    return found


def _same(left: Sequence[Deviation], right: Sequence[Deviation]) -> bool:
    return all(a.agrees(b) for a, b in zip(left, right, strict=True))
