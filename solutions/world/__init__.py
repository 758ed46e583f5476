"""Everything in one world: bodies fall, collide, slide, roll, stack and rest."""

from solutions.world.bodies import Bodies, State, Surfaces, make_bodies, make_state
from solutions.world.broad_phase import candidate_pairs
from solutions.world.contacts import Contacts, collect_contacts
from solutions.world.forces import spring_forces
from solutions.world.mass import in_principal_axes, mass_properties
from solutions.world.memory import Memory
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
    "in_principal_axes",
    "make_bodies",
    "make_state",
    "mass_properties",
    "rotate_by_momentum",
    "run_world",
    "spring_forces",
    "step_world",
]
