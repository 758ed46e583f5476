"""Figures of friction: the slide's equality, the circle, sticking and slipping, impacts, cradles, resting contacts."""

from __future__ import annotations

import warnings

import numpy as np
from matplotlib.figure import Figure

from reference.published.theirs import published
from solutions import as_printed
from solutions.friction import (
    clamp_to_circle,
    clamp_to_square,
    dissipative_impulse,
    friction_force,
    friction_impulse,
    impact_energy,
    point_inverse_mass,
    poisson_impulse,
    sphere_impact,
    stronge_impulse,
)
from solutions.world import (
    complementarity_residual,
    contact_jacobian,
    inverse_mass_matrix,
    propagate_impacts,
    resting_problem,
    simultaneous_impacts,
    solve_by_pivots,
    solve_by_sweeps,
)
from solutions.world.complementarity import NotConverged

GREY = "#999999"
X, Y, UP = np.eye(3)
STILL = np.zeros(3)


def static_friction(figure: Figure) -> None:
    """Static friction is as large as the push, up to μ_s N; as printed it is μ_s N even where nothing pushes."""
    axes = figure.add_subplot()
    push, weight, static, kinetic = np.linspace(0, 16, 801), 20.0, 0.5, 0.35
    force = -friction_force(np.outer(push, X), STILL, weight, static, kinetic)[:, 0]
    held = push <= static * weight
    axes.plot(push[held], force[held], label="held: as large as the push")
    axes.plot(push[~held], force[~held], "-", color="#0072b2", label="sliding: μ_k N")
    printed = as_printed.static_friction_force(weight, static)
    axes.axhline(float(printed), linestyle="--", color="#d55e00", label="as printed: μ_s N")
    axes.plot([0, 16], [0, 16], ":", color=GREY, label="equal to the push")
    axes.set(xlabel="push, N", ylabel="friction against it, N", ylim=(0, 16), xlim=(0, 16))
    axes.set_title("A block at rest, N = 20 N, μ_s = 0.5, μ_k = 0.35")
    axes.legend(loc="upper left")


def circle_not_square(figure: Figure) -> None:
    """Friction on a body that slides: a circle, against its way. A pyramid answers almost always along a diagonal."""
    left, right = figure.subplots(1, 2)
    angles = np.linspace(0, 2 * np.pi, 17)[:-1] + np.pi / 16
    away = 10 * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=-1)
    for axes, name, force in (
        (left, "cone: a circle", clamp_to_circle(away, 1.0)),
        (right, "pyramid: a square", clamp_to_square(away, 1.0, X, Y)),
    ):
        axes.plot(*(1.75 * away[:, :2] / 10).T, "o", color=GREY, markersize=4, label="wanted direction")
        axes.quiver(
            *np.zeros((2, len(force))), force[:, 0], force[:, 1], angles="xy", scale_units="xy", scale=1, width=0.012
        )
        turn = np.linspace(0, 2 * np.pi, 200)
        axes.plot(np.cos(turn), np.sin(turn), "--", color="#0072b2", label="μ N")
        axes.set(title=name, aspect="equal", xlim=(-2, 2), ylim=(-2, 2), xticks=[-1, 0, 1], yticks=[-1, 0, 1])
        axes.set_xlabel("force, in μ N")
    handles = left.get_legend_handles_labels()
    figure.legend(*handles, loc="outside lower center", ncols=2)


def grip_and_slip(figure: Figure) -> None:
    """Oblique impacts of a sphere: what is left of the tangential speed, by the rigid law and as measured."""
    axes = figure.add_subplot()
    case = published("P11")
    e, mu, radius = (case.setup[name] for name in ("restitution", "friction", "radius"))
    angles = np.linspace(1, 89, 441)
    turned = np.radians(angles)
    before = np.outer(np.sin(turned), X) - np.outer(np.cos(turned), UP)
    after, _ = sphere_impact(before, STILL, UP, radius, e, mu)
    axes.plot(angles, after[:, 0] / before[:, 0], label="grip 5/7, slip 1 − μ(1 + e)/tan θ")
    axes.plot(
        case.setup["angle"], case.expected["tangent_restitution"], "o", color="#d55e00", label="measured (Kharaz)"
    )
    critical = np.degrees(np.arctan(3.5 * mu * (1 + e)))
    axes.axvline(critical, linestyle=":", color=GREY)
    axes.annotate(f"slips beyond {critical:.1f}°", (critical + 1, 0.56), fontsize=9)
    axes.set(xlabel="angle from the normal, °", ylabel="v_t after / v_t before", xlim=(0, 90), ylim=(0.5, 1.02))
    axes.set_title("Alumina sphere on glass, e = 0.98, μ = 0.092")
    axes.legend(loc="upper left")


def energy_rise(figure: Figure) -> None:
    """A rod's end strikes the floor with e = 1: where the impact turns its slip round, friction makes energy."""
    axes = figure.add_subplot()
    slips = np.linspace(-3, 3, 601)
    k = point_inverse_mass(1.0, 12 * np.eye(3), (-0.4, 0.0, -0.3))
    u = np.outer(slips, X) - UP
    for mu, style in ((0.0, ":"), (0.2, "--"), (0.75, "-")):
        j = friction_impulse(u, UP, k, 1.0, mu)
        axes.plot(slips, impact_energy(u, j, k), style, label=f"μ = {mu}")
    axes.axhspan(0, 0.3, color="#eeeeee")
    axes.annotate("energy is made", (-2.8, 0.12), fontsize=9)
    axes.set(xlabel="slip of the end before, m/s", ylabel="energy gained, J", xlim=(-3, 3), ylim=(-0.9, 0.3))
    axes.set_title("Newton's restitution beside Coulomb's friction, 1 kg at 1 m/s")
    axes.legend(loc="lower center", ncols=3)


def laws_of_restitution(figure: Figure) -> None:
    """A rod's end strikes the floor, e = 1, under four laws. They part where the slip stops or turns round."""
    left, right = figure.subplots(1, 2)
    slips, e, mu = np.linspace(-3, 3, 301), 1.0, 0.75
    k = point_inverse_mass(1.0, 12 * np.eye(3), (-0.4, 0.0, -0.3))
    u = np.outer(slips, X) - UP
    laws = {
        "Newton, against the slip left": (friction_impulse, "-"),
        "Newton, maximal dissipation": (dissipative_impulse, "--"),
        "Poisson": (poisson_impulse, "-."),
        "Stronge": (stronge_impulse, ":"),
    }
    for name, (law, style) in laws.items():
        j = law(u, UP, k, e, mu)
        left.plot(slips, (u + np.matvec(k, j))[:, 2], style, label=name)
        right.plot(slips, impact_energy(u, j, k), style, label=name)
    right.axhspan(0, 0.15, color="#eeeeee")
    right.annotate("energy is made", (-2.8, 0.03), fontsize=9)
    left.set(xlabel="slip of the end before, m/s", ylabel="normal speed after, m/s", xlim=(-3, 3))
    right.set(xlabel="slip of the end before, m/s", ylabel="energy gained, J", xlim=(-3, 3), ylim=(-0.9, 0.15))
    left.set_title("It falls at 1 m/s, e = 1")
    right.set_title("1 kg, μ = 0.75")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)


def cradle(figure: Figure) -> None:
    """Two readings of one moment. Both keep momentum and energy in the cradle; at once, the rule may make energy."""
    axes = figure.subplots(1, 2, sharey=True, width_ratios=(5, 3))
    for place, start in zip(axes, ([1.0, 0, 0, 0, 0], [1.0, 0, 0.1]), strict=True):
        balls = np.arange(1, len(start) + 1)
        outcomes = {
            "before": np.array(start),
            "pair by pair": propagate_impacts(start, 1.0, 1.0),
            "all at once": simultaneous_impacts(start, 1.0, 1.0),
        }
        for shift, (name, v), colour, hatch in zip(
            (-0.27, 0, 0.27), outcomes.items(), (GREY, "#1b1b1b", "#d55e00"), ("", "", "//"), strict=True
        ):
            energy = f"{v @ v / 2:.3f}"
            place.bar(balls + shift, v, 0.26, color=colour, hatch=hatch, edgecolor="white", label=f"{name}: {energy} J")
        place.axhline(0, color="#1b1b1b", linewidth=1)
        place.set(xlabel="ball", xticks=balls, ylim=(-0.7, 1.65))
        place.legend(loc="upper center", fontsize=8)
    axes[0].set(ylabel="velocity, m/s", title="Newton's cradle")
    axes[1].set_title("Third ball leaving")


def sweeps(figure: Figure) -> None:
    """Resting stacks: how far the forces are from a solution after so many sweeps. Pivoting is there at once."""
    axes = figure.add_subplot()
    counts = np.unique(np.geomspace(1, 3000, 30).astype(int))
    for count, style, marker in ((2, "-", "o"), (5, "--", "s"), (10, "-.", "^"), (20, ":", "v")):
        rows = contact_jacobian(np.arange(count), np.arange(count) - 1, np.tile(UP, (count, 1)), STILL, STILL, count)
        weights = inverse_mass_matrix(np.ones(count), np.tile(np.eye(3), (count, 1, 1)))
        problem = resting_problem(rows, weights, np.tile([0, 0, -9.81, 0, 0, 0], count))
        f, left, done = 0.0, [], 0
        for wanted in counts:
            with warnings.catch_warnings(action="ignore", category=NotConverged):  # what is left is the figure
                f = solve_by_sweeps(*problem, int(wanted) - done, f)
            done = int(wanted)
            left.append(max(1e-16, float(complementarity_residual(*problem, f))))
        axes.loglog(counts, left, style, marker=marker, markersize=4, label=f"{count} bodies")
    exact = float(complementarity_residual(*problem, solve_by_pivots(*problem)))
    axes.axhline(max(1e-16, exact), color=GREY, linewidth=1)
    axes.annotate("pivoting, 20 bodies", (1.1, max(1e-16, exact) * 1.8), fontsize=9)
    axes.set(xlabel="sweeps", ylabel="residual, m/s²", title="Stacks of equal bodies at rest", ylim=(1e-17, 100))
    axes.legend(loc="center left")


FIGURES = {
    (16, "grip-and-slip"): grip_and_slip,
    (16, "energy-made-by-friction"): energy_rise,
    (16, "laws-of-restitution"): laws_of_restitution,
    (22, "two-cradles"): cradle,
    (22, "sweeps"): sweeps,
    (24, "static-friction"): static_friction,
    (24, "circle-not-square"): circle_not_square,
}
