"""What a run looks like in a notebook: the replay, the curve, and the numbers beside theory and the prediction.

Each is an output of its own with a plain-text twin: a notebook that is not trusted yet shows no markup, a terminal none
at all.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

from labs.desk.predicting import Prediction
from reference.compare import Row, Verdict
from reference.family import Quantity
from reference.report import figures, numbers
from reference.report.summary import MARKS, Line, error_of

if TYPE_CHECKING:
    from labs.desk.asking import Asked

DPI = 110
_MEANINGS = {
    Verdict.PASS: "within the tolerance of theory",
    Verdict.KNOWN_DEVIATION: "off by what the method is known to do",
    Verdict.FAIL: "farther off than it should be",
}
"""What stands below a table; an implementation without a number says why itself."""
_STYLE = "border-collapse:collapse;font-variant-numeric:tabular-nums"
_CELL = "padding:2px 12px 2px 0;text-align:{};border:0;background:none"


@dataclass(frozen=True)
class Table:
    """Numbers of one case. headings: of the columns, the first to the left. rows: as many texts. notes: lines below."""

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()

    def __str__(self) -> str:
        every = [self.headings, *self.rows]
        widths = [max(len(row[place]) for row in every) for place in range(len(self.headings))]
        lines = [
            "  ".join(text.ljust(width) if place == 0 else text.rjust(width) for place, (text, width) in found).rstrip()
            for found in (enumerate(zip(row, widths, strict=True)) for row in every)
        ]
        return "\n".join([self.title, *lines, *self.notes])

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": "".join(self._markup())}

    def _markup(self) -> Iterator[str]:
        yield f'<div><b>{escape(self.title)}</b><table style="{_STYLE}">'
        for kind, row in [("th", self.headings), *(("td", row) for row in self.rows)]:
            cells = (
                f'<{kind} style="{_CELL.format("left" if place == 0 else "right")}">{escape(text)}</{kind}>'
                for place, text in enumerate(row)
            )
            yield f"<tr>{''.join(cells)}</tr>"
        yield "</table>"
        yield "".join(f"<div>{escape(note)}</div>" for note in self.notes)
        yield "</div>"


@dataclass(frozen=True)
class Picture:
    """A figure as PNG. text: what it shows, for who cannot see it."""

    png: bytes
    text: str

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        return {"text/plain": self.text, "image/png": self.png}


@dataclass(frozen=True)
class Replay:
    """A replay: a frame of its own with a still picture beside it."""

    markup: str
    text: str

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": self.text, "text/html": self.markup}


def tables(asked: Asked, quantities: Sequence[str], prediction: Prediction | None = None) -> list[Table]:
    """One table a quantity: who, what came, how far from theory."""
    wanted = [asked.family.quantity(name) for name in quantities] or list(asked.family.quantities)
    found = [_table(asked, quantity, prediction if place == 0 else None) for place, quantity in enumerate(wanted)]
    return [*found[:-1], _with_notes(found[-1], asked, [quantity.name for quantity in wanted])]


def curve(asked: Asked) -> Picture | None:
    """The family's curve in every implementation; None where none of them has one."""
    plotted = [line for line in asked.lines if line.result.series is not None]
    if not plotted:
        return None
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(figures.STYLE):
        figure = Figure(figsize=(figures.WIDTH, figures.HEIGHT), layout="constrained", dpi=DPI)
        axes = figure.add_subplot()
        for line in plotted:
            series = line.result.series
            assert series is not None
            style = {**figures.marker(line), **figures.line_style(line), "markevery": (0.05 * len(axes.lines), 0.4)}
            axes.plot(series.times, series.values, label=_who(line), **style)
        axes.set(title=asked.title, xlabel="time, s", ylabel=asked.family.curve.y_label)
        figure.legend(loc="outside lower left", ncols=2, handlelength=3)
        content = io.BytesIO()
        figure.savefig(content, format="png")
    names = ", ".join(_who(line) for line in plotted)
    return Picture(content.getvalue(), f"[{asked.family.curve.y_label} over time: {names}]")


def replay(asked: Asked) -> Replay | None:
    """All runs in one picture, the student's solid and the engines as outlines; None where nothing ran."""
    poses = asked.poses
    if not poses:
        return None
    from reference.viewer import making, page  # noqa: PLC0415 - a check needs none of it

    scenario = asked.case.scenarios[0]
    clip = making.clip(scenario, {each.title: each for each in poses}, asked.title)
    return Replay(page.frame(clip), f"[replay: {', '.join(each.title for each in poses)}]")


def _table(asked: Asked, quantity: Quantity, prediction: Prediction | None) -> Table:
    rows = [(line, row) for line in asked.lines if (row := _row(line, quantity.name))]
    theory = next((row.expected for _, row in rows if row.expected is not None), None)
    cells = [_cells(line, row) for line, row in rows]
    if prediction is not None and prediction.answer is not None:
        cells.insert(0, ("you predicted", prediction.shown, _off(prediction, theory), "", ""))
    if theory is not None:
        cells.append(("theory", _value(theory), "", "", ""))
    unit = f", {quantity.unit}" if quantity.unit else ""
    missing = tuple(f"{_who(line)}: {line.note}" for line in asked.lines if not _row(line, quantity.name))
    title = f"{quantity.title[:1].upper()}{quantity.title[1:]} ({asked.family.title.lower()}, {asked.case.name})"
    return Table(title, ("", f"value{unit}", "off by", "", "timestep"), tuple(cells), missing)


def _row(line: Line, quantity: str) -> Row | None:
    return next((row for row in line.result.rows if row.quantity == quantity), None)


def _cells(line: Line, row: Row) -> tuple[str, ...]:
    value = _value(row.measured) if row.measured is not None else "none"
    timestep = f"{1000 * float(row.settings.split()[1]):.3g} ms"  # of `timestep 0.001 s, …`
    return _who(line), value, error_of(row) if row.error is not None else "", MARKS[row.verdict], timestep


def _off(prediction: Prediction, theory: float | None) -> str:
    """How far a guess is from theory, in percent where theory is not zero."""
    if theory is None or not isinstance(prediction.answer, float):
        return ""
    off = prediction.answer - theory
    return f"{off / abs(theory):+.0%}".replace("-", "−").replace("%", " %") if theory else numbers.deviation(off, "")


def _value(value: float) -> str:
    return numbers.digits(value, 5)


def _who(line: Line) -> str:
    """`yours`, `PyBullet`; the profile only where it says something."""
    return line.result.title if line.tuned else line.title


def _with_notes(table: Table, asked: Asked, quantities: Sequence[str]) -> Table:
    """What the marks mean, why something deviates, and what was recorded elsewhere."""
    rows = [(line, row) for line in asked.lines for row in line.result.rows if row.quantity in quantities]
    meanings = dict.fromkeys(
        f"{MARKS[row.verdict]} {_MEANINGS[row.verdict]}" for _, row in rows if row.verdict in _MEANINGS
    )
    deviations = dict.fromkeys(f"{_who(line)}: {row.note}" for line, row in rows if row.note)
    recorded = [line.result.recording for line in asked.lines if line.result.recording]
    legend = [f"({'; '.join(meanings)})"] * bool(meanings)
    notes = legend + list(deviations) + recorded + [asked.snapped] * bool(asked.snapped)
    return Table(table.title, table.headings, table.rows, (*table.notes, *notes))
