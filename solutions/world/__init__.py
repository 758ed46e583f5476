"""Everything in one world: bodies fall, collide, slide, roll, stack and rest."""

from solutions.world.bodies import (
    Bodies,
    State,
    Surfaces,
    make_bodies,
    make_state,
)
from solutions.world.broad_phase import pairs_in_grid
from solutions.world.complementarity import (
    NotConverged,
    complementarity_residual,
    solve_by_pivots,
    solve_by_sweeps,
)
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.cradle import propagate_impacts, simultaneous_impacts
from solutions.world.forces import spring_forces
from solutions.world.mass import in_principal_axes, mass_properties
from solutions.world.memory import Memory
from solutions.world.resting import (
    contact_jacobian,
    inverse_mass_matrix,
    resting_problem,
    sequential_impulses,
)
from solutions.world.rotation import turn_freely, turned
from solutions.world.rules import Rules
from solutions.world.run import run_world
from solutions.world.simple_contacts import (
    candidate_pairs,
    collect_contacts,
    manifolds,
)
from solutions.world.simple_response import (
    collide_with_friction,
    contact_frames,
    contacts_by_pair,
    kept_impulses,
    out_of_overlap,
    respond,
)
from solutions.world.simple_step import step_world
from solutions.world.simple_turning import inverse_inertias, rotate_by_momentum
from solutions.world.step import advance_world

__all__ = [
    "Bodies",
    "Contacts",
    "Memory",
    "NotConverged",
    "Rules",
    "State",
    "Surfaces",
    "advance_world",
    "candidate_pairs",
    "collect_contacts",
    "collide_with_friction",
    "complementarity_residual",
    "contact_frames",
    "contact_jacobian",
    "contacts_by_pair",
    "find_contacts",
    "in_principal_axes",
    "inverse_inertias",
    "inverse_mass_matrix",
    "kept_impulses",
    "make_bodies",
    "make_state",
    "manifolds",
    "mass_properties",
    "out_of_overlap",
    "pairs_in_grid",
    "propagate_impacts",
    "respond",
    "resting_problem",
    "rotate_by_momentum",
    "run_world",
    "sequential_impulses",
    "simultaneous_impacts",
    "solve_by_pivots",
    "solve_by_sweeps",
    "spring_forces",
    "step_world",
    "turn_freely",
    "turned",
]
