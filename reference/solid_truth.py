"""Closed forms for solids with flat faces: which part of a line lies within them, and how a ball falls among them.

Lengths in m. A plane is n·x = o, with the unit normal n out of the solid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array


def chord(start: Array, way: Array, normals: Array, offsets: Array) -> float:
    """The length of the line from `start` along `way` that lies behind all planes, normals (f, 3) and offsets (f,).

    At the share t of the way, n·(start + t way) − o is the height above a plane. It changes at the rate n·way, so the
    line gets behind the planes that it approaches at t = (o − n·start)/(n·way), and comes out of the others at the same
    expression. Within a convex solid it is between the last of the first and the first of the last.
    """
    rates, heights = normals @ way, normals @ start - offsets
    passed = rates != 0
    shares = -heights[passed] / rates[passed]
    entries, exits = shares[rates[passed] < 0], shares[rates[passed] > 0]
    return float(np.linalg.norm(way)) * max(0.0, float(np.min(exits) - np.max(entries)))


def lid(left: tuple[float, float], right: tuple[float, float], across: float) -> float:
    """Height at the place `across` of the straight line over a channel whose rims are at (across, height), m.

    A convex hull has with two points all points between them: it closes the channel by this line.
    """
    share = (across - left[0]) / (right[0] - left[0])
    return left[1] + share * (right[1] - left[1])


@dataclass(frozen=True)
class Fall:
    """A fall on a level floor.

    time: of the landing, s. rebound: how high the ball rises then, m. aside: its level speed, m/s.
    """

    time: float
    rebound: float
    aside: float


def after_a_wall(
    to_wall: float, to_floor: float, normal: tuple[float, float], restitution: float, gravity: float
) -> Fall:
    """A ball that falls from rest, strikes a smooth slanting wall, and falls on to a level floor.

    to_wall, to_floor: how far it falls before and after the wall, m. normal: the level and the upright part of the
    wall's unit normal; (0, 0) for no wall.

    It strikes the wall with the speed v = √(2 g to_wall), straight down, so that the speed towards the wall is v n_z.
    Newton's law takes (1 + e) v n_z along the normal: the ball goes on down with v − (1 + e) v n_z² and aside with
    (1 + e) v n_z n_x. It reaches the floor at w with w² = that² + 2 g to_floor, and rises by (e w)²/2g.
    """
    level, upright = normal
    before = math.sqrt(2 * gravity * to_wall)
    turned = (1 + restitution) * before * upright
    after = before - turned * upright
    landing = math.sqrt(after**2 + 2 * gravity * to_floor)
    time = before / gravity + (landing - after) / gravity
    return Fall(time, (restitution * landing) ** 2 / (2 * gravity), abs(turned * level))
