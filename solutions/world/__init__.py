"""Everything in one world: bodies fall, collide, slide, roll, stack and rest."""

from solutions.world.bodies import Bodies, State, Surfaces, make_bodies, make_state
from solutions.world.broad_phase import candidate_pairs
from solutions.world.complementarity import complementarity_residual, solve_by_pivots, solve_by_sweeps
from solutions.world.contacts import Contacts, collect_contacts
from solutions.world.cradle import propagate_impacts, simultaneous_impacts
from solutions.world.forces import spring_forces
from solutions.world.mass import in_principal_axes, mass_properties
from solutions.world.memory import Memory
from solutions.world.resting import contact_jacobian, inverse_mass_matrix, resting_problem, sequential_impulses
from solutions.world.rotation import rotate_by_momentum
from solutions.world.rules import Rules
from solutions.world.run import run_world
from solutions.world.step import step_world

__all__ = [
    "Bodies",
    "Contacts",
    "Memory",
    "Rules",
    "State",
    "Surfaces",
    "candidate_pairs",
    "collect_contacts",
    "complementarity_residual",
    "contact_jacobian",
    "in_principal_axes",
    "inverse_mass_matrix",
    "make_bodies",
    "make_state",
    "mass_properties",
    "propagate_impacts",
    "resting_problem",
    "rotate_by_momentum",
    "run_world",
    "sequential_impulses",
    "simultaneous_impacts",
    "solve_by_pivots",
    "solve_by_sweeps",
    "spring_forces",
    "step_world",
]
