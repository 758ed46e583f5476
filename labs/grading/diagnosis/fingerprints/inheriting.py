"""Mistakes that come from another function: what is right itself goes wrong with a wrong one that it uses."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from labs.grading.diagnosis.bank import Misconception
from labs.grading.diagnosis.marks import Mark, Right
from labs.grading.diagnosis.probes import Probe

Function = Callable[..., Any]
Marked = Callable[[Function, str, Sequence[Probe], Sequence[Right | None]], list[Mark]]


@contextlib.contextmanager
def replaced(function: Function, other: Function) -> Iterator[None]:
    """Let every loaded module of a function's package find another one in its place."""
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
    own: Sequence[Sequence[Mark]],
    marked: Marked,
) -> list[tuple[list[str], list[Mark]]]:
    """Marks of a function with each known mistake of those that it uses; the same marks stand once, with all origins.

    What its own known mistakes give as well is left to them.
    """
    found: list[tuple[list[str], list[Mark]]] = []
    for other, bank in earlier.values():
        if other is right or not uses(right, other, cases):
            continue
        for entry in bank:
            with replaced(other, entry.formula):
                marks = marked(right, name, cases, answers)
            told = any(_same(marks, known) for known in own)
            if told or all(mark.right for mark in marks) or all(mark.failure for mark in marks):
                continue
            twin = next((ids for ids, known in found if _same(marks, known)), None)
            if twin is None:
                found.append(([entry.id], marks))
            else:
                twin.append(entry.id)
    return found


def _same(left: Sequence[Mark], right: Sequence[Mark]) -> bool:
    return all(a.agrees(b) for a, b in zip(left, right, strict=True))
