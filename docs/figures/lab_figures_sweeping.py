"""The drawn figures of the lab on swept volumes; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board, span, unit
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, FancyBboxPatch, Polygon, Rectangle, Wedge
from numpy.typing import ArrayLike, NDArray


def ray(figure: Figure) -> None:
    """A ray that enters a ball and leaves it, one that misses, and one that starts inside.

    A ball of radius r around the origin. A ray starts outside at x and moves with u. It enters the ball at a first
    point, marked by a dot, and leaves it at a second one, marked by a cross. A second ray passes above the ball. A
    third one starts just inside the surface: its entry is behind it, and only the cross on the far side is ahead.
    """
    axes = board(figure, (-3.6, 3.6), (-1.75, 1.9))
    axes.add_patch(Circle((0, 0), 1.2, fc=LIGHT, ec=INK, lw=1.6))
    axes.plot(0, 0, "+", color=INK, markersize=8)
    arrow(axes, (0, 0), 1.2 * unit(-60), GREY, "$r$", at=0.5, beside=(10, 3))
    start, along = np.array([-3.1, -0.05]), unit(8)
    arrow(axes, start, 6.3 * along, BLUE)
    arrow(axes, start, 0.95 * along, INK, "$u$", at=0.8, beside=(0, -11))
    axes.plot(*start, "o", color=INK, markersize=6)
    axes.annotate("$x$", start, (-2, 9), textcoords="offset points", ha="center")
    for place, mark, name, beside in zip(
        _crossed(start, along, 1.2), ("o", "X"), ("enters", "leaves"), ((-24, 9), (28, -8)), strict=True
    ):
        axes.plot(*place, mark, color=ORANGE, markersize=8, zorder=6)
        axes.annotate(name, place, beside, textcoords="offset points", ha="center", color=ORANGE, va="center")
    arrow(axes, (-3.1, 1.3), 6.3 * unit(1), GREY, "a miss", at=0.1, beside=(0, 9))
    inside, way = 1.14 * unit(200), unit(-33)
    axes.plot(*inside, "s", color=INK, markersize=6, zorder=6)
    leaves = _crossed(inside, way, 1.2)[1]
    arrow(axes, inside, (np.linalg.norm(leaves - inside) + 0.7) * way, INK, style="--")
    axes.plot(*leaves, "X", color=ORANGE, markersize=8, zorder=6)
    axes.annotate("from inside", inside, (-8, -12), textcoords="offset points", ha="right", va="center")


def relative(figure: Figure) -> None:
    """Two balls that move, and the same as seen from B.

    On the left, in the world: ball A of radius r_A moves to the right and ball B of radius r_B moves to the left, and a
    wind carries both upwards. On the right, as seen from B: B rests and has grown to the radius r_A + r_B, A is a
    point, and its path is a straight ray along the difference of both velocities. The wind is gone.
    """
    world, ride = figure.subplots(1, 2)
    for axes in (world, ride):
        axes.set(xlim=(-2.2, 2.2), ylim=(-1.6, 1.75), aspect="equal")
        axes.set_axis_off()
    a, b = np.array([-1.4, -0.45]), np.array([1.2, 0.05])
    wind, u, v = np.array([0.0, 0.75]), np.array([1.2, 0.0]), np.array([-0.6, 0.0])
    for centre, radius, velocity, name in ((a, 0.35, u, "A"), (b, 0.6, v, "B")):
        world.add_patch(Circle(centre, radius, fc=LIGHT, ec=INK, lw=1.6))
        world.annotate(name, centre, (0, -8), textcoords="offset points", ha="center", va="center", weight="bold")
        arrow(world, centre, velocity, BLUE)
        arrow(world, centre, wind, GREY, style="--")
    world.annotate("$v_A$", a + u, (4, -10), textcoords="offset points", color=BLUE, ha="center")
    world.annotate("$v_B$", b + v, (-6, -12), textcoords="offset points", color=BLUE, ha="center")
    world.annotate("wind", a + wind, (0, 6), textcoords="offset points", color=GREY, ha="center")
    world.annotate("in the world", (0, -1.5), ha="center", color=GREY, size=10)
    centre, point = np.array([0.95, 0.05]), np.array([-1.85, -0.45])
    ride.add_patch(Circle(centre, 0.95, fc="none", ec=ORANGE, ls="--", lw=1.6))
    ride.add_patch(Circle(centre, 0.6, fc=LIGHT, ec=INK, lw=1.6))
    ride.annotate("B", centre, (0, 14), textcoords="offset points", ha="center", va="center", weight="bold")
    ride.plot(*point, "o", color=INK, markersize=6)
    ride.annotate("A", point, (-2, -12), textcoords="offset points", ha="center", va="center", weight="bold")
    arrow(ride, point, u - v, BLUE, "$v_A - v_B$", at=0.45, beside=(0, -11))
    arrow(ride, centre, 0.95 * unit(60), ORANGE, "$r_A + r_B$", at=1.0, beside=(2, 9))
    ride.annotate("as seen from B", (0, -1.5), ha="center", color=GREY, size=10)


def offsets(figure: Figure) -> None:
    """A pass seen from the side, with its looks; and all offsets, seen along the flight.

    On the left the grown ball of radius R, seen from the side. A point flies past the centre at the offset b, and is
    inside along a chord of length c. Looks fall on its line at distances D, drawn as squares. Here one falls before the
    chord and one behind it, and the collision is missed. On the right the same ball as seen along the flight: a disc.
    Offsets are spread evenly over its area. The inner disc up to b is light, and the ring outside, with shorter chords,
    is hatched.
    """
    side, front = figure.subplots(1, 2, width_ratios=(1.5, 1))
    for axes, wide in ((side, 2.55), (front, 1.7)):
        axes.set(xlim=(-wide, wide), ylim=(-1.6, 1.6), aspect="equal")
        axes.set_axis_off()
    b, radius = 0.95, 1.2
    half = np.sqrt(radius**2 - b**2)
    side.add_patch(Circle((0, 0), radius, fc=LIGHT, ec=INK, lw=1.6))
    side.plot(0, 0, "+", color=INK, markersize=8)
    side.plot([-2.5, 2.5], [b, b], color=GREY, lw=1.2)
    side.plot([-half, half], [b, b], color=ORANGE, lw=3.5, solid_capstyle="butt")
    side.annotate("$c$", (0.42, b), (0, -10), textcoords="offset points", color=ORANGE, ha="center", va="center")
    for place in (-0.95, 1.05):
        side.plot(place, b, "s", color=BLUE, markersize=7, zorder=6)
    span(side, (-0.95, 1.38), (1.05, 1.38), "$D$")
    arrow(side, (0, 0), (0, b), INK, "$b$", at=0.5, beside=(9, 0))
    arrow(side, (0, 0), radius * unit(-35), GREY, "$R$", at=0.55, beside=(0, -11))
    side.annotate("look", (-0.95, b), (-15, -2), textcoords="offset points", color=BLUE, ha="right", va="top")
    side.annotate("seen from the side", (0, -1.55), ha="center", color=GREY, size=10)
    front.add_patch(Circle((0, 0), radius, fc="white", ec=INK, hatch="////", lw=1.6))
    front.add_patch(Circle((0, 0), b, fc=LIGHT, ec=INK))
    front.plot(0, 0, "+", color=INK, markersize=8)
    arrow(front, (0, 0), b * unit(60), INK, "$b$", at=0.5, beside=(9, -3))
    front.annotate("seen along the flight", (0, -1.55), ha="center", color=GREY, size=10)


def slabs(figure: Figure) -> None:
    """A ray through two slabs, and the times at which it is in each of them.

    Above, a box in the plane is what an upright slab and a level slab have in common. A ray comes from the lower left,
    enters the level slab first, then the upright one, and then leaves the level one. It is in the box between its
    entry into the upright slab and its exit from the level one. Below, the same as bars over time: one bar for each
    slab, and a third, darker one for what both have in common.
    """
    plan = board(figure, (-3.6, 3.4), (-3.95, 1.5))
    plan.add_patch(Rectangle((-0.9, -1.3), 1.8, 2.8, fc=LIGHT, ec="none"))
    plan.add_patch(Rectangle((-3.4, -0.7), 6.8, 1.4, fc="none", ec=GREY, hatch="...", lw=0))
    for side in (-1, 1):
        plan.plot([0.9 * side, 0.9 * side], [-1.3, 1.5], color=GREY, lw=1.2)
        plan.plot([-3.4, 3.4], [0.7 * side, 0.7 * side], color=GREY, lw=1.2, ls="--")
    plan.add_patch(Rectangle((-0.9, -0.7), 1.8, 1.4, fc="none", ec=INK, lw=2.2))
    start, end = np.array([-2.6, -1.2]), np.array([1.9, 1.45])
    arrow(plan, start, end - start, BLUE)
    rise = (end - start)[1] / (end - start)[0]
    enters, leaves = (start[0] + (y - start[1]) / rise for y in (-0.7, 0.7))
    bars: tuple[tuple[float, float, float, str, dict[str, str]], ...] = (
        (-2.1, enters, leaves, "level slab", {"fc": "white", "hatch": "..."}),
        (-2.75, -0.9, 0.9, "upright slab", {"fc": LIGHT}),
        (-3.4, -0.9, min(0.9, leaves), "box", {"fc": INK}),
    )
    for x, mark in ((enters, "v"), (-0.9, "o"), (leaves, "X"), (0.9, "^")):
        y = start[1] + rise * (x - start[0])
        plan.plot([x, x], [y, -1.65], ":", color=ORANGE, lw=1)
        plan.plot(x, y, mark, color=ORANGE, markersize=7, zorder=6)
    for height, first, last, name, looks in bars:
        plan.add_patch(Rectangle((first, height), last - first, 0.42, ec=INK, **looks))
        plan.annotate(name, (first - 0.12, height + 0.2), ha="right", va="center", size=10)
    plan.annotate("", (3.3, -3.6), (-3.3, -3.6), arrowprops={"arrowstyle": "-|>", "color": GREY})
    plan.annotate("time", (3.3, -3.68), ha="right", va="top", color=GREY, size=10)


def rounded(figure: Figure) -> None:
    """A box that is grown by a ball has round corners.

    A box, and around it two outlines that are r away from its faces. The dashed one has sharp corners, the solid one
    round corners of radius r. A ball touches the upper side, with its centre on both outlines. A second ball has its
    centre inside the sharp corner and outside the round one: it does not touch the box. A hatched quarter disc shows
    the true part of the corner's square.
    """
    axes = board(figure, (-3.1, 3.7), (-1.45, 2.15))
    r, a, b = 0.75, 1.4, 0.55
    axes.add_patch(Rectangle((-a - r, -b - r), 2 * (a + r), 2 * (b + r), fc="none", ec=ORANGE, ls="--", lw=1.6))
    style = f"round,pad=0,rounding_size={r}"
    axes.add_patch(FancyBboxPatch((-a - r, -b - r), 2 * (a + r), 2 * (b + r), boxstyle=style, fc="none", ec=BLUE, lw=2))
    axes.add_patch(Wedge((a, b), r, 0, 90, fc="none", ec=BLUE, hatch="////", lw=0.8))
    axes.add_patch(Rectangle((-a, -b), 2 * a, 2 * b, fc=LIGHT, ec=INK, lw=1.8))
    axes.annotate("box", (0, -0.2), ha="center", va="center")
    touching, beside = np.array([-0.75, b + r]), np.array([a, b]) + 1.22 * r * unit(45)
    for centre, mark in ((touching, "o"), (beside, "X")):
        axes.add_patch(Circle(centre, r, fc="none", ec=INK, lw=1.2, ls=":"))
        axes.plot(*centre, mark, color=INK, markersize=7, zorder=6)
    axes.annotate("touches", touching, (0, 8), textcoords="offset points", ha="center", size=10)
    axes.annotate("a false hit", beside, (78, 14), textcoords="offset points", ha="center", va="center", size=10)
    arrow(axes, (-a, -0.1), (-r, 0), GREY, "$r$", at=0.5, beside=(0, 9))


def turn(figure: Figure) -> None:
    """A rod turns by a right angle, and its tip goes outside of the triangle of start and end.

    A thin rod turns about its end, from level to upright. Thin lines show it in between, and the tip runs along a
    quarter of a circle. A dashed triangle is the convex hull of its start and its end. A post stands between the
    triangle and the arc: the rod goes through it, and the triangle does not touch it.
    """
    axes = board(figure, (-2.6, 2.9), (-0.25, 2.25))
    length = 2.0
    axes.add_patch(Wedge((0, 0), length, 0, 90, fc=LIGHT, ec="none"))
    for degrees in range(10, 90, 10):
        axes.plot(*zip((0, 0), length * unit(degrees), strict=True), color="#b7c0cc", lw=1)
    axes.add_patch(Arc((0, 0), 2 * length, 2 * length, theta1=0, theta2=90, color=BLUE, lw=1.6))
    axes.add_patch(Polygon([(0, 0), (length, 0), (0, length)], fc="none", ec=ORANGE, ls="--", lw=1.8))
    for degrees in (0, 90):
        axes.plot(*zip((0, 0), length * unit(degrees), strict=True), color=INK, lw=4, solid_capstyle="round")
    post = 0.85 * length * unit(45)
    axes.add_patch(Circle(post, 0.1, fc=INK, ec=INK, zorder=6))
    axes.annotate("post", post, (26, 8), textcoords="offset points", va="center", ha="center")
    axes.annotate("start", (length, 0), (14, 0), textcoords="offset points", va="center")
    axes.annotate("end", (0, length), (0, 8), textcoords="offset points", ha="center")
    axes.annotate("path of the tip", length * unit(20), (10, 4), textcoords="offset points", color=BLUE, size=10)
    axes.plot([-0.1, 0.45], [1.0, 1.0], color=ORANGE, lw=1)
    axes.annotate("hull of start and end", (-0.15, 1.0), ha="right", va="center", color=ORANGE, size=10)
    axes.plot(0, 0, "o", mfc="white", mec=INK, markersize=7, zorder=6)


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (ray, relative, offsets, slabs, rounded, turn)}
"""The figures by name."""


def _crossed(start: ArrayLike, along: ArrayLike, radius: float) -> list[NDArray[np.float64]]:
    """Where a line crosses a circle around the origin."""
    x, u = np.asarray(start, dtype=float), np.asarray(along, dtype=float)
    half = np.sqrt((x @ u) ** 2 - x @ x + radius**2)
    return [x + (-(x @ u) + side * half) * u for side in (-1, 1)]
