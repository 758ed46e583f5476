"""One parameter is moved: a small picture at every value, a line over all of them, and a slider in a live notebook."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from labs.desk.display import curve
from labs.desk.tables import Table, absent, capital, tables
from reference.catalogue.family import Quantity
from reference.catalogue.scenarios import find
from reference.errors import InvalidInput, UnknownName
from reference.report import numbers

if TYPE_CHECKING:
    from labs.desk.case_runs import CaseRuns
    from reference.report.sections import Line

TIMESTEP = "timestep"
MOST = 8
"""The most small pictures that can still be read side by side."""
_TIMESTEPS = (1e-3, 2e-3, 1 / 240, 1 / 120)
"""Timesteps in s for a family of which no others were recorded."""
_SHORTEST = 1e-3
"""s; with shorter timesteps a sweep takes longer than a student waits."""
_DECADES = 10.0
"""Values of which the largest is at least so many times the smallest above zero are drawn at equal distances."""


@dataclass(frozen=True)
class Sweep:
    """Runs over the values of one parameter.

    cases: the runs at each value. quantity: what is measured; the family's first if empty. predicted: what the student
    expected of it; empty without a prediction.
    """

    parameter: str
    values: tuple[float, ...]
    cases: tuple[CaseRuns, ...]
    quantity: str = ""
    predicted: str = ""

    @property
    def measured(self) -> Quantity:
        """What the table and the large picture show."""
        family = self.cases[0].family
        return family.quantity(self.quantity) if self.quantity else family.quantities[0]

    @property
    def unit(self) -> str:
        """The parameter's unit; empty for a pure number."""
        grid = self.cases[0].family.grid
        units = {each.name: each.unit for each in grid.parameters} if grid else {}
        return "ms" if self.parameter == TIMESTEP else units[self.parameter]

    def shown(self, value: float) -> float:
        """A value of the parameter in that unit."""
        return 1000 * value if self.parameter == TIMESTEP else value

    @property
    def heading(self) -> str:
        """The parameter with its unit."""
        return f"{self.parameter}, {self.unit}" if self.unit else self.parameter

    @property
    def spread(self) -> bool:
        """Whether the values span decades, so that on an even scale most of them would lie on each other."""
        some = [abs(value) for value in self.values if value]
        return len(some) > 1 and max(some) >= _DECADES * min(some)

    @property
    def titles(self) -> dict[str, str]:
        """The titles of the engines that ran, with the mark of a recording if one answered at any value."""
        found: dict[str, str] = {}
        for line in self._lines():
            if line.result.recording or line.result.job.engine not in found:
                found[line.result.job.engine] = line.result.title
        return found

    def numbers(self, engine: str) -> list[tuple[float, float | None, float | None]]:
        """An engine's numbers: the parameter, what was measured, and what theory says."""
        found = []
        for value, runs in zip(self.values, self.cases, strict=True):
            lines = [line for line in runs.lines if line.result.job.engine == engine]
            row = next((row for line in lines for row in line.result.rows if row.quantity == self.measured.name), None)
            found.append((value, row.measured if row else None, row.expected if row else None))
        return found

    def theory(self) -> dict[float, float]:
        """What theory says, by the parameter's value; nothing where it says nothing."""
        rows = [row for engine in self.titles for row in self.numbers(engine)]
        return {value: expected for value, _, expected in rows if expected is not None}

    @property
    def table(self) -> Table:
        """Every implementation's numbers, with one row per value."""
        columns, theory = [self.numbers(engine) for engine in self.titles], self.theory()
        rows = []
        for place, value in enumerate(self.values):
            found = [column[place][1] for column in columns]
            rows.append((numbers.digits(self.shown(value), 3), *map(_digits, (*found, theory.get(value)))))
        unit = f", {self.measured.unit}" if self.measured.unit else ""
        title = f"{capital(self.measured.title)}{unit}, by {self.parameter}"
        lines = list(self._lines())
        notes = [f"You predicted {self.predicted}."] * bool(self.predicted)
        notes += [absent(line) for line in lines if line.note]
        recorded = dict.fromkeys(line.result.title for line in lines if line.result.recording)
        notes += [f"{', '.join(recorded)}: recorded earlier, which is quicker than a run."] * bool(recorded)
        notes += [runs.snapped for runs in self.cases]
        headings = (self.heading, *self.titles.values(), "theory")
        return Table(title, headings, tuple(rows), tuple(dict.fromkeys(note for note in notes if note)))

    def _lines(self) -> Iterator[Line]:
        return (line for runs in self.cases for line in runs.lines)

    def value(self, value: float) -> str:
        """The parameter at a value, with its unit: `arm 0.1 m`, `timestep 2 ms`."""
        return " ".join(part for part in (self.parameter, numbers.digits(self.shown(value), 3), self.unit) if part)


def point(scenario: str, parameter: str, value: float) -> dict[str, float]:
    """Where a run of a sweep is: the value, and the other parameters of the case if the sweep names one."""
    family, case = find(scenario)
    names = family.grid.names if family.grid and case else ()
    others = {name: case.parameters[name] for name in names if name in case.parameters} if case else {}
    return others | {parameter: value}


def values_of(scenario: str, parameter: str, values: Sequence[float] | float = ()) -> list[float]:
    """The values to run: those given, or a selection of the recorded ones.

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
        return _some([value for value in grid.timesteps if value >= _SHORTEST] if grid else _TIMESTEPS)
    assert grid is not None
    return _some(next(each.values for each in grid.parameters if each.name == parameter))


def _some(values: Sequence[float]) -> list[float]:
    """An even selection of many values, as many as are seen well."""
    return list(values[:: max(1, -(-len(values) // (MOST - 2)))])


def slide(sweep: Sweep) -> None:
    """Show a slider over the runs if somebody can move it; elsewhere the pictures above must do."""
    try:
        import ipywidgets  # noqa: PLC0415 - without it there is the static picture
    except ImportError:
        return
    from IPython.display import display  # noqa: PLC0415

    if not _somebody_is_there():
        return

    def show(value: float) -> None:
        runs = sweep.cases[sweep.values.index(value)]
        shown: list[Any] = [curve(runs), tables(runs, [sweep.measured.name])]
        display(*(each for each in shown if each is not None))  # type: ignore[no-untyped-call]

    options = [(sweep.value(value).removeprefix(f"{sweep.parameter} "), value) for value in sweep.values]
    slider = ipywidgets.SelectionSlider(options=options, description=sweep.parameter, continuous_update=False)
    if hasattr(slider, "_repr_mimebundle_"):
        display(_Slider(ipywidgets.interactive(show, value=slider)))  # type: ignore[no-untyped-call]
    else:  # ipywidgets 7
        ipywidgets.interact(show, value=slider)


class _Slider:
    """A widget with a text in its place where it cannot be shown, as in a page made from the notebook."""

    def __init__(self, widget: Any) -> None:
        self._widget = widget

    def _repr_mimebundle_(self, **named: Any) -> dict[str, Any]:
        return {**self._widget._repr_mimebundle_(**named), "text/plain": "[a slider, where the notebook runs]"}


def _somebody_is_there() -> bool:
    """Whether a person runs the notebook. A program that executes it moves no slider, and may wait for the widget."""
    from IPython import get_ipython  # noqa: PLC0415

    return bool(getattr(getattr(get_ipython(), "kernel", None), "_allow_stdin", False))


def _digits(value: float | None) -> str:
    return "none" if value is None else numbers.quantity(value, "")
