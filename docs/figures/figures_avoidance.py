"""Figures of statement 1: force fields and what they cannot do, tangent points, steering, flocks and crowds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Wedge

from solutions import as_printed
from solutions.avoidance import (
    arrive,
    crowd_step,
    flock_step,
    orca_half_plane,
    permitted_velocity,
    repelling_force,
    seek,
    sphere_force,
    steer_around,
    steering_force,
    tangent_point,
)
from solutions.detection import signed_distance

Array = np.ndarray[Any, Any]
BLACK, BLUE, ORANGE, GREEN = "#1b1b1b", "#0072b2", "#d55e00", "#009e73"
EAST = np.array([1.0, 0.0, 0.0])


def flight(force: Callable[[Array], Array], start: Any, velocity: Any, drag: float, seconds: float) -> Array:
    """Path of 1 kg under a force that depends on its place and a drag, (steps, 3)."""
    position, moving, dt = np.array(start, dtype=float), np.array(velocity, dtype=float), 0.005
    path = [position]
    for _ in range(round(seconds / dt)):
        moving = moving + (force(position) - drag * moving) * dt
        position = position + moving * dt
        path.append(position)
    return np.array(path)


def plan(figure: Figure, xlim: tuple[float, float], ylim: tuple[float, float]) -> Axes:
    """Axes of a plan in metres with equal scales."""
    axes = figure.subplots()
    axes.set(xlim=xlim, ylim=ylim, aspect="equal", xlabel="x, m", ylabel="y, m")
    return axes


def obstacle(axes: Axes, centre: Any, radius: float, reach: float = 0.0) -> None:
    """A grey disc, and the reach of its field as a dotted ring."""
    axes.add_patch(Circle(centre[:2], radius, facecolor="0.8", edgecolor="0.5"))
    if reach:
        axes.add_patch(Circle(centre[:2], radius + reach, fill=False, edgecolor="0.5", linestyle=":"))


def draw_wall(figure: Figure) -> None:
    """Three bodies set out along a wall at 1 m/s; those that start within the reach of its field are driven off.

    Only beyond the reach can one fly along the wall.
    """
    axes = plan(figure, (0, 6), (-0.3, 3.2))
    axes.fill_between([0, 6], -0.3, 0, color="0.8")
    axes.axhline(1.0, color="0.5", linestyle=":")
    axes.text(5.95, 0.95, "reach of the field", ha="right", va="top", color="0.35")
    wall = np.array([0.0, 1.0, 0.0])
    for height, color in ((0.3, BLUE), (0.6, ORANGE), (1.2, BLACK)):
        path = flight(
            lambda p: repelling_force(signed_distance(p, wall, 0.0), wall, 2.0, 1.0), (0, height, 0), EAST, 0.0, 6.0
        )
        axes.plot(path[:, 0], path[:, 1], color=color, linewidth=2)
        axes.plot(0, height, "o", color=color, clip_on=False)
    axes.set_title("A field lets nobody fly along its wall")


def draw_deadlock(figure: Figure) -> None:
    """A body is drawn east by 1 N past a sphere with a field: head-on it stops for good, a little aside it gets around.

    Head-on the force has no part to the side; the body rests where 4 N (1 − s/R)² = 1 N.
    """
    axes = plan(figure, (-5, 5), (-2.2, 3.6))
    obstacle(axes, np.zeros(3), 1.0, 2.0)
    for aside, color, style in ((0.0, ORANGE, "-"), (0.05, BLUE, "--"), (0.6, BLACK, "-")):
        path = flight(lambda p: sphere_force(p, np.zeros(3), 1.0, 4.0, 2.0) + EAST, (-5, aside, 0), EAST, 1.0, 40.0)
        axes.plot(path[:, 0], path[:, 1], style, color=color, linewidth=2)
    axes.plot(-2, 0, "s", color=ORANGE, markersize=8)
    axes.annotate("stops here", (-2, -0.12), (-3.4, -1.6), arrowprops={"arrowstyle": "-", "color": "0.4"})
    axes.set_title("Head-on, the field is a dead end")


def draw_trap(figure: Figure) -> None:
    """Two posts with fields and a gap of 1 m between: bodies drawn east by 1 N are caught in front of it.

    Arrows show the direction of the whole force. Between the posts the forces to the side cancel, but those against
    the way add up.
    """
    axes = plan(figure, (-5, 3), (-2.9, 2.9))
    posts = np.array([[0.0, 1.5, 0.0], [0.0, -1.5, 0.0]])

    def force(p: Array) -> Array:
        return np.asarray(sphere_force(p[..., None, :], posts, 1.0, 4.0, 2.0).sum(axis=-2) + EAST)

    for post in posts:
        obstacle(axes, post, 1.0)
    x, y = np.meshgrid(np.arange(-4.8, 3, 0.5), np.arange(-2.7, 2.9, 0.45))
    place = np.stack([x, y, np.zeros_like(x)], axis=-1)
    free = np.all(np.linalg.norm(place[..., None, :] - posts, axis=-1) > 1.05, axis=-1)
    pull = force(place)
    pull = pull / np.linalg.norm(pull, axis=-1, keepdims=True)
    axes.quiver(x[free], y[free], pull[free, 0], pull[free, 1], color="0.6", scale=26, width=0.004)
    for aside, color, style in ((0.0, ORANGE, "-"), (0.8, BLUE, "-"), (-1.4, BLACK, "--")):
        path = flight(force, (-5, aside, 0), EAST, 1.0, 40.0)
        axes.plot(path[:, 0], path[:, 1], style, color=color, linewidth=2)
    axes.plot(*path[-1, :2], "s", color=ORANGE, markersize=8)
    axes.set_title("A trap in front of an open gap")


def draw_range(figure: Figure) -> None:
    """Force against the distance from the surface: a field without a range never ends, ours ends smoothly at its reach.

    The slide gives no formula. An inverse square pushes everybody everywhere.
    """
    axes = figure.subplots()
    s = np.linspace(0.01, 4, 400)
    place = np.stack([1 + s, 0 * s, 0 * s], axis=-1)
    axes.plot(s, as_printed.force_field(place, np.zeros(3), 4.0)[:, 0], "--", color=ORANGE, label="4 N m²/r²: no end")
    ours = sphere_force(place, np.zeros(3), 1.0, 4.0, 2.0)[:, 0]
    axes.plot(s, ours, color=BLACK, linewidth=2, label="F0 (1 − s/R)², R = 2 m")
    axes.axvline(2.0, color="0.5", linestyle=":")
    axes.text(2.03, 2.2, "reach", color="0.35")
    axes.set(xlabel="distance s from a sphere of 1 m, m", ylabel="force, N", xlim=(0, 4), ylim=(0, 4.1))
    axes.legend(loc="upper right")
    axes.set_title("A field with a range and one without")


def draw_tangent(figure: Figure) -> None:
    """L, k, t and s of the slide's construction: aim at the point where the line of flight touches the sphere."""
    axes = plan(figure, (-0.7, 8.5), (-3.5, 3.5))
    start, centre = np.zeros(3), np.array([5.0, 0.0, 0.0])
    touch = tangent_point(start, (1.0, 0.2, 0.0), centre, 3.0)
    foot = np.array([touch[0], 0.0])
    obstacle(axes, centre, 3.0)
    corners = {"p": (start, (-0.45, -0.1)), "c": (centre, (0.15, -0.45)), "tangent point": (touch, (-1.9, 0.35))}
    for a, b, style in ((start, centre, "-"), (start, touch, "-"), (centre, touch, "-"), (touch, foot, "--")):
        axes.plot([a[0], b[0]], [a[1], b[1]], style, color=BLACK)
    for label, place in (("L = 5", (1.5, -0.5)), ("k = 4", (0.6, 1.35)), ("r = 3", (4.3, 1.3)), ("t", (4.0, -0.5))):
        axes.text(*place, label)
    axes.text(2.8, 0.9, "s")
    for label, (place, (dx, dy)) in corners.items():
        axes.plot(place[0], place[1], "o", color=ORANGE)
        axes.text(place[0] + dx, place[1] + dy, label, color=ORANGE)
    axes.set_title("Steer to the tangent point: t = r²/L, s = √(r² − t²)")


def draw_around(figure: Figure) -> None:
    """Four bodies fly to one goal behind a sphere by its tangent points: each goes along a tangent, an arc, a tangent.

    The one that starts exactly head-on takes its left.
    """
    axes = plan(figure, (-4.3, 4.6), (-2.7, 2.7))
    obstacle(axes, np.zeros(3), 1.0)
    goal = np.array([4.0, 0.0, 0.0])
    for start, color, style in (
        ((-4.0, 0.0, 0.0), ORANGE, "-"),
        ((-4.0, 1.6, 0.0), BLUE, "--"),
        ((-4.0, -0.8, 0.0), BLACK, "-"),
        ((-3.0, -2.4, 0.0), GREEN, "-."),
    ):
        position, heading, path = np.array(start), EAST, [np.array(start)]
        for _ in range(900):
            heading = steer_around(position, heading if len(path) > 1 else goal - position, goal, np.zeros(3), 1.0)
            position = position + 0.01 * heading
            path.append(position)
            if np.linalg.norm(goal - position) < 0.01:
                break
        line = np.array(path)
        axes.plot(line[:, 0], line[:, 1], style, color=color, linewidth=2)
        axes.plot(*start[:2], "o", color=color)
    axes.plot(4, 0, "*", color=BLACK, markersize=13)
    axes.set_title("Around a sphere on the shortest way")


def draw_seek(figure: Figure) -> None:
    """Bodies that seek the star: with target − position they get there, with the widely copied sign they flee."""
    axes = plan(figure, (-5, 5), (-3.1, 3.1))
    target = np.zeros(2)
    wishes = ((as_printed.seek, ORANGE, "--", "position − target"), (seek, BLACK, "-", "target − position"))
    for wish, color, style, label in wishes:
        for angle in np.radians([20, 90, 160, 230, 310]):
            position, velocity = 1.9 * np.array([np.cos(angle), np.sin(angle)]), np.array([0.0, 0.0])
            path = [position]
            for _ in range(45):
                force = steering_force(velocity, wish(position, target, 1.0), 1.0, 0.4, 5.0)
                velocity = velocity + 0.05 * force
                position = position + 0.05 * velocity
                path.append(position)
            line = np.array(path)
            axes.plot(line[:, 0], line[:, 1], style, color=color, linewidth=2, label=label)
            axes.plot(*path[0], "o", color="0.4")
            label = "_"
    axes.plot(0, 0, "*", color=BLACK, markersize=13)
    axes.legend(loc="upper right")
    axes.set_title("seek: the widely copied sign flees")


def draw_arrive(figure: Figure) -> None:
    """Distance from the target while arriving at 2 m/s with a response time of 0.25 s, for three slowing radii.

    From R = 4 v τ on the body stops without overshoot; a shorter one, and plain seeking, run past it.
    """
    axes = figure.subplots()
    critical = 4 * 2.0 * 0.25
    cases = ((critical, BLACK, "-", "R = 4 v τ"), (critical / 8, ORANGE, "--", "R = v τ/2"), (0.0, BLUE, ":", "seek"))
    for radius, color, style, label in cases:
        position, velocity, path = np.array([-4.0, 0.0]), np.array([2.0, 0.0]), [-4.0]
        for _ in range(1400):
            wish = arrive(position, (0, 0), 2.0, radius) if radius else seek(position, (0, 0), 2.0)
            velocity = velocity + 0.005 * steering_force(velocity, wish, 1.0, 0.25, 100.0)
            position = position + 0.005 * velocity
            path.append(position[0])
        axes.plot(0.005 * np.arange(len(path)), path, style, color=color, linewidth=2, label=label)
    axes.axhline(0, color="0.6", linewidth=0.8)
    axes.set(xlabel="t, s", ylabel="x, m", xlim=(0, 7))
    axes.legend(loc="lower right")
    axes.set_title("Arriving: stop without overshoot")


def draw_flock(figure: Figure) -> None:
    """Sixty boids at random, and after 12 s of separation, alignment and cohesion among neighbours within 3 m."""
    rng = np.random.default_rng(3)
    position, velocity = rng.uniform(-3, 3, (60, 2)), rng.uniform(-0.5, 1.2, (60, 2))
    left, right = figure.subplots(1, 2)
    for axes, title, steps in ((left, "at the start", 0), (right, "after 12 s", 240)):
        for _ in range(steps):
            position, velocity = flock_step(position, velocity, 0.05, 3.0, (0.15, 1.0, 0.8), 1.0, 5.0)
        centre = position.mean(axis=0)
        x, y = (position - centre).T
        axes.quiver(x, y, *velocity.T, color=BLACK, angles="xy", scale_units="xy", scale=0.9, width=0.008)
        axes.set(xlim=(-4, 4), ylim=(-4, 4), aspect="equal", xlabel="x, m, from the middle", title=title)
        axes.set_xticks(range(-4, 5, 2))
    left.set_ylabel("y, m, from the middle")


def draw_half_plane(figure: Figure) -> None:
    """Velocities of a disc A that meets B almost head-on; those in grey lead to a collision within 5 s if B flies on.

    The half-plane in blue is what A leaves to itself: its border is half the way out of the grey, B does the other.
    """
    axes = figure.subplots()
    place, velocity_b, tau = np.array([5.0, 0.2]), np.array([-1.0, 0.0]), 5.0
    velocity, wish = np.array([1.0, 0.0]), np.array([1.0, 0.0])
    point, normal = orca_half_plane((0, 0), velocity, 0.5, place, velocity_b, 0.5, tau, 0.1)
    tip, spread = velocity_b + place / tau, np.degrees(np.arcsin(1 / np.linalg.norm(place)))
    heading = np.degrees(np.arctan2(place[1], place[0]))
    round_end = Circle(tip, 1 / tau, facecolor="0.8")
    cone = Wedge(velocity_b, 9.0, heading - spread, heading + spread, width=9.0 - np.sqrt(place @ place - 1) / tau)
    cone.set(facecolor="0.8", edgecolor="none")
    for patch in (cone, round_end):
        axes.add_patch(patch)
    along = np.array([-normal[1], normal[0]])
    ends = [point - 4 * along, point + 4 * along]
    axes.add_patch(Polygon([*ends, ends[1] + 3 * normal, ends[0] + 3 * normal], facecolor=BLUE, alpha=0.15))
    axes.plot(*np.transpose(ends), color=BLUE, linewidth=2)
    axes.annotate("", point, velocity, arrowprops={"arrowstyle": "->", "color": BLUE, "linewidth": 2})
    chosen = permitted_velocity(wish, 1.5, [point], [normal])
    axes.plot(*velocity, "o", color=BLACK)
    axes.plot(*chosen, "s", color=ORANGE)
    axes.text(1.02, 0.05, "v of A")
    axes.text(1.02, -0.42, "its new v", color=ORANGE)
    axes.text(1.55, 0.3, "collision", color="0.3", ha="center")
    axes.text(-0.1, -0.75, "permitted to A", color=BLUE)
    axes.set(xlim=(-1, 2.2), ylim=(-1, 1), aspect="equal", xlabel="$v_x$, m/s", ylabel="$v_y$, m/s")
    axes.set_title("A takes half of the change, B the other")


def draw_crowd(figure: Figure) -> None:
    """Ten discs on a ring swap places through its middle, each with its half-planes alone, and none touches another.

    Their wishes are turned to the right by 0.2 rad, or a perfect ring would jam.
    """
    axes = plan(figure, (-9.5, 9.5), (-6.3, 6.3))
    angle = 2 * np.pi * np.arange(10) / 10
    start = 5.5 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    position, velocity, path = start, np.zeros_like(start), [start]
    right = np.array([[np.cos(0.2), -np.sin(0.2)], [np.sin(0.2), np.cos(0.2)]])
    for _ in range(200):
        wish = arrive(position, -start, 1.0, 1.0) @ right
        position, velocity = crowd_step(position, velocity, wish, 0.5, 1.5, 4.0, 0.1)
        path.append(position)
    lines = np.array(path)
    for disc in range(10):
        color = (BLACK, BLUE, ORANGE, GREEN, "#cc79a7")[disc % 5]
        axes.plot(lines[:, disc, 0], lines[:, disc, 1], color=color)
        axes.add_patch(Circle(lines[60, disc], 0.5, facecolor=color, alpha=0.6))
        axes.plot(*start[disc], "o", color=color, markersize=4)
    axes.set_title("A ring of discs swaps places: the discs after 6 s")


FIGURES = {
    (1, "a-field-and-its-range"): draw_range,
    (1, "along-a-wall"): draw_wall,
    (1, "arrive"): draw_arrive,
    (1, "around-a-sphere"): draw_around,
    (1, "crowd"): draw_crowd,
    (1, "flock"): draw_flock,
    (1, "half-plane"): draw_half_plane,
    (1, "head-on-deadlock"): draw_deadlock,
    (1, "seek-or-flee"): draw_seek,
    (1, "tangent-point"): draw_tangent,
    (1, "trap-between-two"): draw_trap,
}
