"""The drawn figures of the lab on responses; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board, floor
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

E, G = 0.5, 9.81


def mirror(figure: Figure) -> None:
    """A velocity before and after an impact, in two parts.

    A ball meets a plane with the unit normal N. Its velocity v points down and to the right, into the plane. It is the
    sum of a part along the plane and a part (v·N) N, which points against N. After the impact the velocity v' has the
    same part along the plane. Its part along N points out of the plane and is shorter, e times as long.
    """
    axes = board(figure, (-3.1, 3.4), (-0.5, 2.6))
    floor(axes, -2.9, 3.1, 0.0)
    v, after = np.array([1.7, -2.1]), np.array([1.7, 1.05])
    start = -v
    arrow(axes, start, v, BLUE, "$v$", at=0.5, beside=(12, 6))
    arrow(axes, start, (v[0], 0), GREY, "along the plane", at=0.35, beside=(-4, 9), style="--")
    arrow(axes, start, (0, v[1]), GREY, "$(v\\cdot N)\\,N$", at=0.45, beside=(-33, 0), style="--")
    arrow(axes, (0, 0), after, ORANGE, "$v'$", at=0.62, beside=(-8, 9))
    arrow(axes, (0, 0), (after[0], 0), GREY, "", style="--")
    axes.annotate("the same", (0.85, 0.17), color=GREY, ha="center", va="center", size=9)
    arrow(axes, (after[0], 0), (0, after[1]), GREY, "$-e\\,(v\\cdot N)\\,N$", at=0.5, beside=(43, 0), style="--")
    arrow(axes, (0, 0), (0, 1.7), INK, "$N$", beside=(9, -3))
    axes.add_patch(Circle((0, 0), 0.09, fc="white", ec=INK, zorder=6))


def racket(figure: Figure) -> None:
    """A ball and a racket that meet, from the ground and from the racket.

    Two drawings. In the upper one, seen from the ground, a ball flies to the left with v and a racket moves to the
    right with w. In the lower one, seen from the racket, the racket is at rest, the ball comes with v + w, and it
    leaves to the right with e (v + w).
    """
    axes = board(figure, (-4.3, 4.2), (-2.15, 1.6))
    for height, text in ((0.8, "from the\nground"), (-1.2, "from the\nracket")):
        axes.annotate(text, (-3.6, height), color=INK, ha="center", va="center", size=9)
        axes.add_patch(Rectangle((-1.6, height - 0.62), 0.16, 1.24, fc=GREY, ec=INK))
    _ball(axes, (1.6, 0.8))
    arrow(axes, (1.35, 0.8), (-1.3, 0), BLUE, "$v$", at=0.5, beside=(0, 9))
    arrow(axes, (-1.44, 0.8), (1.0, 0), INK, "$w$", at=0.5, beside=(0, 9))
    _ball(axes, (1.6, -0.9))
    arrow(axes, (1.35, -0.9), (-2.3, 0), BLUE, "$v + w$", at=0.45, beside=(0, 9))
    _ball(axes, (1.6, -1.55), style=":")
    arrow(axes, (1.85, -1.55), (1.15, 0), ORANGE, "$e\\,(v + w)$", at=0.5, beside=(0, 9))
    axes.annotate("after", (1.2, -1.55), color=GREY, ha="right", va="center", size=9)


def orders(figure: Figure) -> None:
    """Two orders of the same loop, step by step, beside the true rebound.

    Height over time around an impact. The true path is a curve that touches the floor and rises to e²h. Two rows of
    dots follow steps. Both fall below the floor to the same depth and turn around there. Squares, for respond first
    with the floor carrying the weight, rise beside the curve and end a little below its top. Triangles, for change v,
    move, respond, end far below its top.
    """
    axes = figure.add_subplot()
    dt, height = 0.05, 1.0
    speed = np.sqrt(2 * G * height)
    start = height - 0.02
    fall, top = speed / G, E * speed / G
    axes.axhspan(-0.3, 0, color=LIGHT)
    axes.axhline(0, color=INK, lw=1.5)
    times = np.linspace(0, fall + top, 400)
    true = np.where(times < fall, height - G * times**2 / 2, E * speed * (times - fall) - G * (times - fall) ** 2 / 2)
    axes.plot(times, true, color=GREY, lw=3, alpha=0.7)
    for style, colour, first in (("s-", BLUE, True), ("^--", ORANGE, False)):
        z, v, places = start, 0.0, [start]
        for _ in range(15):
            z, v = _respond_first(z, v, dt) if first else _respond_last(z, v, dt)
            places.append(z)
        shown = slice(5, 14)
        axes.plot(dt * np.arange(16)[shown], places[shown], style, color=colour, lw=1.2, markersize=5)
    axes.set(xlim=(0.24, 0.86), ylim=(-0.19, 0.42), xlabel="time", ylabel="height", xticks=[], yticks=[0, E**2])
    axes.set_yticklabels(["0", "$e^2 h$"])
    axes.spines[["top", "right"]].set_visible(False)
    axes.annotate("in truth", (0.545, 0.235), color=GREY, ha="right")
    axes.annotate("respond,\nchange $v$, move", (0.665, 0.15), color=BLUE, size=9)
    axes.annotate("change $v$, move,\nrespond", (0.665, 0.035), color=ORANGE, size=9)


def clamp(figure: Figure) -> None:
    """The force of a contact over an impact: a spring, with a damper, and with a clamp.

    Force over time. A dotted half wave is the spring alone. A solid curve, spring and damper, starts at once with a
    force of its own, is largest early, and falls below zero at the end, where a dashed piece is marked: it pulls. With
    the clamp the force ends where it reaches zero.
    """
    axes = figure.add_subplot()
    omega, zeta = 1.0, 0.3
    s = np.sqrt(1 - zeta**2)
    t = np.linspace(0, np.pi / s, 400)
    x = -np.exp(-zeta * t) * np.sin(s * t) / s
    v = -np.exp(-zeta * t) * (np.cos(s * t) - zeta / s * np.sin(s * t))
    force = -(omega**2) * x - 2 * zeta * omega * v
    push = force >= 0
    axes.axhline(0, color=INK, lw=1)
    spring = np.linspace(0, np.pi, 200)
    axes.plot(spring, np.sin(spring), ":", color=GREY, lw=2)
    axes.plot(t[push], force[push], color=BLUE, lw=2.2)
    axes.plot(t[~push], force[~push], "--", color=ORANGE, lw=2.2)
    axes.fill_between(t[~push], force[~push], color=ORANGE, alpha=0.15)
    axes.plot(t[push][-1], 0, "o", color=BLUE, clip_on=False)
    axes.set(xlabel="time", ylabel="force on the ball", xticks=[], yticks=[0], xlim=(0, 3.5), ylim=(-0.4, 1.15))
    axes.spines[["top", "right"]].set_visible(False)
    axes.annotate("spring alone", (2.05, 0.95), color=GREY)
    axes.annotate("spring and damper", (0.05, 0.97), color=BLUE)
    axes.annotate("with the clamp: lets go", (2.5, -0.1), color=BLUE, ha="right", va="center")
    axes.annotate("without it: pulls", (2.75, -0.28), color=ORANGE, ha="right", va="center")


def flip(figure: Figure) -> None:
    """At the limit the ball jumps from one side of its place of rest to the other, step by step.

    Displacement over steps. A dotted line marks the place of rest. Dots lie at x and −x in turn, joined by a solid
    zigzag of constant size, with the velocities v and −v drawn as arrows. Crosses show a longer step: their dashed
    zigzag grows.
    """
    axes = figure.add_subplot()
    steps = np.arange(7)
    x = (-1.0) ** steps
    axes.axhline(0, ls=":", color=GREY)
    longer = 1.0 * (-1.25) ** steps
    axes.plot(steps[:6], longer[:6], "x--", color=ORANGE, lw=1, markersize=7, markeredgewidth=2)
    axes.plot(steps, x, "o-", color=BLUE, lw=1.4, markersize=8)
    for step in (0, 1):
        arrow(axes, (step, x[step]), (0, 0.75 * x[step]), INK)
    axes.annotate("$v$", (-0.13, 1.55), ha="right", size=12)
    axes.annotate("$-v$", (0.87, -1.6), ha="right", va="center", size=12)
    axes.annotate("$x$", (-0.13, 0.93), color=BLUE, ha="right", size=12)
    axes.annotate("$-x$", (1.16, -1.3), color=BLUE, va="center", size=12)
    axes.annotate("a longer step", (4.15, 2.5), color=ORANGE)
    axes.annotate("at the limit", (6.12, 1.0), color=BLUE, va="center")
    axes.annotate("place of rest", (6.12, 0.1), color=GREY)
    axes.set(xlabel="step", xlim=(-0.6, 7.4), ylim=(-3.3, 3.1), yticks=[], xticks=steps)
    axes.spines[["top", "right", "left"]].set_visible(False)


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (mirror, racket, orders, clamp, flip)}
"""The figures by name."""


def _respond_first(z: float, v: float, dt: float) -> tuple[float, float]:
    """A step that responds, and in which the floor then carries the weight."""
    v = -E * v if z < 0 and v < 0 else v - G * dt
    return z + v * dt, v


def _respond_last(z: float, v: float, dt: float) -> tuple[float, float]:
    """A step that changes the velocity, moves, and responds at its end."""
    v = v - G * dt
    z = z + v * dt
    return z, -E * v if z < 0 and v < 0 else v


def _ball(axes: Axes, centre: tuple[float, float], style: str = "-") -> None:
    axes.add_patch(Circle(centre, 0.25, fc=LIGHT, ec=INK, ls=style))
