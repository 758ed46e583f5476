"""Figures of contacts that spring: Hertz's law, and a ball that also springs back sideways."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from reference.superball_truth import between_walls
from solutions.forces import semi_implicit_euler
from solutions.response import hertz_contact_time, hertz_force, penalty_force

UP = np.array([0.0, 0.0, 1.0])
SPEEDS, COLOURS = (0.5, 1.0, 2.0), ("#0072b2", "#1b1b1b", "#d55e00")


def hertz_impact(figure: Figure) -> None:
    """Force over an impact at three speeds: a linear spring holds each equally long, Hertz's a fast one less long.

    Both contacts hold 1 kg at 1 m/s for the same time. Marks show the end of the contact by the closed form.
    """
    mass, linear, dt, count = 1.0, 1e4, 1e-5, 4000
    lasts = math.pi * math.sqrt(mass / linear)
    hertz = (3.218 / lasts) ** 2.5 * mass
    axes = figure.subplots(1, 2, sharey=True)
    for side, (name, stiffness, law) in zip(
        axes, (("linear, k d", linear, penalty_force), ("Hertz, k d^{3/2}", hertz, hertz_force)), strict=True
    ):
        for speed, colour in zip(SPEEDS, COLOURS, strict=True):
            position, velocity, forces = np.zeros(3), -speed * UP, []
            for _ in range(count):
                force = law(position[2], velocity[2], UP, stiffness)
                position, velocity = semi_implicit_euler(position, velocity, force / mass, dt)
                forces.append(force[2])
            side.plot(1e3 * dt * np.arange(count), forces, color=colour, lw=1.6, label=f"{speed:g} m/s")
            end = lasts if law is penalty_force else float(hertz_contact_time(mass, stiffness, speed))
            side.plot(1e3 * end, 0, "o", ms=5, color=colour, clip_on=False, zorder=3)
        side.set(xlabel="time, ms", title=name.replace("d^{3/2}", "d$^{3/2}$"), xlim=(0, 40), ylim=(0, 290))
    axes[0].set_ylabel("force, N")
    axes[1].legend(loc="upper right")


def superball(figure: Figure) -> None:
    """A ball thrown under a table: e_t = 0 drifts on to the far side, and a superball, e_t = 1, comes back.

    Without weight, e = 1 and much friction. Along the surface the superball has 3/7, −31/49 and −333/343 of its first
    speed after the three bounces (Garwin 1969).
    """
    axes = figure.add_subplot()
    height = 1.0
    for e_t, colour, style in ((0.0, "#0072b2", "--"), (0.5, "#999999", ":"), (1.0, "#d55e00", "-")):
        thrown, surface = np.array([1.0, 0.0, -1.0]), np.zeros(3)
        bounces = between_walls(thrown, surface, (UP, -UP, UP), (1.0, 1.0, 1.0), 50.0, e_t)
        path = [np.array([0.0, 0.0, height])]
        for velocity, _ in ((thrown, surface), *bounces):
            path.append(path[-1] + velocity * abs(height / velocity[2]))
        x, _, z = np.transpose(path)
        axes.plot(x, z, style, color=colour, lw=1.6, label=f"e_t = {e_t:g}")
        axes.plot(x[-1], z[-1], "o", ms=6, color=colour)
    axes.annotate("thrown", (0, height), (6, 6), textcoords="offset points", fontsize=9)
    axes.axhline(0, color="#999999", lw=1)
    axes.plot([0.45, 4], [height, height], color="#999999", lw=3)
    axes.annotate("table", (3.3, height), (0, 5), textcoords="offset points", fontsize=9)
    axes.set(xlabel="along the floor, m", ylabel="height, m", ylim=(-0.08, 1.2), xlim=(-0.3, 4))
    axes.set_title("A superball comes back from under a table")
    axes.legend(loc="center right")


FIGURES = {
    (8, "hertz-impact"): hertz_impact,
    (16, "superball"): superball,
}
