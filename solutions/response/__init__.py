"""Responding to a collision with a plane (slides 3, 6, 7 and 8).

The response is a new velocity, at its instant or within a step, or the force
of a spring.
"""

from solutions.response.bounces import (
    bounce_along_normal,
    bounce_through_step,
    time_until_rest,
)
from solutions.response.bouncing import bounce
from solutions.response.design import design_contact
from solutions.response.hertz import (
    hertz_contact_time,
    hertz_damping,
    hertz_force,
    hertz_largest_depth,
    hertz_restitution,
    hertz_stiffness,
)
from solutions.response.kinematic import kinematic_response
from solutions.response.penalty import (
    penalty_force,
    penalty_rest_depth,
    penalty_step_limit,
)
from solutions.response.penalty_impact import (
    penalty_damping,
    penalty_restitution,
)
from solutions.response.steps import respond_at_impact, respond_at_step
from solutions.response.tangential import tangential_spring

__all__ = [
    "bounce",
    "bounce_along_normal",
    "bounce_through_step",
    "design_contact",
    "hertz_contact_time",
    "hertz_damping",
    "hertz_force",
    "hertz_largest_depth",
    "hertz_restitution",
    "hertz_stiffness",
    "kinematic_response",
    "penalty_damping",
    "penalty_force",
    "penalty_rest_depth",
    "penalty_restitution",
    "penalty_step_limit",
    "respond_at_impact",
    "respond_at_step",
    "tangential_spring",
    "time_until_rest",
]
