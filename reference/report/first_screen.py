"""What one sees first: a ball that bounces, a ball that comes to rest and a slab that stops, each in a few sentences.

Each finding picks one case of one quantity, and says of every implementation how far it is from theory: who agrees, who
differs by what the method must give, and who differs by more. Every number is taken from the rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from reference.comparison.verdicts import Row, Verdict
from reference.engines import facts
from reference.engines.dart_settings import REST_SPEED
from reference.engines.handwritten_engine import Handwritten
from reference.engines.profiles import EXACT, STOCK
from reference.engines.pybullet_settings import STOCK_REST_SPEED
from reference.report import numbers
from reference.report.marks import MARKS
from reference.report.sections import Line, Section

_NOTHING_LEFT, _FAR = 0.01, 0.1
"""Shares of what theory expects: with less of it nothing has happened; with more of an error the number is told."""


@dataclass(frozen=True)
class Figure:
    """One implementation's number. who: its name. said: its difference from theory. timestep: `1 ms`."""

    who: str
    said: str
    timestep: str


@dataclass(frozen=True)
class Group:
    """The implementations with one answer to both questions: first those that count, then the plain ones.

    mark: of their verdict. opening: `Agree with theory within 1 %`. closing: what is said of the numbers together.
    """

    verdict: Verdict
    mark: str
    opening: str
    figures: tuple[Figure, ...]
    closing: str = ""


@dataclass(frozen=True)
class Finding:
    """One row of the first screen. family: whose picture stands beside it, and where there is more. why: the reason."""

    title: str
    question: str
    family: str
    groups: tuple[Group, ...]
    more: str
    why: str


@dataclass(frozen=True)
class _Pick:
    """Which rows answer a question, and in what words.

    cases: of counted lines and of plain ones. factor: from the rows' unit to `unit`; a share of the drop height of 1 m
    is metres too. nothing: what a run does that has next to none of the quantity. far: how a number is told that is
    nowhere near theory.
    """

    family: str
    quantity: str
    cases: tuple[str, str]
    unit: str
    factor: float
    nothing: str = ""
    far: str = ""

    def row(self, line: Line) -> Row | None:
        found = line.row(self.cases[line.plain], self.quantity)
        return found if found is not None and found.quantity == self.quantity else None

    def said(self, row: Row) -> str:
        """A row's difference from theory with its sign, or in words what happened instead."""
        if row.measured is None or row.error is None or row.expected is None:
            return ""
        if self.nothing and abs(row.measured) < _NOTHING_LEFT * abs(row.expected):
            return self.nothing
        if self.far and abs(row.error) > _FAR * abs(row.expected):
            return self.far.format(row.measured)
        scatter = f" ± {few}" if row.spread and (few := _few(self.factor * row.spread)) != "0" else ""
        return f"{signed(self.factor * row.error)}{scatter} {self.unit}"


_BOUNCE = _Pick("dropped-ball", "rebound", ("e=0.5", "e=0.5"), "mm", 1e3, "does not bounce")
_REST = _Pick("ball-to-rest", "rest_time", ("e=0.8", "e=0.8"), "ms", 1e3, far="rests after {:.3f} s")
_STOP = _Pick("sliding-slab", "stopping_distance", ("μ=0.4,v=2", "μ=0.4,v=2,heading=30°"), "mm", 1e3)
_STACK = _Pick("stack", "height", ("boxes=10", "boxes=10"), "m", 1.0)
_AGREE = 0.01
"""A number that is as its method predicts and within this share of theory agrees with theory, as one says."""
_AS_PREDICTED = (Verdict.KNOWN_DEVIATION, Verdict.DISAGREES)
_WORDS = {2: "two", 3: "three", 4: "four", 5: "five"}
_GROUPS = (
    (Verdict.PASS, "Agree with theory within {:.1g} %"),
    (Verdict.KNOWN_DEVIATION, "Differ, as their method predicts"),
    (Verdict.FAIL, "Miss theory"),
)


def findings(found: Sequence[Section]) -> list[Finding]:
    """The rows of the first screen; one is left out where its scenario was not run."""
    by_name = {section.family.name: section for section in found}
    made = (make(by_name) for make in (_bounce, _rest, _stop))
    return [finding for finding in made if finding is not None]


def _bounce(by_name: dict[str, Section]) -> Finding | None:
    def question(row: Row) -> str:
        return (
            "A ball that keeps half its speed, e = 0.5, falls 1 m. Theory: it rises to"
            f" {1e3 * (row.expected or 0.0):.1f} mm. Each number is a mean of {len(row.values)} drops from about 1 m;"
            " ± is how much single drops scatter."
        )

    why = (
        "A method that looks once per step finds the ball up to one step late, below the floor, and sends it back from"
        " there. PyBullet as installed pushes the ball back before it arrives, from a gap that differs from drop to"
        f" drop. {facts.MUJOCO_HAS_NO_RESTITUTION}"
    )
    return _finding(by_name, _BOUNCE, "Bounce", question, why)


def _rest(by_name: dict[str, Section]) -> Finding | None:
    def question(row: Row) -> str:
        return f"The same ball with e = 0.8 bounces until it rests. Theory: after {row.expected or 0.0:.3f} s."

    why = (
        f"DART ends every rebound below {REST_SPEED:g} m/s, so its ball rests early. As installed, at 1 ms, it adds up"
        " to g Δt of speed to each bounce, which counts in the many small ones, so its ball rests late. PyBullet as"
        " installed returns too much of some bounces and too little of others, and ends any rebound below"
        f" {STOCK_REST_SPEED:g} m/s. MuJoCo as installed does not bounce."
    )
    return _finding(by_name, _REST, "Rest", question, why, _stack(by_name.get(_STACK.family)))


def _stop(by_name: dict[str, Section]) -> Finding | None:
    def question(row: Row) -> str:
        return (
            f"A slab slides at 2 m/s over a floor with μ = 0.4. Theory: it stops after {1e3 * (row.expected or 0):.1f}"
            " mm, whichever way it heads. Engines as installed send it off at 30° to their axes."
        )

    why = (
        "Each step moves the slab with the velocity that friction has already reduced, so it stops half a step short."
        " As installed, PyBullet damps every motion; MuJoCo's friction cone is a diamond, weaker at 30°; DART brakes"
        f" each axis by itself{_rocks(by_name.get(_STOP.family))}."
    )
    return _finding(by_name, _STOP, "Stop", question, why)


def _rocks(section: Section | None) -> str:
    """Where DART's slab, as installed, is at the end: it never counts as stopped. Empty where it did not run."""
    for line in section.lines if section else ():
        series, job = line.result.series, line.result.job
        if (job.engine, job.profile) == ("dart", STOCK) and series is not None and series.values:
            theory = line.family.quantity(_STOP.quantity).expected_value(line.family.case(line.family.curve.case))
            short = 1e3 * (theory - series.values[-1])
            return f": its slab stands {short:.0f} mm short, but rocks there without end"
    return ""


def _finding(
    by_name: dict[str, Section], pick: _Pick, title: str, question: Callable[[Row], str], why: str, more: str = ""
) -> Finding | None:
    section = by_name.get(pick.family)
    rows = list(_rows(section, pick)) if section else []
    if not rows:
        return None
    known = [row for _, row in rows if row.expected is not None]
    if not known:
        return None
    asked = question(max(known, key=lambda row: len(row.values)))
    groups = [_group(pick, rows, verdict, opening) for verdict, opening in _GROUPS]
    return Finding(title, asked, pick.family, tuple(group for group in groups if group), more, why)


def _rows(section: Section, pick: _Pick) -> Iterator[tuple[Line, Row]]:
    """The lines that count and the plain ones, each with its row, in the order of the tables."""
    for line in section.lines:
        row = pick.row(line) if line.counts or line.plain else None
        if row is not None:
            yield line, row


def _group(pick: _Pick, rows: Sequence[tuple[Line, Row]], verdict: Verdict, opening: str) -> Group | None:
    own = [(line, row) for line, row in rows if _is_said_as(row) is verdict]
    if not own:
        return None
    own.sort(key=lambda found: (found[1].verdict in _AS_PREDICTED, not found[0].counts))
    figures = tuple(_figure(pick, line, row) for line, row in own)
    shares = [(row.tolerance or 0.0) / abs(row.expected or 1.0) for _, row in own if row.verdict is Verdict.PASS]
    alike = [row.measured for _, row in own if row.measured is not None and row.verdict in _AS_PREDICTED]
    closing = ""
    if _are_alike(alike):
        closing = f"the last {_WORDS.get(len(alike), len(alike))} agree to"
        closing += f" {_upper(max(alike) - min(alike), own[0][1].unit)}"
    return Group(verdict, MARKS[verdict], opening.format(100 * max(_AGREE, *shares, 0.0)), figures, closing)


def _is_said_as(row: Row) -> Verdict:
    """The verdict that stands for a row on this screen, where all three findings have one limit."""
    if row.verdict in _AS_PREDICTED:
        near = row.error is not None and abs(row.error) <= _AGREE * abs(row.expected or 0.0)
        return Verdict.PASS if near else Verdict.KNOWN_DEVIATION
    return row.verdict


def _figure(pick: _Pick, line: Line, row: Row) -> Figure:
    said = pick.said(row) or line.family.quantity(pick.quantity).absent
    who = line.result.title if line.counts else f"{line.result.title} as installed"
    if line.result.job.engine == Handwritten.name:
        who = line.by_hand
    return Figure(who, said, "" if line.result.job.profile == EXACT else timestep_of(row))


def _stack(section: Section | None) -> str:
    """How far the top of ten boxes is below its place in each engine; empty where they were not stacked."""
    rows = [(line, row) for line, row in _rows(section, _STACK)] if section else []
    counted = [(line, row) for line, row in rows if line.counts and row.error]
    low = [f"{numbers.size(abs(row.error or 0.0), row.unit)} in {line.result.title}" for line, row in counted]
    if not low or any(row.verdict is not Verdict.PASS or (row.error or 0.0) > 0 for _, row in counted):
        return ""
    return f"Ten stacked boxes stand; their top is low by {', '.join(low)}."


def timestep_of(row: Row) -> str:
    """The timestep that a row's settings begin with, as text; empty where they name none."""
    name, _, rest = row.settings.partition(" ")
    return f"{1e3 * float(rest.split(' ')[0]):.2g} ms" if name == "timestep" else ""


def signed(value: float) -> str:
    """A difference with its sign and at most two decimals; 0 below half a hundredth."""
    few = _few(abs(value))
    return few if few == "0" else f"{'−' if value < 0 else '+'}{few}"


def _few(value: float) -> str:
    if value < 0.005:
        return "0"
    return f"{value:.2f}" if value < 0.995 else f"{value:.1f}" if value < 9.95 else f"{value:,.0f}"


def _are_alike(values: Sequence[float]) -> bool:
    return len(values) > 1 and max(values) - min(values) < 1e-6 * max(map(abs, values))


def _upper(difference: float, unit: str) -> str:
    """The next power of ten above a small difference, in its unit."""
    return numbers.size(10.0 ** math.ceil(math.log10(max(difference, 1e-9))), unit)
