"""The drawn figures of the lab on the whole world; `lab_figures.py` says how they are written."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from blackboard import BLUE, GREY, INK, LIGHT, ORANGE, Draw, arrow, board, unit
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Rectangle

from labs.desk.own_world import BALL, BOX, FLOOR, PLANE, thing, world
from solutions.forces import total_force
from solutions.impulse import rotation_matrix
from solutions.world import step_world
from solutions.world.boxes import BOX_FACES, BOX_VERTICES


def tumbling(figure: Figure) -> None:
    """The angular momentum stays while the body and its spin turn.

    The same long box twice, before and after a turn. The arrow L has the same direction and length in both. The arrow ω
    does not lie along L. It lies between L and the long axis of the box, and has moved along with the box.
    """
    for axes, angle, name in zip(figure.subplots(1, 2), (25, 65), ("before", "after"), strict=True):
        axes.set(xlim=(-2, 2), ylim=(-1.7, 1.9), aspect="equal")
        axes.set_axis_off()
        corners = np.array([[-1.3, -0.35], [1.3, -0.35], [1.3, 0.35], [-1.3, 0.35]])
        turn = np.array([unit(angle), unit(angle + 90)])
        axes.add_patch(Polygon(corners @ turn, fc=LIGHT, ec=INK, lw=1.6))
        momentum = 1.5 * unit(90)
        own = turn @ momentum / np.array([0.6, 1.8])
        arrow(axes, (0, 0), momentum, ORANGE, "$L$", at=0.9, beside=(-11, 0))
        arrow(axes, (0, 0), 0.75 * own @ turn, BLUE, "$\\omega$", beside=(3, 9))
        axes.annotate(name, (0, -1.6), ha="center", color=GREY, size=10)


def reach(figure: Figure) -> None:
    """A turned rectangle, and the box along the axes around it.

    A rectangle with the half edges h and k is turned by the angle a, so that h points to the upper right and k to the
    upper left. The dashed box along the axes touches its four corners. Half the width of the box is the reach. It is
    drawn as two arrows, one after the other, from the middle to the right.
    """
    axes = board(figure, (-2.9, 2.9), (-2.0, 2.0))
    h, k, angle = 1.7, 0.8, 28
    turn = np.array([unit(angle), unit(angle + 90)])
    corners = np.array([[-h, -k], [h, -k], [h, k], [-h, k]]) @ turn
    far = np.max(corners, axis=0)
    axes.add_patch(Rectangle(-far, *(2 * far), fc="none", ec=ORANGE, ls="--", lw=1.6))
    axes.add_patch(Polygon(corners, fc=LIGHT, ec=INK, lw=1.6))
    arrow(axes, (0, 0), h * turn[0], INK, "$h$", at=0.6, beside=(-4, 10))
    arrow(axes, (0, 0), k * turn[1], INK, "$k$", at=0.6, beside=(-10, 0))
    first = h * np.cos(np.radians(angle))
    arrow(axes, (0, 0), (first, 0), BLUE)
    arrow(axes, (first, 0), (far[0] - first, 0), ORANGE)
    axes.annotate("reach", (far[0] / 2 - 0.2, -0.2), ha="center", va="center", size=11)
    axes.add_patch(Arc((0, 0), 1.1, 1.1, theta1=0, theta2=angle, color=GREY, lw=1.4))
    axes.annotate("$a$", 0.72 * unit(angle / 2), ha="center", va="center", color=GREY, size=11)


def plank(figure: Figure) -> None:
    """A plank on two trestles, pushed at one end.

    A plank touches two trestles at the distance d to the left and to the right of its middle. A unit force pushes up at
    the right one. The push moves the whole plank upwards, an arrow at each end. It also turns the plank: the arrow of
    the turn points up at the right end, and down at the left end.
    """
    axes = board(figure, (-3.0, 3.0), (-1.5, 1.7))
    axes.add_patch(Rectangle((-2.3, -0.12), 4.6, 0.24, fc=LIGHT, ec=INK, lw=1.6))
    for x in (-1.7, 1.7):
        axes.add_patch(Polygon([(x, -0.12), (x - 0.25, -0.8), (x + 0.25, -0.8)], fc="none", ec=GREY, lw=1.6))
    arrow(axes, (1.7, -1.4), (0, 1.2), ORANGE, "1 N", at=0.1, beside=(16, 0))
    for x, turning in ((-1.7, -1.0), (1.7, 0.8)):
        arrow(axes, (x - 0.15, 0.15), (0, 0.5), INK, "moves", at=1.0, beside=(-4, 9))
        arrow(axes, (x + 0.2, 0.15), (0, turning), BLUE, "turns", at=1.0, beside=(20, 4))
    arrow(axes, (0, 0.3), (1.7, 0), GREY, "$d$", at=0.5, beside=(0, 8), style="--")
    axes.plot(0, 0, "o", color=INK, markersize=6)


def timeline(figure: Figure) -> None:
    """The order of one step.

    Five boxes one after another, three in an upper row and two in a lower one, with arrows from each to the next:
    contacts, where the step begins; impacts, with the old velocities; loads, weight and forces for the time dt; rest,
    impulses so that nothing sinks in; motion, with the new velocities. Impacts and rest, the two that contacts decide,
    have a thick orange frame.
    """
    axes = board(figure, (-3.4, 3.4), (-2.0, 1.8))
    parts = (
        ("1 contacts", "where it begins", (-2.3, 0.9)),
        ("2 impacts", "old velocities", (0, 0.9)),
        ("3 loads", "for the time dt", (2.3, 0.9)),
        ("4 rest", "nothing sinks in", (-1.15, -1.1)),
        ("5 motion", "new velocities", (1.15, -1.1)),
    )
    for name, words, (x, y) in parts:
        decided = name in ("2 impacts", "4 rest")
        looks = {"ec": ORANGE, "lw": 3} if decided else {"ec": INK, "lw": 1.2}
        axes.add_patch(Rectangle((x - 0.9, y - 0.4), 1.8, 0.8, fc=LIGHT, **looks))
        axes.annotate(name, (x, y), ha="center", va="center", weight="bold", size=14)
        axes.annotate(words, (x, y - 0.65), ha="center", va="center", color=INK, size=12)
    for start, along in (
        ((-1.4, 0.9), (0.5, 0)),
        ((0.9, 0.9), (0.5, 0)),
        ((1.35, 0.4), (-1.65, -1.05)),
        ((-0.25, -1.1), (0.5, 0)),
    ):
        arrow(axes, start, along, INK)


def own_engine(figure: Figure) -> None:
    """What the simulator of the lab does: a heap, a jelly and a brick.

    Left, from the side: eight balls and a box have fallen between walls and lie in a heap. Middle, from the side: a
    cube of eight balls and springs falls, drawn pale, and stands on the floor, drawn dark. Right, from above the side:
    a brick that spins about its middle axis, at four instants with the numbers 1 to 4. One of its long narrow faces
    is dark blue. It is on top at first. At the end it is below and out of sight: the brick has turned over.
    """
    for axes, draw in zip(figure.subplots(1, 3, width_ratios=(1, 1, 1.3)), (_heap, _jelly, _brick), strict=True):
        axes.set_aspect("equal")
        axes.set_axis_off()
        draw(axes)


def _run(things: list[Any], dt: float, steps: int, weight: float = 9.81, push: Any = None) -> tuple[Any, list[Any]]:
    """Bodies, and the states of so many steps. push: the forces on the bodies in a state."""
    bodies, state = world(things, 0.3, 0.4)
    states, memory = [state], None
    for _ in range(steps):
        rules = 2 * 9.81 * dt, 1e-3, 10
        force = (0.0, 0.0, 0.0) if push is None else push(states[-1])
        *after, key, impulse = step_world(bodies, states[-1], (0.0, 0.0, -weight), dt, rules, memory, force)
        states.append(tuple(after))
        memory = key, impulse
    return bodies, states


def _outline(axes: Any, kind: int, size: Any, place: Any, turn: Any, alpha: float) -> None:
    """A ball or a box as it is seen along y."""
    style = {"fc": LIGHT, "ec": INK, "lw": 1.2, "alpha": alpha, "zorder": 2 - place[1]}
    if kind == BALL:
        axes.add_patch(Circle((place[0], place[2]), size[0], **style))
        return
    corners = place + (BOX_VERTICES * size) @ rotation_matrix(turn).T
    for face in BOX_FACES:
        normal = np.mean(corners[face], axis=0) - place
        if normal[1] < 0:  # towards the one who looks
            axes.add_patch(Polygon(corners[face][:, [0, 2]], joinstyle="round", **style))


def _heap(axes: Any) -> None:
    walls = [thing(PLANE, n, position=-0.3 * np.array(n)) for n in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]
    places = [
        (x, y, 0.15 + 0.25 * k) for k in (0, 1) for x, y in ((-0.15, -0.2), (0.2, -0.1), (-0.15, 0.2), (0.15, 0.2))
    ]
    balls = [thing(BALL, 0.1, 1.0, place) for place in places]
    box = thing(BOX, (0.12, 0.1, 0.08), 1.5, (0, 0, 0.8), (0.8, 0.4, 0.4, 0.2))
    bodies, states = _run([FLOOR, *walls, *balls, box], 1 / 120, 240)
    for k in range(5, len(bodies[0])):
        _outline(axes, bodies[5][k], bodies[6][k], states[-1][0][k], states[-1][1][k], 1.0)
    axes.plot([-0.3, -0.3, 0.3, 0.3], [0.6, 0, 0, 0.6], color=INK, lw=1.6)
    axes.set(xlim=(-0.35, 0.35), ylim=(-0.05, 0.75))


def _jelly(axes: Any) -> None:
    ends = np.argwhere(np.triu(np.ones((8, 8)), 1))
    corners = 0.3 * (np.array(list(product((0, 1), repeat=3))) - 0.5)
    turn = rotation_matrix(np.array([0.9, 0.1, 0.4, 0.1]) / np.sqrt(0.99))
    places = corners @ turn.T + (0, 0, 0.75)
    rest = np.linalg.norm(places[ends[:, 0]] - places[ends[:, 1]], axis=-1)

    def springs(state: Any) -> Any:
        whole = np.zeros((9, 3))
        mass, radius, stiff, soft = np.full(8, 0.25), np.full(8, 0.06), np.full(28, 250.0), np.full(28, 2.0)
        moving = state[0][1:], state[2][1:], mass, radius
        whole[1:] = total_force(*moving, np.zeros(3), 0.0, np.zeros(3), ends, stiff, rest, soft)
        return whole

    balls = [thing(BALL, 0.06, 0.25, place) for place in places]
    _, states = _run([FLOOR, *balls], 1 / 240, 200, push=springs)
    for number, alpha in ((0, 0.25), (200, 1.0)):
        at = states[number][0][1:]
        for a, b in ends:
            axes.plot(*at[[a, b]][:, [0, 2]].T, color=BLUE, lw=0.8, alpha=alpha, zorder=1)
        for place in at:
            _outline(axes, BALL, (0.06, 0, 0), place, None, alpha)
    axes.plot([-0.4, 0.4], [0, 0], color=INK, lw=1.6)
    axes.set(xlim=(-0.4, 0.4), ylim=(-0.05, 1.1))


def _brick(axes: Any) -> None:
    """Four instants, each half a turn after the one before, seen from above the side."""
    bodies, states = _run([thing(BOX, (0.3, 0.05, 0.15), 1.0, spin=(0.2, 0.1, 6.0))], 0.004, 375, weight=0.0)
    tilt = np.radians(30)
    sight = np.array([0, np.cos(tilt), -np.sin(tilt)])
    right, up = np.array([1.0, 0, 0]), np.array([0, np.sin(tilt), np.cos(tilt)])
    for number, step in enumerate((0, 130, 260, 375)):
        turn = rotation_matrix(states[step][1][0])
        corners = (BOX_VERTICES * bodies[6][0]) @ turn.T
        at = np.array([0.8 * (number % 2), -0.7 * (number // 2)])
        for face in BOX_FACES:
            normal = np.mean(corners[face], axis=0)
            if normal @ sight < 0:
                shown = at + corners[face] @ np.stack([right, up], axis=-1)
                colour = BLUE if normal @ turn[:, 2] > 0.1 else LIGHT
                axes.add_patch(Polygon(shown, fc=colour, ec=INK, lw=1.2, joinstyle="round"))
        axes.annotate(str(number + 1), at - (0, 0.34), ha="center", va="center", color=GREY, size=8)
    axes.autoscale_view()


DRAWN = tumbling, reach, plank, timeline, own_engine
LAB_FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in DRAWN}
"""The figures by name."""
