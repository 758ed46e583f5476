"""Avoiding a collision: fields, steering, flocks and crowds (slide 1)."""

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
