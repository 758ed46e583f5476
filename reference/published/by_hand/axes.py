"""Directions and a velocity of zero, as the lecture's functions take them: arrays of shape (3,)."""

from __future__ import annotations

import numpy as np

X, Y, UP = np.eye(3)
"""Along the floor, across it, and away from it."""
STILL = np.zeros(3)
"""Of what does not move."""
