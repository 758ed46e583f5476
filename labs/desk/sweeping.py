"""One parameter moved: small pictures of every value, a line over all of them, and a slider where there is a kernel."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from labs.desk.showing import DPI, Picture, Table, curve, tables
from reference.errors import InvalidInput, UnknownName
from reference.family import Quantity
from reference.report import figures, numbers
from reference.scenarios import find

if TYPE_CHECKING:
    from labs.desk.asking import Asked

TIMESTEP = "timestep"
MOST = 8
"""Small pictures that still can be read."""
_SMALL = (2.3, 1.9)
"""Inches of one of them."""
_COLUMNS = 4
_TIMESTEPS = (5e-4, 1e-3, 2e-3, 1 / 240)
"""s, where nothing was recorded at others."""


@dataclass(frozen=True)
class Sweep:
    """Runs over the values of one parameter. quantity: what is measured, the family's first if empty."""

    parameter: str
    values: tuple[float, ...]
    asked: tuple[Asked, ...]
    quantity: str = ""

    @property
    def measured(self) -> Quantity:
        """What the table and the large picture show."""
        family = self.asked[0].family
        return family.quantity(self.quantity) if self.quantity else family.quantities[0]

    def numbers(self) -> dict[str, list[tuple[float, float | None, float | None]]]:
        """For each implementation its values: the parameter, what was measured, and what theory says."""
        found: dict[str, list[tuple[float, float | None, float | None]]] = {}
        for value, asked in zip(self.values, self.asked, strict=True):
            for line in asked.lines:
                row = next((row for row in line.result.rows if row.quantity == self.measured.name), None)
                known = (row.measured, row.expected) if row else (None, None)
                found.setdefault(line.result.title, []).append((value, *known))
        return found

    @property
    def table(self) -> Table:
        """Every implementation's numbers, one row a value."""
        found = self.numbers()
        rows = []
        for place, value in enumerate(self.values):
            theory = next((row[place][2] for row in found.values() if row[place][2] is not None), None)
            cells = [_digits(row[place][1]) for row in found.values()]
            rows.append((numbers.digits(value, 3), *cells, _digits(theory)))
        unit = f", {self.measured.unit}" if self.measured.unit else ""
        title = f"{self.measured.title}{unit}, by {self.parameter}"
        notes = dict.fromkeys(asked.snapped for asked in self.asked if asked.snapped)
        missing = {f"{line.result.title}: {line.note}" for asked in self.asked for line in asked.lines if line.note}
        return Table(title, (self.parameter, *found, "theory"), tuple(rows), (*sorted(missing), *notes))

    @property
    def picture(self) -> Picture:
        """A small picture for each value, and one of what was measured over all of them."""
        import matplotlib
        from matplotlib.figure import Figure

        count = len(self.values) + 1
        columns, rows = min(count, _COLUMNS), -(-count // _COLUMNS)
        with matplotlib.rc_context(figures.STYLE | {"font.size": 8, "axes.titlesize": 8}):
            size = (_SMALL[0] * columns, _SMALL[1] * rows + 0.4)
            figure = Figure(figsize=size, layout="constrained", dpi=DPI)
            places = figure.subplots(rows, columns, squeeze=False).flat
            for axes, value, asked in zip(places, self.values, self.asked, strict=False):
                _draw(axes, asked)
                axes.set_title(f"{self.parameter} {value:g}")
            _draw_measured(places[count - 1], self)
            for axes in list(places)[count:]:
                axes.set_axis_off()
            handles = {line.get_label(): line for axes in figure.axes for line in axes.lines}
            figure.legend(
                list(handles.values()),
                [str(each) for each in handles],
                loc="outside lower left",
                ncols=4,
                handlelength=3,
            )
            content = io.BytesIO()
            figure.savefig(content, format="png")
        return Picture(content.getvalue(), f"[{self.measured.title} over {self.parameter}]")


def values_of(scenario: str, parameter: str, values: Sequence[float] = ()) -> list[float]:
    """The values that are run: those given, or some of those that were recorded.

    Raises
    ------
    UnknownName, InvalidInput
        If the scenario has no such parameter, or too many values are given to be seen side by side.
    """
    family, _ = find(scenario)
    grid = family.grid
    names = [TIMESTEP, *(grid.names if grid else ())]
    if parameter not in names:
        raise UnknownName(f"parameter of {family.name}", parameter, names)
    if len(values) > MOST:
        raise InvalidInput(f"{len(values)} values are too many to be seen side by side: at most {MOST}")
    if values:
        return list(values)
    if parameter == TIMESTEP:
        return list(grid.timesteps) if grid else list(_TIMESTEPS)
    assert grid is not None
    known = next(each.values for each in grid.parameters if each.name == parameter)
    chosen = range(0, len(known), max(1, -(-len(known) // (MOST - 2))))
    return [known[place] for place in chosen]


def slide(sweep: Sweep) -> None:
    """A slider over the runs, where widgets work; the pictures above stay for where they do not."""
    try:
        import ipywidgets  # noqa: PLC0415 - without it there is the static picture
    except ImportError:
        return
    from IPython.display import display  # noqa: PLC0415

    def show(value: float) -> None:
        asked = sweep.asked[sweep.values.index(value)]
        shown: list[Any] = [curve(asked), tables(asked, [sweep.measured.name])[0]]
        display(*(each for each in shown if each is not None))  # type: ignore[no-untyped-call]

    options = [(numbers.digits(value, 3), value) for value in sweep.values]
    slider = ipywidgets.SelectionSlider(options=options, description=sweep.parameter, continuous_update=False)
    ipywidgets.interact(show, value=slider)


def _draw(axes: Any, asked: Asked) -> None:
    for line in asked.lines:
        series = line.result.series
        if series is not None:
            axes.plot(series.times, series.values, label=line.result.title, **figures.line_style(line))


def _draw_measured(axes: Any, sweep: Sweep) -> None:
    looks = {line.result.title: line for asked in sweep.asked for line in asked.lines}
    for title, found in sweep.numbers().items():
        xs = [value for value, measured, _ in found if measured is not None]
        ys = [measured for _, measured, _ in found if measured is not None]
        axes.plot(xs, ys, label=title, **figures.marker(looks[title]), **figures.line_style(looks[title], thin=True))
    rows = [row for found in sweep.numbers().values() for row in found]
    theory = {value: expected for value, _, expected in rows if expected is not None}
    axes.plot(list(theory), list(theory.values()), color="#999999", linestyle=":", label="theory")
    unit = f", {sweep.measured.unit}" if sweep.measured.unit else ""
    axes.set(title=f"{sweep.measured.title}{unit}", xlabel=sweep.parameter)


def _digits(value: float | None) -> str:
    return "none" if value is None else numbers.digits(value, 5)
