"""Figures of statement 10: a ray against a Minkowski sum, slabs over time, and what is left once a body turns."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from solutions.sweeping import (
    motion_bound,
    ray_box,
    rotated,
    separation_of_hulls,
    sweep_convex,
)

BLACK, BLUE, ORANGE, GREEN, GREY = "#1b1b1b", "#0072b2", "#d55e00", "#009e73", "#999999"
STILL = np.zeros(3)
ROD = np.array([[0.0, 0, 0], [1.0, 0, 0]])
TURNING = np.array([0.0, 0.0, 2.0])
POST, POST_RADIUS = np.array([0.5, 0.75, 0.0]), 0.08


def minkowski_sum(figure: Figure) -> None:
    """Two moving boxes (left), and the same seen from B (right): A is a point, B has grown, the way of A is a ray."""
    world, relative = figure.subplots(1, 2)
    half_a, half_b = np.array([0.3, 0.2, 0.1]), np.array([0.5, 0.4, 0.1])
    place_a, place_b = np.array([-2.0, -0.8, 0]), np.array([0.6, 0.9, 0])
    way_a, way_b = np.array([2.2, 0.9, 0]), np.array([0.1, -1.0, 0])
    first, last = ray_box(place_a - place_b, way_a - way_b, half_a + half_b)
    for place, way, half, color, name in ((place_a, way_a, half_a, BLUE, "A"), (place_b, way_b, half_b, ORANGE, "B")):
        for time, style in ((0.0, ":"), (float(first), "-")):
            corner = (place + way * time - half)[:2]
            world.add_patch(
                Rectangle(tuple(corner), *2 * half[:2], fill=False, edgecolor=color, linestyle=style, lw=1.6)
            )
        world.annotate("", (place + way * first)[:2], place[:2], arrowprops={"arrowstyle": "->", "color": color})
        world.annotate(name, place[:2], (8, -2) if name == "B" else (-4, -22), textcoords="offset points", color=color)
    world.set(xlim=(-2.6, 1.4), ylim=(-1.4, 1.6), aspect="equal", xlabel="x, m", ylabel="y, m", title="In the world")
    start, way = (place_a - place_b)[:2], (way_a - way_b)[:2]
    grown = half_a + half_b
    relative.add_patch(
        Rectangle(tuple(-grown[:2]), *2 * grown[:2], facecolor="#f6ddcb", edgecolor=ORANGE, linestyle="--")
    )
    relative.add_patch(Rectangle(tuple(-half_b[:2]), *2 * half_b[:2], facecolor="#e9a67a", edgecolor=ORANGE))
    relative.plot(*np.array([start, start + way * min(float(last), 1.4) * 1.1]).T, color=BLUE)
    for time, marker in ((first, "o"), (last, "s")):
        relative.plot(*(start + way * time), marker, color=BLACK)
    relative.plot(*start, ".", color=BLUE, markersize=10)
    relative.annotate(
        f"enters at {first:.2f}", start + way * first, (-4, 10), textcoords="offset points", ha="right", fontsize=9
    )
    relative.annotate("B grown by A", (0, -grown[1]), (0, -13), textcoords="offset points", ha="center", fontsize=9)
    relative.set(xlim=(-3, 1.3), ylim=(-2, 1.3), aspect="equal", xlabel="x, m", title="Seen from B")


def rod_at(time: float) -> np.ndarray:
    """Both ends of the turning rod."""
    return rotated(ROD, TURNING * time)


def advance(dt: float) -> list[tuple[float, float]]:
    """Give the looks of a conservative advancement of the rod towards the post: times and separations."""
    looks, time = [], 0.0
    while time <= dt:
        separation, normal = separation_of_hulls(rod_at(time), POST[None])
        gap = float(separation) - POST_RADIUS
        looks.append((time, gap))
        if gap < 1e-3:
            break
        time += gap / float(motion_bound(STILL, TURNING, 1.0, -normal))
    return looks


def draw_rod(axes: Axes, time: float, **style: object) -> None:
    """Draw the rod at a time."""
    axes.plot(*rod_at(time)[:, :2].T, **style)


def turning_rod(figure: Figure) -> None:
    """A rod turns towards a post: the hull of its start and its end (dashed) misses part of what it sweeps.

    A bound on its motion needs no swept volume: looks spaced by it close in on the touch and never pass it.
    """
    plan, steps = figure.subplots(1, 2)
    dt = 0.9
    for time in np.linspace(0, dt, 40):
        draw_rod(plan, float(time), color="#cfe3f2", lw=3)
    hull = np.array([STILL, rod_at(0)[1], rod_at(dt)[1]])[:, :2]
    plan.add_patch(Polygon(hull, fill=False, edgecolor=ORANGE, linestyle="--", lw=1.8, zorder=4))
    looks = advance(dt)
    for time, _ in looks:
        draw_rod(plan, time, color=BLACK, lw=1)
    plan.add_patch(Circle(tuple(POST[:2]), POST_RADIUS, fc=GREEN, ec=BLACK, zorder=5))
    plan.set(xlim=(-0.35, 1.15), ylim=(-0.12, 1.12), aspect="equal", xlabel="x, m", ylabel="y, m", title="Swept volume")
    times = np.linspace(0, dt, 400)
    gaps = [float(separation_of_hulls(rod_at(float(time)), POST[None])[0]) - POST_RADIUS for time in times]
    steps.plot(times, gaps, color=BLUE, label="separation")
    for (time, gap), (later, _) in pairwise(looks):
        steps.plot([time, later], [gap, 0], color=GREY, lw=1)
    steps.plot(*np.array(looks).T, "o", color=BLACK, markersize=4, label=f"{len(looks)} looks")
    touch = float(sweep_convex(ROD, STILL, STILL, TURNING, 0.0, [STILL], POST, STILL, STILL, POST_RADIUS, dt))
    steps.axvline(touch, color=ORANGE, linestyle=":", label=f"touch, {touch:.3f} s")
    steps.axhline(0, color=GREY, lw=0.8)
    steps.set(xlabel="time, s", ylabel="separation, m", title="Advancement", xlim=(0, 0.55))
    steps.legend(fontsize=8)


FIGURES = {
    (10, "minkowski-sum"): minkowski_sum,
    (10, "turning-rod"): turning_rod,
}
