"""Swept volumes (slide 10): the time at which moving bodies first touch.

Bodies that only fly are reduced to a relative motion, and a ray against a
Minkowski sum. Bodies that turn are swept by conservative advancement.

The motion of one body relative to the other:

- `relative_motion`: of A as seen from B
- `rotated`: a vector after a turn about an axis
- `motion_bound`: the fastest that any point of a body moves along a direction

Bodies that only fly:

- `ray_sphere`: when a ray meets a sphere
- `ray_capsule`: when a ray meets a capsule
- `ray_box`: from when to when a ray is in a box
- `sweep_sphere_sphere`: when two balls first touch
- `sweep_sphere_plane`: when a ball first touches a plane

Looks that miss a contact, and looks that miss nothing:

- `missed_share`: the share of the collisions that one look per step misses
- `advance`: when a hull that moves and turns first touches one that rests

Bodies that turn:

- `nearest_on_triangle`: the point of a triangle nearest to a given point
- `separation_of_hulls`: how far two bodies are apart, and in which direction
- `sweep_convex`: when any two convex bodies first touch
- `UndecidedWarning`: given where the looks were too few to decide

Corners, edges and faces in straight motion:

- `vertex_face_impact`: when a corner meets a face
- `edge_edge_impact`: when two edges meet
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
