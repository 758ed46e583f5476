"""A comparison as tables in the terminal: one line an implementation, or every case with its numbers."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from rich.console import Console
from rich.table import Table
from rich.text import Text

from reference import lecture
from reference.comparison.verdicts import Row, Verdict
from reference.engines.profiles import TUNED
from reference.report import numbers
from reference.report.summary import (
    LEGEND,
    MARKS,
    Cell,
    Line,
    Section,
    columns,
    error_of,
    left_of,
    recordings,
    verdict_line,
)
from reference.report.worst import nearest_to_fail

WORST = 5
"""How many rows the list of the worst has."""
_COLUMN = 14
"""Width at which the headings of the figures are broken: five columns fit in a terminal of 80."""
_ANY_WIDTH = 1000
"""Wider than any table, to see how wide it would like to be."""
_STYLES = {
    Verdict.PASS: "green",
    Verdict.KNOWN_DEVIATION: "yellow",
    Verdict.FAIL: "red",
    Verdict.CRASHED: "bold red",
}
_GLYPHS = {"handwritten": "●○×", "pybullet": "■□+", "mujoco": "▲△*", "dart": "◆◇~"}
"""An engine's marks: tuned, stock, any other profile."""
_COLOURS = {"handwritten": None, "pybullet": 33, "mujoco": 208, "dart": 35}
"""Of the 256 that terminals have; None is the terminal's own. Blue, orange and green show on black and on white."""
_MARKS_OF_A_CURVE = 6
_NEAR = 0.1
"""An axis is drawn on to the next tick if that is no more than this share of it away."""


@dataclass(frozen=True)
class Points:
    """A curve in the terminal. line: whose it is, None for theory. joined: points of a curve, not single ones."""

    line: Line | None
    xs: Sequence[float]
    ys: Sequence[float]
    joined: bool = True


def print_comparison(console: Console, found: Iterable[Section], with_cases: bool = False) -> None:
    """Print each family: what is asked, a table, and what the marks mean."""
    found = list(found)
    for section in found:
        console.print()
        console.print(Text(section.family.title, style="bold"))
        console.print(Text(_statements(section), style="dim"))
        console.print(Text(section.family.expected))
        for table in _cases(section) if with_cases else [_overview(section)]:
            console.print(table)
        _print_remarks(console, section, with_cases)
    rows = [row for section in found for line in section.lines for row in line.result.rows]
    if len(found) > 1:
        _print_at_a_glance(console, found)
    seen = [verdict for verdict in Verdict if any(row.verdict is verdict for row in rows)]
    console.print()
    for verdict in seen:
        console.print(Text.assemble((f"{MARKS[verdict]} {verdict}", style_of(verdict)), f": {LEGEND[verdict]}"))
    for recorded in recordings(line.result for section in found for line in section.lines):
        console.print(Text(recorded))
    console.print(Text(verdict_line(rows), style="bold"))


def _print_at_a_glance(console: Console, found: Sequence[Section]) -> None:
    """All families in one screen: the worst mark of each implementation, and how many of its checks agree.

    Where that is too wide, the tuned settings, which count, come first and all others in a table below.
    """
    titles = columns(found)
    tables = [_screen(found, titles)]
    if console.measure(tables[0], options=console.options.update(width=_ANY_WIDTH)).maximum > console.width:
        tuned = [title for title in titles if title.endswith(f", {TUNED}")]
        tables = [_screen(found, chosen) for chosen in (tuned, [title for title in titles if title not in tuned])]
    for table in tables:
        console.print()
        console.print(table)
    worst = nearest_to_fail(found, WORST)
    if worst:
        console.print()
        console.print(Text("tuned, worst first: share of its limit", style="bold"))
    for section, line, row, used in worst:
        what = f"{section.family.name}, {row.case}: {section.family.quantity(row.quantity).title}"
        console.print(Text(f"  {numbers.percent(used).lstrip('+'):>7}  {line.result.title}, {what} {error_of(row)}"))


def _screen(found: Sequence[Section], titles: Sequence[str]) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("\nat a glance", no_wrap=True)
    for title in titles:
        table.add_column(title.replace("hand-written", "by hand").replace(", ", "\n"), no_wrap=True)
    for section in found:
        lines = [section.line(title) for title in titles]
        cells = [
            Text(f"{line.whole.mark} {_short_count(line)}", style=style_of(line.whole.verdict)) if line else Text("")
            for line in lines
        ]
        table.add_row(section.family.name, *cells)
    return table


def _short_count(line: Line) -> str:
    """The count, or `needs`; nothing where the mark says it all."""
    return line.whole.count if "/" in line.whole.count or line.whole.verdict is Verdict.NEEDS else ""


def _statements(section: Section) -> str:
    """Which statements of the lecture the family puts to the test."""
    titles = [f"{number} {lecture.statement(number).title}" for number in section.family.statements]
    return f"Lecture, statement{'s' if len(titles) > 1 else ''} {'; '.join(titles)}"


def _overview(section: Section) -> Table:
    """One line an implementation; in each cell how many cases agree, and the worst error."""
    table = _table("implementation", *(quantity.title for quantity in section.family.quantities))
    for line in section.lines:
        cells = [Text(str(line.whole.verdict), style=style_of(line.whole.verdict))] if line.note else _texts(line.cells)
        table.add_row(Text(line.title, style="bold" if line.tuned else ""), *cells)
    return table


def _texts(cells: Sequence[Cell]) -> list[Text]:
    lines = [(f"{cell.mark} {cell.count}".strip(), cell.worst, cell.left) for cell in cells]
    return [
        Text("\n".join(filter(None, texts)), style=style_of(cell.verdict))
        for texts, cell in zip(lines, cells, strict=True)
    ]


def _cases(section: Section) -> Iterator[Table]:
    """A table a quantity: under each case what every implementation measured."""
    for quantity in section.family.quantities:
        table = _table(f"\n{quantity.title}", "\nmeasured", "\nerror", "\nleft", "\nverdict")
        for case in section.cases:
            expected = section.expected(case, quantity)
            heading = [case, expected, "", "", "expected"] if expected else [case]
            table.add_row(*(Text(text, style="bold") for text in heading))
            for line in section.lines:
                row = line.row(case, quantity.name)
                if row is not None:
                    table.add_row(Text(f"  {line.title}"), *_figures(row))
        yield table


def _figures(row: Row) -> tuple[str, str, str, Text]:
    measured = "" if row.measured is None else numbers.quantity(row.measured, row.unit)
    error = "" if row.error is None else error_of(row)
    left = left_of(row) if row.verdict is Verdict.KNOWN_DEVIATION else ""
    return measured, error, left, Text(f"{MARKS[row.verdict]} {row.verdict}", style=style_of(row.verdict))


def _print_remarks(console: Console, section: Section, with_cases: bool) -> None:
    """Why there is no number; with the cases also why one deviates."""
    for note, titles in section.remarks():
        if with_cases or not note.startswith(str(Verdict.KNOWN_DEVIATION)):
            console.print(Text(f"  {', '.join(titles)}: {note}", style="dim"))


def _table(first: str, *others: str) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    table.add_column(first, no_wrap=True)
    for title in others:
        table.add_column("\n".join(textwrap.wrap(title, _COLUMN)) if len(title) > _COLUMN else title, no_wrap=True)
    return table


def style_of(verdict: Verdict) -> str:
    """How a verdict is coloured."""
    return _STYLES.get(verdict, "dim")


def marked(line: Line | None) -> Text:
    """The character that marks an implementation's curve: its shape says the engine, filled means tuned."""
    if line is None:
        return Text("─")
    job, colour = line.result.job, _colour(line)
    glyphs = _GLYPHS.get(job.engine, "▼▽-")
    glyph = glyphs[0] if line.tuned else glyphs[1] if job.profile == "stock" else glyphs[2]
    return Text(glyph, style="" if colour is None else f"color({colour})")


def plot(curves: Sequence[Points], x_label: str, y_label: str, width: int, height: int) -> Text:
    """Curves against axes of so many characters, drawn by plotext; `ImportError` where that is not installed.

    Lines are made of fine dots. What tells them apart is their marks, spread so that those of curves that coincide
    lie side by side; colours only help.
    """
    import plotext  # late: an extra, and a plot is not always wanted

    low, high = _range(x for curve in curves for x in curve.xs)
    bottom, top = _rounded(*_range(y for curve in curves for y in curve.ys), height // 3)
    figure = plotext.figure
    plotext.terminal.limit(False, False)  # how large the terminal is, rich knows better
    figure.clear()
    figure.theme("colorless")
    figure.plot_size(width, height - 1)
    figure.axes(False, axis="x", side="upper")
    figure.axes(False, axis="y", side="right")
    room = (high - low) * (1 - (len(x_label) + 5) / width)
    for axis, ends, last in (("x", (low, high), low + room), ("y", (bottom, top), top)):
        ticks = [tick for tick in _ticks(*ends, width // 12 if axis == "x" else height // 3) if tick <= last]
        figure.ruler(axis).lim(*ends)
        figure.ruler(axis).ticks(ticks, [f"{tick:.6g}".replace("-", "−") for tick in ticks])
    for curve in reversed(curves):  # where they coincide, the first is seen, and each shows where it parts from it
        if curve.joined:
            figure.draw(figure.signal(list(curve.xs), list(curve.ys), marker=_pen("braille", curve.line)).lines(True))
    owned = [curve for curve in curves if curve.line is not None and len(curve.xs)]
    for place, curve in enumerate(owned):
        xs, ys = _marks(curve, place, len(owned), low, high, width)
        figure.draw(figure.signal(xs, ys, marker=_pen(marked(curve.line).plain, curve.line)))
    lines = Text.from_ansi(figure.build().string()).split("\n")
    lines[-1].truncate(width - len(x_label), pad=True)
    lines[-1].append(x_label)
    return Text("\n", no_wrap=True, end="").join([Text(y_label), *lines])


def _pen(shape: str, line: Line | None) -> object:
    import plotext

    colour = _colour(line)
    return plotext.marker(shape, plotext.pixel() if colour is None else plotext.pixel(foreground=colour))


def _colour(line: Line | None) -> int | None:
    return None if line is None else _COLOURS.get(line.result.job.engine, 36)


def _marks(
    curve: Points, place: int, count: int, low: float, high: float, width: int
) -> tuple[list[float], list[float]]:
    """Where a curve gets its marks: the first of `count` curves early, the last late; single points side by side."""
    if not curve.joined:
        aside = (place - (count - 1) / 2) * (high - low) / width
        return [x + aside for x in curve.xs], list(curve.ys)
    repeats = max(1, min(_MARKS_OF_A_CURVE, width // (3 * count)))
    wanted = [low + (high - low) * (turn + (place + 0.5) / count) / repeats for turn in range(repeats)]
    nearest = [min(range(len(curve.xs)), key=lambda k: abs(curve.xs[k] - x)) for x in wanted if x <= curve.xs[-1]]
    return [curve.xs[k] for k in nearest], [curve.ys[k] for k in nearest]


def _range(values: Iterable[float]) -> tuple[float, float]:
    """Smallest and largest value, a little apart where they are one."""
    found = list(values)
    low, high = min(found, default=0.0), max(found, default=1.0)
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _rounded(low: float, high: float, most: int) -> tuple[float, float]:
    """The range up to the next round number, where that is near."""
    step = _step(low, high, most)
    end = math.ceil(high / step - 1e-9) * step
    return low, end if end - high <= _NEAR * (high - low) else high


def _ticks(low: float, high: float, most: int) -> list[float]:
    """Round numbers from low to high, about as many as asked for and no more."""
    step = _step(low, high, most)
    return [count * step for count in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def _step(low: float, high: float, most: int) -> float:
    """Distance of the ticks: 1, 2 or 5 times a power of ten."""
    finest = (high - low) / max(1, most)
    power = 10.0 ** math.floor(math.log10(finest))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= finest * (1 - 1e-9))
