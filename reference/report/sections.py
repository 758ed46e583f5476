"""The rows of a comparison gathered for the tables: a section for each family, a line for each implementation, cells.

The page and the terminal print the same cells, which `reference.report.cells` makes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from reference.catalogue.case import Case
from reference.catalogue.family import Family, Quantity
from reference.catalogue.scenarios import catalogue
from reference.comparison.convergence import ROUNDING
from reference.comparison.pairs import Pair, pairs
from reference.comparison.results import JobResult
from reference.comparison.verdicts import Row
from reference.engines import engine_names, load_engine, profiles, tried_versions
from reference.report import numbers
from reference.report.cells import Cell

_METHODS = {profiles.EXACT: "exact", profiles.WORLD: "in the world", profiles.STEP: "at the step"}
"""Methods of hand-written code, as a sentence has them."""


@dataclass(frozen=True)
class Line:
    """One engine and profile in a family's tables."""

    result: JobResult
    family: Family

    @property
    def title(self) -> str:
        """Engine and profile, as in every table: `PyBullet, tuned` or `hand-written, exact`."""
        return f"{self.result.title}, {self.result.job.profile}"

    @property
    def name(self) -> str:
        """The implementation in a sentence: `PyBullet` or `hand-written code`."""
        return self.result.title.replace("hand-written", "hand-written code", 1)

    @property
    def by_hand(self) -> str:
        """How hand-written code does it, in words: `by hand, exact`."""
        return f"by hand, {_METHODS.get(self.result.job.profile, self.result.job.profile)}"

    @property
    def counts(self) -> bool:
        """Whether this line's verdicts count."""
        return profiles.counts(self.result.job.profile)

    @property
    def handwritten(self) -> bool:
        """Whether this is hand-written code of ours, and no engine."""
        return self.result.job.engine == "handwritten"

    @property
    def plain(self) -> bool:
        """Whether this is what one gets who sets nothing, or by hand the plainest method."""
        return profiles.is_plain(self.result.job.profile)

    @property
    def note(self) -> str:
        """Why there is no number at all; empty where there are numbers."""
        if any(row.quantity for row in self.result.rows):
            return ""
        return "; ".join(dict.fromkeys(row.why for row in self.result.rows))

    @cached_property
    def cells(self) -> tuple[Cell, ...]:
        """One cell for each quantity. A case without any number counts in each of them."""
        return tuple(
            Cell(tuple(row for row in self.result.rows if row.quantity in (quantity.name, "")), self.family)
            for quantity in self.family.quantities
        )

    @cached_property
    def whole(self) -> Cell:
        """All rows of this line, quantities together."""
        return Cell(self.result.rows, self.family)

    @property
    def _studied_unit(self) -> str:
        return self.family.quantity(self.family.convergence.quantity).unit

    @cached_property
    def errors(self) -> list[tuple[str, str]]:
        """The studied timesteps, each with its error, as text."""
        study, unit = self.result.convergence, self._studied_unit
        if study is None:
            return []
        pairs = zip(study.timesteps, study.errors, strict=True)
        return [(numbers.size(timestep, "s"), numbers.size(error, unit)) for timestep, error in pairs]

    @property
    def order(self) -> str:
        """The measured order of convergence, or why there is none."""
        study = self.result.convergence
        if study is None or len(study.errors) < 2:
            return "too few timesteps"
        if study.order is None:
            *_, second, largest = sorted(study.errors)
            alone = largest > ROUNDING and largest > second / ROUNDING
            return f"{'one timestep alone' if alone else 'rounding'}, {numbers.size(largest, self._studied_unit)}"
        return f"order {study.order:.2f}".replace("-0.00", "0.00").replace("-", "−")

    def row(self, case: str, quantity: str) -> Row | None:
        """The row of one case and quantity, or the one that says why there is none."""
        for row in self.result.rows:
            if row.case == case and row.quantity in (quantity, ""):
                return row
        return self.result.rows[0] if self.note else None


@dataclass(frozen=True)
class Section:
    """A family and its lines, in the order of the tables."""

    family: Family
    lines: tuple[Line, ...]

    @cached_property
    def _asked(self) -> dict[str, Case]:
        """The cases that were requested, by name, and the family's own."""
        moved = (case for line in self.lines if line.result.job.at for case in line.result.job.chosen(self.family))
        return {case.name: case for case in (*self.family.cases, *moved)}

    @cached_property
    def cases(self) -> tuple[str, ...]:
        """The cases that were run, in the family's order; all of them where no line has any number."""
        run = {row.case for line in self.lines for row in line.result.rows}
        names = tuple(self._asked)
        return tuple(name for name in names if name in run) or names

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        """Every two numbers of the same case and quantity, in the order of the lines.

        An engine is named as its job names it: one of somebody's own by its file, and not by what its class says.
        """
        named = ((line.result.job.engine, row) for line in self.lines for row in line.result.rows)
        return tuple(pairs(row if row.engine == name else replace(row, engine=name) for name, row in named))

    @property
    def studied(self) -> list[Line]:
        """The lines with errors at several timesteps."""
        return [line for line in self.lines if line.result.convergence is not None]

    def line(self, title: str) -> Line | None:
        """The line of that engine and profile; None where the family has none."""
        return next((line for line in self.lines if line.title == title), None)

    def expected(self, case: str, quantity: Quantity) -> str:
        """What theory says of a quantity in one case; empty where it has no figure."""
        rows = (line.row(case, quantity.name) for line in self.lines)
        compared = next((row.expected for row in rows if row is not None and row.expected is not None), None)
        value = quantity.theory(self._asked[case]) if compared is None else compared
        return "" if value is None else numbers.quantity(value, quantity.unit)


def sections(results: Iterable[JobResult]) -> list[Section]:
    """Gather results by family, in the catalogue's order; engines in the order of the tables, what counts first."""
    results, families = _with_own_titles(list(results)), catalogue()
    engines = engine_names()

    def place(result: JobResult) -> tuple[object, ...]:
        name = result.job.engine
        return engines.index(name) if name in engines else len(engines), name

    found = []
    for family in families.values():
        own = [result for result in results if result.job.family == family.name]
        own.sort(key=lambda result: (*place(result), profiles.place(result.job.profile)))
        if own:
            found.append(Section(family, tuple(Line(result, family) for result in own)))
    return found


def _with_own_titles(results: Sequence[JobResult]) -> list[JobResult]:
    """The results; where engines of two files share a title, each title has its file's name behind it, or its path."""
    engines: dict[str, dict[str, None]] = {}
    for result in results:
        engines.setdefault(result.title, {})[result.job.engine] = None

    def title(result: JobResult) -> str:
        alike = engines[result.title]
        files = {Path(engine).name for engine in alike}
        own = Path(result.job.engine).name if len(files) == len(alike) else result.job.engine
        return f"{result.title} ({own})" if len(alike) > 1 else result.title

    return [replace(result, title=title(result)) for result in results]


def recordings(results: Iterable[JobResult]) -> list[str]:
    """What was not run here but recorded elsewhere, each recording once, and what was moved to a recorded point.

    Also which engine is of another version than those that the lab was tried with.
    """
    results = list(results)
    notes = [result.recording for result in results] + [result.job.snapped for result in results]
    own = [result for result in results if result.job.engine in engine_names()]
    notes += [tried_versions.warning(load_engine(result.job.engine), result.version) for result in own]
    return list(dict.fromkeys(note for note in notes if note))
