"""Directions on a plane that slopes down towards +x."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array


def normal_of(slope: float) -> Array:
    """Unit normal, (3,), of a plane that slopes by an angle, rad."""
    return np.array([math.sin(slope), 0.0, math.cos(slope)])


def downhill_on(slope: float) -> Array:
    """Unit vector down that slope, (3,)."""
    return np.array([math.cos(slope), 0.0, -math.sin(slope)])
