"""Gravity, viscosity, springs and wind, and what makes motion of them.

The slides are 23, 25 to 27, 29 and 30.

Gravity (slides 23 and 25)
- `uniform_gravity`: the weight of a body.
- `universal_gravity`: the pull of one body on another.
- `surface_gravity`: the acceleration of free fall at a distance.
- `universal_gravity_energy`: the energy of two bodies that attract each other.
- `mutual_gravity`: the pull on every body of a group.

Springs and dampers (slides 24, 27 and 29)
- `spring_force`, `damper_force`, `spring_damper_force`: on end 1 of a spring.
- `spring_energy`: what is stored in it.
- `natural_frequency`, `damping_ratio`: how a mass on a spring swings.
- `spring_step_limit`: the longest stable steps of both Eulers.
- `damped_oscillator`, `friction_oscillator`, `driven_oscillator`: the exact
  motion of a mass on a spring.

A fluid (slide 26)
- `stokes_drag`: the drag of a slow, thick flow on a ball.
- `buoyancy`: the lift that the slide forgets.
- `terminal_velocity`: of a sphere that falls steadily.
- `relaxation_time`, `drag_motion`: how a body comes to this velocity.
- `sphere_shape_factor`, `spheroid_shape_factors`: drag and shape.
- `reynolds_number`, `check_stokes_regime`: where Stokes' drag ends.
- `drag_correction`, `terminal_velocity_corrected`: what holds beyond.

Wind (slide 30)
- `wind_force`: of a wind on a body.
- `sample_field`: the velocity of the wind at a position.

All forces, and motion (slide 30)
- `total_force`: the sum of all forces on each ball of a scene.
- `explicit_euler`, `semi_implicit_euler`, `velocity_verlet`, `runge_kutta_4`,
  `implicit_euler`: a step.
- `ballistic_motion`: the exact motion under a constant acceleration.
- `evaluate_forces`, `acceleration_of`, `audit_energy`: any forces, by name.

An argument without physical meaning is refused, such as a negative mass or a
viscosity that is not a number. The `ValueError` names the argument and its
value.
"""

from __future__ import annotations

from solutions.forces.accumulator import (
    EnergyAudit,
    Force,
    acceleration_of,
    audit_energy,
    evaluate_forces,
)
from solutions.forces.correlations import LARGEST_REYNOLDS, drag_correction
from solutions.forces.drag import buoyancy, stokes_drag
from solutions.forces.falling import (
    drag_motion,
    relaxation_time,
    terminal_velocity,
    terminal_velocity_corrected,
)
from solutions.forces.gravity import (
    GRAVITATIONAL_CONSTANT,
    STANDARD_GRAVITY,
    mutual_gravity,
    surface_gravity,
    uniform_gravity,
    universal_gravity,
    universal_gravity_energy,
)
from solutions.forces.integrators import (
    ballistic_motion,
    explicit_euler,
    implicit_euler,
    runge_kutta_4,
    semi_implicit_euler,
    velocity_verlet,
)
from solutions.forces.oscillators import (
    damped_oscillator,
    damping_ratio,
    friction_oscillator,
    natural_frequency,
)
from solutions.forces.resonance import driven_oscillator
from solutions.forces.reynolds import (
    STOKES_LIMIT,
    StokesRegimeWarning,
    check_stokes_regime,
    reynolds_number,
)
from solutions.forces.shapes import sphere_shape_factor, spheroid_shape_factors
from solutions.forces.springs import (
    damper_force,
    spring_damper_force,
    spring_energy,
    spring_force,
)
from solutions.forces.stability import spring_step_limit
from solutions.forces.total import total_force
from solutions.forces.wind import sample_field, wind_force

__all__ = [
    "GRAVITATIONAL_CONSTANT",
    "LARGEST_REYNOLDS",
    "STANDARD_GRAVITY",
    "STOKES_LIMIT",
    "EnergyAudit",
    "Force",
    "StokesRegimeWarning",
    "acceleration_of",
    "audit_energy",
    "ballistic_motion",
    "buoyancy",
    "check_stokes_regime",
    "damped_oscillator",
    "damper_force",
    "damping_ratio",
    "drag_correction",
    "drag_motion",
    "driven_oscillator",
    "evaluate_forces",
    "explicit_euler",
    "friction_oscillator",
    "implicit_euler",
    "mutual_gravity",
    "natural_frequency",
    "relaxation_time",
    "reynolds_number",
    "runge_kutta_4",
    "sample_field",
    "semi_implicit_euler",
    "sphere_shape_factor",
    "spheroid_shape_factors",
    "spring_damper_force",
    "spring_energy",
    "spring_force",
    "spring_step_limit",
    "stokes_drag",
    "surface_gravity",
    "terminal_velocity",
    "terminal_velocity_corrected",
    "total_force",
    "uniform_gravity",
    "universal_gravity",
    "universal_gravity_energy",
    "velocity_verlet",
    "wind_force",
]
