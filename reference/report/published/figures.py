"""The figures of the published cases: measured oblique impacts, the rigid law, and what the implementations do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from reference.published.results import PublishedRow
from reference.published.rigid_law import rigid_sphere
from reference.report.figures import HEIGHT, STYLE, WIDTH, as_svg, colour_of, marker_of
from reference.report.published.tables import PublishedLine

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MEASURED = "Crosses are measured (Kharaz); the line is the law of a rigid sphere, with a kink where it stops gripping."
_SIZES = (13, 10, 7, 4)
"""Sizes of the implementations' markers, so that each shows around the next where their numbers coincide."""


class Panel(NamedTuple):
    """One figure. figure, angles: names of what is drawn, and of the angles against which it is drawn."""

    figure: str
    angles: str
    title: str
    limits: tuple[float, float]
    caption: str

    @property
    def name(self) -> str:
        """Of the figure's file."""
        return f"published-{self.figure.replace('_', '-')}"


PANELS = (
    Panel(
        "tangent_restitution",
        "angle",
        "Tangential speed after over before",
        (0.5, 1.02),
        f"{_MEASURED} All implementations follow it: 5/7 while it grips. None of them has the measured dip near 20°.",
    ),
    Panel(
        "spin",
        "angle_of_spin",
        "Spin after the impact, rad/s",
        (0.0, 680.0),
        f"{_MEASURED} Where the sphere grips, the real one spins faster: its contact yields sideways and swings back.",
    ),
)
"""Tangential restitution and spin of P11 against the angle."""


def oblique_impact(line: PublishedLine, place: int) -> str:
    """One of the panels, by its place, as SVG."""
    import matplotlib  # late: its import takes half a second, and a table needs none of it
    from matplotlib.figure import Figure

    panel = PANELS[place]
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": panel.name}):
        drawn = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        axes = drawn.add_subplot()
        _draw(axes, line, panel.figure, panel.angles, place)
        axes.set(title=panel.title, xlabel="angle from the normal, °", xlim=(0, 90), ylim=panel.limits)
        drawn.legend(loc="outside lower left", ncols=3, handlelength=2)
        return as_svg(drawn, panel.name)


def _draw(axes: Axes, line: PublishedLine, figure: str, angles: str, place: int) -> None:
    case = line.case
    every = np.linspace(1.0, 89.0, 441)
    axes.plot(every, rigid_sphere(case, every)[place], color="#999999", linewidth=1.6, label="rigid sphere")
    for size, (name, cell) in zip(_SIZES, line.cells.items(), strict=False):
        found = [(case.numbers(angles)[row.place - 1], value) for row, value in _measured(cell.rows, figure)]
        if found:
            look: dict[str, Any] = {"marker": marker_of(name), "color": colour_of(name), "linestyle": "none"}
            axes.plot(*zip(*found, strict=True), markersize=size, fillstyle="none", label=line.title(name), **look)
    axes.plot(case.numbers(angles), case.expected[figure], "x", color="#b3261e", markersize=8, label="measured")


def _measured(rows: tuple[PublishedRow, ...], figure: str) -> list[tuple[PublishedRow, float]]:
    """The rows of one figure that have a number, with it."""
    return [(row, row.measured) for row in rows if row.figure == figure and row.measured is not None]
