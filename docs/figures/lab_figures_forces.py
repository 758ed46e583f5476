"""The drawn figures of the lab on forces; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle


def pull(figure: Figure) -> None:
    """The pull of body 2 on body 1.

    Body 1 is on the left and body 2, which is larger, on the right and higher. The vector d runs from body 1 to body 2.
    The force F on body 1 lies on the same line and points to body 2; the force on body 2 is just as long and points
    back to body 1.
    """
    axes = board(figure, (-2.6, 2.8), (-1.3, 1.5))
    one, two = np.array([-1.8, -0.7]), np.array([1.8, 0.7])
    axes.add_patch(Circle((one[0], one[1]), 0.2, fc=LIGHT, ec=INK))
    axes.add_patch(Circle((two[0], two[1]), 0.42, fc=LIGHT, ec=INK))
    along = (two - one) / np.linalg.norm(two - one)
    off = np.array([-along[1], along[0]])
    axes.plot(*np.transpose([one, two]), ":", color=GREY)
    arrow(axes, one - 0.38 * off, two - one, GREY, "$d = x_2 - x_1$", at=0.5, beside=(22, -13), style="--")
    arrow(axes, one, 1.15 * along, ORANGE, "$F$", at=0.85, beside=(-4, 12))
    arrow(axes, two, -1.15 * along, ORANGE, "$-F$", at=0.85, beside=(-8, 12))
    axes.annotate("1", (one[0], one[1] + 0.38), color=INK, ha="center")
    axes.annotate("2", (two[0], two[1] + 0.55), color=INK, ha="center")


def euler(figure: Figure) -> None:
    """One step of explicit Euler on a circle.

    A satellite moves on a dotted circle around a heavy body in the middle. Its velocity v is a tangent. A step along
    the tangent, v Δt, ends outside the circle. There the next velocity, v + a Δt, is a little longer than v, and turned
    towards the middle.
    """
    axes = board(figure, (-1.6, 2.2), (-0.35, 1.75))
    turn = np.linspace(-0.25, np.pi + 0.25, 100)
    axes.plot(1.2 * np.cos(turn), 1.2 * np.sin(turn), ":", color=GREY)
    axes.plot(0, 0, "o", color=INK, markersize=9)
    angle, dt = np.radians(55), 0.62
    p = 1.2 * np.array([np.cos(angle), np.sin(angle)])
    v = 1.2 * np.array([np.sin(angle), -np.cos(angle)])
    after, new = p + v * dt, v - p * dt
    axes.plot(*p, "o", color=INK)
    arrow(axes, p, v * dt, BLUE, "$v\\,\\Delta t$", at=0.5, beside=(12, 10))
    arrow(axes, p, -0.55 * p, GREY, "$a$", at=0.8, beside=(-10, 2), style="--")
    axes.plot(*after, "o", mfc="white", mec=INK)
    arrow(axes, after, new * 0.62, ORANGE, "$(v + a\\,\\Delta t)\\,\\Delta t$", at=0.75, beside=(48, 4))
    axes.plot(*np.transpose([[0, 0], after]), ":", color=GREY, lw=1)
    axes.annotate("farther out", (after[0] + 0.1, after[1] + 0.08), color=INK, va="bottom")


def damper(figure: Figure) -> None:
    """A spring with a damper beside it, between two ends that move.

    A zigzag and, beside it, a piston join end 2 on the left to end 1 on the right. The unit vector u points from end 2
    to end 1. The velocity w of end 1 relative to end 2 points up and to the right. Only its part along the spring, w·u,
    changes the length. The force F on end 1 points back along the spring, towards end 2.
    """
    axes = board(figure, (-2.6, 3.2), (-1.0, 1.6))
    left, right = np.array([-2.0, 0.0]), np.array([1.2, 0.0])
    zig = np.linspace(-1.6, 0.8, 13)
    axes.plot(
        [-2.0, *zig, 1.2], [0.18] + [0.18 + 0.16 * (-1) ** n * (0 < n < 12) for n in range(13)] + [0.18], color=INK
    )
    axes.plot([-2.0, -0.6], [-0.3, -0.3], color=INK)
    axes.plot([0.1, -0.9, -0.9, 0.1], [-0.14, -0.14, -0.46, -0.46], color=GREY)
    axes.plot([-0.6, -0.6], [-0.18, -0.42], color=INK, lw=3)
    axes.plot([0.1, 0.1], [-0.46, -0.14], color=GREY)
    axes.plot([0.1, 1.2], [-0.3, -0.3], color=GREY)
    for end, name, shift in ((left, "2", -0.3), (right, "1", 0.0)):
        axes.plot([end[0], end[0]], [-0.42, 0.34], color=INK, lw=2)
        axes.annotate(name, (end[0] + shift, -0.72 if shift == 0 else -0.05), color=INK, ha="center")
    w = np.array([1.3, 0.95])
    arrow(axes, right, w, BLUE, "$w$", beside=(8, 4))
    arrow(axes, right, (w[0], 0), BLUE, "$(w\\cdot u)\\,u$", beside=(4, -12), style="--")
    axes.plot([right[0] + w[0]] * 2, [0, w[1]], ":", color=GREY)
    arrow(axes, left + np.array([0.2, 0.75]), (0.9, 0), GREY, "$u$", beside=(9, 0))
    arrow(axes, right + np.array([0, 0.62]), (-1.1, 0), ORANGE, "$F$ on end 1", at=0.9, beside=(-8, 11))


def roots(figure: Figure) -> None:
    """What one step multiplies a critically damped motion by.

    A plot of the larger factor of a step, in size, over the step ω Δt from 0 to 2.4, for a damping ratio of 1. The
    factor of semi-implicit Euler falls from 1, rises again steeply and crosses 1 at 0.83. That of explicit Euler falls
    to 0 at 1 and crosses 1 at 2.
    """
    axes = figure.add_subplot()
    axes.spines[["top", "right"]].set_visible(False)
    step = np.linspace(0, 2.4, 400)
    explicit = np.abs(1 - step)
    semi = np.array([max(abs(np.roots([1, -(2 - 2 * s - s * s), 1 - 2 * s]))) for s in step])
    axes.plot(step, explicit, color=BLUE, lw=2.2)
    axes.plot(step, semi, "--", color=ORANGE, lw=2.2)
    axes.axhline(1, color=GREY, ls=":")
    axes.plot([2.0], [1.0], "o", color=BLUE)
    axes.plot([2 * np.sqrt(2) - 2], [1.0], "s", color=ORANGE)
    axes.set(xlim=(0, 2.4), ylim=(0, 2.4), xlabel="$\\omega\\,\\Delta t$", ylabel="size of the factor of a step")
    axes.set(
        xticks=[0, 0.5, 2 * np.sqrt(2) - 2, 1.5, 2], xticklabels=["0", "0.5", "0.83", "1.5", "2"], yticks=[0, 1, 2]
    )
    axes.annotate("semi-implicit", (0.92, 1.75), color=ORANGE, ha="right")
    axes.annotate("explicit", (1.5, 0.32), color=BLUE)
    axes.annotate("grows", (1.5, 1.08), color=GREY, ha="center")
    axes.annotate("dies", (1.5, 0.84), color=GREY, ha="center")


def ball(figure: Figure) -> None:
    """A ball that sinks in a thick fluid, and three forces on it.

    A ball in a fluid sinks with the velocity v. Its weight m g points down. The buoyancy, which is the weight of the
    fluid that the ball displaces, and the drag both point up. Together they are as long as the weight.
    """
    axes = board(figure, (-2.8, 2.8), (-1.9, 1.9))
    axes.add_patch(Rectangle((-1.9, -1.85), 3.8, 3.5, fc=LIGHT, ec="none"))
    axes.add_patch(Circle((0, 0), 0.45, fc="white", ec=INK))
    arrow(axes, (0, 0), (0, -1.5), INK, "$m g$", beside=(16, 4))
    arrow(axes, (-0.14, 0), (0, 0.95), BLUE, "buoyancy", beside=(-34, 0))
    arrow(axes, (0.14, 0), (0, 0.55), ORANGE, "drag", beside=(24, 6))
    arrow(axes, (1.3, 0.45), (0, -0.9), GREY, "$v$", at=0.5, beside=(10, 0), style="--")


def box(figure: Figure) -> None:
    """A ball, the cube with the same moments of inertia, and the ball whose drag the cube gets.

    A ball of radius r, and over it a square with the side 1.55 r, the cube that has the ball's moments of inertia.
    The corners of the square are outside the ball, and its sides are well inside. A dashed circle as wide as the square
    is the smaller ball whose drag the cube gets.
    """
    axes = board(figure, (-2.8, 2.8), (-1.9, 1.9))
    half = 1.4 * np.sqrt(0.6)
    axes.add_patch(Circle((0, 0), 1.4, fc=LIGHT, ec=INK))
    axes.add_patch(Rectangle((-half, -half), 2 * half, 2 * half, fc="none", ec=BLUE, lw=2))
    axes.add_patch(Circle((0, 0), half, fc="none", ec=ORANGE, ls="--", lw=2))
    axes.plot([0, -1.4 * np.cos(0.6)], [0, 1.4 * np.sin(0.6)], color=INK)
    axes.plot(0, 0, ".", color=INK)
    axes.annotate("$r$", (-0.45, 0.45), color=INK, ha="center")
    axes.annotate("cube", (half + 0.08, half), color=BLUE, va="bottom")
    axes.annotate("ball", (1.4, -0.75), color=INK)
    axes.annotate("drag of\nthis ball", (0, -0.6), color=ORANGE, ha="center", va="center")


def wind(figure: Figure) -> None:
    """Wind on somebody who moves.

    A body moves to the right with the velocity v. The wind w blows obliquely to the right and up. The difference, v − w
    as an arrow from the tip of w to the tip of v, is how the body moves through the air. The force F points the other
    way: along w − v.
    """
    axes = board(figure, (-1.6, 3.6), (-0.8, 2.0))
    v, w = np.array([2.4, 0.0]), np.array([1.5, 1.4])
    arrow(axes, (0, 0), v, INK, "$v$", at=0.6, beside=(0, -11))
    arrow(axes, (0, 0), w, BLUE, "$w$", at=0.6, beside=(-9, 8))
    arrow(axes, w, v - w, GREY, "$v - w$", at=0.5, beside=(24, 4), style="--")
    arrow(axes, (0, 0), 0.75 * (w - v), ORANGE, "$F$", at=0.9, beside=(-12, 2))
    axes.plot(0, 0, "o", color=INK, markersize=8, zorder=6)


def network(figure: Figure) -> None:
    """Three balls, two springs, and every force on the one in the middle.

    Three balls are joined by two springs, like a chain that hangs to the right and down. Each spring pulls both of its
    balls, with arrows that point along the spring towards each other. On the middle ball the pulls of both springs, its
    weight and the drag of a stream to the right add up.
    """
    axes = board(figure, (-2.6, 2.9), (-1.8, 1.5))
    balls = np.array([[-2.0, 1.0], [0.0, 0.2], [1.9, -0.9]])
    for a, b in ((0, 1), (1, 2)):
        axes.plot(*balls[[a, b]].T, ":", color=GREY, lw=2)
        along = (balls[b] - balls[a]) / np.linalg.norm(balls[b] - balls[a])
        for end, way in ((a, along), (b, -along)):
            arrow(axes, balls[end] + 0.2 * way, 0.62 * way, ORANGE)
    for number, (x, y) in enumerate(balls):
        axes.add_patch(Circle((x, y), 0.2, fc=LIGHT, ec=INK, zorder=5))
        axes.annotate(str(number + 1), (x, y), ha="center", va="center", zorder=6, color=INK)
    arrow(axes, balls[1] + [0, -0.2], (0, -0.85), INK, "weight", beside=(-22, 4))
    arrow(axes, balls[1] + [0.18, 0.08], (0.8, 0.0), BLUE, "drag", beside=(18, 2))
    axes.annotate("pulls of the springs", (-1.5, -0.25), color=ORANGE, ha="center")


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (pull, euler, damper, roots, ball, box, wind, network)}
"""The figures by name."""
