"""The drawn figures of the lab on friction; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board, floor
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Rectangle


def crate(figure: Figure) -> None:
    """A push that leans on a crate.

    A crate stands on a level floor. Its weight m g points down. A push F points forward and down, at an angle a below
    the horizontal. The floor answers with the normal force N, which points up, and with friction along the floor,
    against the push.
    """
    axes = board(figure, (-3.2, 3.2), (-1.45, 2.1))
    floor(axes, -3.0, 3.0, -0.6)
    axes.add_patch(Rectangle((-0.8, -0.6), 1.6, 1.2, fc=LIGHT, ec=INK))
    axes.plot([-2.3, -0.8], [0.6, 0.6], ":", color=GREY)
    tip, angle = np.array([-0.8, 0.6]), np.radians(50)
    push = 1.35 * np.array([np.cos(angle), -np.sin(angle)])
    arrow(axes, tip - push, push, BLUE, "$F$", at=0.0, beside=(-9, 3))
    axes.add_patch(Arc((tip[0], tip[1]), 1.1, 1.1, theta1=130, theta2=180, color=GREY))
    axes.annotate("$a$", (-1.5, 0.8), color=GREY, ha="center", va="center")
    arrow(axes, (0.1, 0.0), (0, -0.95), INK, "$m g$", beside=(16, 2))
    arrow(axes, (-0.2, -0.6), (0, 2.2), ORANGE, "$N$", beside=(11, -2))
    arrow(axes, (0.8, -0.52), (-1.0, 0), ORANGE, "friction", at=0.0, beside=(28, 4))


def limit(figure: Figure) -> None:
    """Friction over the push on a body that was at rest.

    A plot of friction over push. Up to the limit of static friction, friction is exactly as large as the push, a
    straight line through zero, and the body rests. Beyond it the body slides, and friction drops to the lower level of
    kinetic friction and stays there.
    """
    axes = figure.add_subplot()
    axes.set(xlabel="push", ylabel="friction", xlim=(0, 9), ylim=(0, 6))
    axes.spines[["top", "right"]].set_visible(False)
    axes.plot([0, 5], [0, 5], color=BLUE, lw=2.2)
    axes.plot([5, 9], [3, 3], color=ORANGE, lw=2.2)
    axes.plot([5, 5], [5, 3], ":", color=GREY)
    axes.plot(5, 5, "o", color=BLUE)
    axes.plot(5, 3, "o", mfc="white", mec=ORANGE)
    axes.plot([0, 5], [5, 5], ":", color=GREY)
    axes.plot([0, 5], [3, 3], ":", color=GREY)
    axes.set(xticks=[], yticks=[3, 5], yticklabels=["$\\mu_k N$", "$\\mu_s N$"])
    axes.annotate("at rest: as large as the push", (2.3, 1.4), color=BLUE, va="center")
    axes.annotate("slides", (7, 3.4), color=ORANGE, ha="center", va="center")


def cones(figure: Figure) -> None:
    """Three shapes of the friction that a floor can give.

    Three drawings side by side: a circle of radius μN, a diamond with its corners on the axes at μN, and a square whose
    sides cross the axes at μN. In each the same velocity v points 30° above the x axis, and an arrow F_k shows
    friction. On the circle it is straight against v; on the diamond it points to the left corner, along the x axis; on
    the square to the lower left corner.
    """
    figure.set_figheight(2.1)
    angle = np.radians(30)
    v = np.array([np.cos(angle), np.sin(angle)])
    shapes = (
        ("circle", Circle((0, 0), 1.0, fc=LIGHT, ec=INK), -v),
        ("diamond", Polygon([(1, 0), (0, 1), (-1, 0), (0, -1)], fc=LIGHT, ec=INK), np.array([-1.0, 0.0])),
        ("square", Rectangle((-1, -1), 2, 2, fc=LIGHT, ec=INK), np.array([-1.0, -1.0])),
    )
    for place, (name, shape, friction) in enumerate(shapes):
        axes = figure.add_subplot(1, 3, place + 1)
        axes.set(xlim=(-1.45, 1.75), ylim=(-1.6, 1.5), aspect="equal")
        axes.set_axis_off()
        axes.add_patch(shape)
        axes.plot([-1.3, 1.3], [0, 0], ":", color=GREY, lw=1)
        axes.plot([0, 0], [-1.3, 1.3], ":", color=GREY, lw=1)
        arrow(axes, (0, 0), 1.45 * v, BLUE, "$v$", beside=(6, 5))
        arrow(axes, (0, 0), friction, ORANGE, "$F_k$", at=0.55, beside=(9, -9) if friction[1] else (0, 9))
        axes.annotate(name, (0, -1.5), ha="center", color=INK)


def bowling(figure: Figure) -> None:
    """A ball that slides over the floor and turns too slowly.

    A ball of radius r moves to the right with the velocity v and turns clockwise with ω, which is less than rolling.
    Its lowest point slips over the floor to the right with u. Friction acts there, to the left, at an arm r below the
    centre.
    """
    axes = board(figure, (-2.6, 3.2), (-1.55, 1.5))
    floor(axes, -2.4, 2.9, -1.0)
    axes.add_patch(Circle((0, 0), 1.0, fc=LIGHT, ec=INK))
    axes.plot(0, 0, "o", mfc="white", mec=INK, markersize=7, zorder=5)
    arrow(axes, (0, 0), (2.0, 0), INK, "$v$", beside=(9, 0))
    arrow(axes, (0, 0), (0, -1.0), GREY, "$r$", at=0.5, beside=(9, 0), style="--")
    arrow(axes, (0, -1.0), (1.3, 0), BLUE, "$u$", beside=(8, 6))
    arrow(axes, (0, -1.0), (-1.5, 0), ORANGE, "friction", at=0.75, beside=(0, 11))
    axes.add_patch(Arc((0, 0), 1.3, 1.3, theta1=60, theta2=150, color=GREY, lw=1.6))
    arrow(axes, (0.33, 0.56), (0.03, -0.018), GREY)
    axes.annotate("$\\omega$", (-0.12, 0.8), color=GREY, ha="center", va="center")


def leaving(figure: Figure) -> None:
    """A push that grows along a straight line until it leaves the circle of static friction.

    A circle of radius L, which is μ_s N. The push P begins at its middle and ends inside. From there its end moves
    along R t, a straight line, and leaves the circle at one point ahead. The same line met the circle in the past on
    its other side.
    """
    axes = board(figure, (-2.6, 2.6), (-1.75, 1.75))
    axes.add_patch(Circle((0, 0), 1.5, fc=LIGHT, ec=INK))
    push, rate = np.array([-0.1, -0.75]), np.array([0.75, 0.66])
    along, across = push @ rate, rate @ rate
    root = np.sqrt(along**2 + across * (1.5**2 - push @ push))
    out, past = push + rate * (root - along) / across, push - rate * (root + along) / across
    axes.plot(*np.transpose([past, push]), ":", color=GREY)
    arrow(axes, (0, 0), push, BLUE, "$P$", at=0.55, beside=(-10, 0))
    arrow(axes, push, out - push, ORANGE, "$R\\,t$", at=0.5, beside=(12, -8))
    axes.plot(*out, "D", color=ORANGE, zorder=6)
    axes.annotate("breaks away", (out[0] + 0.1, out[1] + 0.12), color=ORANGE, va="bottom")
    axes.plot(*past, "s", mfc="white", mec=GREY)
    axes.annotate("in the past", (past[0] - 0.12, past[1] - 0.1), color=GREY, ha="right")
    arrow(axes, (0, 0), 1.5 * np.array([-0.8, 0.6]), GREY, "$L$", at=0.5, beside=(6, 8), style="--")


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (crate, limit, cones, bowling, leaving)}
"""The figures by name."""
