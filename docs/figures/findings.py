"""Figures of the findings about the engines, in docs/engines.md: drawn from recordings, and one line by hand."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.bouncing_ball import drop_height
from reference.comparison.results import Job
from reference.recording.reading import recall, replay
from reference.report.figures import COLOURS, MARKERS
from reference.scene.scenario import GRAVITY
from solutions.forces import semi_implicit_euler
from solutions.response import kinematic_response
from solutions.world import propagate_impacts

GREY = "#777777"
UP = np.array([0.0, 0.0, 1.0])


def _rebounds(engine: str, profile: str, timestep: float) -> np.ndarray:
    """First rebound of each recorded drop at e = 0.5, as a share of its drop height."""
    result = recall(Job("dropped-ball", engine, profile, ("e=0.5",), changes=(("timestep", timestep),)))
    assert result is not None
    return np.array(next(row.values for row in result.rows if row.quantity == "rebound"))


def worse_with_smaller_steps(figure: Figure) -> None:
    """Rebound of 13 drops at each timestep in PyBullet: as installed, it bounces worse the smaller the timestep."""
    axes = figure.add_subplot()
    timesteps = np.array([1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4])
    for profile, name, colour, marker in (
        ("stock", "as installed", "#d55e00", "o"),
        ("tuned", "tuned", "#0072b2", "s"),
    ):
        drops = np.array([_rebounds("pybullet", profile, dt) for dt in timesteps])
        axes.plot(
            np.repeat(1e3 * timesteps, drops.shape[1]), drops.ravel(), marker, color=colour, markersize=3, alpha=0.4
        )
        dashes = ":" if profile == "stock" else "-"
        axes.plot(1e3 * timesteps, drops.mean(axis=1), dashes, marker=marker, color=colour, label=name)
    axes.axhline(0.25, color=GREY, linewidth=0.8)
    axes.annotate("theory, e² = 0.25", (0.16, 0.253), fontsize=9, color=GREY, va="bottom")
    axes.set_xscale("log")
    axes.set_xticks(1e3 * timesteps, [f"{1e3 * dt:g}" for dt in timesteps])
    axes.minorticks_off()
    axes.set(xlabel="timestep, ms", ylabel="first rebound ÷ drop height", xlim=(0.15, 13), ylim=(-0.01, 0.33))
    axes.set_title("PyBullet: a ball dropped from about 1 m, e = 0.5")
    axes.legend(loc="lower right")


def _drop_by_hand(height: float, dt: float) -> tuple[float, float]:
    """How deep the ball is when a step of semi-implicit Euler first ends inside the floor, and its first rebound, m.

    The next step begins with the rebound at e = 0.5 and has no weight in it, as the hand-written step does.
    """
    position, velocity, weight, deepest = height * UP, np.zeros(3), -GRAVITY * UP, 0.0
    while deepest == 0 or velocity[2] > 0:
        highest = position[2]
        struck = position[2] < 0 and velocity[2] < 0
        if struck:
            deepest, velocity = -float(position[2]), kinematic_response(velocity, UP, 0.5)
        position, velocity = semi_implicit_euler(position, velocity, 0 * UP if struck else weight, dt)
    return deepest, float(highest)


def where_the_floor_is_noticed(figure: Figure) -> None:
    """Thirteen drops at steps of 1 ms: the deeper the ball is when the floor is noticed, the lower it rebounds."""
    axes = figure.add_subplot()
    dt, case = 1e-3, catalogue()["dropped-ball"].case("e=0.5")
    heights = np.array([drop_height(scenario) for scenario in case.scenarios])
    depths, by_hand = np.transpose([_drop_by_hand(height, dt) for height in heights])
    found = {
        "handwritten": (by_hand, "hand-written, step"),
        "dart": (_rebounds("dart", "stock", dt) * heights, "DART, as installed"),
        "pybullet": (_rebounds("pybullet", "tuned", dt) * heights, "PyBullet, tuned"),
    }
    order = np.argsort(depths)
    for engine, (rebounds, name) in found.items():
        off = 1e3 * (rebounds - heights / 4)[order]
        axes.plot(1e3 * depths[order], off, marker=MARKERS[engine], color=COLOURS[engine], markersize=4, label=name)
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.set(
        xlabel="depth of the ball when the floor is noticed, mm",
        ylabel="rebound less theory, mm",
        ylim=(-3.2, 1.8),
    )
    axes.set_title("A ball dropped from about 1 m, e = 0.5, timestep 1 ms")
    axes.legend(loc="upper right")


def a_slab_from_above(figure: Figure) -> None:
    """A slab sent off at 30° on a level floor, from above: with a pyramid of friction it leaves its line."""
    axes = figure.add_subplot()
    case = "μ=0.4,v=2,heading=30°"
    for engine, name, dashes in (
        ("mujoco", "MuJoCo, as installed", (0, (1, 1.6))),
        ("dart", "DART, as installed", (0, (4, 1.5))),
        ("pybullet", "PyBullet, as installed", "-"),
    ):
        poses = replay(Job("sliding-slab", engine, "stock"), case)
        way = 1e3 * (poses.positions[:, 0, :2] - poses.positions[0, 0, :2])
        axes.plot(*way.T, linestyle=dashes, color=COLOURS[engine])
        axes.plot(*way[-1], MARKERS[engine], color=COLOURS[engine], label=f"{name}: {np.hypot(*way[-1]):.0f} mm")
    line = 509.684 * np.array([math.cos(math.radians(30)), math.sin(math.radians(30))])
    axes.plot(*np.transpose([0 * line, line]), color=GREY, linewidth=0.8)
    axes.plot(*line, "x", color=GREY, markersize=8, label="theory: 510 mm")
    axes.set(xlabel="along x, mm", ylabel="along y, mm", aspect="equal", xlim=(-10, 620), ylim=(-20, 480))
    axes.set_title("μ = 0.4, 2 m/s; marks show where the run ends")
    axes.legend(loc="upper left")


def _final_velocities(engine: str, profile: str, case: str) -> np.ndarray:
    """Velocities of the five balls over the last three frames of the replay, m/s."""
    poses = replay(Job("cradle", engine, profile), case)
    return np.asarray((poses.positions[-1, :, 0] - poses.positions[-3, :, 0]) / (poses.times[-1] - poses.times[-3]))


def five_balls(figure: Figure) -> None:
    """Velocities after the first of five elastic balls has struck the others at 1 m/s, touching and 1 µm apart."""
    numbers, start = np.arange(1, 6), np.array([1.0, 0.0, 0.0, 0.0, 0.0])
    panels = figure.subplots(1, 2, sharey=True)
    for axes, case in zip(panels, ("5 touching", "5, 1 µm apart"), strict=True):
        axes.plot(
            numbers, propagate_impacts(start, 1.0, 1.0), "-o", color="#1b1b1b", label="hand-written, pair by pair"
        )
        axes.plot(numbers, _final_velocities("pybullet", "tuned", case), "--s", color="#0072b2", label="tuned engines")
        axes.plot(
            numbers, _final_velocities("pybullet", "spring", case), "-.", color="#cc79a7", label="PyBullet, spring"
        )
        axes.plot(
            numbers, _final_velocities("mujoco", "stock", case), ":^", color="#d55e00", label="MuJoCo, as installed"
        )
        axes.set(title=case.removeprefix("5, ").removeprefix("5 "), xlabel="ball", xticks=numbers)
    panels[0].set_ylabel("velocity afterwards, m/s")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)


FINDINGS: dict[str, Callable[[Figure], None]] = {
    "worse-with-smaller-steps": worse_with_smaller_steps,
    "where-the-floor-is-noticed": where_the_floor_is_noticed,
    "a-slab-from-above": a_slab_from_above,
    "five-balls": five_balls,
}
"""File name → figure."""
