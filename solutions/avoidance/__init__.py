"""Avoiding a collision (slide 1): "force fields, steer to avoid, … flocking".

steering     the force with which a body steers to or from a target
fields       the force of a field around an obstacle
obstacles    a way around a sphere, by its tangent point
approach     when two moving spheres are nearest, and how near
flock        the three rules of a flock, and its step
neighbours   who is near whom, found without looking at all pairs
cones        the half-plane of velocities with which a disc avoids another
half_planes  the velocity nearest to a preferred one that half-planes permit
orca         the step of a crowd of discs
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
