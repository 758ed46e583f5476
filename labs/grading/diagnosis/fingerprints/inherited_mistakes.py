"""Mistakes that a function inherits: it is right itself, but goes wrong because a function that it uses is wrong."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from types import FunctionType
from typing import Any

from labs.grading.diagnosis.deviations import Deviation, Right
from labs.grading.diagnosis.misconceptions import Misconception
from labs.grading.diagnosis.probes import Probe

Function = Callable[..., Any]
Measure = Callable[[Function, str, Sequence[Probe], Sequence[Right | None]], list[Deviation]]


@contextlib.contextmanager
def replaced(others: Mapping[Function, Function]) -> Iterator[None]:
    """Put other functions in the place of some, in every loaded module of their packages."""
    packages = {function.__module__.partition(".")[0] for function in others}
    places = [
        (module, name, value)
        for key, module in list(sys.modules.items())
        if key.partition(".")[0] in packages
        for name, value in list(getattr(module, "__dict__", {}).items())
        if isinstance(value, FunctionType) and value in others
    ]
    try:
        for module, name, function in places:
            setattr(module, name, others[function])
        yield
    finally:
        for module, name, function in places:
            setattr(module, name, function)


def used(function: Function, others: Iterable[Function], cases: Sequence[Probe]) -> set[Function]:
    """Those of the other functions that a function calls on any good probe, directly or through others."""
    called = set[Function]()

    def noticed(other: Function) -> Function:
        def call(*arguments: Any, **named: Any) -> Any:
            called.add(other)
            return other(*arguments, **named)

        return call

    with replaced({other: noticed(other) for other in others}):
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
    called = used(right, [other for other, _ in earlier.values() if other is not right], cases)
    for other, bank in earlier.values():
        if other not in called:
            continue
        for entry in bank:
            with replaced({other: entry.formula}):
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
