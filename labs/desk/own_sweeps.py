"""Pellets and spinning rods for a notebook's own loops, and the replay of such a loop beside recordings.

The scenarios are turned in space. A loop gets a pellet as seen along its wall's own axes, and a rod as seen by somebody
who drifts along with the rod and the ball.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from labs.desk.display import Replay
from labs.desk.own_motion import beside, first_scenario, replay_beside
from reference import sweeping_truth, truth
from reference.arrays import Array
from reference.catalogue.scenarios import find, spinning_rods
from reference.errors import InvalidInput
from reference.scene import geometry
from reference.scene.scenario import Body, Box, Scenario, Sphere

CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


@dataclass(frozen=True, eq=False)
class Shots:
    """Balls that fly at a wall, seen from the middle of the wall along its own axes.

    half_extents: of the wall, (3,), m. starts: centres of the balls, (n, 3), m. velocity: of all of them, (3,), m/s.
    radius: m. restitution: of an impact. durations: (n,), s.
    """

    half_extents: Array
    starts: Array
    velocity: Array
    radius: float
    restitution: float
    durations: Array


@dataclass(frozen=True, eq=False)
class Pass:
    """A rod that spins towards a ball at rest, seen from the rod's middle.

    rod: corners, (8, 3), m. grown: corners of the rod grown by the ball's radius, (8, 3), m. spin: (3,), rad/s.
    ball: its centre, (3,), m. duration: s. touch: when they touch in theory, s.
    """

    rod: Array
    grown: Array
    spin: Array
    ball: Array
    duration: float
    touch: float


def shots(case: str) -> Shots:
    """The shots of a case such as `pellets/v=60,w=12mm`.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case, or it is no ball that flies at a box.
    """
    scenarios = _scenarios(case)
    wall, ball, shape, sphere = _box_and_ball(case, scenarios[0])
    back = geometry.opposite(np.array(wall.orientation))
    starts = [np.subtract(_box_and_ball(case, each)[1].position, wall.position) for each in scenarios]
    return Shots(
        np.array(shape.half_extents),
        geometry.rotate(back, np.array(starts)),
        geometry.rotate(back, np.array(ball.velocity)),
        sphere.radius,
        scenarios[0].pairs[0].restitution,
        np.array([each.duration for each in scenarios]),
    )


def shot_beside(case: str, times: ArrayLike, places: ArrayLike, engines: Sequence[str]) -> Replay:
    """A replay of the first shot as your loop has it, beside engines that are tuned.

    times: (n,), s. places: (n, 3), m, of the ball's centre, as in `shots`.

    Raises
    ------
    InvalidInput, UnknownName
        As for `shots` and `labs.desk.own_motion.beside`.
    """
    wall, *_ = _box_and_ball(case, first_scenario(case))
    ways = np.asarray(places, dtype=float)
    if ways.ndim != 2 or ways.shape[1] != 3:
        raise InvalidInput(f"places must have the shape (n, 3), not {ways.shape}")
    world = np.array(wall.position) + geometry.rotate(np.array(wall.orientation), ways)
    return beside(case, world, engines, times=times)


def passes(case: str) -> list[Pass]:
    """The passes of a case such as `spinning-rod/ω=100`.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case, or it is no box that spins towards a ball.
    """
    found = []
    for scenario in _scenarios(case):
        rod, ball, shape, sphere = _box_and_ball(case, scenario)
        turned, half = np.array(rod.orientation), np.array(shape.half_extents)
        found.append(
            Pass(
                geometry.rotate(turned, CORNERS * half),
                geometry.rotate(turned, CORNERS * (half + sphere.radius)),
                np.array(rod.angular_velocity),
                np.subtract(ball.position, rod.position),
                scenario.duration,
                scenario.duration - spinning_rods.AFTER,
            )
        )
    return found


def rod_beside(case: str, time: float, engines: Sequence[str], *, stock: bool = False) -> Replay:
    """A replay of the first pass, in which your rod strikes the ball at a time, beside engines.

    Where the time is infinite, your rod passes. Otherwise the two part as in theory. stock: whether the engines are
    shown as they come.

    Raises
    ------
    InvalidInput, UnknownName
        As for `passes`, or if the time is negative or NaN, or an engine has no recording.
    """
    if not time >= 0:
        raise InvalidInput(f"the rod strikes at a time from 0 on, or never: {time}")
    scenario = first_scenario(case)
    rod, ball, *_ = _box_and_ball(case, scenario)
    drift, spin = np.array(rod.velocity), np.array(rod.angular_velocity)

    def poses(times: Array) -> tuple[Array, Array]:
        before, after = np.minimum(times, time), np.maximum(times - time, 0.0)
        upon = geometry.turned(np.array(rod.orientation), spin * min(time, scenario.duration))
        gained, slower = _parting(spin, geometry.rotate(upon, np.array([0.0, 1.0, 0.0])))
        turns = before[:, None] * spin + after[:, None] * (spin - slower)
        places = [
            np.array(body.position) + times[:, None] * drift + after[:, None] * change
            for body, change in ((rod, -gained / rod.mass), (ball, gained / ball.mass))
        ]
        upright = np.broadcast_to([1.0, 0.0, 0.0, 0.0], (len(times), 4))
        orientations = np.array([geometry.turned(np.array(rod.orientation), turn) for turn in turns])
        return np.stack(places, axis=1), np.stack([orientations, upright], axis=1)

    return replay_beside(case, (rod.name, ball.name), poses, engines, stock=stock, oblique=False)


def _parting(spin: Array, normal: Array) -> tuple[Array, Array]:
    """The momentum that the ball gains, N s, and what the rod loses of its spin, rad/s, both as vectors."""
    speed = float(np.linalg.norm(spin))
    arm = sweeping_truth.struck_arm(spinning_rods.REACH, spinning_rods.DISTANCE)
    size = spinning_rods.impulse(speed)
    softness = truth.rod_softness(spinning_rods.ROD, arm, spinning_rods.HALF_LENGTH, spinning_rods.HALF_THICKNESS)
    turning = (softness - 1 / spinning_rods.ROD) / arm  # a/I, 1/(kg m)
    return size * normal, size * turning * spin / speed


def _scenarios(case: str) -> tuple[Scenario, ...]:
    family, chosen = find(case)
    if chosen is None:
        raise InvalidInput(f"{case!r} names no case: give family/case, such as {family.name}/{family.curve.case}")
    return chosen.scenarios


def _box_and_ball(case: str, scenario: Scenario) -> tuple[Body, Body, Box, Sphere]:
    boxes = [body for body in scenario.bodies if isinstance(body.shape, Box)]
    balls = [body for body in scenario.bodies if isinstance(body.shape, Sphere)]
    if len(boxes) == len(balls) == 1 and isinstance(boxes[0].shape, Box) and isinstance(balls[0].shape, Sphere):
        return boxes[0], balls[0], boxes[0].shape, balls[0].shape
    raise InvalidInput(f"{case} is not about one box and one ball")
