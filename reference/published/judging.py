"""Published figures against an implementation's answers: rows with a verdict, each with its reason."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from reference.catalogue.family import Expectation
from reference.comparison.verdicts import NOTHING_FINITE, Verdict, judge, verdict_of
from reference.engines.base import Engine
from reference.errors import CannotExpress, CollisionsError, NeedsFunction, NoWords, RunFailed, as_failed_run
from reference.published.answers import Answer, Answers
from reference.published.case import Figure, Published, numbers_of
from reference.published.drivers import answers_of
from reference.published.results import PublishedRow


def compare_published(case: Published, engine: Engine) -> tuple[tuple[PublishedRow, ...], Answers]:
    """Ask an engine and judge its answers; every error that it raises becomes a row, except `InvalidInput`."""
    try:
        with as_failed_run():
            answers = {name: _plain(given) for name, given in answers_of(case, engine).items()}
            return judged(case, engine.name, answers), answers
    except (NeedsFunction, CannotExpress, NoWords, RunFailed) as error:
        return (refusal(case, engine.name, error),), {}


def _plain(given: Answer) -> Answer:
    """The same, in floats and tuples of floats alone."""

    def plain(figure: Figure) -> Figure:
        return numbers_of(figure) if np.ndim(figure) else float(figure)  # type: ignore[arg-type]

    return replace(
        given,
        value=None if given.value is None else plain(given.value),
        tolerance=None if given.tolerance is None else plain(given.tolerance),
        shift=plain(given.shift),
        shift_tolerance=plain(given.shift_tolerance),
    )


def refusal(case: Published, engine: str, error: CollisionsError) -> PublishedRow:
    """The row that says why there is no number of a whole case."""
    return PublishedRow(case.name, engine, "", 0, verdict_of(error), note=str(error))


def judged(case: Published, engine: str, answers: Answers) -> tuple[PublishedRow, ...]:
    """One row a published number, in the order in which they were published."""
    missing = Answer(None, reason="it was not asked")
    return tuple(row for figure in case.expected for row in _rows(case, engine, figure, answers.get(figure, missing)))


def _rows(case: Published, engine: str, figure: str, given: Answer) -> list[PublishedRow]:
    several, expected = isinstance(case.expected[figure], tuple), numbers_of(case.expected[figure])
    blanks = [
        PublishedRow(case.name, engine, figure, place if several else 0, Verdict.CANNOT_EXPRESS, None, number)
        for place, number in enumerate(expected, 1)
    ]
    if given.value is None:
        return [replace(blank, note=given.reason) for blank in blanks]
    tolerance = case.tolerance[figure] if given.tolerance is None else given.tolerance
    columns = [numbers_of(given.value)] + [
        numbers_of(part) if isinstance(part, tuple) else (part,) * len(expected)
        for part in (tolerance, given.shift, given.shift_tolerance)
    ]
    return [_row(blank, case, given, *numbers) for blank, *numbers in zip(blanks, *columns, strict=True)]


def _row(
    blank: PublishedRow,
    case: Published,
    given: Answer,
    measured: float,
    tolerance: float,
    shift: float,
    shift_tolerance: float,
) -> PublishedRow:
    assert blank.expected is not None  # a published number
    reason = given.reason or case.reason
    expectation = Expectation(blank.expected, tolerance, reason, shift, given.shift_reason, shift_tolerance)
    verdict = judge(measured, expectation)
    note = given.shift_reason if verdict is Verdict.KNOWN_DEVIATION else ""
    row = replace(blank, verdict=verdict, tolerance=tolerance, reason=reason, shift=shift, note=note)
    return replace(row, measured=measured) if math.isfinite(measured) else replace(row, note=NOTHING_FINITE)


def passes(rows: Sequence[PublishedRow]) -> bool:
    """Whether every number of a case was found as published."""
    return bool(rows) and all(row.verdict is Verdict.PASS for row in rows)
