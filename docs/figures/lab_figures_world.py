"""The drawn figures of the lab on the whole world; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board, unit
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle


def tumbling(figure: Figure) -> None:
    """The angular momentum stays while the body and its spin turn.

    The same long box twice, before and after a turn. The arrow L has the same direction and length in both. The arrow ω
    does not lie along L. It lies between L and the long axis of the box, and has moved along with the box.
    """
    for axes, angle, name in zip(figure.subplots(1, 2), (25, 65), ("before", "after"), strict=True):
        axes.set(xlim=(-2, 2), ylim=(-1.7, 1.9), aspect="equal")
        axes.set_axis_off()
        corners = np.array([[-1.3, -0.35], [1.3, -0.35], [1.3, 0.35], [-1.3, 0.35]])
        turn = np.array([unit(angle), unit(angle + 90)])
        axes.add_patch(Polygon(corners @ turn, fc=LIGHT, ec=INK, lw=1.6))
        momentum = 1.5 * unit(90)
        own = turn @ momentum / np.array([0.6, 1.8])
        arrow(axes, (0, 0), momentum, ORANGE, "$L$", at=0.9, beside=(-11, 0))
        arrow(axes, (0, 0), 0.75 * own @ turn, BLUE, "$\\omega$", at=0.9, beside=(12, 0))
        axes.annotate(name, (0, -1.6), ha="center", color=GREY, size=10)


def reach(figure: Figure) -> None:
    """A turned rectangle, and the box along the axes around it.

    A rectangle with the half edges h and k is turned by the angle a. The dashed box along the axes touches its four
    corners. Half the width of the box is the sum of two pieces, one of each edge, drawn one after the other from the
    middle to the right.
    """
    axes = board(figure, (-2.9, 2.9), (-2.0, 2.0))
    h, k, angle = 1.7, 0.8, 28
    turn = np.array([unit(angle), unit(angle + 90)])
    corners = np.array([[-h, -k], [h, -k], [h, k], [-h, k]]) @ turn
    far = np.max(corners, axis=0)
    axes.add_patch(Rectangle(-far, *(2 * far), fc="none", ec=ORANGE, ls="--", lw=1.6))
    axes.add_patch(Polygon(corners, fc=LIGHT, ec=INK, lw=1.6))
    arrow(axes, (0, 0), h * turn[0], INK, "$h$", at=0.6, beside=(-4, 10))
    arrow(axes, (0, 0), k * turn[1], INK, "$k$", at=0.6, beside=(-10, 0))
    first = h * np.cos(np.radians(angle))
    arrow(axes, (0, 0), (first, 0), BLUE)
    arrow(axes, (first, 0), (far[0] - first, 0), ORANGE, "reach", at=0.0, beside=(0, -12))


def plank(figure: Figure) -> None:
    """A plank on two trestles, pushed at one end.

    A plank touches two trestles at the distance d to the left and to the right of its middle. A unit force pushes up at
    the right one. The push moves the whole plank upwards, an arrow at each end. It also turns the plank: the arrow of
    the turn points up at the right end, and down at the left end.
    """
    axes = board(figure, (-3.0, 3.0), (-1.5, 1.7))
    axes.add_patch(Rectangle((-2.3, -0.12), 4.6, 0.24, fc=LIGHT, ec=INK, lw=1.6))
    for x in (-1.7, 1.7):
        axes.add_patch(Polygon([(x, -0.12), (x - 0.25, -0.8), (x + 0.25, -0.8)], fc="none", ec=GREY, lw=1.6))
    arrow(axes, (1.7, -1.4), (0, 1.2), ORANGE, "1 N", at=0.1, beside=(16, 0))
    for x, turning in ((-1.7, -1.0), (1.7, 0.8)):
        arrow(axes, (x - 0.15, 0.15), (0, 0.5), INK, "moves", at=1.0, beside=(-4, 9))
        arrow(axes, (x + 0.2, 0.15), (0, turning), BLUE, "turns", at=1.0, beside=(20, 4))
    arrow(axes, (0, 0.3), (1.7, 0), GREY, "$d$", at=0.5, beside=(0, 8), style="--")
    axes.plot(0, 0, "o", color=INK, markersize=6)


def timeline(figure: Figure) -> None:
    """The order of one step.

    Five boxes from left to right, with arrows between them: contacts, where the step begins; impacts, with the old
    velocities; loads, weight and forces for the time dt; rest, impulses so that nothing sinks in; motion, with the new
    velocities. The two boxes in the middle, loads and rest, have the velocities of the end of the step.
    """
    axes = board(figure, (-3.4, 3.4), (-0.9, 0.9))
    parts = (("contacts", "where it begins"), ("impacts", "old velocities"), ("loads", "for dt"), ("rest", "impulses"),
             ("motion", "new velocities"))  # fmt: skip
    for number, (name, words) in enumerate(parts):
        x = -3.3 + 1.36 * number
        axes.add_patch(
            Rectangle((x, -0.3), 1.14, 0.6, fc=LIGHT, ec=ORANGE if name in ("impacts", "rest") else INK, lw=1.6)
        )
        axes.annotate(name, (x + 0.57, 0.05), ha="center", va="center", weight="bold", size=9)
        axes.annotate(words, (x + 0.57, -0.55), ha="center", va="center", color=GREY, size=8)
        if number < len(parts) - 1:
            arrow(axes, (x + 1.16, 0), (0.18, 0), INK)


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (tumbling, reach, plank, timeline)}
"""The figures by name."""
