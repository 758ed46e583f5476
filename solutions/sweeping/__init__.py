"""Swept volumes (slide 10): the time at which moving bodies first touch.

Bodies that only fly are reduced to a relative motion, and a ray against a
Minkowski sum. Bodies that turn are swept by conservative advancement.

motion       the motion of one body relative to the other, and a bound on it
rays         a ray against a sphere, a capsule and a box
spheres      two balls, and a ball and a plane
looking      what one look per step misses, and looks that miss nothing
advancement  any two convex bodies that fly and turn
nearest      how far two convex bodies are apart, and along which direction
features     corner against face, and edge against edge, in straight motion
rounds       the loop of conservative advancement, for many pairs at once
"""

from solutions.sweeping.advancement import sweep_convex
from solutions.sweeping.features import edge_edge_impact, vertex_face_impact
from solutions.sweeping.looking import advance, missed_share
from solutions.sweeping.motion import motion_bound, relative_motion, rotated
from solutions.sweeping.nearest import nearest_on_triangle, separation_of_hulls
from solutions.sweeping.rays import ray_box, ray_capsule, ray_sphere
from solutions.sweeping.rounds import UndecidedWarning
from solutions.sweeping.spheres import (
    sweep_sphere_plane,
    sweep_sphere_sphere,
)

__all__ = [
    "UndecidedWarning",
    "advance",
    "edge_edge_impact",
    "missed_share",
    "motion_bound",
    "nearest_on_triangle",
    "ray_box",
    "ray_capsule",
    "ray_sphere",
    "relative_motion",
    "rotated",
    "separation_of_hulls",
    "sweep_convex",
    "sweep_sphere_plane",
    "sweep_sphere_sphere",
    "vertex_face_impact",
]
