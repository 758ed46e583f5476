"""The drawn figures of the lab on avoidance; `lab_figures.py` says how they are written."""

from __future__ import annotations

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board, span, unit
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Wedge


def wish(figure: Figure) -> None:
    """A body, its velocity, the wish towards the target, and the force between the two.

    A body, drawn as a small triangle, moves upwards to the right with its velocity v. A star is its target, to the
    right. From the body an arrow points straight at the star: the velocity that it wants, as long as its top speed. A
    third, thick arrow leads from the tip of the velocity to the tip of the wish. The force points in its direction.
    """
    axes = board(figure, (-3.2, 3.4), (-1.3, 1.6))
    body, target = np.array([-2.4, -0.6]), np.array([2.9, -0.1])
    velocity = np.array([1.5, 1.5])
    ahead = 2.3 * (target - body) / np.linalg.norm(target - body)
    axes.plot([body[0], target[0]], [body[1], target[1]], ":", color=GREY)
    axes.plot(*target, "*", color=INK, markersize=14)
    axes.annotate("target", target, (0, -17), textcoords="offset points", ha="center")
    arrow(axes, body, velocity, INK, "velocity $v$", at=0.55, beside=(-38, 6))
    arrow(axes, body, ahead, BLUE, "wanted", at=0.55, beside=(0, -13))
    arrow(axes, body + velocity, ahead - velocity, ORANGE, "force", at=0.45, beside=(24, 8))
    axes.plot(*body, ">", color=INK, markersize=11)


def field(figure: Figure) -> None:
    """The force of the field over the separation, and a flier in front of a pillar.

    On the left a curve: the force is F0 at the surface and inside, falls with a curve that is bent upwards, and meets
    the axis without a kink at the reach R. On the right a round pillar with a dashed circle, its reach. Arrows point
    straight away from the pillar, long ones near it and short ones farther out. A flier straight to the left of it has
    an arrow to its goal, which is straight behind the pillar: both arrows are in one line.
    """
    curve, plan = figure.subplots(1, 2, width_ratios=(1, 1.5))
    s = np.linspace(-0.35, 1.5, 200)
    curve.plot(s, np.clip(1 - s, 0, 1) ** 2, color=BLUE, lw=2)
    curve.plot([0, 0], [0, 1], ":", color=GREY)
    curve.set(xlim=(-0.4, 1.5), ylim=(0, 1.25), xticks=(0, 1), yticks=(1,))
    curve.set_xticklabels(["0", "$R$"])
    curve.set_yticklabels(["$F_0$"])
    curve.set_xlabel("separation $s$")
    for side in ("top", "right"):
        curve.spines[side].set_visible(False)
    plan.set(xlim=(-2.9, 2.5), ylim=(-1.7, 1.7), aspect="equal")
    plan.set_axis_off()
    plan.add_patch(Circle((0, 0), 0.5, fc=LIGHT, ec=INK, lw=1.6))
    plan.add_patch(Circle((0, 0), 1.6, fc="none", ec=GREY, ls="--"))
    for angle in (35, 90, 145, 215, 270, 325):
        for far, long in ((0.6, 0.5), (1.15, 0.16)):
            arrow(plan, far * unit(angle), long * unit(angle), BLUE)
    flier = np.array([-1.25, 0.0])
    arrow(plan, flier, (-0.55, 0), BLUE, "field", at=0.9, beside=(-12, 9))
    arrow(plan, flier, (0.55, 0), ORANGE, "pull", at=0.7, beside=(0, 10))
    plan.plot(*flier, "o", color=INK, markersize=7, zorder=6)
    plan.plot(2.2, 0, "*", color=INK, markersize=14)
    plan.annotate("goal", (2.2, 0), (0, -17), textcoords="offset points", ha="center")


def tangent(figure: Figure) -> None:
    """A flier, a sphere, the tangent, and the perpendicular from the tangent point to the line to the centre.

    The flier is on the left, at the distance L from the centre of a circle of radius r. From the flier a line of length
    k touches the circle above, at the tangent point, where a small square marks the right angle between it and the
    radius. From the tangent point a dashed perpendicular of length s drops onto the line to the centre. Its foot is t
    short of the centre.
    """
    axes = board(figure, (-3.5, 3.2), (-1.9, 2.0))
    flier, centre, radius = np.array([-3.1, -0.3]), np.array([1.4, -0.3]), 1.5
    far = float(centre[0] - flier[0])
    short = radius**2 / far
    touch = centre + np.array([-short, np.sqrt(radius**2 - short**2)])
    foot = centre - (short, 0)
    axes.add_patch(Circle(centre, radius, fc=LIGHT, ec=INK, lw=1.6))
    axes.plot([flier[0], centre[0]], [flier[1], centre[1]], color=GREY, lw=1.2)
    axes.plot([touch[0], centre[0]], [touch[1], centre[1]], color=INK, lw=1.4)
    axes.plot([touch[0], foot[0]], [touch[1], foot[1]], "--", color=ORANGE, lw=1.6)
    arrow(axes, flier, touch - flier, BLUE, "$k$", at=0.55, beside=(-6, 11))
    corner = 0.2 * (flier - touch) / np.linalg.norm(flier - touch), 0.2 * (centre - touch) / radius
    square = np.array([touch + corner[0], touch + corner[0] + corner[1], touch + corner[1]])
    axes.plot(*square.T, color=INK, lw=1)
    axes.plot(*flier, ">", color=INK, markersize=11)
    axes.plot(*centre, "+", color=INK, markersize=9)
    axes.plot(*touch, "o", color=ORANGE, markersize=7, zorder=6)
    axes.annotate("$r$", (touch + centre) / 2, (9, 4), textcoords="offset points", ha="center")
    axes.annotate("$s$", (touch + foot) / 2, (-8, -4), textcoords="offset points", color=ORANGE, ha="center")
    axes.annotate("$t$", (foot + centre) / 2, (0, 5), textcoords="offset points", ha="center")
    span(axes, (flier[0], -1.05), (centre[0], -1.05), "$L$")


def miss(figure: Figure) -> None:
    """The way of A as seen from B, and the point where it is nearest.

    B is a ball at rest in the middle. A point A is on the left at x, the vector from B to A, and moves along a straight
    line with u. The line passes above B. A dot marks the point of the line that is nearest to B, and there a small
    square shows that the vector from B is at right angles to the line. Behind this point A moves away.
    """
    axes = board(figure, (-3.4, 3.4), (-1.1, 1.9))
    start, along = np.array([-2.9, 0.35]), unit(10)
    nearest = start - (start @ along) * along
    axes.add_patch(Circle((0, 0), 0.45, fc=LIGHT, ec=INK, lw=1.6))
    axes.annotate("B", (0, 0), (0, -24), textcoords="offset points", ha="center", weight="bold")
    arrow(axes, start, 6.2 * along, GREY)
    arrow(axes, start, 1.2 * along, BLUE, "$u$", at=0.7, beside=(0, 9))
    arrow(axes, (0, 0), start, INK, "$x$", at=0.62, beside=(0, -11))
    arrow(axes, (0, 0), nearest, ORANGE)
    across = 0.18 * nearest / np.linalg.norm(nearest)
    square = np.array([nearest - across, nearest - across - 0.18 * along, nearest - 0.18 * along])
    axes.plot(*square.T, color=INK, lw=1)
    axes.plot(*start, "o", color=INK, markersize=7, zorder=6)
    axes.annotate("A", start, (-10, 6), textcoords="offset points", ha="center", weight="bold")
    axes.plot(*nearest, "o", color=ORANGE, markersize=8, zorder=6)
    axes.annotate("nearest", nearest, (2, 9), textcoords="offset points", ha="center", color=ORANGE)
    axes.annotate("moves away", start + 5.3 * along, (0, -14), textcoords="offset points", ha="center", color=GREY)


def pushes(figure: Figure) -> None:
    """Three boids, with the pushes that each pair adds.

    Three boids 0, 1 and 2 form a triangle; thin lines join the pairs. From each boid two arrows point away from the
    other two. Boids 0 and 1 are near each other, and their arrows are long. Boid 2 is farther away, and its arrows and
    those that it causes are short. The two arrows of a pair are equally long and opposite. A fourth boid, 3, is in no
    pair and has no arrow.
    """
    axes = board(figure, (-3.4, 3.4), (-1.7, 1.9))
    places = np.array([[-1.3, -0.5], [-0.4, 0.35], [1.3, -0.7]])
    for i, j in ((0, 1), (0, 2), (1, 2)):
        axes.plot(*places[[i, j]].T, color=GREY, lw=1)
        apart = places[i] - places[j]
        push = 1.15 * apart / (apart @ apart)
        arrow(axes, places[i], push, BLUE)
        arrow(axes, places[j], -push, BLUE)
    names = ((0, (-2, -15)), (1, (2, -18)), (2, (0, 10)))
    for which, beside in names:
        axes.plot(*places[which], "o", color=INK, markersize=8, zorder=6)
        axes.annotate(str(which), places[which], beside, textcoords="offset points", ha="center", weight="bold")
    axes.plot(2.6, 1.4, "o", mfc="white", color=INK, markersize=8)
    axes.annotate("3", (2.6, 1.4), (13, -4), textcoords="offset points", ha="center", weight="bold")


def halfplane(figure: Figure) -> None:
    """The plane of relative velocities: the cone with its round end, u, the change to the border, and A's half-plane.

    On the left the plane of relative velocities. From zero the vector x leads towards B. A grey cone around it has its
    tip at zero, and is cut off by a round end. A relative velocity u is inside, a little above the axis. A short arrow
    c, at right angles to the upper side of the cone, leads from u to this side. On the right the plane of A's own
    velocities: from v_A an arrow of half the length leads to a straight border. The side beyond the border is hatched:
    it is permitted to A.
    """
    cone, own = figure.subplots(1, 2, width_ratios=(1.35, 1))
    for axes, wide, high in ((cone, (-0.6, 4.2), (-1.7, 2.2)), (own, (-1.15, 1.25), (-1.2, 1.25))):
        axes.set(xlim=wide, ylim=high, aspect="equal")
        axes.set_axis_off()
    tilt, half = 8.0, 24.0
    ahead, side = unit(tilt), unit(tilt + half)
    middle = 1.9
    radius = middle * np.sin(np.radians(half))
    starts = middle * np.cos(np.radians(half))
    cone.add_patch(Wedge((0, 0), 3.8, tilt - half, tilt + half, width=3.8 - starts, fc=LIGHT, ec="none"))
    cone.add_patch(Circle(middle * ahead, radius, fc=LIGHT, ec="none"))
    for sign in (-1, 1):
        leg = unit(tilt + sign * half)
        cone.plot(*np.array([starts * leg, 3.8 * leg]).T, color=INK, lw=1.6)
        cone.plot(*np.array([0 * leg, starts * leg]).T, ":", color=GREY)
    cone.add_patch(Arc((middle * ahead[0], middle * ahead[1]), 2 * radius, 2 * radius, angle=tilt,
                       theta1=90 + half, theta2=270 - half, ec=INK, lw=1.6))  # fmt: skip
    cone.plot(0, 0, "+", color=INK, markersize=9)
    cone.annotate("0", (0, 0), (-8, -12), textcoords="offset points", ha="center")
    arrow(cone, (0, 0), 3.6 * ahead, GREY, "to B", at=0.93, beside=(0, -11))
    u = 2.7 * unit(tilt + 8)
    normal = np.array([-side[1], side[0]])
    change = -(u @ normal) * normal
    cone.plot(*u, "o", color=INK, markersize=7, zorder=6)
    cone.annotate("$u$", u, (11, -6), textcoords="offset points", ha="center")
    arrow(cone, u, change, ORANGE, "$c$", at=0.5, beside=(-10, -2))
    cone.annotate("relative velocities", (1.9, -1.6), ha="center", color=GREY, size=10)
    start = np.array([0.1, -0.55])
    point = start + change / 2
    ends = np.array([point - 1.2 * side, point + 1.2 * side])
    own.add_patch(Polygon(np.concatenate([ends, ends[::-1] + 0.4 * normal]), fc="none", ec=BLUE, hatch="///", lw=0))
    own.plot(*ends.T, color=BLUE, lw=2)
    arrow(own, start, change / 2, ORANGE, "$c/2$", at=0.6, beside=(20, 3))
    arrow(own, point - 0.6 * side, 0.6 * normal, INK, "$n$", at=1.0, beside=(-8, 3))
    own.plot(*start, "o", color=INK, markersize=7, zorder=6)
    own.annotate("$v_A$", start, (12, -9), textcoords="offset points", ha="center")
    own.annotate("permitted", point + 0.62 * normal + 0.35 * side, ha="center", color=BLUE, size=10)
    own.annotate("velocities of A", (0.05, -1.14), ha="center", color=GREY, size=10)


LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (wish, field, tangent, miss, pushes, halfplane)}
"""The figures by name."""
