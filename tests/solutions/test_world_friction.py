"""Friction of bodies that touch at several places: what holds, what slips, and with which coefficient."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.rules import Rules
from solutions.world.step import step_world

G = 9.81


def on_slope(ratio, static, kinetic):
    """A box of unequal edges on a slope of tan θ = ratio, which descends across its corners."""
    angle, heading = np.arctan(ratio), 0.4
    down = np.array([np.cos(heading) * np.cos(angle), np.sin(heading) * np.cos(angle), -np.sin(angle)])
    normal = np.array([np.cos(heading) * np.sin(angle), np.sin(heading) * np.sin(angle), np.cos(angle)])
    axis = np.array([-np.sin(heading), np.cos(heading), 0]) * np.sin(angle / 2)
    half, mass = np.array([0.3, 0.2, 0.1]), 2.0
    moments = mass / 3 * (np.sum(half**2) - half**2)
    bodies = make_bodies([("box", half), ("half-space", normal)], [mass, np.inf], moments, 0.0, kinetic, static)
    return bodies, make_state([0.1 * normal, (0, 0, 0)], [(np.cos(angle / 2), *axis), (1, 0, 0, 0)]), down, angle


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_four_places_hold_a_box_together_up_to_static_friction(response):
    """The lower ones carry more than the upper ones; all of them slip with μ_k as soon as together they cannot hold."""
    dt, rules = 0.01, Rules(response=response, sweeps=400, tolerance=1e-10, directions=12)
    for ratio, holds in ((0.47, True), (0.53, False)):
        bodies, state, down, angle = on_slope(ratio, 0.5, 0.1)
        after, _, _ = step_world(bodies, state, (0, 0, -G), dt, rules)
        gained = 0.0 if holds else dt * G * (np.sin(angle) - 0.1 * np.cos(angle))
        # Between two of twelve directions 1 − cos(π/12), 3.4 % of friction is lost
        limit = 1e-8 if response == "sequential" else 0.034 * 0.1 * dt * G
        assert after.velocity[0] @ down == pytest.approx(gained, abs=limit)
