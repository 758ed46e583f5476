"""What P28 asks of a body that lands: when, how fast, and at which angle."""

from __future__ import annotations

import math

from reference.arrays import Array
from reference.published.answers import Answers, as_answers


def at_impact(time: float, velocity: Array) -> Answers:
    """The figures of P28, from the instant, s, and the velocity, m/s."""
    along, upwards = float(velocity[0]), float(velocity[2])
    angle = math.degrees(math.atan2(upwards, along))
    return as_answers(time=time, along=along, upwards=upwards, speed=math.hypot(along, upwards), angle=angle)
