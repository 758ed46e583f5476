"""Figures of the report: the trajectories of one case together, and error against timestep.

Engines differ by colour and marker and profiles by line style, so that colour is never the only difference. Text stays
text, and the file holds no date and no random name: the same numbers give the same bytes.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from reference.engines.profiles import EXACT, JOINT, SPRING, STEP, STOCK, TUNED, WORLD, counts
from reference.report import numbers
from reference.report.sections import Line, Section

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH, HEIGHT = 5.8, 3.9
"""Size of a figure, inches: two fit side by side on a desktop screen, one fills a phone."""
COLOURS = {"handwritten": "#1b1b1b", "pybullet": "#0072b2", "mujoco": "#d55e00", "dart": "#009e73"}
_STROKES = {"handwritten": (5.0, 0.35), "pybullet": (3.2, 1.0), "mujoco": (1.9, 1.0), "dart": (0.8, 1.0)}
"""Width in points and opacity of curves that count: where they coincide, each still shows on both sides of the next."""
MARKERS = {"handwritten": "o", "pybullet": "s", "mujoco": "^", "dart": "D"}
_OTHER_COLOUR, _OTHER_MARKER = "#cc79a7", "v"
"""Those of an engine that is not the lab's own."""
_MARKER_DISTANCE, _STAGGER = 0.4, 0.05
"""Between the markers of a curve, and between the first markers of two curves, as shares of the axes' diagonal."""
_DASHES: dict[str, Any] = {
    EXACT: "-",
    TUNED: "-",
    WORLD: (0, (9, 1.5)),
    SPRING: (0, (6, 1.5, 1.2, 1.5)),
    JOINT: (0, (3, 1.2, 3, 3)),
    STEP: (0, (1, 1.6)),
    STOCK: (0, (1, 1.6)),
    "poisson": (0, (7, 2, 1.5, 2)),
    "stronge": (0, (5, 1.5, 1.2, 1.5, 1.2, 1.5)),
    "verlet": (0, (3, 1.2, 1, 1.2)),
    "explicit": (0, (1.5, 1.2)),
    "inertia box": (0, (3, 1.2)),
}
_OTHER_DASHES = (0, (5, 2))
_LONG = 36
"""Letters of an entry from which on a legend is small."""
_BELOW = 4
"""How far below the smallest error above rounding, as a factor, errors of rounding are drawn."""
STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "font.size": 10,
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 11,
    "axes.titlelocation": "left",
    "legend.frameon": False,
    "legend.fontsize": 9,
}


def trajectories(section: Section) -> str:
    """The family's curve in every implementation that ran its case, as SVG; empty where none did."""
    curve, plotted = section.family.curve, [line for line in section.lines if line.result.series is not None]

    def draw(axes: Axes, line: Line) -> str:
        series = line.result.series
        assert series is not None
        sparse = staggered(len(axes.get_lines())) if series.times else {}
        axes.plot(*series.dense(), **sparse, **marker(line), **line_style(line))
        return line.title

    labels = {"title": curve.title, "xlabel": "time, s", "ylabel": curve.y_label}
    return _figure(f"{section.family.name}-trajectories", plotted, draw, labels)


def convergence(section: Section) -> str:
    """Error against timestep, log–log, with the measured orders in the legend, as SVG; empty where none was studied.

    Errors that are only rounding would flatten all other lines, and so they are drawn along the lower edge.
    """
    study = section.family.convergence
    quantity = section.family.quantity(study.quantity)
    plotted = section.studied
    studies = [line.result.convergence for line in plotted if line.result.convergence]
    sizes = [error for errors in studies if errors.order is not None for error in errors.errors if error > 0]
    edge = min(sizes, default=1e-15) / _BELOW

    def draw(axes: Axes, line: Line) -> str:
        errors = line.result.convergence
        assert errors is not None
        shown = errors.errors if errors.order is not None else [edge] * len(errors.errors)
        axes.loglog(errors.timesteps, shown, **marker(line), **line_style(line, thin=True))
        return f"{line.title}: {line.order}"

    unit = f", {quantity.unit}" if quantity.unit else ""
    title = f"Error of the {quantity.title}, {study.case}"
    labels = {"title": title, "xlabel": "timestep, s", "ylabel": f"root mean square error{unit}"}
    return _figure(f"{section.family.name}-convergence", plotted, draw, labels, edge)


def _figure(
    name: str,
    lines: Sequence[Line],
    draw: Callable[[Axes, Line], str],
    labels: dict[str, str],
    lower_edge: float | None = None,
) -> str:
    """Draw lines, those that count on top, with a legend below in the order of the tables: an SVG with its own ids."""
    if not lines:
        return ""
    import matplotlib  # late: its import takes half a second, and a table needs none of it
    from matplotlib.figure import Figure

    with matplotlib.rc_context(STYLE | {"svg.hashsalt": name}):
        figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        axes = figure.add_subplot()
        drawn = {}
        for line in sorted(lines, key=lambda line: line.counts):
            label = draw(axes, line)
            drawn[line.title] = axes.get_lines()[-1], label
        axes.set(**labels)
        if lower_edge is not None:
            _label_with_powers(axes)
            axes.set_ylim(bottom=lower_edge / 1.5)
            axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
            axes.set_axisbelow(True)
        handles, texts = zip(*(drawn[line.title] for line in lines), strict=True)
        small = {"fontsize": 8} if max(map(len, texts)) > _LONG else {}
        figure.legend(handles, texts, loc="outside lower left", ncols=2, handlelength=3, **small)
        return as_svg(figure, name)


def as_svg(figure: Figure, name: str) -> str:
    """The SVG element of a figure, with ids of its own, so that one page can hold several figures."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata=dict.fromkeys(("Date", "Creator", "Format", "Type")))
    return _own_ids(text.getvalue(), name)


def _label_with_powers(axes: Axes) -> None:
    """Write the powers of ten on logarithmic axes as plain text: matplotlib's typesetting would take half the time."""
    from matplotlib.ticker import LogFormatter

    class Powers(LogFormatter):
        def __call__(self, value: float, pos: int | None = None) -> str:
            chosen = super().__call__(value, pos)  # it labels fewer ticks where there are many
            return numbers.power_of_ten(value) if chosen else ""

    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(Powers())
        axis.set_minor_formatter(Powers(minor_thresholds=(1, 0.4)))


def marker(line: Line) -> dict[str, Any]:
    """How a line's points are drawn: with the engine's own shape, hollow where the profile does not count."""
    style = {"marker": marker_of(line.result.job.engine), "markersize": 5}
    return style if line.counts else style | {"markerfacecolor": "white"}


def colour_of(engine: str) -> str:
    """The colour of an engine's curves."""
    return COLOURS.get(engine, _OTHER_COLOUR)


def marker_of(engine: str) -> str:
    """The shape of an engine's points, in matplotlib's words."""
    return MARKERS.get(engine, _OTHER_MARKER)


def staggered(number: int) -> dict[str, Any]:
    """Few markers on a curve; those of the next curve come a little later, so that no marker hides another."""
    return {"markevery": (_STAGGER * number, _MARKER_DISTANCE)}


def line_style(line: Line, thin: bool = False, as_counted: bool = False) -> dict[str, Any]:
    """The engine's colour and the profile's dashes; curves that count are wide, so that coinciding ones show."""
    engine, profile = line.result.job.engine, TUNED if as_counted else line.result.job.profile
    style = {"color": colour_of(engine), "linestyle": _DASHES.get(profile, _OTHER_DASHES)}
    if thin or not counts(profile):
        return style | {"linewidth": 1.3}
    width, opacity = _STROKES.get(engine, (1.5, 1.0))
    return style | {"linewidth": width, "alpha": opacity}


def _own_ids(text: str, name: str) -> str:
    """The SVG element alone, its ids prefixed, its numbers short; of lines only those in the legend keep their ids."""
    # A hundredth of a point is not seen. The labels between the tags keep their digits.
    svg = re.sub(r">[^<]*<|(\.\d\d)\d+", lambda found: found[1] or found[0], text[text.index("<svg") :])
    svg = re.sub(r'<g id="(?:text|patch|[xy]tick|matplotlib)[^"]*">', "<g>", svg)
    drawn, legend, explained = svg.partition('<g id="legend')
    svg = re.sub(r'<g id="line2d[^"]*">', "<g>", drawn) + legend + explained  # nothing refers to a line or a tick
    for number, long in enumerate(re.findall(r'\bid="([mp][0-9a-f]{8,})"', svg)):  # of markers and clips
        svg = svg.replace(long, f"m{number}")
    svg = re.sub(r">\s+<", "><", _without_second_styles(svg))
    svg = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', svg)
    svg = re.sub(r'href="#([^"]+)"', rf'href="#{name}-\1"', svg)
    return re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", svg)


def _without_second_styles(svg: str) -> str:
    """The figure without the style of each use of a marker that repeats the marker's own."""
    own = dict(re.findall(r'<path id="([^"]+)"[^>]*?( style="[^"]*")', svg))
    use = re.compile(r'(<use xlink:href="#([^"]+)"[^>]*?)( style="[^"]*")')
    return use.sub(lambda it: it[1] if own.get(it[2]) == it[3] else it[0], svg)
