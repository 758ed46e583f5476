"""A submission's functions in the lab's scenarios: driver and trajectory stay here, the functions run in the worker.

A scenario needs functions of several topics. Those of the tested topic are the submission's; all others are correct
ones, so that an earlier mistake costs no points twice.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest

from labs.correct_functions import package_of_correct_functions
from labs.grading.calling.calls import Call
from labs.grading.calling.cases import OneCase
from labs.grading.errors import FunctionRaised, GraderFailed, WrongType
from labs.grading.phrases import gives_beside_physics
from reference import lecture
from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import find
from reference.comparison.compare import compare_case
from reference.comparison.results import Job
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.engines.implementation import Implementation
from reference.engines.profiles import EXACT, TUNED
from reference.errors import InvalidInput, NeedsFunction, RunFailed
from reference.recording.reading import recall

TIMESTEP = 0.02
"""s. The hand-written drivers solve for the instant of an impact: with long steps as well as with short ones."""
SINGLE = 1e-4
"""Share of a number that single precision may lose over all the calls of a run."""
SMALLEST = 1e-3
"""A number below this size, in its own unit, is compared as if it were so large."""
MOST_CALLS = 4000
"""Ten times as many as any of these runs needs; an impact that never ends would call for ever."""
MOST_NUMBERS, MOST_AXES = 64, 3
"""Limits of an array that a function returns in a run: a matrix for each of a few bodies."""
RIGHT = package_of_correct_functions() or "solutions"
"""The package with correct functions of the other topics. If a student's tree has none, these tests are skipped."""
WITHOUT_OTHERS = "whole scenarios are run with your functions when the lab is marked"
"""What a student reads who lacks other labs' functions."""


@dataclass(frozen=True)
class Mixed(Implementation):
    """A submission's functions of one topic, and correct ones of all others.

    one_case: says what a function takes for one case. The submission's functions are called for one at a time, as a
    driver's calls may have several bodies.
    """

    source: str = RIGHT
    call: Call | None = None
    topic: str = ""
    one_case: Callable[[str], OneCase | None] = lambda name: None
    calls: Iterator[int] = field(default_factory=itertools.count, repr=False, compare=False)

    def function(self, name: str) -> Callable[..., Any]:
        """Return the submission's function, or the correct one if it belongs to another topic."""
        found, calls = self._function(name), self.calls

        def called(*arguments: Any, **named: Any) -> Any:
            if next(calls) > MOST_CALLS:
                raise RunFailed("with these answers the run comes to no end")
            return found(*arguments, **named)

        return called

    def first_defined(self, names: Sequence[str]) -> str:
        """The first of these names that the submission defines, or else as any implementation says."""
        own = (name for name in names if lecture.function(name).topic == self.topic and self._defines(name))
        return next(own, None) or super().first_defined(names)

    def _defines(self, name: str) -> bool:
        return self.call is not None and bool(self.call.defines(name))

    def _function(self, name: str) -> Callable[..., Any]:
        entry, call = lecture.function(name), self.call
        written = entry.topic == self.topic and entry.role == "written"
        if call is None or not (written or (entry.topic == self.topic and call.defines(name))):
            return super().function(name)
        theirs = _one_at_a_time(call.implementation().function(name), self.one_case(name))
        return lambda *arguments, **named: _arrays(theirs(*arguments, **named))


def _one_at_a_time(function: Callable[..., Any], case: OneCase | None) -> Callable[..., Any]:
    """A function that is called once for each case; for all in one call if it gives no answer to a single one."""

    def called(*arguments: Any, **named: Any) -> Any:
        if case and not named and case.leading(arguments):
            with contextlib.suppress(FunctionRaised, WrongType, ValueError):
                return case.one_by_one(function, arguments)
        return function(*arguments, **named)

    return called


def _arrays(value: Any) -> Any:
    """An answer as arrays, which the drivers need; lists are accepted as well.

    It must not be larger than any that these runs need: a driver that adds a row to a column of thousands would fill
    the memory.
    """
    if isinstance(value, tuple):
        return tuple(map(_arrays, value))
    array = np.asarray(value)
    if array.size > MOST_NUMBERS or array.ndim > MOST_AXES:
        raise RunFailed(f"an answer has the shape {array.shape}, where there is one contact")
    return array


def with_solutions(submission: Any, topic: str) -> Implementation:
    """The submission's functions of a topic, with correct ones of other topics; skips the test if these are missing."""
    try:
        Implementation(RIGHT).function("ballistic_motion")
    except (NeedsFunction, InvalidInput):  # no such function, no such package
        pytest.skip(WITHOUT_OTHERS)
    return Mixed(call=submission.process(), topic=topic, one_case=submission.one_case)


def compared_with_theory(
    code: Implementation, family: str, cases: Collection[str], quantities: Collection[str]
) -> None:
    """Run cases of a family and raise an AssertionError unless the quantities agree with theory.

    The message has the measured number, that of theory, and those that were recorded in the engines.
    """
    found, _ = find(family)
    seen: set[str] = set()
    for name in cases:
        case = found.case(name)
        for row in _rows(code, found, replace(case, scenarios=case.scenarios[:1])):
            if row.quantity in quantities or not row.quantity:
                seen.add(row.quantity)
                assert _is_right(row), _told(found, row)
    if missing := sorted(set(quantities) - seen):
        raise GraderFailed(f"{family} has no {', '.join(missing)} to compare in {', '.join(cases)}")


def _rows(code: Implementation, family: Family, case: Case) -> list[Row]:
    engine = load_engine("handwritten", code)
    settings = engine.settings(case.scenarios[0], EXACT).change(timestep=TIMESTEP)
    return compare_case(family, case, engine, EXACT, settings)[0]


def _is_right(row: Row) -> bool:
    if row.verdict in (Verdict.PASS, Verdict.KNOWN_DEVIATION):
        return True
    if row.measured is None or row.expected is None:
        return False
    return abs(row.measured - row.expected) <= SINGLE * max(abs(row.expected), row.scale or 0.0, SMALLEST)


def _told(family: Family, row: Row) -> str:
    if not row.quantity:
        return f"{family.title}, {row.case}: {row.note}"
    quantity = family.quantity(row.quantity)
    physics = "says nothing" if row.expected is None else f"{row.expected:.6g} {row.unit}".rstrip()
    came = row.note if row.measured is None else f"{row.measured:.6g} {row.unit}".rstrip()
    lines = [f"{family.title}, {row.case}: {quantity.title}", gives_beside_physics(came, physics)]
    engines = [f"{title} {value:.6g}" for title, value in _engines(row)]
    return "\n".join([*lines, *([f"engines {', '.join(engines)} (recorded)"] if engines else [])])


def _engines(row: Row) -> list[tuple[str, float]]:
    found = []
    for name in engine_names():
        result = recall(Job(row.family, name, TUNED, (row.case,))) if name != "handwritten" else None
        for other in result.rows if result else ():
            if other.quantity == row.quantity and other.measured is not None:
                found.append((load_engine(name).title, other.measured))
    return found
