"""Bodies fall, collide, slide, roll, stack and rest in one world (slides 3 to 29)."""

from solutions.world.bodies import Bodies, State, Surfaces, make_bodies, make_state
from solutions.world.broad_phase import candidate_pairs
from solutions.world.contacts import Contacts, collect_contacts
from solutions.world.rotation import rotate_by_momentum
from solutions.world.step import Memory, Rules, step_world

__all__ = [
    "Bodies",
    "Contacts",
    "Memory",
    "Rules",
    "State",
    "Surfaces",
    "candidate_pairs",
    "collect_contacts",
    "make_bodies",
    "make_state",
    "rotate_by_momentum",
    "step_world",
]
