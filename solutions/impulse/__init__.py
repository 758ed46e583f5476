"""Impulses between two rigid bodies (slides 11 to 21).

The package goes from the velocity of a point to an impact in space.
"""

from solutions.impulse.auditing import audit
from solutions.impulse.body import Body
from solutions.impulse.impact import (
    apply_impulse,
    collide,
    energy_lost,
    impulse_magnitude,
    inverse_effective_mass,
)
from solutions.impulse.inertia import (
    box_inertia,
    mass_and_inertia,
    rod_inertia,
    rotation_matrix,
    sphere_inertia,
    world_inertia,
    world_inverse_inertia,
)
from solutions.impulse.momentum import (
    apply_impulse_to_momenta,
    contact_impulses,
    impulse_of_force,
    mean_force,
    velocities_from_momenta,
)
from solutions.impulse.normals import edge_edge_normal, point_plane_normal
from solutions.impulse.points import (
    COLLIDING,
    RESTING,
    SEPARATING,
    classify_contact,
    normal_velocity,
    point_velocity,
    rebound_velocity,
    relative_velocity,
)

__all__ = [
    "COLLIDING",
    "RESTING",
    "SEPARATING",
    "Body",
    "apply_impulse",
    "apply_impulse_to_momenta",
    "audit",
    "box_inertia",
    "classify_contact",
    "collide",
    "contact_impulses",
    "edge_edge_normal",
    "energy_lost",
    "impulse_magnitude",
    "impulse_of_force",
    "inverse_effective_mass",
    "mass_and_inertia",
    "mean_force",
    "normal_velocity",
    "point_plane_normal",
    "point_velocity",
    "rebound_velocity",
    "relative_velocity",
    "rod_inertia",
    "rotation_matrix",
    "sphere_inertia",
    "velocities_from_momenta",
    "world_inertia",
    "world_inverse_inertia",
]
