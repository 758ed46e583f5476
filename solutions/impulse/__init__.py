"""Impulses between two rigid bodies (slides 11 to 21).

`Body` is what an impact needs to know of a body.

The velocities at a contact:

- `rebound_velocity`: u_n⁺ = −e u_n⁻ (slide 12)
- `point_velocity`: of a point that moves with a body (slide 14)
- `relative_velocity`: of A's point of contact as seen from B's (slide 15)
- `normal_velocity`: the rate at which two bodies part (slides 15 and 19)
- `classify_contact`: COLLIDING, RESTING or SEPARATING (slide 21)

The normal of a contact:

- `point_plane_normal`: that of a face (slide 17)
- `edge_edge_normal`: across two edges (slide 17)

Momentum:

- `impulse_of_force`: J = ∫F dt (slide 13)
- `mean_force`: ΔP/Δt less the other forces
- `contact_impulses`: J on A and −J on B (slide 16)
- `apply_impulse_to_momenta`: P += J, L += r × J (slide 21)
- `velocities_from_momenta`: v = P/M, ω = I⁻¹ L (slide 21)

How hard a body is to turn:

- `sphere_inertia`: moments of inertia of a solid ball about its centre
- `box_inertia`: those of a solid box
- `rod_inertia`: those of a thin rod
- `rotation_matrix`: from the axes of the body to those of the world
- `world_inertia`: I(t) of a turned body
- `world_inverse_inertia`: I⁻¹(t) of a turned body (slide 18)
- `mass_and_inertia`: M and I, from 1/M and I⁻¹

The impact:

- `apply_impulse`: the velocities after an impulse (slide 18)
- `impulse_magnitude`: j = −(1 + e) u_n⁻/k (slide 20)
- `inverse_effective_mass`: k (slide 20)
- `collide`: the whole impact (slides 11 and 21)
- `energy_lost`: (1 − e²) u_n⁻²/(2k)
- `audit`: ΔP, ΔL and ΔE of both bodies together (slide 21)
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
