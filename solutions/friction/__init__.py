"""Friction, sticking and sliding (slides 16, 22 and 24).

The package covers dry friction, friction in an impact, and contacts that rest.
"""

from solutions.friction.complementarity import complementarity_residual, solve_by_pivots, solve_by_sweeps
from solutions.friction.cone import clamp_to_circle, clamp_to_square
from solutions.friction.contacts import contact_jacobian, inverse_mass_matrix, resting_problem, sequential_impulses
from solutions.friction.cradle import propagate_impacts, simultaneous_impacts
from solutions.friction.dry import friction_force, holds, sliding_motion
from solutions.friction.impact import (
    friction_impulse,
    impact_energy,
    point_inverse_mass,
    sphere_grips,
    sphere_impact,
    superball_impact,
)
from solutions.friction.impact_laws import dissipative_impulse, poisson_impulse, stronge_impulse
from solutions.friction.support import (
    along_surface,
    apparent_force,
    break_away_time,
    friction_angle,
    normal_force,
    stick_slip_times,
)

__all__ = [
    "along_surface",
    "apparent_force",
    "break_away_time",
    "clamp_to_circle",
    "clamp_to_square",
    "complementarity_residual",
    "contact_jacobian",
    "dissipative_impulse",
    "friction_angle",
    "friction_force",
    "friction_impulse",
    "holds",
    "impact_energy",
    "inverse_mass_matrix",
    "normal_force",
    "point_inverse_mass",
    "poisson_impulse",
    "propagate_impacts",
    "resting_problem",
    "sequential_impulses",
    "simultaneous_impacts",
    "sliding_motion",
    "solve_by_pivots",
    "solve_by_sweeps",
    "sphere_grips",
    "sphere_impact",
    "stick_slip_times",
    "stronge_impulse",
    "superball_impact",
]
