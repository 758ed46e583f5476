"""Closed forms for solids with flat faces: which part of a line lies within them.

Lengths in m. A plane is n·x = o, with the unit normal n out of the solid.
"""

from __future__ import annotations

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
