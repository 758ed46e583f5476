"""Figures of the impulse statements: points, normals, the impulse, and what it does to two bodies."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon

from solutions import as_printed
from solutions.impulse import (
    Body,
    box_inertia,
    classify_contact,
    collide,
    edge_edge_normal,
    impulse_magnitude,
    impulse_of_force,
    mean_force,
    normal_velocity,
    point_velocity,
    rebound_velocity,
    relative_velocity,
    rod_inertia,
    rotation_matrix,
    sphere_inertia,
    world_inverse_inertia,
)

BLACK, GREY, BLUE, ORANGE = "#1b1b1b", "#999999", "#0072b2", "#d55e00"
STILL, UPRIGHT = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])
X, Y, Z = np.eye(3)
GROUND = Body(STILL, STILL, STILL, 0.0, np.zeros((3, 3)))


def _ball(velocity: np.ndarray, arm: np.ndarray, mass: float = 1.0) -> Body:
    return Body(velocity, STILL, arm, 1 / mass, world_inverse_inertia(sphere_inertia(mass, 0.5), UPRIGHT))


def _arrow(axes: Axes, start: np.ndarray, along: np.ndarray, colour: str, text: str = "", dashed: bool = False) -> None:
    end = np.asarray(start)[:2] + np.asarray(along)[:2]
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.6, "linestyle": "--" if dashed else "-"}
    axes.annotate("", end, np.asarray(start)[:2], arrowprops=style | {"shrinkA": 0, "shrinkB": 0})
    if text:
        offset = 8 * np.asarray(along)[:2] / max(float(np.linalg.norm(along)), 1e-9)
        axes.annotate(text, end, offset, textcoords="offset points", ha="center", va="center", color=colour)


def _plain(axes: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    axes.set(xlim=x, ylim=y, aspect="equal")
    axes.set_axis_off()


def two_bodies(figure: Figure) -> None:
    """Two boxes fly and turn, meet at a corner, and leave with four new velocities; one picture every 0.35 s."""
    axes = figure.add_subplot()
    size = np.array([1.0, 0.6, 0.4])
    moments = box_inertia(1.0, size)
    angle_a = math.radians(30)
    turned = np.array([math.cos(angle_a / 2), 0, 0, math.sin(angle_a / 2)])
    corner = rotation_matrix(turned) @ (-0.5, -0.3, 0.0)
    arm_b = np.array([0.3, 0.3, 0.0])
    a = Body(np.array([1.0, -2.5, 0]), 1.0 * Z, corner, 1.0, world_inverse_inertia(moments, turned))
    b = Body(np.array([0.6, 1.5, 0]), STILL, arm_b, 1.0, world_inverse_inertia(moments, UPRIGHT))
    after = collide(a, b, Y, 0.8)
    for body, later, angle, colour, name in ((a, after[:2], angle_a, BLACK, "A"), (b, after[2:], 0.0, BLUE, "B")):
        for time in np.linspace(-0.7, 0.7, 5):
            velocity, spin = (body.velocity, body.angular_velocity) if time <= 0 else later
            turn = angle + time * np.asarray(spin)[2]
            centre = (-np.asarray(body.arm) + time * np.asarray(velocity))[:2]
            along = np.array([math.cos(turn), math.sin(turn)])
            across = np.array([-along[1], along[0]])
            corners = [centre + s * 0.5 * along + t * 0.3 * across for s, t in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
            face = colour if time == 0 else "none"
            style = ":" if time < 0 else "-"
            axes.add_patch(Polygon(corners, fill=time == 0, fc=face, ec=colour, alpha=0.75, ls=style, lw=1.2))
        axes.annotate(name, -np.asarray(body.arm)[:2], color="white", ha="center", va="center", weight="bold")
    axes.plot(0, 0, "o", color=ORANGE, markersize=5, zorder=5)
    _plain(axes, (-2.4, 3.4), (-1.9, 2.9))
    axes.set_title("Dotted: before. Filled: the impact. Lines: after. e = 0.8")


def restitution(figure: Figure) -> None:
    """Gap between two bodies over time: the reversal makes them part; the prose's mere fraction lets them overlap."""
    axes = figure.add_subplot()
    before, after = np.linspace(-0.5, 0, 2), np.linspace(0, 0.5, 2)
    axes.plot(before, -2 * before, color=BLACK)
    for e, style in ((1.0, "-"), (0.5, "--"), (0.0, "-.")):
        axes.plot(after, rebound_velocity(-2.0, e) * after, style, color=BLACK, label=f"−e u_n, e = {e:g}")
    printed = as_printed.velocity_after_restitution(-2.0, 0.5)
    axes.plot(after, printed * after, ":", color=ORANGE, linewidth=2.5, label="as the prose has it, e = 0.5")
    axes.axhspan(-0.7, 0, color="#e8e8e8")
    axes.annotate("overlap", (-0.47, -0.4))
    axes.set(xlabel="time from the impact, s", ylabel="gap, m", ylim=(-0.7, 1.1), xlim=(-0.5, 0.5))
    axes.set_title("They close at 2 m/s")
    axes.legend(loc="upper center")


def area(figure: Figure) -> None:
    """Force over two contacts of the same ball: ten times the force in a tenth of the time leaves the same impulse."""
    axes = figure.add_subplot()
    for duration, style, name in ((20e-3, "--", "soft"), (2e-3, "-", "hard")):
        time = np.linspace(0, duration, 400)
        force = np.outer(np.sin(np.pi * time / duration) * np.pi / (2 * duration), Z)
        impulse = impulse_of_force(force, time)
        mean = mean_force(impulse, duration)[2]
        label = f"{name}: mean {mean:.0f} N, ∫F dt = {impulse[2]:.2f} N s"
        axes.plot(1e3 * time, force[:, 2], style, color=BLACK if name == "hard" else BLUE, label=label)
        axes.fill_between(1e3 * time, force[:, 2], color=GREY, alpha=0.35)
    axes.set(xlabel="time, ms", ylabel="force, N", xlim=(0, 20.5), ylim=(0, 850))
    axes.set_title("An impulse is an area, not a force")
    axes.legend(loc="upper right")


def wheel(figure: Figure) -> None:
    """Velocities v + ω × r of points of a rolling wheel: none where it touches, twice the hub's on top; path dotted."""
    axes = figure.add_subplot()
    omega, hub = -2.0 * Z, 0.5 * Y
    axes.add_patch(Circle((0, 0.5), 0.5, fill=False, ec=BLACK, lw=1.5))
    for degrees in range(0, 360, 45):
        arm = 0.5 * np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0])
        velocity = point_velocity(X, omega, arm)
        if np.linalg.norm(velocity) > 1e-9:
            _arrow(axes, hub + arm, 0.3 * velocity, BLUE)
        axes.plot(*(hub + arm)[:2], "o", color=BLUE, markersize=4)
    _arrow(axes, hub, 0.3 * X, BLACK, "v")
    angle = np.linspace(-2.6, 3.6, 200)
    axes.plot(0.5 * (angle - np.sin(angle)), 0.5 * (1 - np.cos(angle)), ":", color=GREY, linewidth=1.5)
    axes.axhline(0, color=BLACK, linewidth=1)
    axes.annotate("ṗ = 0", (0, 0), (8, -11), textcoords="offset points", color=BLUE)
    _plain(axes, (-1.2, 1.7), (-0.2, 1.4))
    axes.set_title("A wheel that rolls: every point has its own velocity")


def order(figure: Figure) -> None:
    """The same two points seen both ways: ṗ_A − ṗ_B against the normal closes, ṗ_B − ṗ_A along it would part."""
    pair = figure.subplots(1, 2)
    p_a, p_b = np.array([0.5, -0.9, 0]), np.array([-0.9, 0.3, 0])
    for axes, title, u in (
        (pair[0], "u = ṗ_A − ṗ_B", relative_velocity(p_a, p_b)),
        (pair[1], "the other order", relative_velocity(p_b, p_a)),
    ):
        axes.add_patch(Circle((0, 1), 1, fc="#dddddd", ec=BLACK))
        axes.add_patch(Circle((0, -1), 1, fc="#f4f4f4", ec=BLACK))
        axes.annotate("A", (0.4, 1.4), ha="center")
        axes.annotate("B", (-0.4, -1.5), ha="center")
        _arrow(axes, STILL, p_a, BLACK, "ṗ_A", dashed=True)
        _arrow(axes, STILL, p_b, BLACK, "ṗ_B", dashed=True)
        _arrow(axes, STILL, 0.9 * Y, GREY, "n")
        _arrow(axes, STILL, u, ORANGE, "u")
        sign = {-1: "colliding", 1: "separating"}[int(classify_contact(Y @ u))]
        axes.set_title(f"{title}: u_n = {Y @ u:+.1f}, {sign}".replace("-", "−"), fontsize=9)
        _plain(axes, (-2, 2), (-2.1, 2.1))


def right_angle(figure: Figure) -> None:
    """Equal balls without friction, B at rest: B leaves along the normal, A across it, always at a right angle."""
    axes = figure.add_subplot()
    for column, degrees in enumerate((15.0, 45.0, 75.0)):
        line = np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0])
        middle = np.array([3.6 * column, 0, 0])
        v_a, _, v_b, _ = collide(_ball(1.4 * X, 0.5 * line), _ball(STILL, -0.5 * line), -line, 1.0)
        for centre, name in ((middle - 0.5 * line, "A"), (middle + 0.5 * line, "B")):
            axes.add_patch(Circle(centre[:2], 0.5, fill=False, ec=GREY, lw=1.5))
            axes.annotate(name, centre[:2], (-9, 6), textcoords="offset points", ha="center", color=GREY)
        a, b = middle - 0.5 * line, middle + 0.5 * line
        _arrow(axes, a - 1.4 * X, 1.4 * X, GREY, dashed=True)
        _arrow(axes, a, v_a, BLACK)
        _arrow(axes, b, v_b, BLUE)
        axes.annotate(f"{degrees:.0f}° off", (3.6 * column, -2.25), ha="center")
    _plain(axes, (-2.2, 9.2), (-2.5, 2.7))
    axes.set_title("Dashed: A before. After e = 1: A black, B blue")


def across_edges(figure: Figure) -> None:
    """Height of the normal of two crossed edges: A × B shrinks and flips; of unit length and towards A it stays 1."""
    axes = figure.add_subplot()
    degrees = np.linspace(-180, 180, 361)
    edge_b = 0.8 * np.stack([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0 * degrees], axis=-1)
    axes.plot(degrees, np.cross(X, edge_b)[:, 2], "--", color=ORANGE, label="A × B, as printed")
    crossed = np.abs(np.sin(np.radians(degrees))) > 1e-6
    height = np.full(len(degrees), np.nan)
    height[crossed] = edge_edge_normal(X, edge_b[crossed], Z, STILL)[:, 2]
    axes.plot(degrees, height, color=BLACK, label="unit, towards A")
    axes.plot((-180, 0, 180), (1, 1, 1), "o", mfc="white", mec=BLACK, label="parallel: none", clip_on=False)
    axes.set(xlabel="angle from edge A to edge B, degrees", ylabel="component towards A", ylim=(-1.1, 1.8))
    axes.set(xlim=(-180, 180), xticks=range(-180, 181, 90))
    axes.set_title("Edges of 1 m and 0.8 m, A above B")
    axes.legend(loc="upper center", ncols=3, fontsize=9)


def both_plus(figure: Figure) -> None:
    """Places of two equal balls over time: with plus on both, B is pushed along with A and their momentum is 4 N s."""
    pair = figure.subplots(1, 2, sharey=True)
    a, b = _ball(-X, -0.5 * X), _ball(X, 0.5 * X)
    impulse = impulse_magnitude(a, b, X, 1.0) * X
    printed = as_printed.velocities_after_impulse(a.velocity, b.velocity, 1.0, 1.0, impulse)
    right = collide(a, b, X, 1.0)[::2]
    for axes, title, after in ((pair[0], "as printed: + j n on both", printed), (pair[1], "− j n on B", right)):
        for body, later, style, name in ((a, after[0], "-", "A"), (b, after[1], "--", "B")):
            start = -np.asarray(body.arm)[0]
            path = (start - np.asarray(body.velocity)[0], start, start + later[0])
            axes.plot(path, (-1, 0, 1), style, color=BLACK if name == "A" else BLUE, label=name)
        momentum = after[0][0] + after[1][0]
        axes.set_title(f"{title}\nmomentum 0 → {momentum:.0f} N s", fontsize=9)
        axes.set(xlabel="place of the centre, m", xlim=(-2.7, 2.7))
    pair[0].set_ylabel("time, s")
    pair[1].legend(loc="lower center")


def after_against_before(figure: Figure) -> None:
    """Normal velocity of the points before and after 120 impacts of boxes in space: all on the line −e u_n."""
    axes = figure.add_subplot()
    rng = np.random.default_rng(3)
    for e, marker, colour in ((1.0, "o", BLACK), (0.5, "s", BLUE), (0.1, "^", ORANGE)):
        turn, normal = rng.normal(size=(2, 40, 4)), rng.normal(size=(40, 3))
        turn /= np.linalg.norm(turn, axis=-1)[..., None]
        normal /= np.linalg.norm(normal, axis=-1)[..., None]
        a, b = (
            Body(*rng.normal(size=(3, 40, 3)), rng.uniform(0.2, 5, 40), world_inverse_inertia((1, 2, 3), turn[side]))
            for side in (0, 1)
        )
        v_a, w_a, v_b, w_b = collide(a, b, normal, e)
        before = normal_velocity(a, b, normal)
        moved = a._replace(velocity=v_a, angular_velocity=w_a), b._replace(velocity=v_b, angular_velocity=w_b)
        after = normal_velocity(*moved, normal)
        ends = np.array([-6.0, 0.0])
        axes.plot(ends, rebound_velocity(ends, e), color=GREY, linewidth=1)
        axes.plot(before, after, marker, color=colour, markersize=4, label=f"e = {e:g}", alpha=0.8)
    axes.set(xlabel="u_n before, m/s", ylabel="u_n after, m/s", xlim=(-6, 5), ylim=(-0.3, 6))
    axes.annotate("separating: left alone", (3.9, 4.4), ha="right", fontsize=9)
    axes.set_title("Boxes of any mass, turned and spun at random")
    axes.legend(loc="upper right", ncols=3, fontsize=9)


def along_a_rod(figure: Figure) -> None:
    """Impulse on a rod that a fixed peg strikes at 1 m/s: at its end it turns away and takes a quarter of the blow."""
    axes = figure.add_subplot()
    place = np.linspace(-1, 1, 201)
    inverse = world_inverse_inertia(rod_inertia(1.0, 2.0), UPRIGHT)
    rod = Body(-X, STILL, place[:, None] * Z, 1.0, inverse)
    for e, style in ((1.0, "-"), (0.5, "--"), (0.0, "-.")):
        axes.plot(place, impulse_magnitude(rod, GROUND, X, e), style, label=f"e = {e:g}", color=BLACK)
        axes.plot((-1, 1), [(1 + e) / 4] * 2, "o", color=ORANGE, clip_on=False, zorder=3)
    axes.axhline(2.0, color=GREY, linestyle=":")
    axes.annotate("(1 + e) m: a rod that could not turn, e = 1", (0, 2.04), ha="center", fontsize=9)
    axes.annotate("(1 + e) m/4", (-0.97, 0.08), color=ORANGE)
    axes.set(xlabel="where it is struck, in half lengths from the middle", ylabel="impulse j, N s", ylim=(0, 2.25))
    axes.set(xlim=(-1, 1))
    axes.set_title("Rod of 1 kg; marks: the closed form")
    axes.legend(loc="upper right", bbox_to_anchor=(1, 0.9))


def kinds(figure: Figure) -> None:
    """What a contact is called against its closing speed: as printed, slow contacts part and fast partings rest."""
    axes = figure.add_subplot()
    closing, threshold = np.linspace(-1, 1, 400), 0.3
    shade = {"colliding": ("#555555", "white"), "resting": ("#bbbbbb", BLACK), "separating": ("#f2f2f2", BLACK)}
    names = np.array(["colliding", "resting", "separating"])
    rows = (
        ("as printed", as_printed.contact_kind(closing, threshold)),
        ("right", names[classify_contact(-closing, threshold) + 1]),
    )
    for row, (_, found) in enumerate(rows):
        for name in names:
            inside = closing[found == name]
            width = inside[-1] - inside[0]
            fill, ink = shade[str(name)]
            axes.barh(row, width, left=inside[0], height=0.6, color=fill, edgecolor=BLACK)
            axes.annotate(name, (inside[0] + width / 2, row), ha="center", va="center", color=ink)
    for place in (-threshold, threshold):
        axes.axvline(place, color=ORANGE, linestyle="--", linewidth=1)
    axes.set_yticks((0, 1), [name for name, _ in rows])
    axes.set(xlabel="speed at which the points close, m/s (negative: they part)", xlim=(-1, 1), ylim=(-0.6, 1.6))
    axes.set_title("Dashed: the threshold, 0.3 m/s either way")
    axes.grid(visible=False)


FIGURES = {
    (11, "two-bodies-collide"): two_bodies,
    (12, "restitution"): restitution,
    (13, "an-area-not-a-force"): area,
    (14, "velocity-of-a-point"): wheel,
    (15, "the-order-of-the-difference"): order,
    (16, "along-the-normal"): right_angle,
    (17, "across-two-edges"): across_edges,
    (18, "plus-on-both"): both_plus,
    (19, "after-against-before"): after_against_before,
    (20, "along-a-rod"): along_a_rod,
    (21, "three-kinds"): kinds,
}
