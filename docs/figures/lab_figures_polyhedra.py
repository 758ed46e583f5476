"""The drawn figures of the lab on polyhedra; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Polygon, Wedge
from numpy.typing import ArrayLike, NDArray


def heights(figure: Figure) -> None:
    """Two points and the planes of a convex solid, seen from the side.

    A convex solid with its outward normals. A point q inside is behind all planes, and its depth is the way to the
    nearest of them. A point p lies beyond a corner. It is in front of two planes, at the heights h1 and h2. A dashed
    line shows that the corner itself is farther away than either height.
    """
    axes = board(figure, (-3.3, 3.6), (-1.75, 2.0))
    corners = np.array([(-1.9, -1.2), (1.0, -1.2), (1.5, 0.5), (-1.2, 0.8)])
    axes.add_patch(Polygon(corners, fc=LIGHT, ec=INK))
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        normal = _right(end - start)
        arrow(axes, start + 0.42 * (end - start), 0.42 * normal, GREY)
    corner, p, q = corners[2], np.array([2.9, 1.5]), np.array([0.35, -0.75])
    right, top = _right(corners[2] - corners[1]), _right(corners[3] - corners[2])
    axes.plot(*zip(corner, corner + 1.25 * _along(corner - corners[1]), strict=True), ":", color=GREY)
    axes.plot(*zip(corner, corner + 1.75 * _along(corner - corners[3]), strict=True), ":", color=GREY)
    arrow(axes, p, -((p - corner) @ right) * right, ORANGE, "$h_1$", at=0.5, beside=(2, -11))
    arrow(axes, p, -((p - corner) @ top) * top, BLUE, "$h_2$", at=0.55, beside=(10, 0))
    axes.plot(*zip(p, corner, strict=True), "--", color=INK, lw=1.2)
    axes.plot(*p, "o", color=INK, markersize=7)
    axes.annotate("$p$", p, (9, 5), textcoords="offset points")
    arrow(axes, q, ((corners[1] - q) @ np.array([0, -1.0])) * np.array([0, -1.0]), ORANGE, "depth", 0.5, (23, 0))
    axes.plot(*q, "o", color=INK, markersize=7)
    axes.annotate("$q$", q, (-10, 5), textcoords="offset points")


def areas(figure: Figure) -> None:
    """A segment goes through the plane of a triangle at a point x.

    A triangle a, b, c lies in a plane. A segment comes from start on one side and goes to end on the other side. It
    meets the plane at x, which is inside the triangle here. Lines from x to the corners cut the triangle into three
    smaller ones. The one opposite to a corner has the share of the area that is the weight of this corner. A second
    segment, drawn grey, meets the plane outside the triangle.
    """
    axes = board(figure, (-3.6, 3.6), (-1.75, 2.1))
    plane = np.array([(-3.3, -1.25), (1.9, -1.25), (3.3, 0.95), (-1.9, 0.95)])
    axes.add_patch(Polygon(plane, fc="none", ec=GREY, ls=":"))
    a, b, c = np.array([-1.7, -0.85]), np.array([1.4, -0.65]), np.array([0.5, 0.75])
    x = 0.25 * a + 0.35 * b + 0.4 * c
    for corners, look in (((x, b, c), "#ffffff"), ((x, c, a), LIGHT), ((x, a, b), "#c9d3e0")):
        axes.add_patch(Polygon(corners, fc=look, ec=INK))
    for name, corner, beside in (("$a$", a, (-10, -4)), ("$b$", b, (9, -6)), ("$c$", c, (4, 9))):
        axes.annotate(name, corner, beside, textcoords="offset points", ha="center", va="center")
    axes.plot(*zip((x + b + c) / 3, (1.75, 0.35), strict=True), color=GREY, lw=1)
    axes.annotate("weight of $a$", (1.8, 0.42), color=INK, ha="center", va="bottom", size=10)
    way = np.array([0.25, 1.35])
    arrow(axes, x + way, -way, BLUE, "start", at=0.0, beside=(20, 4))
    axes.plot(*zip(x, x - 0.95 * way, strict=True), "--", color=BLUE, lw=1.8)
    axes.annotate("end", x - 0.95 * way, (14, -2), textcoords="offset points", color=BLUE, va="center")
    axes.plot(*x, "o", color=ORANGE, markersize=7, zorder=6)
    axes.annotate("$x$", x, (-10, 7), textcoords="offset points", color=ORANGE, ha="center")
    miss = np.array([2.45, -0.35])
    arrow(axes, miss + 0.9 * way, -0.9 * way, GREY)
    axes.plot(*zip(miss, miss - 0.8 * way, strict=True), "--", color=GREY, lw=1.8)
    axes.plot(*miss, "s", mfc="white", mec=GREY, zorder=6)


def turning(figure: Figure) -> None:
    """Two points beside a line from a to b.

    A line runs from a to b. A point c lies to its left, and the way from a over b to c turns counter-clockwise, so the
    sign is +1. A second point lies to the right, with the sign −1. The grey triangle a, b, c has half the area of the
    parallelogram of b − a and c − a.
    """
    axes = board(figure, (-3.2, 3.3), (-1.7, 2.1))
    a, b, c, d = np.array([-2.2, -0.9]), np.array([1.7, 0.15]), np.array([-0.5, 1.5]), np.array([0.9, -1.2])
    axes.add_patch(Polygon([a, b, c], fc=LIGHT, ec="none"))
    along = _along(b - a)
    axes.plot(*zip(a - 0.8 * along, b + 1.3 * along, strict=True), ":", color=GREY)
    arrow(axes, a, b - a, INK, "$b - a$", at=0.55, beside=(6, -12))
    arrow(axes, a, c - a, BLUE, "$c - a$", at=0.55, beside=(-22, 6))
    axes.add_patch(Arc((a[0], a[1]), 2.0, 2.0, theta1=15, theta2=54, color=BLUE, lw=1.6))
    for name, point, beside in (("$a$", a, (-8, -10)), ("$b$", b, (5, -12)), ("$c$: +1", c, (24, 8))):
        axes.plot(*point, "o", color=INK, markersize=5)
        axes.annotate(name, point, beside, textcoords="offset points", ha="center", va="center")
    axes.plot(*d, "s", mfc="white", mec=ORANGE, markersize=7)
    axes.annotate("−1", d, (16, -1), textcoords="offset points", color=ORANGE, ha="center", va="center")


def crossings(figure: Figure) -> None:
    """Rays from four points to the outside of a solid with a notch.

    A solid in the shape of a U, seen from the side. A ray up from a point in its left arm leaves the solid once:
    inside. A ray from a point under the notch, in the floor, leaves the solid once as well. A ray from a point left of
    the solid that runs to the right crosses four borders, an even number: outside. A ray up through the edge where two
    faces of the top meet touches both of them, although it leaves the solid only once there.
    """
    axes = board(figure, (-3.6, 3.6), (-1.7, 2.15))
    corners = np.array([(-2.3, -1.3), (2.3, -1.3), (2.3, 0.7), (1.6, 1.15), (0.9, 0.7), (0.9, -0.5), (-0.9, -0.5),
                        (-0.9, 0.9), (-2.3, 0.9)])  # fmt: skip
    axes.add_patch(Polygon(corners, fc=LIGHT, ec=INK))
    arrow(axes, (-1.75, -0.15), (0, 1.95), BLUE, "1", at=0.93, beside=(-9, 0))
    axes.plot(-1.75, 0.9, "o", color=BLUE, zorder=6)
    axes.plot(-1.75, -0.15, "o", color=INK, zorder=6)
    arrow(axes, (-3.2, 0.3), (6.4, 0), INK, "4", at=0.97, beside=(0, 10), style="--")
    axes.plot([-2.3, -0.9, 0.9, 2.3], [0.3] * 4, "s", color=INK, zorder=6, markersize=5)
    axes.plot(-3.2, 0.3, "o", color=INK, zorder=6)
    arrow(axes, (1.6, -0.9), (0, 2.8), ORANGE, "1 or 2?", at=0.93, beside=(26, 0))
    axes.plot(1.6, 1.15, "D", color=ORANGE, zorder=6)
    axes.plot(1.6, -0.9, "o", color=INK, zorder=6)
    arrow(axes, (0.1, -0.95), (0, 2.5), BLUE, "1", at=0.94, beside=(9, 0))
    axes.plot(0.1, -0.5, "o", color=BLUE, zorder=6)
    axes.plot(0.1, -0.95, "o", color=INK, zorder=6)


def angles(figure: Figure) -> None:
    """How much of a point's view the sides of an outline take.

    Two drawings of the same outline, without its top side. On the left a point inside: the sides that are there take
    most of the directions, and only the gap above is left open. On the right a point outside: it sees the front of the
    near side and the back of the far sides under nearly the same directions. The first counts as minus, the others as
    plus, and they nearly cancel.
    """
    left, right = figure.subplots(1, 2)
    corners = np.array([(-1.0, 1.0), (-1.3, -1.0), (0.9, -1.0), (1.2, 0.9)])
    for axes, point, xs in ((left, np.array([-0.1, 0.1]), (-1.7, 1.7)), (right, np.array([-2.4, 0.0]), (-2.9, 1.6))):
        axes.set(xlim=xs, ylim=(-1.55, 1.55), aspect="equal")
        axes.set_axis_off()
        axes.plot(*corners.T, color=INK, lw=2)
        axes.plot(*corners[[0, 3]].T, ":", color=GREY)
        axes.plot(*point, "o", color=INK, zorder=6)
        for corner in corners:
            axes.plot(*zip(point, corner, strict=True), ":", color=GREY, lw=1)
    point = np.array([-0.1, 0.1])
    turns = np.unwrap(np.arctan2(*(corners - point).T[::-1]))
    left.add_patch(Wedge((point[0], point[1]), 0.5, *np.degrees([turns[0], turns[-1]]), fc=LIGHT, ec=BLUE, lw=1.6))
    left.annotate("+", (point[0], point[1] - 0.3), color=BLUE, ha="center", va="center", size=14)
    left.annotate("the gap", (0.1, 1.15), color=GREY, ha="center")
    point = np.array([-2.4, 0.0])
    turns = np.degrees(np.arctan2(*(corners - point).T[::-1]))
    right.add_patch(Wedge((point[0], point[1]), 0.75, turns[1], turns[0], fc="none", ec=ORANGE, lw=1.8))
    right.add_patch(Wedge((point[0], point[1]), 1.9, turns[1], turns[3], width=0.35, fc=LIGHT, ec=BLUE, lw=1.6))
    right.annotate("−", (-1.9, 0.0), color=ORANGE, ha="center", va="center", size=14)
    right.annotate("+", (-0.68, -0.08), color=BLUE, ha="center", va="center", size=14)


def crossed(figure: Figure) -> None:
    """Two bars that go through each other, and a rod that goes through a plate.

    On the left two bars cross like the strokes of a plus sign. No corner of either is inside the other. On the right a
    thin rod goes through the middle of a plate. The rod's edges go through the faces of the plate, but no edge of the
    plate meets the rod.
    """
    left, right = figure.subplots(1, 2)
    for axes in (left, right):
        axes.set(xlim=(-1.8, 1.8), ylim=(-1.7, 1.7), aspect="equal")
        axes.set_axis_off()
    for corners, look, colour in (
        ([(-1.6, -0.3), (1.5, -0.35), (1.5, 0.25), (-1.6, 0.3)], LIGHT, INK),
        ([(-0.35, -1.5), (0.25, -1.5), (0.35, 1.5), (-0.25, 1.5)], "none", BLUE),
    ):
        left.add_patch(Polygon(corners, fc=look, ec=colour, lw=1.8))
        left.plot(*np.transpose(corners), "o", color=colour, markersize=6)
    plate = np.array([(-1.6, -0.75), (0.9, -0.75), (1.6, 0.55), (-0.9, 0.55)])
    for x in (-0.12, 0.12):
        right.plot([x, x], [-1.5, -0.87], color=BLUE, lw=1.8)
        right.plot([x, x], [-0.87, -0.1], "--", color=BLUE, lw=1.2, zorder=5)
        right.plot([x, x], [-0.1, 1.5], color=BLUE, lw=1.8, zorder=5)
        right.plot(x, -0.1, "D", color=ORANGE, zorder=6, markersize=5)
    right.add_patch(Polygon(plate, fc=LIGHT, ec=INK, lw=1.8))
    right.add_patch(Polygon(np.vstack([plate[:2], plate[1::-1] - (0, 0.13)]), fc="#ffffff", ec=INK, lw=1.2))
    right.add_patch(Polygon(np.vstack([plate[1:3], plate[2:0:-1] - (0, 0.13)]), fc="#ffffff", ec=INK, lw=1.2))
    right.plot([-0.12, 0.12], [1.5, 1.5], color=BLUE, lw=1.8)
    right.plot([-0.12, 0.12], [-1.5, -1.5], color=BLUE, lw=1.8)


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (heights, areas, turning, crossings, angles, crossed)}
"""The figures by name."""


def _along(way: ArrayLike) -> NDArray[np.float64]:
    along = np.asarray(way, dtype=float)
    return np.asarray(along / np.linalg.norm(along))


def _right(way: ArrayLike) -> NDArray[np.float64]:
    """The unit vector to the right of a way, which points outwards if the way runs round counter-clockwise."""
    x, y = _along(way)
    return np.array([y, -x])
