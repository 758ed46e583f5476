"""Everything in one world: bodies fall, collide, slide, roll and rest.

What a world is made of:

- `make_bodies`: `Bodies`, with `Surfaces`, which do not change
- `make_state`: the `State`, which each step changes
- `mass_properties`, `in_principal_axes`: centre, moments and axes of a shape

The lab's own world, in the order of its lesson:

- `step_world`: forces, contacts, velocities, positions (slide 3)
- `inverse_inertias`, `rotate_by_momentum`: a body turns freely (slide 18)
- `candidate_pairs`, `manifolds`, `collect_contacts`: where bodies touch
- `contacts_by_pair`, `contact_frames`: contacts of each two bodies, their rows
- `collide_with_friction`: one impact
- `propagate_impacts`, `simultaneous_impacts`: a row of balls (slide 21)
- `inverse_mass_matrix`, `contact_jacobian`: M⁻¹ and J of all contacts
- `resting_problem`: A and b of resting contacts (slide 22)
- `complementarity_residual`: how far forces are from a solution
- `solve_by_sweeps`: projected Gauss–Seidel; it may warn of `NotConverged`
- `solve_by_pivots`: Lemke's method
- `sequential_impulses`: sweeps with Coulomb friction
- `respond`: impacts first, then rest (slides 21 and 22)
- `kept_impulses`: with which impulses a step begins
- `out_of_overlap`: what is deep inside is moved out

The larger world, of many bodies and with all shapes and laws:

- `advance_world`: one step, under `Rules`, with the `Memory` of the last one
- `run_world`: many steps
- `find_contacts`: its `Contacts` (slides 2, 9 and 17)
- `pairs_in_grid`: the broad phase
- `turned`, `turn_freely`: a turn, and a free flight of a turning body
- `spring_forces`: of springs between points of bodies (slide 29)
"""

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
