"""The outcome of a demonstration: its numbers, its curves, and its lesson with the numbers in it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from labs.demonstrations.demonstration import Demonstration
from labs.demonstrations.lesson import Error, Magnitude, Number, Predicted, Theory
from reference.comparison.results import JobResult
from reference.comparison.verdicts import Row
from reference.report import numbers
from reference.report.row_text import error_of
from reference.report.sections import Line, Section, sections
from reference.report.terminal_plot import Points

_FINE = 200
"""Points of a predicted curve."""
_LONGER = 1.03
"""A predicted curve ends at so many times the longest timestep, to the right of the last measured point."""


@dataclass(frozen=True)
class Outcome:
    """The results of a demonstration's runs, as the class gets to see them."""

    demonstration: Demonstration
    results: tuple[JobResult, ...]

    @cached_property
    def section(self) -> Section:
        """The runs in the order of the tables."""
        return sections(self.results)[0]

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """All numbers of all runs."""
        return tuple(row for result in self.results for row in result.rows)

    @cached_property
    def implementations(self) -> dict[tuple[str, str], Line]:
        """Engine and profile → the first of its lines; with several timesteps it has one for each of them."""
        found: dict[tuple[str, str], Line] = {}
        for line in self.section.lines:
            found.setdefault((line.result.job.engine, line.result.job.profile), line)
        return found

    def row(self, engine: str, profile: str, quantity: str, label: str = "") -> Row | None:
        """One number, or why there is no number; the label names one of several cases or timesteps."""
        asked = self.demonstration
        timestep = asked.timesteps.get(label)
        case = asked.cases.get(label, next(iter(asked.cases.values())))
        for line in self.section.lines:
            job = line.result.job
            if (job.engine, job.profile, dict(job.changes).get("timestep")) == (engine, profile, timestep):
                return line.row(case, quantity)
        return None

    def theory(self, quantity: str, label: str = "") -> float | None:
        """What theory says, if anything; the label names one of several cases."""
        family, asked = self.section.family, self.demonstration
        case = asked.cases.get(label, next(iter(asked.cases.values())))
        return family.quantity(quantity).theory(family.case(case))

    def formatted(self, value: float | None, quantity: str) -> str:
        """A value as table and lesson show it; empty if there is no value."""
        if value is None:
            return ""
        asked = self.demonstration
        if quantity == asked.quantity and asked.percent:
            return f"{100 * value:.0f} %"
        if quantity == asked.quantity and value in asked.words:
            return asked.words[value]
        return numbers.quantity(value, self.section.family.quantity(quantity).unit)

    def lesson(self) -> list[str]:
        """The lines of the lesson with their numbers, without the lines whose numbers are missing."""
        texts = (line.text(self.written) for line in self.demonstration.lesson)
        return [text for text in texts if text]

    def written(self, number: Number) -> str:
        """A number of the lesson as text; empty if it is missing."""
        if isinstance(number, Predicted):
            return self.formatted(self._predicted(number), self.demonstration.quantity)
        if isinstance(number, Theory):
            return self.formatted(self.theory(number.quantity, number.at), number.quantity)
        row = self.row(number.engine, number.profile, number.quantity, number.at)
        if row is None or row.measured is None:
            return ""
        if isinstance(number, Error):
            return error_of(row)
        value = abs(row.measured) if isinstance(number, Magnitude) else row.measured
        return self.formatted(value, number.quantity)

    def _predicted(self, number: Predicted) -> float | None:
        asked = self.demonstration
        return None if asked.predicted is None else asked.predicted(asked.timesteps[number.at])

    @cached_property
    def curves(self) -> list[Points]:
        """What is plotted: the family's curve, or the quantity against the timestep with its prediction."""
        asked = self.demonstration
        if not asked.timesteps:
            drawn = [(line, line.result.series) for line in self.section.lines]
            return [Points(line, series.times, series.values) for line, series in drawn if series is not None]
        found = []
        unit = 100 if asked.percent else 1
        if asked.predicted is not None:
            end = max(asked.timesteps.values()) * _LONGER
            fine = [end * (place + 1) / _FINE for place in range(_FINE)]
            found.append(Points(None, [1e3 * step for step in fine], [unit * asked.predicted(step) for step in fine]))
        for (engine, profile), line in self.implementations.items():
            rows = {step: self.row(engine, profile, asked.quantity, label) for label, step in asked.timesteps.items()}
            values = {step: row.measured for step, row in rows.items() if row is not None and row.measured is not None}
            if values:
                points = [1e3 * step for step in values], [unit * value for value in values.values()]
                found.append(Points(line, *points, joined=False))
        return found

    @property
    def axes(self) -> tuple[str, str]:
        """What the axes are called, with their units."""
        if self.demonstration.timesteps:
            unit = self.section.family.quantity(self.demonstration.quantity).unit
            return "timestep, ms", f"{self.demonstration.heading}, {'%' if self.demonstration.percent else unit}"
        return "time, s", self.section.family.curve.y_label
