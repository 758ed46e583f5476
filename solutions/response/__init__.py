"""Responding to a collision with a plane (slides 3, 6, 7 and 8).

The response is a new velocity, at its instant or within a step, or the force of a
spring.
"""

from solutions.response.bounces import bounce_along_normal, bounce_through_step, time_until_rest
from solutions.response.kinematic import kinematic_response, moving_plane_response
from solutions.response.penalty import penalty_force, penalty_rest_depth, penalty_step_limit
from solutions.response.penalty_impact import penalty_contact_time, penalty_damping, penalty_restitution
from solutions.response.steps import respond_at_impact, respond_at_step

__all__ = [
    "bounce_along_normal",
    "bounce_through_step",
    "kinematic_response",
    "moving_plane_response",
    "penalty_contact_time",
    "penalty_damping",
    "penalty_force",
    "penalty_rest_depth",
    "penalty_restitution",
    "penalty_step_limit",
    "respond_at_impact",
    "respond_at_step",
    "time_until_rest",
]
