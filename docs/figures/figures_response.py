"""Figures of the response statements: policies within a step, the guard, the end of bouncing, penalty contacts."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from solutions import as_printed
from solutions.detection import time_of_impact_exact, time_of_impact_interpolated
from solutions.forces import ballistic_motion, semi_implicit_euler
from solutions.response import (
    bounce_along_normal,
    kinematic_response,
    penalty_damping,
    penalty_force,
    penalty_rest_depth,
    penalty_restitution,
    penalty_step_limit,
    respond_at_impact,
    respond_at_step,
    time_until_rest,
)

GREY = "#999999"
UP, GRAVITY = np.array([0.0, 0.0, 1.0]), 9.81
PULL = -GRAVITY * UP


def _step(policy: str, position: np.ndarray, velocity: np.ndarray, restitution: float, dt: float) -> tuple:
    if policy == "at the step":
        return respond_at_step(position, velocity, PULL, UP, position[..., 2] < 0, restitution, dt)
    if policy == "exact root":
        time = time_of_impact_exact(position[..., 2], velocity[..., 2], -GRAVITY)
    else:
        end = ballistic_motion(position, velocity, PULL, dt)[0][..., 2]
        time = time_of_impact_interpolated(np.maximum(position[..., 2], 0.0), end, 0.0, dt)
    return respond_at_impact(position, velocity, PULL, UP, restitution, time, dt)


def accuracy(figure: Figure) -> None:
    """Error of the first rebound against the number of steps, root mean square over 60 drops: three policies."""
    axes = figure.add_subplot()
    restitution, heights = 0.7, np.linspace(0.45, 0.55, 60)
    timesteps = np.array([2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3])
    orders = {"at the step": "first order", "slide's T": "second order", "exact root": "rounding"}
    for policy, style, marker in (("at the step", "--", "s"), ("slide's T", "-.", "^"), ("exact root", "-", "o")):
        errors = []
        for dt in timesteps:
            position, velocity = np.outer(heights, UP), np.zeros((len(heights), 3))
            for _ in range(round(0.5 / dt)):
                position, velocity = _step(policy, position, velocity, restitution, dt)
            # The steps of semi-implicit Euler lie on a parabola whose slope is that of a velocity half a step ago.
            slope = velocity[:, 2] - GRAVITY * dt / 2 * (policy == "at the step")
            apex = position[:, 2] + slope**2 / (2 * GRAVITY)
            errors.append(np.sqrt(np.mean((apex - restitution**2 * heights) ** 2)))
        axes.loglog(0.5 / timesteps, errors, style, marker=marker, label=f"{policy}: {orders[policy]}")
    axes.set_xticks(0.5 / timesteps, [f"{0.5 / dt:.0f}" for dt in timesteps])
    axes.minorticks_off()
    axes.set(xlabel="steps for half a second", ylabel="error of the rebound, m", ylim=(1e-17, 1))
    axes.set_title("Ball dropped from about 0.5 m, e = 0.7")
    axes.legend(loc="center right")


def zeno(figure: Figure) -> None:
    """Ever shorter flights end at t1 (1 + e)/(1 − e): a step that goes past it ends at rest, in one call."""
    axes = figure.add_subplot()
    times = np.linspace(0, 3.0, 3001)
    for restitution, style in ((0.5, "-"), (0.7, "--")):
        height, *_ = bounce_along_normal(1.0, 0.0, -GRAVITY, restitution, times)
        end = time_until_rest(1.0, 0.0, -GRAVITY, restitution)
        line = axes.plot(times, height, style, label=f"e = {restitution}, rest at {end:.3f} s")
        axes.plot(end, 0, "o", color=line[0].get_color(), clip_on=False, zorder=3)
    axes.set(xlabel="length of the one step, s", ylabel="height after it, m", ylim=(0, 1.05), xlim=(0, 3))
    axes.set_title("Every point of these curves is a single step from the start")
    axes.legend(loc="upper right")


def two_policies(figure: Figure) -> None:
    """Backing up finds the instant of impact; at a time step the ball turns too deep, and rebounds too low."""
    axes = figure.add_subplot()
    dt, restitution = 0.04, 0.8
    times = np.linspace(0, 0.8, 801)
    exact, *_ = bounce_along_normal(0.45, 0.0, -GRAVITY, restitution, times)
    axes.plot(times, exact, color=GREY, linewidth=4, alpha=0.6, label="exact motion")
    for policy, style in (("exact root", "o"), ("at the step", "s--")):
        position, velocity, heights = 0.45 * UP, np.zeros(3), [0.45]
        for _ in range(20):
            position, velocity = _step(policy, position, velocity, restitution, dt)
            heights.append(position[2])
        colour = "#1b1b1b" if policy == "exact root" else "#d55e00"
        label = "backed up to the impact" if policy == "exact root" else "answered at the step"
        axes.plot(dt * np.arange(21), heights, style, color=colour, markersize=5, label=label)
    axes.axhline(0, color="#1b1b1b", linewidth=1)
    axes.set(xlabel="time, s", ylabel="height, m", title="Steps of 40 ms, e = 0.8", ylim=(-0.16, 0.7))
    axes.legend(loc="upper right")


def guard(figure: Figure) -> None:
    """A point left 1.5 cm behind the plane is on its way out; as printed the answer throws it back in, for ever."""
    axes = figure.add_subplot()
    dt, steps = 0.01, 12
    for name, marker in (("as printed", "s--"), ("with the guard", "o-")):
        z, v, places = -0.015, np.array([0.0, 0.0, 1.0]), [-15.0]
        for _ in range(steps):
            z = z + v[2] * dt
            if z < 0:
                v = as_printed.mirror_response(v, UP) if name == "as printed" else kinematic_response(v, UP, 1.0)
            places.append(1e3 * z)
        axes.plot(
            1e3 * dt * np.arange(steps + 1),
            places,
            marker,
            label=name,
            color={"s": "#d55e00", "o": "#1b1b1b"}[marker[0]],
        )
    axes.axhspan(-30, 0, color="#e8e8e8")
    axes.annotate("behind the plane", (75, -26), fontsize=9)
    axes.set(xlabel="time, ms", ylabel="height, mm", title="v − 2 (v·N) N, without and with its guard", ylim=(-30, 90))
    axes.legend(loc="upper left")


def penalty_impact(figure: Figure) -> None:
    """Force over an impact: as printed it is elastic; a dashpot pulls at the end, unless a clamp lets go."""
    axes = figure.add_subplot()
    mass, stiffness, dt = 1.0, 1e4, 1e-5
    damping = 2 * 0.3 * math.sqrt(stiffness * mass)
    cases = (
        ("k d, as printed", 0.0, False, ":"),
        ("damped, no clamp", damping, True, "--"),
        ("damped and clamped", damping, False, "-"),
    )
    for name, c, adhesive, style in cases:
        position, velocity, forces = np.zeros(3), -UP, []
        for _ in range(3600):
            force = penalty_force(position[2], velocity[2], UP, stiffness, c, adhesive)
            position, velocity = semi_implicit_euler(position, velocity, force / mass, dt)
            forces.append(force[2])
        axes.plot(1e3 * dt * np.arange(3600), forces, style, label=f"{name}: e = {velocity[2]:.3f}", linewidth=2)
    axes.axhline(0, color=GREY, linewidth=1)
    axes.set(
        xlabel="time, ms", ylabel="force, N", title="1 kg at 1 m/s on a spring of 10 kN/m, ζ = 0.3", ylim=(-50, 175)
    )
    axes.legend(loc="upper right")


def penalty_ratio(figure: Figure) -> None:
    """Restitution of a spring with a dashpot against the damping ratio; marks are simulated impacts."""
    axes = figure.add_subplot()
    ratios, marks = np.linspace(0, 2, 401), np.array([0.05, 0.2, 0.4, 0.7, 1.0, 1.5])
    mass, stiffness, dt = 1.0, 1e4, 1e-5
    for adhesive, style, marker in ((False, "-", "o"), (True, "--", "s")):
        label = "with adhesion" if adhesive else "never pulls"
        axes.plot(ratios, penalty_restitution(mass, stiffness, 200 * ratios, adhesive), style, label=label)
        c = 200 * (marks if not adhesive else marks[marks < 0.9])
        position, velocity = np.zeros((len(c), 3)), np.tile(-UP, (len(c), 1))
        for _ in range(4400):
            force = penalty_force(position[:, 2], velocity[:, 2], UP, stiffness, c, adhesive)
            position, velocity = semi_implicit_euler(position, velocity, force / mass, dt)
        axes.plot(c / 200, velocity[:, 2], marker, color=axes.get_lines()[-1].get_color())
    wanted = penalty_damping(0.5, mass, stiffness) / 200
    axes.plot([0, wanted, wanted], [0.5, 0.5, 0], ":", color=GREY)
    axes.annotate(f"e = 0.5 needs ζ = {wanted:.3f}", (wanted + 0.02, 0.51), fontsize=9)
    axes.set(xlabel="damping ratio ζ = c/(2√(k m))", ylabel="restitution e", ylim=(0, 1.02), xlim=(0, 2))
    axes.set_title("What a penalty contact leaves of the speed")
    axes.legend(loc="upper right")


def penalty_steps(figure: Figure) -> None:
    """Where semi-implicit Euler lets a pressed contact rest (dots) and where it shakes (crosses); line: the limit."""
    axes = figure.add_subplot()
    mass, stiffness = 1.0, 1.0
    ratios = np.linspace(0, 2, 201)
    axes.plot(ratios, penalty_step_limit(mass, stiffness, 2 * ratios), label="(2/ω)(√(1 + ζ²) − ζ)")
    ratio, step = (values.ravel() for values in np.meshgrid(np.linspace(0, 2, 17), np.linspace(0.1, 2.3, 23)))
    rest = penalty_rest_depth(mass, GRAVITY, stiffness)
    position, velocity = -rest * (1 - 1e-6) * np.tile(UP, (len(step), 1)), np.zeros((len(step), 3))
    moved = np.zeros(len(step))
    for _ in range(600):
        force = penalty_force(position[:, 2], velocity[:, 2], UP, stiffness, 2 * ratio)
        position, velocity = semi_implicit_euler(position, velocity, force / mass + PULL, step)
        moved = np.maximum(moved, np.abs(position[:, 2] / rest + 1))
    calm = moved < 1e-4
    axes.plot(ratio[calm], step[calm], ".", color="#0072b2", label="rests")
    axes.plot(ratio[~calm], step[~calm], "x", color="#d55e00", markersize=5, label="shakes")
    axes.set(xlabel="damping ratio ζ", ylabel="step Δt, in 1/ω", ylim=(0, 2.4), title="Damping shortens the step")
    figure.legend(loc="outside right upper")


FIGURES = {
    (3, "accuracy-against-steps"): accuracy,
    (3, "zeno"): zeno,
    (6, "two-policies"): two_policies,
    (7, "the-guard"): guard,
    (8, "penalty-impact"): penalty_impact,
    (8, "penalty-restitution"): penalty_ratio,
    (8, "penalty-step-limit"): penalty_steps,
}
