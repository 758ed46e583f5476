"""Figures of spring meshes (statements 28 and 29)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from solutions.meshes import (
    SpringMesh,
    cloth,
    edge_strain,
    implicit_mesh_step,
    lattice,
    limit_strain,
    mesh_energy,
    mesh_sphere_contact,
    mesh_step,
    spring_mesh,
    stable_timestep,
    static_shape,
    timestep_bound,
    zero_energy_modes,
)

GRAVITY = (0.0, 0.0, -9.81)
KINDS = (("structural",), ("structural", "shear"), ("structural", "shear", "bend"))
BLACK, BLUE, RED, GREEN = "#1b1b1b", "#0072b2", "#d55e00", "#009e73"
GREY = "#b0b0b0"


def draw_edges(axes: Any, mesh: SpringMesh, shape: np.ndarray, columns: tuple[int, ...], **style: Any) -> None:
    """Every edge as a line, all in one stroke that is broken between them."""
    lines = np.concatenate([shape[mesh.edges], np.full((len(mesh.edges), 1, 3), np.nan)], axis=1).reshape(-1, 3)
    axes.plot(*(lines[:, column] for column in columns), **style)


def internal_springs(figure: Figure) -> None:
    """A bar that is fixed at its left end, under its own weight; grey is its shape at rest.

    Edges alone shear until it hangs down; with the internal springs along its diagonals it keeps its shape.
    """
    shown = ("structural",), ("structural", "face", "space")
    for axes, kinds, title in zip(
        figure.subplots(1, 2, sharey=True), shown, ("Edges alone", "With internal springs"), strict=True
    ):
        position, edges = lattice(7, 2, 2, 0.1, kinds)
        mesh = spring_mesh(position, edges, 500.0, 0.0, 0.005, range(4))
        shape = static_shape(mesh, position, GRAVITY, 1e-6)
        view = (0, 2)
        draw_edges(axes, mesh, position, view, color=GREY, linewidth=0.8)
        draw_edges(axes, mesh, shape, view, color=BLUE, linewidth=1.2)
        axes.plot(*position[:4, view].T, "s", color=BLACK, markersize=5)
        cube, cube_edges = lattice(2, 2, 2, 0.1, kinds)
        modes = zero_energy_modes(spring_mesh(cube, cube_edges, 1.0), cube)
        axes.set_title(title)
        axes.set_xlabel("x, m")
        axes.text(0.6, -0.58, f"a free cube\nhas {modes} motions\nat no cost", ha="right")
        axes.set_aspect("equal")
    figure.axes[0].set_ylabel("z, m")


def step_limit(figure: Figure) -> None:
    """The longest stable step of a 10×10 cloth, and what it does 1 % below and 1 % above that.

    Structural, shear and bend springs each shorten it. A single spring's limit is three times too optimistic.
    """
    left, right = figure.subplots(1, 2)
    meshes = [(spring_mesh(*cloth(10, 10, 1.0, kinds), 1.0), cloth(10, 10, 1.0)[0]) for kinds in KINDS]
    limits = [float(stable_timestep(mesh, position)) for mesh, position in meshes]
    left.bar(range(3), limits, color=[GREY, "#7fb3d5", BLUE], width=0.65)
    left.plot(range(3), [timestep_bound(mesh) for mesh, _ in meshes], "v", color=BLACK, label="safe, by adding up")
    for at, limit in enumerate(limits):
        left.text(at, limit + 0.03, f"{limit:.3g}", ha="center")
    left.axhline(2, color=RED, linestyle="--", label="single spring, 2√(m/k)")
    left.set_xticks(range(3), ["structural", "+ shear", "+ bend"])
    left.set_ylabel("longest step, √(m/k)")
    left.set_ylim(0, 2.9)
    left.legend(loc="upper left")
    mesh, position = meshes[-1]
    kick = 1e-6 * np.random.default_rng(1).normal(size=position.shape) * (1, 1, 0)
    for share, style, color in ((1.01, "-", RED), (0.99, "--", BLUE)):
        p, v, farthest = position + kick, np.zeros_like(position), []
        for _ in range(60):
            p, v = mesh_step(mesh, p, v, (0, 0, 0), share * limits[-1])
            farthest.append(np.abs(p - position).max())
        right.semilogy(range(1, 61), farthest, style, color=color)
    right.text(52, 3e-5, "1 % below", color=BLUE, ha="right")
    right.text(30, 1e-2, "1 % above", color=RED, ha="right")
    right.set_xlabel("steps")
    right.set_ylabel("farthest node from rest, spacings")
    right.set_title("All three kinds")


def implicit_step(figure: Figure) -> None:
    """Energy of a plucked cloth that nothing damps: the cheap step keeps it, the implicit one takes it away.

    Right: what one implicit step keeps of a vibration, from short steps to long ones.
    """
    left, right = figure.subplots(1, 2)
    position, edges = cloth(6, 6, 0.1)
    mesh = spring_mesh(position, edges, 50.0, 0.0, 0.01)
    limit = float(stable_timestep(mesh, position))
    start = position + 0.01 * np.random.default_rng(3).normal(size=position.shape) * (1, 1, 0)
    runs = (
        (mesh_step, 0.2, "cheap, 0.2 of the limit", BLACK, "-"),
        (implicit_mesh_step, 0.2, "implicit, 0.2", BLUE, "--"),
        (implicit_mesh_step, 2.0, "implicit, 2", RED, ":"),
    )
    for move, share, label, color, style in runs:
        p, v, energies = start, np.zeros_like(start), [float(mesh_energy(mesh, start))]
        for _ in range(int(30 / share)):
            p, v = move(mesh, p, v, (0, 0, 0), share * limit)
            energies.append(float(mesh_energy(mesh, p) + 0.01 * np.sum(v * v) / 2))
        time = share * np.arange(len(energies))
        left.plot(time, np.array(energies) / energies[0], style, color=color, label=label)
    left.set_xlabel("time, limits of the cheap step")
    left.set_ylabel("energy, of that at first")
    left.set_ylim(0, 1.75)
    left.legend(loc="upper right")
    share = np.logspace(-2, 2, 200)
    right.semilogx(share, 1 / np.hypot(1, 2 * share), color=BLUE)
    right.axvline(1, color=GREY, linestyle="--")
    right.text(1.15, 0.93, "limit of the\ncheap step", va="top")
    right.set_xlabel("ω dt / 2")
    right.set_ylabel("amplitude kept in one implicit step")
    right.set_ylim(0, 1.05)


def strain_limiting(figure: Figure) -> None:
    """A soft cloth that hangs from two corners, left to its springs and with their strain limited to a tenth.

    Near the pins the springs alone stretch far. If they are shortened after every step, none
    is more than a tenth too long.
    """
    position, edges = cloth(9, 9, 0.1)
    mesh = spring_mesh(position, edges, 10.0, 0.05, 0.01, [0, 8])
    free = static_shape(mesh, position, GRAVITY, 1e-4)
    p, v, dt = position, np.zeros_like(position), 0.01
    for _ in range(300):
        moved, v = mesh_step(mesh, p, 0.99 * v, GRAVITY, dt)
        p = limit_strain(mesh, moved, iterations=60)
        v = v + (p - moved) / dt
    views = figure.subplots(1, 3, width_ratios=(1, 1, 1.1))
    structural = mesh.edges[: 2 * 9 * 8]
    for axes, shape, title in ((views[0], free, "Springs alone"), (views[1], p, "Limited")):
        lines = spring_mesh(position, structural, 1.0)
        draw_edges(axes, lines, shape, (0, 2), color=BLUE, linewidth=0.8)
        axes.plot(*shape[[0, 8]][:, [0, 2]].T, "s", color=BLACK, markersize=5)
        axes.set_title(title)
        axes.set_xlabel("x, m")
        axes.set_aspect("equal")
        axes.set_ylim(-1.1, 0.1)
    views[0].set_ylabel("z, m")
    for shape, label, color, style in ((free, "alone", RED, "-"), (p, "limited", BLUE, "--")):
        strain = np.sort(edge_strain(mesh, shape))
        views[2].plot(np.linspace(0, 1, len(strain)), strain, style, color=color, label=label)
    views[2].axhline(0.1, color=GREY, linestyle=":")
    views[2].set_xlabel("share of the springs")
    views[2].set_title("Strain")
    views[2].legend(loc="upper left")


def cloth_over_sphere(figure: Figure) -> None:
    """A cloth two seconds after it was dropped on a fixed sphere, with friction.

    Every node is tested and put back, and no more than that: the edges between them cut a little into the sphere.
    """
    position, edges = cloth(25, 25, 0.05)
    position = position - (0.6, 0.6, -0.5)
    mesh = spring_mesh(position, edges, 100.0, 0.1, 0.004)
    p, v, dt = position, np.zeros_like(position), 0.002
    for _ in range(1000):
        p, v = mesh_sphere_contact(mesh, *mesh_step(mesh, p, v, GRAVITY, dt), (0, 0, 0), 0.4, friction=0.5)
    axes: Any = figure.add_subplot(projection="3d", computed_zorder=False)
    theta, phi = np.meshgrid(np.linspace(0, np.pi, 19), np.linspace(0, 2 * np.pi, 37))
    ball = 0.39 * np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
    axes.plot_surface(*ball, color=GREY, linewidth=0, shade=True, zorder=1)
    rows = p.reshape(25, 25, 3)
    axes.plot_surface(
        *np.moveaxis(rows, -1, 0), rstride=1, cstride=1, color="#9ecae1", edgecolor=BLUE, linewidth=0.4, zorder=2
    )
    axes.set_box_aspect((1, 1, 0.8), zoom=1.75)
    axes.set_xlim(-0.6, 0.6)
    axes.set_ylim(-0.6, 0.6)
    axes.set_zlim(-0.5, 0.46)
    axes.view_init(elev=22, azim=-55)
    axes.set_axis_off()


def damping_in_a_mesh(figure: Figure) -> None:
    """A wobbling cube is thrown: what dampers along its springs do to it, and what −k_d v on every node does.

    Dampers along the springs, −k_d((v1 − v2)·u)u, calm the wobble and leave the flight alone; the slide's −k_d v stops
    the cube in the air.
    """
    left, right = figure.subplots(1, 2)
    position, edges = lattice(3, 3, 3, 0.1)
    start = position + 0.01 * np.random.default_rng(5).normal(size=position.shape)
    dt, mass = 0.002, 0.05
    cases = (
        ("no damping", 0.0, 0.0, BLACK, ":"),
        ("along the springs", 0.2, 0.0, BLUE, "-"),
        ("−k_d v on the nodes", 0.0, 0.2, RED, "--"),
    )
    for label, damping, drag, color, style in cases:
        mesh = spring_mesh(position, edges, 100.0, damping, mass)
        p, v = start, np.tile((2.0, 0.0, 0.0), (27, 1))
        wobble, speed = [], []
        for _ in range(500):
            p, v = mesh_step(mesh, p, v, -drag / mass * v, dt)
            mean = v.mean(axis=0)
            wobble.append(float(mesh_energy(mesh, p) + mass * np.sum((v - mean) ** 2) / 2))
            speed.append(mean[0])
        time = dt * np.arange(1, 501)
        left.plot(time, wobble, style, color=color, label=label)
        right.plot(time, speed, style, color=color, label=label)
    left.set_title("Energy of the wobble")
    left.set_ylabel("J")
    right.set_title("Speed of the flight")
    right.set_ylabel("m/s")
    right.set_ylim(0, 2.9)
    right.legend(loc="upper right")
    for axes in (left, right):
        axes.set_xlabel("time, s")


FIGURES = {
    (28, "internal-springs"): internal_springs,
    (28, "step-limit"): step_limit,
    (28, "implicit-step"): implicit_step,
    (28, "strain-limiting"): strain_limiting,
    (28, "cloth-over-sphere"): cloth_over_sphere,
    (29, "damping-in-a-mesh"): damping_in_a_mesh,
}
