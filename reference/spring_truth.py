"""A ball that falls into a spring with a dashpot, weight included: closed forms of one contact.

All quantities are per unit mass. With x the height above the plane, k the stiffness (1/s²), ω = √k and ζ the damping
ratio, the contact obeys

    x″ + 2 ζ ω x′ + k x = −g    from x = 0, x′ = −v,

and it pushes with the acceleration a = −k x − 2 ζ ω x′ until that is zero; a plane cannot pull. Measured from the place
of rest, y = x + g/k, the path is that of a damped oscillator without weight, so that y, x′ and a have closed forms. Two
instants are roots of these: the deepest one, x′ = 0, and the last one, a = 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from reference import forces_truth


@dataclass(frozen=True)
class SpringContact:
    """speed: of the fall at the touch, m/s. gravity: towards the plane, m/s². stiffness: per unit mass, 1/s²."""

    speed: float
    gravity: float
    stiffness: float
    damping_ratio: float

    @property
    def rest_depth(self) -> float:
        """Where spring and weight are in balance, m: k d = g."""
        return self.gravity / self.stiffness

    @property
    def deepest(self) -> float:
        """The greatest depth, m: that of x′ = 0. Without dashpot it is g/k + √((g/k)² + v²/k)."""
        return -self._state(self._turn)[0]

    @property
    def time_below(self) -> float:
        """Time between the two passages of the surface, s: the contact, and the free flight up from where it ends."""
        height, rate = self._state(self._end)
        # x + w t − g t²/2 = 0 at the first of the two roots, since the body comes up from below
        return self._end + 2 * -height / (rate + math.sqrt(rate**2 + 2 * self.gravity * height))

    @property
    def rebound_speed(self) -> float:
        """Speed with which the body passes the surface on its way up, m/s: w² − 2 g d where the plane lets go at d."""
        height, rate = self._state(self._end)
        return math.sqrt(rate**2 + 2 * self.gravity * height)

    @property
    def _turn(self) -> float:
        return _root(lambda time: self._state(time)[1], self._quarter)

    @property
    def _end(self) -> float:
        """When the push is zero, s, after the deepest instant."""

        def push(time: float) -> float:
            height, rate = self._state(time)
            return self.stiffness * height + 2 * self.damping_ratio * math.sqrt(self.stiffness) * rate

        return _root(push, self._quarter, self._turn)

    @property
    def _quarter(self) -> float:
        """A step towards a root, s, shorter than the time from any root to the next of its kind."""
        return 0.5 / math.sqrt(self.stiffness)

    def _state(self, time: float) -> tuple[float, float]:
        """Height and velocity at a time."""
        damping = 2 * self.damping_ratio * math.sqrt(self.stiffness)
        place, rate = forces_truth.swing(self.rest_depth, -self.speed, self.stiffness, damping, 1.0, time)
        return place - self.rest_depth, rate


def _root(function: Callable[[float], float], step: float, start: float = 0.0) -> float:
    """The first time after `start` at which a function of time rises through zero, by steps and then halves."""
    low = start
    while function(low + step) <= 0:
        low += step
    high = low + step
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) <= 0 else (low, middle)
    return (low + high) / 2
