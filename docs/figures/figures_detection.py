"""Figures of the detection statements: sides of a plane, times of impact, overlap over a step, what steps miss."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from solutions import as_printed
from solutions.detection import (
    missing_probability,
    overlap_interval,
    side_of_plane,
    signed_distance,
    time_of_impact_exact,
    time_of_impact_interpolated,
)

GREY = "#999999"
GRAVITY = 9.81


def continuous_test(figure: Figure) -> None:
    """A ball flies through a wall between two steps: at both ends of the step nothing overlaps, within it they do."""
    axes = figure.add_subplot()
    speed, radius, thickness, dt = 20.0, 0.02, 0.01, 0.01
    start, end = overlap_interval(0.13, -speed, radius, thickness, dt)
    times = np.linspace(0, dt, 201)
    place = 0.13 - speed * times
    axes.fill_between(1000 * times, place - radius, place + radius, color="#cfe3f2", label="ball")
    axes.plot(1000 * times, place, color="#0072b2")
    axes.axhspan(-thickness, 0, color=GREY, label="wall")
    axes.axvspan(1000 * start, 1000 * end, facecolor="none", edgecolor="#d55e00", hatch="///", label="overlap")
    axes.plot([0, 1000 * dt], [0.13, 0.13 - speed * dt], "o", color="#1b1b1b", markersize=8, label="what a step sees")
    axes.set(
        xlabel="time, ms",
        ylabel="distance before the front face, m",
        title="20 m/s, one step of 10 ms",
        ylim=(-0.12, 0.16),
    )
    axes.legend(loc="lower left", ncols=2)


def signed_distances(figure: Figure) -> None:
    """Points and their signed distances from the plane 3x + 4z = 2; the left side as printed is five times as much."""
    axes = figure.add_subplot()
    normal, offset = np.array([3.0, 0.0, 4.0]), -2.0
    points = np.array([[-0.4, 0, 1.2], [0.5, 0, 0.9], [0.5, 0, 0.125], [-0.6, 0, 0.2], [0.9, 0, -0.55]])
    along = np.array([-1.2, 1.2])
    axes.fill_between(along, -1, (2 - 3 * along) / 4, color="#e8e8e8")
    axes.plot(along, (2 - 3 * along) / 4)
    for point, distance in zip(points, signed_distance(points, normal, offset), strict=True):
        foot = point - distance * normal / 5
        side = int(side_of_plane(distance, 1e-12))
        axes.plot([point[0], foot[0]], [point[2], foot[2]], ":", color=GREY)
        axes.plot(
            point[0], point[2], {1: "o", 0: "D", -1: "s"}[side], color={1: "#0072b2", 0: "#009e73", -1: "#d55e00"}[side]
        )
        left_side = float(normal @ point + offset)
        label = f"s = {distance:+.2f} m" if side else "s = 0, on the plane"
        axes.annotate(
            f"{label}\nprinted: {left_side:+.2f}" if side else f"{label}\nprinted: not colliding",
            (point[0], point[2]),
            (9, 2) if side == 0 else (7, -8),
            textcoords="offset points",
            fontsize=8,
        )
    axes.set(xlabel="x, m", ylabel="z, m", xlim=(-1.2, 1.5), ylim=(-0.8, 1.4), aspect="equal")
    axes.set_title("In front (●), on (◆) and behind (■) the plane")


def chord_and_parabola(figure: Figure) -> None:
    """The slide's T is where the chord of a step cuts the plane: early by at most g Δt²/(8 v), in the step's middle."""
    path, error = figure.subplots(1, 2)
    height, speed, dt = 0.35, 0.6, 0.25
    times = np.linspace(0, dt, 101)
    fall = height - speed * times - GRAVITY * times**2 / 2
    exact = time_of_impact_exact(height, -speed, -GRAVITY)
    slide = time_of_impact_interpolated(height, fall[-1], 0.0, dt)
    path.axhline(0, color=GREY)
    path.plot(times, fall, label="path")
    path.plot([0, dt], [height, fall[-1]], "--", label="chord")
    path.plot(slide, 0, "s", color="#0072b2", label=f"slide's T, {slide:.3f} s")
    path.plot(exact, 0, "o", color="#1b1b1b", label=f"exact, {exact:.3f} s")
    path.set(xlabel="time in the step, s", ylabel="separation, m", title="One long step", ylim=(-0.18, 0.62))
    path.legend(loc="upper right", fontsize=8)
    dt, speed = 1e-3, 4.43
    heights = np.linspace(0, 1, 101)[1:-1] * (speed * dt + GRAVITY * dt**2 / 2)
    end = heights - speed * dt - GRAVITY * dt**2 / 2
    early = time_of_impact_exact(heights, -speed, -GRAVITY) - time_of_impact_interpolated(heights, end, 0.0, dt)
    error.plot(heights * 1e3, early * 1e9)
    error.axhline(GRAVITY * dt**2 / (8 * speed) * 1e9, color="#d55e00", linestyle="--")
    error.annotate("g Δt²/(8 v)", (0.1, 282), color="#d55e00")
    error.set(
        xlabel="separation at its start, mm", ylabel="T too early by, ns", title="1 ms at 4.43 m/s", ylim=(0, 310)
    )


def printed_time_of_impact(figure: Figure) -> None:
    """With the signed distances of slide 4, slide 5 puts the impact outside the step; its d are magnitudes."""
    axes = figure.add_subplot()
    before, dt = 0.3, 0.1
    after = np.linspace(-0.6, 0.3, 901)
    printed = as_printed.time_of_impact(0.0, dt, before, after)
    right = time_of_impact_interpolated(before, after, 0.0, dt)
    for piece in (after < -before - 1e-9, after > -before + 1e-9):
        axes.plot(after[piece], 1e3 * printed[piece], "--", color="#d55e00")
    axes.plot([], [], "--", color="#d55e00", label="as printed, d2 signed")
    axes.plot(after, 1e3 * np.where(np.isfinite(right), right, np.nan), label="with magnitudes, none without impact")
    axes.axhspan(0, 1e3 * dt, color="#e8e8e8", label="the step")
    axes.axvline(0, color=GREY, linewidth=1)
    axes.annotate("does not reach\nthe plane", (0.02, -150), fontsize=9)
    axes.annotate("goes through", (-0.02, -150), fontsize=9, ha="right")
    axes.set(xlabel="separation at the end of the step, m", ylabel="T after its start, ms", ylim=(-200, 420))
    axes.set_title("A step of 100 ms that starts 0.3 m before the plane")
    figure.legend(loc="outside lower center", ncols=3, fontsize=8)


def temporal_aliasing(figure: Figure) -> None:
    """Share of the balls that a test at each step misses; marks count 2000 shots of every phase, lines are theory."""
    axes = figure.add_subplot()
    radius, thickness, shots = 0.02, 0.01, 2000
    speeds, marks = np.linspace(0.5, 60, 400), np.linspace(3, 60, 12)
    phases = (np.arange(shots) + 0.5) / shots
    for dt, style, marker in ((1 / 60, "-", "o"), (1 / 240, "--", "s"), (1e-3, ":", "^")):
        line = axes.plot(
            speeds, missing_probability(speeds, thickness, radius, dt), style, label=f"Δt = {1000 * dt:.3g} ms"
        )
        looks = radius + marks[:, None, None] * dt * (phases[:, None] - np.arange(30))
        caught = np.any((looks <= radius) & (looks >= -(thickness + radius)), axis=-1)
        axes.plot(marks, 1 - caught.mean(axis=-1), marker, color=line[0].get_color(), markersize=5)
    axes.set(xlabel="speed, m/s", ylabel="share that is missed", ylim=(-0.03, 1))
    axes.set_title("A ball of 20 mm radius, a wall of 10 mm")
    axes.legend(loc="center right", bbox_to_anchor=(1.0, 0.42))


FIGURES = {
    (2, "continuous-test"): continuous_test,
    (4, "signed-distance"): signed_distances,
    (5, "chord-and-parabola"): chord_and_parabola,
    (5, "as-printed"): printed_time_of_impact,
    (9, "temporal-aliasing"): temporal_aliasing,
}
