"""One parameter moved: small pictures of every value, a line over all of them, and a slider where there is a kernel."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from labs.desk.showing import DPI, Picture, Table, curve, tables
from reference.errors import InvalidInput, UnknownName
from reference.family import Quantity
from reference.report import figures, numbers
from reference.scenarios import find

if TYPE_CHECKING:
    from labs.desk.asking import Asked
    from reference.report.summary import Line

TIMESTEP = "timestep"
MOST = 8
"""Small pictures that still can be read."""
_SMALL = (2.3, 1.9)
"""Inches of one of them."""
_COLUMNS = 4
_TIMESTEPS = (1e-3, 2e-3, 1 / 240, 1 / 120)
"""s, where nothing was recorded at others."""
_SHORTEST = 1e-3
"""s; with shorter steps a sweep takes longer than one waits."""


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

    @property
    def heading(self) -> str:
        """The parameter with its unit."""
        grid = self.asked[0].family.grid
        units = {each.name: each.unit for each in grid.parameters} if grid else {}
        unit = "s" if self.parameter == TIMESTEP else units[self.parameter]
        return f"{self.parameter}, {unit}" if unit else self.parameter

    @property
    def titles(self) -> dict[str, str]:
        """The engines that were asked, as they are called; with the mark of a recording where one answered."""
        found: dict[str, str] = {}
        for line in self._lines():
            if line.result.recording or line.result.job.engine not in found:
                found[line.result.job.engine] = line.result.title
        return found

    def numbers(self, engine: str) -> list[tuple[float, float | None, float | None]]:
        """An engine's numbers: the parameter, what was measured, and what theory says."""
        found = []
        for value, asked in zip(self.values, self.asked, strict=True):
            lines = [line for line in asked.lines if line.result.job.engine == engine]
            row = next((row for line in lines for row in line.result.rows if row.quantity == self.measured.name), None)
            found.append((value, row.measured if row else None, row.expected if row else None))
        return found

    def theory(self) -> dict[float, float]:
        """What theory says, by the parameter's value; nothing where it says nothing."""
        rows = [row for engine in self.titles for row in self.numbers(engine)]
        return {value: expected for value, _, expected in rows if expected is not None}

    @property
    def table(self) -> Table:
        """Every implementation's numbers, one row a value."""
        columns, theory = [self.numbers(engine) for engine in self.titles], self.theory()
        rows = [
            (numbers.digits(value, 3), *(_digits(column[place][1]) for column in columns), _digits(theory.get(value)))
            for place, value in enumerate(self.values)
        ]
        unit = f", {self.measured.unit}" if self.measured.unit else ""
        title = f"{self.measured.title}{unit}, by {self.parameter}"
        lines = list(self._lines())
        notes = [f"{line.result.title}: {line.note}" for line in lines if line.note]
        recorded = dict.fromkeys(line.result.title for line in lines if line.result.recording)
        notes += [f"{', '.join(recorded)}: recorded earlier, which is quicker than a run."] * bool(recorded)
        notes += [asked.snapped for asked in self.asked]
        headings = (self.heading, *self.titles.values(), "theory")
        return Table(title, headings, tuple(rows), tuple(dict.fromkeys(note for note in notes if note)))

    def _lines(self) -> Iterator[Line]:
        return (line for asked in self.asked for line in asked.lines)

    @property
    def picture(self) -> Picture:
        """A small picture for each value, and one of what was measured over all of them."""
        import matplotlib
        from matplotlib.figure import Figure

        shown = [(value, asked) for value, asked in zip(self.values, self.asked, strict=True) if _has_curve(asked)]
        count = len(shown) + 1
        columns, rows = min(count, _COLUMNS), -(-count // _COLUMNS)
        with matplotlib.rc_context(figures.STYLE | {"font.size": 8, "axes.titlesize": 8}):
            size = (_SMALL[0] * columns, _SMALL[1] * rows + 0.4)
            figure = Figure(figsize=size, layout="constrained", dpi=DPI)
            places = figure.subplots(rows, columns, squeeze=False).flat
            for axes, (value, asked) in zip(places, shown, strict=False):
                _draw(axes, asked, self.titles)
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


def values_of(scenario: str, parameter: str, values: Sequence[float] | float = ()) -> list[float]:
    """The values that are run: those given, or some of those that were recorded.

    Raises
    ------
    UnknownName, InvalidInput
        If the scenario has no such parameter, or too many values are given to be seen side by side.
    """
    values = [values] if isinstance(values, int | float) else values
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
        recorded = [value for value in grid.timesteps if value >= _SHORTEST] if grid else []
        return recorded or list(_TIMESTEPS)
    assert grid is not None
    known = next(each.values for each in grid.parameters if each.name == parameter)
    chosen = range(0, len(known), max(1, -(-len(known) // (MOST - 2))))
    return [known[place] for place in chosen]


def slide(sweep: Sweep) -> None:
    """A slider over the runs, where somebody can move it; the pictures above stay for where nobody can."""
    try:
        import ipywidgets  # noqa: PLC0415 - without it there is the static picture
    except ImportError:
        return
    from IPython.display import display  # noqa: PLC0415

    if not _somebody_is_there():
        return

    def show(value: float) -> None:
        asked = sweep.asked[sweep.values.index(value)]
        shown: list[Any] = [curve(asked), tables(asked, [sweep.measured.name])[0]]
        display(*(each for each in shown if each is not None))  # type: ignore[no-untyped-call]

    options = [(numbers.digits(value, 3), value) for value in sweep.values]
    slider = ipywidgets.SelectionSlider(options=options, description=sweep.parameter, continuous_update=False)
    ipywidgets.interact(show, value=slider)


def _somebody_is_there() -> bool:
    """Whether a person runs the notebook: who only executes it can be asked nothing, and some wait for the widget."""
    from IPython import get_ipython  # noqa: PLC0415

    return bool(getattr(getattr(get_ipython(), "kernel", None), "_allow_stdin", False))


def _has_curve(asked: Asked) -> bool:
    return any(line.result.series is not None for line in asked.lines)


def _draw(axes: Any, asked: Asked, titles: Mapping[str, str]) -> None:
    for line in asked.lines:
        series = line.result.series
        if series is not None:
            label = titles[line.result.job.engine]
            axes.plot(series.times, series.values, label=label, **figures.line_style(line))


def _draw_measured(axes: Any, sweep: Sweep) -> None:
    looks = {line.result.job.engine: line for asked in sweep.asked for line in asked.lines}
    for engine, title in sweep.titles.items():
        found = [(value, measured) for value, measured, _ in sweep.numbers(engine) if measured is not None]
        look = {**figures.marker(looks[engine]), **figures.line_style(looks[engine], thin=True)}
        axes.plot([value for value, _ in found], [measured for _, measured in found], label=title, **look)
    theory = sweep.theory()
    axes.plot(list(theory), list(theory.values()), color="#999999", linestyle=":", label="theory")
    unit = f", {sweep.measured.unit}" if sweep.measured.unit else ""
    axes.set(title=f"{sweep.measured.title}{unit}", xlabel=sweep.heading)
    axes.locator_params(axis="x", nbins=4)


def _digits(value: float | None) -> str:
    return "none" if value is None else numbers.digits(value, 5)
