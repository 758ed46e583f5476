"""Forces, and the motion that they cause (slides 23 to 27, 29 and 30).

Gravity
- `uniform_gravity`: the weight of a body (slide 25)
- `universal_gravity`: the pull of one body on another (slide 25)
- `surface_gravity`: the free fall at a distance from a body (slide 25)
- `universal_gravity_energy`: the energy of two bodies that attract each other
- `mutual_gravity`: the pull on every body of a group

Springs and dampers
- `spring_force`: the force of a spring on its end 1 (slide 27)
- `damper_force`: the force of a damper on its end 1 (slide 29)
- `spring_damper_force`: the force of both, side by side (slide 29)
- `spring_energy`: the energy that a spring stores
- `spring_step_limit`: the longest stable steps of both Eulers
- `natural_frequency`: how fast a mass on a spring swings
- `damping_ratio`: how much of the critical damping there is
- `damped_oscillator`: the exact motion with a damper
- `friction_oscillator`: the exact motion with dry friction
- `driven_oscillator`: the exact motion under a periodic force

A fluid
- `stokes_drag`: the drag of a slow, thick flow on a ball (slide 26)
- `buoyancy`: the lift that the slide leaves out (slide 26)
- `terminal_velocity`: how fast a sphere falls steadily (slide 26)
- `relaxation_time`: how long a body takes to reach that velocity
- `drag_motion`: the exact motion until then
- `sphere_shape_factor`: the K of a sphere (slide 26)
- `spheroid_shape_factors`: the K of longer and flatter bodies
- `reynolds_number`: how far inertia outweighs viscosity
- `check_stokes_regime`: a warning where Stokes' drag ends
- `drag_correction`: the true drag over Stokes' drag
- `terminal_velocity_corrected`: how fast a sphere falls by its true drag

Wind
- `wind_force`: the force of a wind on a fast body (slide 30)
- `sample_field`: the velocity of the wind at a position (slide 30)

All forces
- `total_force`: the sum of all forces on each ball of a scene (slide 30)
- `evaluate_forces`: forces of any kind on every body, by name (slide 30)
- `acceleration_of`: the acceleration that they cause (slide 30)
- `audit_energy`: the energy that each of them brings in

Motion
- `explicit_euler`: a step that takes all at its start
- `semi_implicit_euler`: a step that moves with the new velocity
- `velocity_verlet`: a step of second order
- `runge_kutta_4`: a step of fourth order
- `implicit_euler`: a step that takes all at its end
- `ballistic_motion`: the exact motion under a constant acceleration

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
