"""What came of a demonstration: its numbers, its curves, and its lesson with the numbers in it.

In a lesson `{engine profile quantity figure at label}` stands for a number of the run. The figure is `measured`, `size`
(without its sign) or `error`; the label names one of several cases or timesteps, and is left out where there is one.
`{theory quantity at label}` is what theory says of it, `{predicted label}` what the method is known to make of it. A
part in [brackets] is left out where a number in it is missing, and a line that has none left is left out as a whole.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from labs.demonstrations.questions import Demonstration
from reference.comparison.results import JobResult
from reference.comparison.verdicts import Row
from reference.report import numbers
from reference.report.summary import Line, Section, error_of, sections
from reference.report.terminal import Points

_FINE = 200
"""Points of a predicted curve."""


@dataclass(frozen=True)
class Seen:
    """What came of a demonstration's runs."""

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
        """Engine and profile → the first of its lines: where there are several timesteps, it has one for each."""
        found: dict[tuple[str, str], Line] = {}
        for line in self.section.lines:
            found.setdefault((line.result.job.engine, line.result.job.profile), line)
        return found

    def row(self, engine: str, profile: str, quantity: str, label: str = "") -> Row | None:
        """One number, or why there is none; the label names a case or a timestep where there are several."""
        asked = self.demonstration
        timestep = asked.timesteps.get(label)
        case = asked.cases.get(label, next(iter(asked.cases.values())))
        for line in self.section.lines:
            job = line.result.job
            if (job.engine, job.profile, dict(job.changes).get("timestep")) == (engine, profile, timestep):
                return line.row(case, quantity)
        return None

    def theory(self, quantity: str, label: str = "") -> float | None:
        """What theory says, if anything; the label names a case where there are several."""
        family, asked = self.section.family, self.demonstration
        case = asked.cases.get(label, next(iter(asked.cases.values())))
        return family.quantity(quantity).theory(family.case(case))

    def said(self, value: float | None, quantity: str) -> str:
        """A value as it is written in table and lesson."""
        if value is None:
            return ""
        asked = self.demonstration
        if quantity == asked.quantity and asked.percent:
            return f"{100 * value:.0f} %"
        if quantity == asked.quantity and value in asked.words:
            return asked.words[value]
        return numbers.quantity(value, self.section.family.quantity(quantity).unit)

    def lesson(self) -> list[str]:
        """The lines of the lesson with their numbers; those alone whose numbers there are."""
        return [line for line in (filled(line, self._figure) for line in self.demonstration.lesson) if line]

    def _figure(self, words: str) -> str:
        """The number that a placeholder in the lesson stands for; empty where there is none."""
        words, _, label = words.partition(" at ")
        asked, (first, *others) = self.demonstration, words.split()
        if first == "predicted":
            assert asked.predicted is not None
            return self.said(asked.predicted(asked.timesteps[" ".join(others)]), asked.quantity)
        if first == "theory":
            return self.said(self.theory(others[0], label), others[0])
        profile, quantity, figure = others
        row = self.row(first, profile, quantity, label)
        if row is None or row.measured is None:
            return ""
        if figure == "error":
            return error_of(row)
        return self.said({"measured": row.measured, "size": abs(row.measured)}[figure], quantity)

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
            end = max(asked.timesteps.values()) * 1.03
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


def filled(line: str, figure: Callable[[str], str]) -> str:
    """A line of a lesson with its numbers; empty where one outside brackets is missing, or none is left at all."""
    asked: list[str] = []

    def fill(part: str) -> str | None:
        found = [figure(words) for words in re.findall(r"\{([^}]*)\}", part)]
        asked.extend(found)
        values = iter(found)
        return re.sub(r"\{[^}]*\}", lambda _: next(values), part) if all(found) else None

    whole = fill(re.sub(r"\[([^]]*)\]", lambda part: fill(part[1]) or "", line))
    if whole is None or (asked and not any(asked)):
        return ""
    return re.sub(r":\s*,", ":", whole).strip()  # the first of a list is missing
