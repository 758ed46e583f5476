"""The friction of a stretch of steps at once, against a plain loop that takes one step after another."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.prediction import friction


def one_step_after_another(speed, pull, limits, ease, softness):
    """The same recurrence as plainly as it can be written."""
    slip, speeds, slips = speed, [speed], [speed]
    for most in limits:
        wanted = (slip + pull) / (ease * (1 + softness))
        impulse = max(-most, min(most, wanted))
        speed, slip = speed + pull - impulse, slip + pull - ease * impulse
        speeds.append(speed)
        slips.append(slip)
    return speeds, slips


UNEVEN = 0.004 * (1 + np.sin(np.arange(400)) / 2)  # limits as in a contact that settles


@pytest.mark.parametrize(
    ("speed", "pull", "ease", "softness"),
    [
        (0.7, 0.0, 1.0, 0.0),  # a slab slides and stops
        (0.7, 0.0, 3.5, 1e-5),  # a ball begins to roll
        (-0.3, 0.005, 1.0, 0.5),  # up a slope, and down again
        (0.0, 0.0035, 1.0, 0.1),  # holds in some steps, slips in others
        (0.0, 0.02, 3.5, 0.0),  # down a slope, slipping
    ],
)
def test_stretches_of_friction_are_the_plain_step_loop(speed, pull, ease, softness):
    found = friction.by_limits(speed, pull, UNEVEN, ease, softness)
    np.testing.assert_allclose(found, one_step_after_another(speed, pull, UNEVEN, ease, softness), rtol=0, atol=1e-12)


def one_step_by_hand(speed, pull, static, kinetic, steps):
    """Static friction holds a body at rest, kinetic friction opposes its velocity, and no step turns it back."""
    speeds = [speed]
    for _ in range(steps):
        if speed == 0:
            after = 0.0 if abs(pull) <= static else pull - math.copysign(kinetic, pull)
        else:
            after = speed + pull - math.copysign(kinetic, speed)
            after = 0.0 if after * speed <= 0 else after
        speed = after
        speeds.append(speed)
    return speeds


@pytest.mark.parametrize(
    ("speed", "pull"),
    [(0.5, 0.0), (-0.5, 0.0045), (-0.5, 0.006), (0.0, 0.0045), (0.0, 0.006), (0.0, -0.006)],
)
def test_friction_by_hand_is_the_plain_step_loop(speed, pull):
    found = friction.by_hand(speed, pull, 0.005, 0.003, 300)
    np.testing.assert_allclose(found, one_step_by_hand(speed, pull, 0.005, 0.003, 300), rtol=0, atol=1e-12)
