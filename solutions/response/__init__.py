"""Responding to a collision with a plane (slides 3, 6, 7 and 8).

A new velocity:

- `kinematic_response`: the velocity after a collision
- `respond_at_impact`: a step that backs up to its collision
- `respond_at_step`: a step that looks for a collision at its start
- `bounce`: a ball over many such steps
- `time_until_rest`: when a bouncing body lies on the plane for good
- `bounce_along_normal`: all bounces within a step, along the normal
- `bounce_through_step`: the same in space

The force of a spring and a dashpot:

- `penalty_force`: the force
- `penalty_rest_depth`: how deep the floor gives way to a weight
- `penalty_step_limit`: the longest timestep that is stable
- `penalty_restitution`: how much speed an impact leaves
- `penalty_damping`: the damping for a given restitution
- `design_contact`: stiffness, damping and timestep for a given task

Beyond the slides:

- `hertz_force`: the force of two elastic spheres
- `hertz_stiffness`: its stiffness, from radii and moduli
- `hertz_largest_depth`: how deep an impact goes
- `hertz_contact_time`: how long an impact lasts
- `hertz_restitution`: how much speed an impact leaves
- `hertz_damping`: the damping for a given restitution
- `tangential_spring`: friction of a penalty contact
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
