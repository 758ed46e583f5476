"""Known mistakes about the contacts of a world.

A mistake that loses contacts or finds too many gives results of another length, which say nothing else of it.
"""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from solutions.impulse import rotation_matrix
from solutions.world import candidate_pairs, manifolds


def contacts(bodies, state, margin, kept=lambda meet, i, j: meet[i, j], told=lambda found: found, order=(0, 1)):
    """Boxes around bodies, pairs, places; each part may be another one."""
    share, *_, meet, kind, size = bodies
    wide = np.matvec(np.abs(rotation_matrix(state[1])), size)
    reach = np.where(kind[:, None] == 0, size[:, :1], np.where(kind[:, None] == 1, wide, np.inf)) + margin / 2
    i, j = candidate_pairs(state[0] - reach, state[0] + reach).T
    pairs = np.stack([i, j], axis=-1)[(share[i] + share[j] > 0) & kept(meet, i, j)]
    return told(manifolds(bodies, state, pairs[:, order], margin))


def with_(**parts):
    return lambda bodies, state, margin: contacts(bodies, state, margin, **parts)


def turned_round(found):
    a, b, point, normal, gap, key = found
    return b, a, point, -normal, gap, key


def on_a(found):
    a, b, point, normal, gap, key = found
    return a, b, point - normal * gap[:, None] / 2, normal, gap, key


# fmt: off
BANK = (
    M("collect_contacts", "those that do not meet",
      with_(kept=lambda meet, i, j: ~meet[i, j]),
      "Only bodies that do not meet are looked at.",
      "What does `meet[i, j]` say of two bodies?"),
    M("collect_contacts", "A and B turned round", with_(told=turned_round),
      "A and B have changed places. The lower kind is A, and the normal points to it.",
      "Which body should the normal point to?"),
    M("collect_contacts", "the larger number first", with_(order=(1, 0)),
      "The larger number comes first in each pair. Of two balls or two boxes, A and B have changed places.",
      "In which order does `candidate_pairs` give the two numbers of a pair?"),
    M("collect_contacts", "places on one surface", with_(told=on_a),
      "The places are on the surface of A and not halfway between the two.",
      "What does the given function return for the places?"),
)
# fmt: on
