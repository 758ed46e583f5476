"""The drawn figures of the labs: geometry with its names, as a teacher would draw it on the board.

`python docs/figures/draw.py` writes them as `labs/figures/NAME.svg`, where a notebook finds them (`lab.figure`). The
first line of a function's docstring is the title of its figure; the rest says in words what the figure shows, for
readers who cannot see it. Shape, stroke and label say everything that colour says.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, across, arrow, board, dot, plot, rotated, span, unit
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Rectangle
from numpy.typing import ArrayLike, NDArray


def contact(figure: Figure) -> None:
    """A contact of two bodies A and B, and its names.

    A is above and B below; they touch at one point. The unit normal n points from B to A. The arms r_A and r_B run from
    each centre of mass to the point. The impulse J = j n acts on A, and −J on B. The velocity u is that of A's point as
    seen from B's; it points down into B, against n, so the two approach.
    """
    axes = board(figure, (-3.6, 3.6), (-2.2, 2.2))
    a = _touching(axes, (1.7, 0.85), 158, "A", (-0.85, 0.25))
    b = _touching(axes, (1.9, 0.8), 342, "B", (0.95, -0.2))
    arrow(axes, a, -a, GREY, "$r_A$", at=0.45, beside=(-10, -7), style="--")
    arrow(axes, b, -b, GREY, "$r_B$", at=0.45, beside=(10, 7), style="--")
    arrow(axes, (0, 0), (0, 1.0), INK, "$n$", beside=(-10, 0))
    arrow(axes, (0.16, 0), (0, 1.9), ORANGE, "$J = j\\,n$ on A", beside=(42, 4))
    arrow(axes, (-0.16, 0), (0, -1.9), ORANGE, "$-J$ on B", beside=(-34, 0))
    arrow(axes, (0, 0), (1.0, -0.3), BLUE, "$u$", beside=(10, 3))
    axes.plot(0, 0, "o", color=INK, markersize=7, zorder=6)


def rolling(figure: Figure) -> None:
    """A point of a body moves with the centre and turns about it.

    A body with the centre c and a point at the end of its arm r. The point's velocity is drawn as the sum of two
    arrows: v, the same as that of the centre, and ω × r, at a right angle to the arm, on the side to which the body
    turns. The body turns anticlockwise.
    """
    axes = board(figure, (-2.4, 3.2), (-1.5, 2.2))
    centre, arm = np.array([-0.5, 0.0]), np.array([1.35, 0.45])
    v, turning = np.array([1.15, -0.45]), 0.95 * np.array([-0.45, 1.35])
    point = centre + arm
    _blob(axes, centre, (1.55, 1.05), 0.2)
    dot(axes, centre)
    arrow(axes, centre, arm, GREY, "$r$", at=0.55, beside=(0, 10), style="--")
    arrow(axes, centre, v, INK, "$v$", beside=(4, -10))
    arrow(axes, point, v, INK, "$v$", beside=(6, -10))
    arrow(axes, point + v, turning, BLUE, "$\\omega \\times r$", at=0.5, beside=(24, 2))
    arrow(axes, point, v + turning, ORANGE, "$\\dot p$", at=0.6, beside=(-14, 2))
    axes.add_patch(Arc(centre, 0.8, 0.8, theta1=120, theta2=250, color=BLUE, lw=1.6))
    arrow(axes, centre + 0.4 * unit(252), 0.02 * unit(342), BLUE)
    axes.annotate("$\\omega$", centre, (-27, 0), textcoords="offset points", color=BLUE, ha="center", va="center")
    axes.plot(*point, "o", color=INK, markersize=6, zorder=6)


def edges(figure: Figure) -> None:
    """Two crossing edges and the normal that stands on both.

    Edge a of body A lies over edge b of body B; they cross at the point of contact. The cross product a × b stands at a
    right angle to both. It is as long as the area of the parallelogram of a and b, and it may point up or down,
    depending on which end of an edge is listed first. The normal n has unit length and points towards A's centre.
    """
    axes = board(figure, (-2.9, 3.3), (-1.25, 2.35))
    a, b, up = np.array([2.0, 0.5]), np.array([1.5, -0.75]), np.array([0.0, 1.0])
    area = np.array([-(a + b) / 2, (a - b) / 2, (a + b) / 2, (b - a) / 2])
    axes.add_patch(Polygon(area, fc=LIGHT, ec=GREY, ls=":"))
    axes.annotate("area = $|a \\times b|$", (0.75, -0.72), color=GREY, ha="center", va="center", fontsize=9)
    arrow(axes, -a, 2 * a, INK, "$a$, edge of A", beside=(12, 10))
    arrow(axes, b, -2 * b, BLUE, "$b$, edge of B", beside=(-16, 10))
    arrow(axes, (0.05, 0), 2.1 * up, GREY, "$a \\times b$, or the opposite", beside=(66, 0), style="--")
    arrow(axes, (-0.03, 0), 1.2 * up, ORANGE, "$n$", at=0.8, beside=(-12, 0))
    dot(axes, (-1.2, 1.9))
    axes.annotate("centre of A", (-1.2, 1.9), (-6, 0), textcoords="offset points", ha="right", va="center")
    axes.plot(0, 0, "o", color=INK, markersize=6, zorder=6)


def turned(figure: Figure) -> None:
    """The inverse inertia of a turned rod: into the body's axes, divide there, and back.

    On the left a rod lies slanting in the world, with a torque arrow τ. In the middle the whole picture is turned back
    by Rᵀ, so that the rod lies along its own axis z, where its moments are three plain numbers. There the torque is
    divided by the moments, which keeps only what is across the rod. On the right the result is turned by R into the
    world again.
    """
    axes = board(figure, (-4.6, 4.6), (-1.55, 1.6))
    lean, torque = 32.0, np.array([0.55, 1.0])
    for x, angle, shown, name in (
        (-3.2, lean, torque, "in the world"),
        (0.0, 90.0, rotated(torque, 90 - lean), "in its own axes"),
        (3.2, lean, across(torque, lean), "in the world"),
    ):
        centre, along = np.array([x, 0.0]), 1.15 * unit(angle)
        axes.plot(*zip(centre - along, centre + along, strict=True), color=LIGHT, lw=13, solid_capstyle="round")
        axes.plot(*zip(centre - along, centre + along, strict=True), color=GREY, lw=1, ls=":")
        arrow(axes, centre, shown, BLUE if x <= 0 else ORANGE)
        axes.annotate(name, (x, -1.45), ha="center", fontsize=9, color=GREY)
    axes.annotate("$\\tau$", (-2.75, 1.1), color=BLUE)
    axes.annotate("$R^T\\tau$", (-0.95, 1.12), color=BLUE, ha="center")
    own = across(rotated(torque, 90 - lean), 90)
    arrow(axes, (0, 0), own, ORANGE, "divided by\nthe moments", beside=(-6, -20), size=9)
    axes.annotate("$I^{-1}\\tau$", (2.62, 0.95), color=ORANGE, ha="center")
    for start, text in ((-1.75, "$R^T$"), (1.35, "$R$")):
        arrow(axes, (start, 0.0), (0.55, 0.0), INK, text, at=0.5, beside=(0, 11))


def peg(figure: Figure) -> None:
    """A level rod falls on a peg that is an arm x from its centre.

    A thin rod of mass M and length L falls with the speed v. Its right end is over a fixed peg, an arm x from the
    centre. The impulse J acts upwards on the rod at the peg. Afterwards the point on the peg goes up with e v, and the
    rod turns.
    """
    axes = board(figure, (-3.0, 3.0), (-1.35, 1.35))
    axes.add_patch(Rectangle((-2.2, 0), 4.4, 0.16, fc=LIGHT, ec=INK))
    axes.add_patch(Polygon([(1.7, 0), (1.5, -0.75), (1.9, -0.75)], fc=GREY, ec=INK))
    axes.plot([0.9, 2.5], [-0.75, -0.75], color=INK, lw=1.5)
    dot(axes, (0, 0.08))
    arrow(axes, (0, 0.08), (0, -0.95), INK, "$v$", beside=(10, 2))
    arrow(axes, (-1.5, 0.08), (0, -0.95), INK, "$v$", beside=(10, 2))
    arrow(axes, (1.7, 0.0), (0, 1.15), ORANGE, "$J$", beside=(11, 0))
    span(axes, (0, 0.42), (1.7, 0.42), "$x$")


def signs(figure: Figure) -> None:
    """What pushes A pushes B as hard the other way, and turns both.

    Two bars touch in one point. The impulse J points up on the upper bar A, at the end of its arm r_A, and −J points
    down on the lower bar B, at the end of its arm r_B. Curved arrows show that A turns with r_A × J and B with
    r_B × (−J).
    """
    axes = board(figure, (-3.2, 3.2), (-1.95, 1.95))
    a, b = np.array([-1.3, 0.55]), np.array([1.3, -0.55])
    for centre, name, place in ((a, "A", (-1.0, 0.0)), (b, "B", (1.0, 0.0))):
        axes.add_patch(Rectangle(centre - (1.55, 0.22), 3.1, 0.44, fc=LIGHT, ec=INK))
        axes.annotate(name, centre + place, ha="center", va="center", weight="bold")
        dot(axes, centre)
    arrow(axes, a, (1.3, -0.3), GREY, "$r_A$", at=0.4, beside=(0, 11), style="--")
    arrow(axes, b, (-1.3, 0.3), GREY, "$r_B$", at=0.4, beside=(0, -12), style="--")
    arrow(axes, (0.0, 0.28), (0, 1.3), ORANGE, "$J$", beside=(11, 0))
    arrow(axes, (0.0, -0.28), (0, -1.3), ORANGE, "$-J$", beside=(-14, 0))
    for centre, first, text, place in (
        (a, 120, "$r_A \\times J$", (-0.1, 1.05)),
        (b, 300, "$r_B \\times (-J)$", (0.2, -1.2)),
    ):
        axes.add_patch(Arc(centre, 1.3, 1.3, theta1=first - 60, theta2=first + 45, color=BLUE, lw=1.8))
        end = centre + 0.65 * unit(first + 46)
        arrow(axes, end, 0.02 * unit(first + 136), BLUE)
        axes.annotate(text, centre + place, color=BLUE, ha="center", va="center")
    axes.plot([0, 0], [0.28, -0.28], ":", color=INK)


def plane(figure: Figure) -> None:
    """A point in front of a plane, and the way straight to it.

    A slanted plane with its normal vector (a, b, c), which has any length. A point p lies in front of the plane. The
    way from p straight back to the plane has the length s and runs against the unit normal.
    """
    axes = board(figure, (-2.9, 3.1), (-1.3, 2.45))
    along, normal = unit(-14), unit(76)
    axes.plot(*zip(-2.5 * along, 2.7 * along, strict=True), color=INK, lw=2)
    axes.add_patch(Polygon([-2.5 * along, 2.7 * along, 2.7 * along - 0.22 * normal, -2.5 * along - 0.22 * normal],
                           fc=LIGHT, ec="none"))  # fmt: skip
    foot = 1.1 * along
    p = foot + 1.45 * normal
    arrow(axes, p, -1.45 * normal, ORANGE, "$s$", at=0.5, beside=(10, 2))
    axes.plot(*p, "o", color=INK, markersize=7)
    axes.annotate("$p$", p, (9, 6), textcoords="offset points")
    arrow(axes, -1.3 * along, 2.0 * normal, BLUE, "$(a, b, c)$, of any length", beside=(66, -2))
    arrow(axes, -1.45 * along, 1.0 * normal, INK, "unit normal", at=0.8, beside=(-36, 0))
    axes.annotate("in front", 2.2 * along + 0.45 * normal, ha="center", color=GREY)
    axes.annotate("behind", 2.2 * along - 0.6 * normal, ha="center", color=GREY)


def step(figure: Figure) -> None:
    """A ball that is noticed only at the end of a step.

    Height over time. The true path comes down to the floor and bounces up at the instant of impact. The program looks
    at the ball at the dots only. It finds the ball a depth δ below the floor at the end of a step, gives it its new
    velocity there, and the ball rises from too deep. In one step the ball moves v Δt, so δ is anything up to that.
    """
    axes = plot(figure, "time", "height of the ball's lowest point")
    dt, v, e = 1.0, 1.0, 0.55
    times = np.array([-2, -1, 0, 1, 2, 3]) * dt
    depth = 0.62
    found = np.array([2 * v - depth, v - depth, -depth, e * v - depth, 2 * e * v - depth, 3 * e * v - depth])
    hit = -depth / v
    axes.plot([-2, hit, 3], [2 * v - depth, 0, e * (3 - hit)], "--", color=GREY, lw=1.8)
    axes.plot(times, found, "o-", color=BLUE, lw=1.6)
    axes.axhline(0, color=INK, lw=1.5)
    axes.axhspan(-1.15, 0, color=LIGHT, zorder=0)
    span(axes, (0.18, 0), (0.18, -depth), "$\\delta$", vertical=True)
    span(axes, (-1, -0.92), (0, -0.92), "$\\Delta t$", below=True)
    axes.annotate("true path", (1.8, e * (1.8 - hit)), (-12, 9), textcoords="offset points", color=GREY, ha="right")
    axes.annotate("computed", (2.5, 2.5 * e * v - depth), (-4, -15), textcoords="offset points", color=BLUE)
    axes.annotate(
        "noticed here", (0, -depth), (-14, 0), textcoords="offset points", ha="right", va="center", color=BLUE
    )
    axes.set(xlim=(-2.2, 3.2), ylim=(-1.15, 2.1))


def chord(figure: Figure) -> None:
    """The slide's time of impact: where the chord crosses the plane.

    Separation over one step. It begins at s0, above zero, and ends at s1, below zero. The slide joins the two with a
    straight chord, which crosses zero at T. The true path between the same two points is a parabola.
    """
    axes = plot(figure, "time within the step", "separation")
    time = np.linspace(0, 1, 100)
    path = 0.75 - 0.25 * time - 1.0 * time**2
    axes.axhline(0, color=INK, lw=1.5)
    axes.axhspan(-0.75, 0, color=LIGHT, zorder=0)
    axes.plot(time, path, color=GREY, lw=2)
    axes.plot([0, 1], path[[0, -1]], "o--", color=BLUE)
    cross = path[0] / (path[0] - path[-1])
    span(axes, (-0.045, 0), (-0.045, path[0]), "$s_0$", vertical=True)
    span(axes, (1.045, 0), (1.045, path[-1]), "$s_1 < 0$", vertical=True)
    axes.plot([cross], [0], "D", color=ORANGE, zorder=5)
    axes.annotate("T of the slide", (cross, 0), (-6, -17), textcoords="offset points", color=ORANGE, ha="right")
    axes.annotate("true path", (0.45, 0.47), (8, 4), textcoords="offset points", color=GREY)
    axes.annotate("chord", (0.28, 0.38), (-10, -14), textcoords="offset points", color=BLUE, ha="right")
    span(axes, (0, -0.62), (1, -0.62), "$\\Delta t$")
    axes.set(xlim=(-0.22, 1.3), ylim=(-0.75, 0.95))


def puck(figure: Figure) -> None:
    """A puck between two walls, and the same way unfolded.

    Below, a puck slides between two walls that are a length L apart and turns round at each. Above, every bounce is
    replaced by a mirror image of the room: the puck goes straight on through a row of rooms. Each wall that the
    straight way crosses is one impact.
    """
    axes = board(figure, (-0.35, 5.1), (-1.0, 1.55))
    for wall in range(5):
        axes.plot(
            [wall, wall], [0.55, 1.25], color=INK, lw=2 if wall in (0, 1) else 1, ls="-" if wall in (0, 1) else ":"
        )
    arrow(axes, (0.35, 0.9), (3.3, 0), BLUE)
    axes.annotate("the way, unfolded: three walls", (1.2, 0.36), color=BLUE, fontsize=9, va="center")
    axes.plot(0.35, 0.9, "o", color=BLUE, markersize=9)
    for wall in (1, 2, 3):
        axes.plot(wall, 0.9, "D", color=ORANGE, markersize=6, zorder=5)
    axes.annotate("mirror images of the room", (2.5, 1.38), ha="center", color=GREY, fontsize=9)
    for wall in (0, 1):
        axes.plot([wall, wall], [-0.75, 0.15], color=INK, lw=2)
    way = [(0.35, 0.0), (1, -0.12), (0, -0.36), (1, -0.6), (0.65, -0.68)]
    for start, end in itertools.pairwise(way):
        last = end == way[-1]
        if last:
            arrow(axes, start, np.subtract(end, start), BLUE)
        else:
            axes.plot(*zip(start, end, strict=True), color=BLUE, lw=1.6)
    axes.plot(0.35, 0.0, "o", color=BLUE, markersize=9)
    span(axes, (0, 0.36), (1, 0.36), "$L$")
    axes.annotate("the way in the room: three impacts", (1.2, -0.36), color=GREY, fontsize=9, va="center")


def wall(figure: Figure) -> None:
    """A ball flies through a thin wall between two looks.

    A wall of thickness w. The ball, of radius r, is drawn where it first touches the front face and where it leaves the
    back face: its centre travels w + 2r in between. In one step the centre moves v Δt, which is longer, so the ball can
    be before the wall at one look and behind it at the next.
    """
    axes = board(figure, (-3.6, 3.6), (-1.5, 1.45))
    axes.add_patch(Rectangle((-0.3, -0.72), 0.6, 1.5, fc=GREY, ec=INK, alpha=0.6))
    for x in (-0.75, 0.75):
        axes.add_patch(Circle((x, 0), 0.45, fc=LIGHT, ec=INK))
        dot(axes, (x, 0))
    for x in (-2.1, 2.3):
        axes.add_patch(Circle((x, 0), 0.45, fill=False, ec=BLUE, ls="--", lw=1.6))
        axes.plot(x, 0, "s", color=BLUE, markersize=6)
    span(axes, (-0.75, 0.98), (0.75, 0.98), "$w + 2r$: overlap")
    span(axes, (-2.1, -1.0), (2.3, -1.0), "$v\\,\\Delta t$: from one look to the next", below=True)
    axes.annotate("wall", (0, -0.83), ha="center", va="top", fontsize=9, color=GREY)
    axes.annotate("look", (-2.1, 0.55), ha="center", color=BLUE, fontsize=9)
    axes.annotate("next look", (2.3, 0.55), ha="center", color=BLUE, fontsize=9)
    arrow(axes, (-3.5, 0), (0.8, 0), INK, "$v$", at=0.5, beside=(0, 9))


LAB_FIGURES: dict[str, Draw] = {
    draw.__name__: draw for draw in (contact, rolling, edges, turned, peg, signs, plane, step, chord, puck, wall)
}
"""The figures by name."""


def _blob(axes: Axes, centre: ArrayLike, radii: Sequence[float], dent: float) -> None:
    """A body of no particular shape."""
    angle = np.linspace(0, 2 * np.pi, 200)
    wave = 1 + 0.06 * np.cos(3 * angle + 7 * dent) + 0.04 * np.sin(2 * angle - dent)
    outline = np.stack([radii[0] * wave * np.cos(angle), radii[1] * wave * np.sin(angle)], axis=-1)
    axes.add_patch(Polygon(np.asarray(centre) + outline, fc=LIGHT, ec=INK, lw=1.4))


def _touching(axes: Axes, radii: Sequence[float], degrees: float, name: str, place: ArrayLike) -> NDArray[np.float64]:
    """A turned ellipse whose lowest point is the origin, or whose highest is if it is turned by more than half.

    Returns its centre.
    """
    angle = np.linspace(0, 2 * np.pi, 721)
    along, sideways = unit(degrees % 180), unit(degrees % 180 + 90)
    outline = radii[0] * np.outer(np.cos(angle), along) + radii[1] * np.outer(np.sin(angle), sideways)
    height = outline[:, 1] if degrees < 180 else -outline[:, 1]
    centre = -outline[np.argmin(height)]
    axes.add_patch(Polygon(centre + outline, fc=LIGHT, ec=INK, lw=1.4))
    axes.annotate(name, centre + place, ha="center", va="center", weight="bold", size=13)
    dot(axes, centre)
    return np.asarray(centre)
