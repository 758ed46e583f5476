"""Whether a step may carry a fast ball past a wall that it should meet: decided before a scenario runs."""

from __future__ import annotations

import numpy as np

from reference.scene.scenario import Box, Scenario, Sphere

STEP = 1e-3
"""An ordinary timestep of an engine, s."""


def way_of_a_step(scenario: Scenario, timestep: float) -> float:
    """How far the fastest body moves in a step as it starts, m."""
    return timestep * max(float(np.linalg.norm(body.velocity)) for body in scenario.bodies)


def may_leap(scenario: Scenario) -> bool:
    """Whether one ball without weight flies at one fixed box, so fast that a millisecond carries it past the middle.

    A method that looks at the ends of such steps may never see the ball before the middle of the wall, from where it
    pushes the ball out on the far side.
    """
    if len(scenario.bodies) != 2 or len(scenario.pairs) != 1 or any(scenario.gravity):
        return False
    wall, ball = sorted(scenario.bodies, key=lambda body: not body.immovable)
    if not wall.immovable or ball.immovable:
        return False
    if not isinstance(wall.shape, Box) or not isinstance(ball.shape, Sphere):
        return False
    return way_of_a_step(scenario, STEP) > min(wall.shape.half_extents) + ball.shape.radius
