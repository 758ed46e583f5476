"""The drawn figures of the lab on spring meshes; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, ORANGE, Draw, arrow, board, unit
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle
from numpy.typing import ArrayLike, NDArray


def spring(figure: Figure) -> None:
    """A stretched spring between two nodes, with its length, its length at rest, and the unit vector u.

    Two nodes with a spring between them, drawn as a zigzag of the length L. The unit vector u at end 1 points from end
    2 to end 1, away from the spring. Above is the shorter length at rest, L_0.
    """
    axes = board(figure, (-3.3, 3.3), (-1.0, 1.45))
    second, first = np.array([-2.1, -0.2]), np.array([1.9, 0.35])
    along = (first - second) / np.linalg.norm(first - second)
    _zigzag(axes, second, first)
    for place, name, beside in ((first, "end 1", (4, 18)), (second, "end 2", (-4, 18))):
        axes.plot(*place, "o", color=INK, markersize=11, zorder=6)
        axes.annotate(name, place, beside, textcoords="offset points", ha="center", va="center")
    arrow(axes, first, 0.95 * along, INK, "$u$", at=0.75, beside=(2, -13))
    _length(axes, second + np.array([-0.07, 0.5]), second + 2.6 * along + np.array([-0.07, 0.5]), "$L_0$ at rest")
    _length(axes, second + np.array([-0.12, 0.85]), first + np.array([-0.12, 0.85]), "$L$")


def parts(figure: Figure) -> None:
    """The velocity of end 1, split into a part along the edge and a part across it.

    End 2 rests. End 1 moves with the velocity v, at the angle α to the direction u of the edge. Dashed lines split v
    into a part along the edge, which changes its length, and a part across it, which turns the edge.
    """
    axes = board(figure, (-2.9, 3.4), (-0.75, 1.85))
    second, first = np.array([-2.3, 0.0]), np.array([0.9, 0.0])
    _zigzag(axes, second, first)
    for place, name in ((first, "end 1"), (second, "end 2, at rest")):
        axes.plot(*place, "o", color=INK, markersize=11, zorder=6)
        axes.annotate(name, place, (0, -19), textcoords="offset points", ha="center", va="center")
    v = np.array([1.35, 1.2])
    arrow(axes, first, v, BLUE, "$v$", at=0.6, beside=(-12, 6))
    arrow(axes, first, np.array([v[0], 0]), ORANGE, "changes the length", at=0.5, beside=(46, -11))
    arrow(axes, first, np.array([0, v[1]]), GREY, "turns the edge", at=0.75, beside=(-46, 2))
    axes.plot([first[0] + v[0]] * 2, [0, v[1]], "--", color=GREY, lw=1.1)
    axes.plot([first[0], first[0] + v[0]], [v[1]] * 2, "--", color=GREY, lw=1.1)
    axes.add_patch(Arc(first, 1.0, 1.0, theta1=0, theta2=float(np.degrees(np.arctan2(v[1], v[0]))), lw=1.3))
    axes.annotate("$\\alpha$", first, (31, 10), textcoords="offset points", ha="center", va="center")


def modes(figure: Figure) -> None:
    """A row of nodes slides along itself; a diagonal forbids it.

    On the left a block of three by three squares. The upper row of nodes has slid to the right, and the edges across
    lean: to first order no edge has changed its length. On the right the same block has a diagonal in one upper square,
    drawn thick and dashed. It would have to become longer, so that the row stays.
    """
    left, right = figure.subplots(1, 2)
    for axes, slid, text in ((left, 0.3, "no edge becomes longer"), (right, 0.0, "this one would")):
        axes.set(xlim=(-0.6, 3.7), ylim=(-0.85, 2.6), aspect="equal")
        axes.set_axis_off()
        grid = np.array([[[x + slid * (y == 2), y] for x in range(4)] for y in range(3)], dtype=float)
        for row in grid:
            axes.plot(*row.T, "-", color=INK, lw=1.5)
        for column in np.swapaxes(grid, 0, 1):
            axes.plot(*column.T, "-", color=INK, lw=1.5)
        axes.plot(*grid.reshape(-1, 2).T, "o", color=INK, markersize=6)
        axes.annotate(text, (1.5, -0.55), ha="center", va="center", color=GREY)
    for x in (0, 1.5, 3):
        arrow(left, (x + 0.12, 2.3), (0.5, 0), BLUE)
    right.plot([1, 2], [1, 2], "--", color=ORANGE, lw=3)
    right.annotate("a diagonal", (2.15, 2.35), ha="center", va="center", color=ORANGE)


def against(figure: Figure) -> None:
    """A node and its neighbours move against each other.

    A node in the middle of a row has moved by x to the right, and its two neighbours have moved by x to the left. Faint
    rings show where they were at rest. The spring on its right is shorter than at rest, and the one on its left longer.
    """
    axes = board(figure, (-3.3, 3.3), (-0.95, 0.95))
    rest, moved = np.array([-2.2, 0.0, 2.2]), np.array([-2.2 - 0.5, 0.5, 2.2 - 0.5])
    for start, end in ((0, 1), (1, 2)):
        _zigzag(axes, np.array([moved[start], 0.0]), np.array([moved[end], 0.0]))
    for before, after, name in zip(rest, moved, ("$-x$", "$x$", "$-x$"), strict=True):
        axes.add_patch(Circle((before, 0), 0.12, fc="none", ec=GREY, ls="--", lw=1.2))
        axes.plot(after, 0, "o", color=INK, markersize=11, zorder=6)
        arrow(axes, (before, 0.36), (after - before, 0), BLUE, name, at=0.5, beside=(0, 10))
    axes.annotate("longer", (-1.1, -0.5), ha="center", va="center", color=ORANGE)
    axes.annotate("shorter", (1.15, -0.5), ha="center", va="center", color=ORANGE)


def dent(figure: Figure) -> None:
    """An edge between two nodes on a ball cuts into it.

    A ball with its centre and the radius r. Two nodes lie on its surface, each with a normal n that points away from
    the centre, and a straight edge of length L joins them. The middle of the edge is below the surface.
    """
    axes = board(figure, (-2.6, 2.6), (-0.35, 2.35))
    centre, radius = np.array([0.0, 0.0]), 1.6
    axes.add_patch(Arc(centre, 2 * radius, 2 * radius, theta1=8, theta2=172, color=INK, lw=1.6))
    axes.plot(0, 0, "+", color=INK, markersize=9)
    places = [radius * unit(degrees) for degrees in (128, 52)]
    axes.plot(*np.array(places).T, "-", color=BLUE, lw=2.2)
    for place in places:
        axes.plot(*place, "o", color=INK, markersize=9, zorder=6)
        arrow(axes, place, 0.6 * place / radius, INK, "$n$", at=0.9, beside=(12 if place[0] > 0 else -12, 0))
    arrow(axes, centre, places[1], GREY, "$r$", at=0.5, beside=(9, -6), style="--")
    axes.annotate("$L$", (0, places[0][1]), (0, -11), textcoords="offset points", ha="center", va="center", color=BLUE)
    looks = {"arrowstyle": "<->", "color": ORANGE, "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (0.0, radius), (0.0, places[0][1]), arrowprops=looks)
    axes.annotate("inside", (0, radius), (0, 9), textcoords="offset points", ha="center", va="center", color=ORANGE)


def shares(figure: Figure) -> None:
    """A spring that is too long, and the ways of its two ends.

    Above, a spring between a small mass m_1 and a large mass m_2 is too long by x. Below, both ends have been drawn
    together until it is as long as it may be: the small one has moved farther, and their centre of mass, a cross, has
    stayed in place.
    """
    axes = board(figure, (-3.2, 3.2), (-1.35, 1.25))
    before, after = (-2.2, 2.2), (-0.95, 1.78)
    for height, ends in ((0.55, before), (-0.65, after)):
        _zigzag(axes, np.array([ends[0], height]), np.array([ends[1], height]))
        for x, size in zip(ends, (10, 18), strict=True):
            axes.plot(x, height, "o", color=INK, markersize=size, zorder=6)
        axes.plot(1.1, height, "X", color=ORANGE, markersize=9, zorder=7)
    axes.annotate("$m_1$", (before[0], 0.55), (0, 15), textcoords="offset points", ha="center", va="center")
    axes.annotate("$m_2$", (before[1], 0.55), (0, 18), textcoords="offset points", ha="center", va="center")
    axes.annotate("centre of mass", (1.1, 0.55), (0, 17), textcoords="offset points", ha="center", color=ORANGE)
    axes.plot([1.1, 1.1], [0.55, -0.65], ":", color=ORANGE, lw=1.3)
    for start, end in zip(before, after, strict=True):
        axes.plot([start, start], [0.4, -1.05], ":", color=GREY, lw=1.1)
        arrow(axes, (start, -1.05), (end - start, 0), BLUE)
    axes.annotate("far", (-1.6, -1.05), (0, -9), textcoords="offset points", ha="center", va="center", color=BLUE)
    axes.annotate("near", (2.0, -1.05), (0, -9), textcoords="offset points", ha="center", va="center", color=BLUE)


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (spring, parts, modes, against, dent, shares)}
"""The figures by name."""


def _zigzag(axes: Axes, start: NDArray[np.float64], end: NDArray[np.float64], teeth: int = 11) -> None:
    """A spring between two places."""
    along = end - start
    across = 0.11 * np.array([-along[1], along[0]]) / np.linalg.norm(along)
    shares_of_way = np.concatenate([[0, 0.15], np.linspace(0.18, 0.82, teeth), [0.85, 1]])
    sides = np.concatenate([[0, 0], np.where(np.arange(teeth) % 2, 1, -1), [0, 0]])
    places = start + shares_of_way[:, None] * along + sides[:, None] * across
    axes.plot(*places.T, "-", color=GREY, lw=1.6, zorder=2)


def _length(axes: Axes, start: ArrayLike, end: ArrayLike, text: str) -> None:
    """A length between two points, with its name above."""
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    looks = {"arrowstyle": "<->", "color": GREY, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=looks)
    axes.annotate(text, (start + end) / 2, (0, 8), textcoords="offset points", ha="center", va="center")
