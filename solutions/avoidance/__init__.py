"""Avoiding a collision (slide 1): "force fields, steer to avoid, … flocking".

Steering
- `seek`: the velocity wanted by a body that moves towards a target
- `flee`: the velocity wanted by a body that moves away from it
- `arrive`: the velocity wanted by a body that is to stop at it
- `steering_force`: the force that changes a velocity into the wanted one
- `limited`: vectors shortened to a largest length

Fixed obstacles
- `repelling_force`: the force of a field around an obstacle of any shape
- `sphere_force`: the force of this field around a sphere
- `tangent_point`: where a line from a position touches a sphere
- `is_in_the_way`: whether a sphere is in the way to a goal
- `steer_around`: the direction to a goal, or around a sphere before it
- `side_of`: on which side to pass what lies straight ahead

Others that move
- `nearest_approach`: when two spheres are nearest, and how near
- `neighbour_pairs`: who is near whom, found without looking at all pairs
- `separation`: the push away from the neighbours of a flock
- `towards_mean`: its alignment and its cohesion
- `flock_step`: a step of the flock

Crowds, beyond slide 1
- `orca_half_plane`: the velocities with which a disc avoids another
- `cap_of_cone`: the round end of the cone of those that collide
- `permitted_velocity`: the nearest velocity that all half-planes permit
- `crowd_step`: a step of a crowd of discs
"""

from solutions.avoidance.approach import nearest_approach
from solutions.avoidance.cones import cap_of_cone, orca_half_plane
from solutions.avoidance.directions import limited
from solutions.avoidance.fields import repelling_force, sphere_force
from solutions.avoidance.flock import flock_step, separation, towards_mean
from solutions.avoidance.half_planes import permitted_velocity
from solutions.avoidance.neighbours import neighbour_pairs
from solutions.avoidance.obstacles import (
    is_in_the_way,
    side_of,
    steer_around,
    tangent_point,
)
from solutions.avoidance.orca import crowd_step
from solutions.avoidance.steering import arrive, flee, seek, steering_force

__all__ = [
    "arrive",
    "cap_of_cone",
    "crowd_step",
    "flee",
    "flock_step",
    "is_in_the_way",
    "limited",
    "nearest_approach",
    "neighbour_pairs",
    "orca_half_plane",
    "permitted_velocity",
    "repelling_force",
    "seek",
    "separation",
    "side_of",
    "sphere_force",
    "steer_around",
    "steering_force",
    "tangent_point",
    "towards_mean",
]
