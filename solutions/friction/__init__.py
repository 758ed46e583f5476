"""Friction, sticking and sliding (slides 16 and 24).

Dry friction of a body on its support:

- `holds`: whether static friction can hold a body at rest
- `friction_force`: friction on a body that slides, rests or starts to slide
- `sliding_motion`: a step of a body that slides, and where it stops
- `support_force`: the normal force, and what friction has to hold
- `break_away_time`: when a growing force sets a body in motion
- `clamp_to_circle`: the cone of friction
- `clamp_to_square`: the pyramid that many programs use instead
- `roll_step`: a step of a ball that slides until it rolls

Friction during an impact, which the slides leave out:

- `point_inverse_mass`: the matrix from an impulse to a change of velocity
- `friction_impulse`: the impulse by Newton's rule, with grip or slip
- `impact_energy`: the energy that an impulse adds
- `sphere_impact`: a sphere that strikes a plane
- `dissipative_impulse`: the impulse that takes the most energy
- `poisson_impulse`: an impact followed through, with Poisson's restitution
- `stronge_impulse`: an impact followed through, with Stronge's restitution
"""

from solutions.friction.cone import clamp_to_circle, clamp_to_square
from solutions.friction.dry import friction_force, holds, sliding_motion
from solutions.friction.impact import (
    friction_impulse,
    impact_energy,
    point_inverse_mass,
    sphere_impact,
)
from solutions.friction.impact_laws import (
    dissipative_impulse,
    poisson_impulse,
    stronge_impulse,
)
from solutions.friction.rolling import roll_step
from solutions.friction.support import (
    break_away_time,
    support_force,
)

__all__ = [
    "break_away_time",
    "clamp_to_circle",
    "clamp_to_square",
    "dissipative_impulse",
    "friction_force",
    "friction_impulse",
    "holds",
    "impact_energy",
    "point_inverse_mass",
    "poisson_impulse",
    "roll_step",
    "sliding_motion",
    "sphere_impact",
    "stronge_impulse",
    "support_force",
]
