"""Swept volumes (slide 10).

Bodies that move without turning are reduced to a relative motion and a ray
against a Minkowski sum. Bodies that turn are swept by conservative
advancement.
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
