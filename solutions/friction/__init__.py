"""Friction, sticking and sliding (slides 16 and 24).

The package covers dry friction, balls that slide and roll, and friction in an impact.
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
