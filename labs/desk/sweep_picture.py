"""The picture of a sweep: what was measured over the parameter, and a small curve for every value."""

from __future__ import annotations

import io
import itertools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from labs.desk.display import DPI, Picture, look
from labs.desk.tables import capital
from reference.report import figures, numbers

if TYPE_CHECKING:
    from labs.desk.case_runs import CaseRuns
    from labs.desk.sweeps import Sweep

_LARGE, _SMALL, _ROWS = (3.6, 3.4), 1.75, 2
"""Size of the large picture and width of a small one, in inches, and the number of rows of small ones."""
_ALIKE = 10.0
"""All curves get the same scale if the largest range is at most so many times the smallest."""
_UNNAMED = "_"
"""The label of a line that a legend leaves out."""
_JUMP = 0.75
"""Two neighbouring numbers that differ by more than this share of their range are two, and no line joins them."""
_STEEP = 1.5
"""They do so only if they are that much steeper than the whole."""
_LEVEL = 1e-2
"""Numbers that all differ by less than this share of their size make no jump."""
_ROUNDING = 1e-9
"""A difference below this share of theory's range is rounding, of which no picture is made."""
_SEEN = 0.05
"""What lies nearer to theory than this share of theory's range cannot be told from it in a picture."""


def picture(sweep: Sweep) -> Picture:
    """What was measured over all values, and beside it a small picture of the curve for each."""
    import matplotlib
    from matplotlib.figure import Figure

    shown = [(value, runs) for value, runs in zip(sweep.values, sweep.cases, strict=True) if _has_curve(runs)]
    columns = -(-len(shown) // _ROWS)
    with matplotlib.rc_context(figures.STYLE | {"font.size": 8, "axes.titlesize": 9}):
        figure = Figure(figsize=(_LARGE[0] + _SMALL * columns, _LARGE[1]), layout="constrained", dpi=DPI)
        shares = [_LARGE[0], max(_SMALL * columns, 1e-3)]
        large, small = figure.subfigures(1, 2, width_ratios=shares, squeeze=False)[0]
        _draw_measured(large, sweep)
        if shown:
            _draw_curves(small, shown, sweep)
        large.legend(loc="outside lower left", ncols=4, handlelength=2, columnspacing=1, fontsize=8)
        content = io.BytesIO()
        figure.savefig(content, format="png")
    return Picture(content.getvalue(), f"[{sweep.measured.title} over {sweep.parameter}]")


def _has_curve(runs: CaseRuns) -> bool:
    return any(line.result.series is not None for line in runs.lines)


def _draw_curves(figure: Any, shown: Sequence[tuple[float, CaseRuns]], sweep: Sweep) -> None:
    columns = -(-len(shown) // _ROWS)
    places = figure.subplots(_ROWS, columns, squeeze=False, sharex=True, sharey=_are_alike(shown))
    for axes, (value, runs) in zip(places.flat, shown, strict=False):
        for line in runs.lines:
            if line.result.series is not None:
                axes.plot(line.result.series.times, line.result.series.values, **look(line))
        axes.set_title(sweep.value(value))
        axes.tick_params(labelbottom=True)
    for axes in places.flat[len(shown) :]:
        axes.set_axis_off()
    figure.suptitle(sweep.cases[0].family.curve.y_label, x=0.01, horizontalalignment="left", fontsize=9)
    figure.supxlabel("time, s", fontsize=8)


def _are_alike(shown: Sequence[tuple[float, CaseRuns]]) -> bool:
    """Whether all curves can be read on one scale."""
    series = [[line.result.series for line in runs.lines if line.result.series] for _, runs in shown]
    ranges = [max(max(each.values) for each in one) - min(min(each.values) for each in one) for one in series]
    return max(ranges) <= _ALIKE * min(ranges)


def _draw_measured(large: Any, sweep: Sweep) -> None:
    """What was measured over the parameter, and below it how far that is from theory where one sees no difference."""
    looks = {line.result.job.engine: line for runs in sweep.cases for line in runs.lines}
    theory = sweep.theory()
    measured = {
        engine: {value: number for value, number, _ in sweep.numbers(engine) if number is not None}
        for engine in sweep.titles
    }
    below = _lies_on_theory(measured, theory)
    panels = large.subplots(2, 1, sharex=True, height_ratios=(3, 2)) if below else [large.subplots()]
    places = {value: float(at) if sweep.spread else sweep.shown(value) for at, value in enumerate(sweep.values)}
    for engine, title in sweep.titles.items():
        style = {**figures.marker(looks[engine]), **look(looks[engine])}
        _draw_line(panels[0], places, measured[engine], sweep.spread, title, style)
        if below:
            off = {value: number - theory[value] for value, number in measured[engine].items()}
            _draw_line(panels[1], places, off, sweep.spread, _UNNAMED, style)
    grey = {"color": "#999999", "linestyle": ":", "marker": "_"}
    _draw_line(panels[0], places, theory, sweep.spread, "theory", grey)
    unit = f", {sweep.measured.unit}" if sweep.measured.unit else ""
    panels[0].set(title=f"{capital(sweep.measured.title)}{unit}")
    if below:
        panels[1].axhline(0, color="#999999", linestyle=":")
        panels[1].set_title(f"less theory{unit}", fontsize=8)
    panels[-1].set_xlabel(sweep.heading)
    if sweep.spread:
        panels[-1].set_xticks(list(places.values()), [numbers.digits(sweep.shown(value), 3) for value in places])
    else:
        panels[-1].locator_params(axis="x", nbins=6)


def _draw_line(
    axes: Any, places: dict[float, float], found: dict[float, float], spread: bool, label: str, style: dict[str, Any]
) -> None:
    """Draw numbers over the parameter, joined by a line except where they jump."""
    points = [(places[value], number) for value, number in found.items()]
    for piece in _pieces(points, spread):
        axes.plot(*zip(*piece, strict=True), label=label, **style)
        label = _UNNAMED  # a legend has the name once


def _pieces(points: Sequence[tuple[float, float]], spread: bool) -> list[list[tuple[float, float]]]:
    """Points in the pieces that a line may join: it does not cross a jump, which is no slope."""
    if not points:
        return []
    wide = max(x for x, _ in points) - min(x for x, _ in points)
    high = max(y for _, y in points) - min(y for _, y in points)
    if high <= _LEVEL * max(abs(y) for _, y in points):
        return [list(points)]
    pieces = [[points[0]]]
    for before, after in itertools.pairwise(points):
        rise, run = abs(after[1] - before[1]), after[0] - before[0]
        steep = spread or rise * wide > _STEEP * high * run
        jumps = rise > _JUMP * high and steep
        if jumps and len(points) > 2:
            pieces.append([])
        pieces[-1].append(after)
    return pieces


def _lies_on_theory(measured: dict[str, dict[float, float]], theory: dict[float, float]) -> bool:
    """Whether every number lies so near theory that a picture shows one line."""
    known = [(number, theory.get(value)) for found in measured.values() for value, number in found.items()]
    if len(theory) < 2 or any(expected is None for _, expected in known):
        return False
    high = max(theory.values()) - min(theory.values())
    off = [abs(number - expected) for number, expected in known if expected is not None]
    return _ROUNDING * high < max(off, default=0.0) <= _SEEN * high
