"""The rows of published cases gathered for the tables on the page and in the terminal: cells, reasons, a summary."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from reference.comparison.verdicts import Verdict, why
from reference.engines import engine_names, load_engine
from reference.published.case import Kind, Published
from reference.published.judging import passes
from reference.published.results import PublishedResult, PublishedRow
from reference.published.theirs import published_cases
from reference.recording.files import MARK
from reference.report import numbers
from reference.report.marks import AGREES, MARKS, SEVERITY

PRINTED = 9
"""Digits of a number in the tables."""
TITLES: dict[Kind, str] = {
    "verification": "Verification: closed forms, and methods that can be repeated digit by digit",
    "validation": "Validation against measurement",
    "cross-engine": "Cross-engine: what another simulator gave",
}

LEGEND = {
    Verdict.PASS: "as published, within the tolerance",
    Verdict.KNOWN_DEVIATION: "differs by the amount that the method predicts",
    Verdict.DISAGREES: "as far off as the figure is large, for a reason",
    Verdict.FAIL: "neither",
    Verdict.CANNOT_EXPRESS: "the engine cannot express it",
    Verdict.NO_WORDS: "the lab cannot express it yet",
    Verdict.NEEDS: "a function that is not written yet",
    Verdict.NOT_AVAILABLE: "the engine is not installed here",
    Verdict.CRASHED: "the run died or gave no usable state",
    Verdict.LOST: "the run was lost to load, a time limit or short memory; it was not judged",
    Verdict.RUNNING: "the run has not ended yet",
}


@dataclass(frozen=True)
class PublishedCell:
    """One cell of a table, for all numbers of one case in one implementation."""

    result: PublishedResult

    @property
    def rows(self) -> tuple[PublishedRow, ...]:
        """A row for each number."""
        return self.result.rows

    @cached_property
    def verdict(self) -> Verdict:
        """The worst verdict among the numbers that were found; without any, that on the whole case."""
        judged = [
            row for row in self.rows if row.verdict not in (Verdict.CANNOT_EXPRESS, Verdict.NO_WORDS)
        ] or self.rows
        return min((row.verdict for row in judged), key=SEVERITY.index)

    @property
    def text(self) -> str:
        """`✓ 3/5`: the mark, and how many numbers agree of all that were published; `∅` alone where none was asked."""
        agreeing = sum(row.verdict in AGREES for row in self.rows)
        count = (
            f" {agreeing}/{len(self.rows)}" if any(row.figure and row.measured is not None for row in self.rows) else ""
        )
        return f"{MARKS[self.verdict]}{count}{MARK if count and self.result.recording else ''}"

    @property
    def reasons(self) -> list[str]:
        """Why a number deviates or is missing, each reason once."""
        return list(dict.fromkeys(why(row.verdict, row.note) for row in self.rows if row.note))


@dataclass(frozen=True)
class PublishedLine:
    """One case and the results of the implementations, by engine."""

    case: Published
    cells: dict[str, PublishedCell]

    @property
    def reasons(self) -> list[tuple[str, list[str]]]:
        """Why a number deviates or is missing, each reason once, with the titles of the engines that it applies to."""
        return _gathered((reason, name) for name, cell in self.cells.items() for reason in cell.reasons)

    @property
    def tolerances(self) -> list[tuple[str, list[str]]]:
        """The reasons of the tolerances, in the same way."""
        return _gathered((row.reason, name) for name, cell in self.cells.items() for row in cell.rows if row.reason)

    def figures(self) -> list[dict[str, PublishedRow]]:
        """For each published number, the rows of the engines that have one."""
        found: dict[tuple[str, int], dict[str, PublishedRow]] = {}
        for name, cell in self.cells.items():
            for row in cell.rows:
                if row.figure:
                    found.setdefault((row.figure, row.place), {})[name] = row
        return list(found.values())

    @staticmethod
    def theirs(found: Mapping[str, PublishedRow]) -> float | None:
        """The published number, from the rows of one number."""
        return next((row.expected for row in found.values() if row.expected is not None), None)

    @property
    def asked(self) -> list[str]:
        """The engines that gave a number, or should have."""
        return [name for name, cell in self.cells.items() if any(row.figure for row in cell.rows)]

    def title(self, name: str) -> str:
        """An engine's title, marked where its numbers are recorded."""
        return self.cells[name].result.title

    @property
    def running(self) -> bool:
        """Whether an implementation is still at it, so that nobody knows yet who finds its numbers."""
        return any(row.verdict is Verdict.RUNNING for cell in self.cells.values() for row in cell.rows)

    @property
    def found_by(self) -> list[str]:
        """The engines that found every number as published, except the one that the numbers come from."""
        return [name for name, cell in self.cells.items() if name != self.case.origin and passes(cell.rows)]


@dataclass(frozen=True)
class PublishedTables:
    """All lines, in the order of the cases, and the engines, in the order of the tables."""

    lines: tuple[PublishedLine, ...]
    engines: tuple[str, ...]

    @staticmethod
    def of(results: Iterable[PublishedResult]) -> PublishedTables:
        """Gather results by case."""
        by_job = {(result.job.case, result.job.engine): result for result in results}
        asked = {engine for _, engine in by_job}
        engines = [*(name for name in engine_names() if name in asked), *sorted(asked - set(engine_names()))]
        lines = [
            PublishedLine(
                case, {name: PublishedCell(by_job[key]) for name in engines if (key := (case.name, name)) in by_job}
            )
            for case in published_cases().values()
        ]
        return PublishedTables(tuple(line for line in lines if line.cells), tuple(engines))

    def of_kind(self, kind: Kind) -> list[PublishedLine]:
        """The lines of one of the three tables."""
        return [line for line in self.lines if line.case.kind == kind]

    @property
    def rows(self) -> list[PublishedRow]:
        """Every row of every line."""
        return [row for line in self.lines for cell in line.cells.values() for row in cell.rows]

    @property
    def recordings(self) -> list[str]:
        """The recordings of what was not run here, each once."""
        found = [cell.result.recording for line in self.lines for cell in line.cells.values()]
        return list(dict.fromkeys(filter(None, found)))

    @property
    def sentence(self) -> str:
        """How many cases an implementation finds as published that they do not come from, of those that are decided."""
        found = sum(bool(line.found_by) for line in self.lines)
        through = sum(bool(line.found_by) or not line.running for line in self.lines)
        of = f"{found} of {through} published cases"
        return f"{of} agree in every number with an implementation that is not their own."

    @property
    def exceptions(self) -> list[str]:
        """Each other case, with the reasons."""
        return [f"{line.case.name}: {_why(line)}" for line in self.lines if not (line.found_by or line.running)]


def engine_title(name: str) -> str:
    """An engine's title, as in the head of a column."""
    return load_engine(name).title


def label(case: Published, row: PublishedRow) -> str:
    """A figure's name in a reader's words, with the label of this number and its unit."""
    labels, unit = case.labels.get(row.figure), case.units.get(row.figure)
    which = f" {labels[row.place - 1]}," if labels and row.place else f" {row.place}," if row.place else ","
    return f"{row.figure.replace('_', ' ')}{which} {unit or ''}".rstrip(" ,")


def figure(value: float | None) -> str:
    """A number with as many digits as are published."""
    return "" if value is None else numbers.digits(value, PRINTED)


def _gathered(found: Iterable[tuple[str, str]]) -> list[tuple[str, list[str]]]:
    titles: dict[str, dict[str, None]] = {}
    for reason, name in found:
        titles.setdefault(reason, {})[engine_title(name)] = None
    return [(reason, list(names)) for reason, names in titles.items()]


def _why(line: PublishedLine) -> str:
    return "; ".join(f"{', '.join(names)}: {reason}" for reason, names in line.reasons)
