"""The figure of the published cases: measured oblique impacts, the rigid law, and what the implementations do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from reference.published.friction import rigid_sphere
from reference.published.judging import PublishedRow
from reference.report.figures import COLOURS, HEIGHT, MARKERS, STYLE, WIDTH, as_svg
from reference.report.published_summary import PublishedLine

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CAPTION = (
    "Oblique impacts of an alumina sphere on glass: measured (Kharaz), by the law of a rigid sphere, and in the"
    " implementations. Angles are from the normal. All of them follow the rigid law; the measured dip near 20° is none"
    " of theirs: a real contact yields sideways and swings back."
)
_PANELS = (
    ("tangent_restitution", "angle", "tangential speed after over before"),
    ("spin", "angle_of_spin", "spin after, rad/s"),
)


def oblique_impacts(line: PublishedLine) -> str:
    """P11 in two panels against the angle, tangential restitution and spin, as SVG."""
    import matplotlib  # late: half a second that a table need not wait for
    from matplotlib.figure import Figure

    name = "published-oblique-impacts"
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": name}):
        figure = Figure(figsize=(2 * WIDTH, HEIGHT), layout="constrained")
        panels = figure.subplots(1, 2)
        for place, (axes, panel) in enumerate(zip(panels, _PANELS, strict=True)):
            _draw(axes, line, *panel, place)
        handles = panels[0].get_legend_handles_labels()
        figure.legend(*handles, loc="outside lower left", ncols=3, handlelength=3)
        return as_svg(figure, name)


def _draw(axes: Axes, line: PublishedLine, figure: str, angles: str, title: str, place: int) -> None:
    case = line.case
    every = np.linspace(1.0, 89.0, 441)
    axes.plot(every, rigid_sphere(case, every)[place], color="#999999", linewidth=1.6, label="rigid sphere")
    for size, (name, cell) in zip((13, 10, 7, 4), line.cells.items(), strict=False):
        found = [(case.values(angles)[row.place - 1], value) for row, value in _measured(cell.rows, figure)]
        if found:
            colour = COLOURS.get(name, "#cc79a7")
            look: dict[str, Any] = {"marker": MARKERS.get(name, "v"), "color": colour, "linestyle": "none"}
            axes.plot(*zip(*found, strict=True), markersize=size, fillstyle="none", label=line.title(name), **look)
    axes.plot(case.values(angles), case.expected[figure], "x", color="#b3261e", markersize=8, label="measured")
    axes.set(title=title, xlabel="angle from the normal, °", xlim=(0, 90), ylim=(0, None))


def _measured(rows: tuple[PublishedRow, ...], figure: str) -> list[tuple[PublishedRow, float]]:
    """The rows of one figure that have a number, with it."""
    return [(row, row.measured) for row in rows if row.figure == figure and row.measured is not None]
