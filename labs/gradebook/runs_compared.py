"""Students' runs beside theory and the engines: a table and a replay for each student, a distribution for the class.

The engines' numbers come from recordings, so that the pages are the same on every machine.
"""

from __future__ import annotations

import contextlib
import statistics
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from labs.gradebook.own_words import in_our_words
from labs.gradebook.runs_figure import figure
from labs.gradebook.scenario_runs import HANDWRITTEN, RUNS, Asked, result
from reference.catalogue.family import Quantity
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row
from reference.engines import engine_names, load_engine
from reference.engines.profiles import TUNED
from reference.errors import CollisionsError
from reference.recording.reading import recall
from reference.report import numbers
from reference.report.marks import AGREES
from reference.report.replays import case_clip
from reference.report.sections import sections
from reference.viewer import page

NO_NUMBER = "none"


@dataclass(frozen=True)
class Compared:
    """One run of one student. rows: quantity, the student's number, theory's and each engine's, in words.

    agrees: whether every number shown is as it must be. why: why there is no number. replay: a frame, as markup.
    recorded: where and when the engines were recorded.
    """

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    agrees: bool
    why: str
    replay: str
    recorded: tuple[str, ...]


@dataclass(frozen=True)
class Spread:
    """What a class measured in one run. right: students whose number is as it must be. measured: who have a number.

    without: why others have none, in our own words, and how many. picture: an SVG element. in_words: the same for those
    who do not see it.
    """

    title: str
    right: int
    measured: int
    median: str
    theory: str
    without: tuple[tuple[str, int], ...]
    picture: str
    in_words: str


def compared(kept: Iterable[Mapping[str, Any]], lab: str) -> list[Compared]:
    """A student's runs, as a page shows them; those of cases that no longer exist are left out."""
    found = _read(kept)
    return [_compared(asked, found[asked.name]) for asked in RUNS.get(lab, ()) if asked.name in found]


def spreads(every: Iterable[Iterable[Mapping[str, Any]]], lab: str) -> list[Spread]:
    """The distributions of a class: one for each run of the lab, of the quantity that is shown first."""
    classes = [_read(kept) for kept in every]
    found = []
    for asked in RUNS.get(lab, ()):
        results = [each[asked.name] for each in classes if asked.name in each]
        if results:
            found.append(_spread(asked, results))
    return found


def _read(kept: Iterable[Mapping[str, Any]]) -> dict[str, JobResult]:
    found = {}
    for each in kept:
        with contextlib.suppress(CollisionsError, LookupError, TypeError, ValueError):  # of another release
            found[str(each["case"])] = result(each)
    return found


@cache
def _engines(asked: Asked) -> tuple[JobResult, ...]:
    """What was recorded of a case in each engine that has it."""
    family, case = asked.place
    found = []
    for name in engine_names():
        if name != HANDWRITTEN:
            recorded = recall(Job(family.name, name, TUNED, (case.name,), with_poses=True))
            if recorded is not None and any(row.measured is not None for row in recorded.rows):
                found.append(recorded)
    return tuple(found)


def _compared(asked: Asked, own: JobResult) -> Compared:
    family, case = asked.place
    engines = _engines(asked)
    rows, agrees = [], True
    for name in asked.quantities:
        quantity, row = family.quantity(name), _row(own, name)
        agrees = agrees and row is not None and row.verdict in AGREES
        theory = quantity.theory(case)
        rows.append((quantity.title, _number(row, quantity), _value(theory, quantity), *_values(engines, quantity)))
    why = next((row.note for row in own.rows if row.measured is None and row.note), "")
    title = f"{family.title}, {case.name}"
    clip = case_clip(case, sections((own, *engines))[0].lines, title, all_shown=True) if own.poses else None
    return Compared(
        title,
        ("", "yours", "theory", *(each.title for each in engines)),
        tuple(rows),
        agrees,
        why,
        page.frame(clip) if clip else "",
        tuple(each.recording for each in engines),
    )


def _spread(asked: Asked, results: Sequence[JobResult]) -> Spread:
    family, case = asked.place
    quantity = family.quantity(asked.quantities[0])
    rows = [_row(own, quantity.name) for own in results]
    values = [row.measured for row in rows if row is not None and row.measured is not None]
    theory = quantity.theory(case)
    marks = {"theory": theory} | {_plain(each): _measured(each, quantity) for each in _engines(asked)}
    known = {name: value for name, value in marks.items() if value is not None}
    missing = Counter(
        in_our_words(next((row.note for row in own.rows if row.note), ""))
        for own, row in zip(results, rows, strict=True)
        if row is None or row.measured is None
    )
    median = statistics.median(values) if values else None
    said = ", ".join(f"{name} {numbers.quantity(value, quantity.unit)}" for name, value in known.items())
    return Spread(
        f"{family.title}, {case.name}: {quantity.title}",
        sum(row is not None and row.verdict in AGREES for row in rows),
        len(values),
        _value(median, quantity),
        _value(theory, quantity),
        tuple(missing.most_common()),
        figure(values, known, f"{quantity.title}, {quantity.unit}".rstrip(", "), asked.name) if values else "",
        f"How many students measured which {quantity.title}; their median is {_value(median, quantity)}. {said}.",
    )


def _row(own: JobResult, quantity: str) -> Row | None:
    return next((row for row in own.rows if row.quantity == quantity), None)


def _plain(engine: JobResult) -> str:
    return load_engine(engine.job.engine).title


def _measured(engine: JobResult, quantity: Quantity) -> float | None:
    row = _row(engine, quantity.name)
    return row.measured if row else None


def _values(engines: Iterable[JobResult], quantity: Quantity) -> list[str]:
    return [_value(_measured(each, quantity), quantity) for each in engines]


def _number(row: Row | None, quantity: Quantity) -> str:
    if row is None or row.measured is None:
        return NO_NUMBER
    mark = "✓" if row.verdict in AGREES else "✗"
    return f"{_value(row.measured, quantity)} {mark}"


def _value(value: float | None, quantity: Quantity) -> str:
    return "–" if value is None else numbers.quantity(value, quantity.unit)
