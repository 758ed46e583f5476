"""The corners and the faces of a box."""

from __future__ import annotations

import numpy as np

BOX_VERTICES = np.array(
    [(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
)
"""(8, 3), the corners of a box whose half extents are 1."""

BOX_FACES = np.array(
    [
        (0, 1, 3, 2),
        (4, 6, 7, 5),
        (0, 4, 5, 1),
        (2, 3, 7, 6),
        (0, 2, 6, 4),
        (1, 5, 7, 3),
    ]
)
"""(6, 4), numbers of corners, counterclockwise from outside: −x, +x, −y, …"""
