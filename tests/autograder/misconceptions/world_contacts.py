"""Known mistakes about the contacts of a world."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from solutions.impulse import rotation_matrix
from solutions.world import candidate_pairs, manifolds


def by_kind(kind, ball, box, plane):
    return np.where(kind[:, None] == 0, ball, np.where(kind[:, None] == 1, box, plane))


def contacts(
    bodies,
    state,
    margin,
    ball=lambda size: size[:, :1],
    box=lambda rotation, size: np.matvec(np.abs(rotation), size),
    plane=np.inf,
    wider=lambda margin: margin / 2,
    kept=lambda share, meet, i, j: (share[i] + share[j] > 0) & meet[i, j],
    near=lambda margin: margin,
    told=lambda found: found,
):
    """Boxes around bodies, pairs, places; each part may be another one."""
    share, *_, meet, kind, size = bodies
    reach = by_kind(kind, ball(size), box(rotation_matrix(state[1]), size), plane) + wider(margin)
    pairs = candidate_pairs(state[0] - reach, state[0] + reach)
    return told(manifolds(bodies, state, pairs[kept(share, meet, pairs[:, 0], pairs[:, 1])], near(margin)))


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
    M("collect_contacts", "boxes not turned", with_(box=lambda rotation, size: size),
      "A box reaches as far as its half extents, however it is turned.",
      "A plank of 6 m is turned upright. How far does it reach upwards?"),
    M("collect_contacts", "sizes forgotten", with_(box=lambda rotation, size: np.matvec(rotation, size)),
      "R h is one corner of the box, and not the farthest along each axis: it may even be negative.",
      "Which corner of the box reaches farthest along x? Which signs has it?"),
    M("collect_contacts", "R for its transpose",
      with_(box=lambda rotation, size: np.matvec(np.abs(rotation.mT), size)),
      "R and Rᵀ have changed places: the rows of R are what counts along the axes of the world.",
      "The first column of R is the box's own x axis. Where in R are the parts of all three that lie along the world's x?"),
    M("collect_contacts", "no margin around the boxes", with_(wider=lambda margin: 0.0),
      "The boxes are not widened: two bodies with a gap within the margin are not found where it lies along an axis.",
      "Two balls are 10 cm apart along x, and the margin is 12 cm. Do their boxes overlap?"),
    M("collect_contacts", "half the margin", with_(wider=lambda margin: margin / 4),
      "The boxes are widened by too little: the gap may be as wide as the whole margin.",
      "How much wider must each of two boxes be so that they overlap at a gap of one margin?"),
    M("collect_contacts", "margin at the surfaces forgotten", with_(near=lambda margin: 0.0),
      "The given function is asked for overlaps alone.",
      "Up to which gap do two surfaces count as touching?"),
    M("collect_contacts", "planes without a width", with_(plane=0.0),
      "A half-space is a point in your list of boxes. It has no end.",
      "Where does a floor end?"),
    M("collect_contacts", "planes of one metre", with_(plane=1.0),
      "A half-space reaches one metre, as its normal does. It has no end.",
      "Where does a floor end?"),
    M("collect_contacts", "balls as wide as a point", with_(ball=lambda size: 0 * size),
      "A ball has no width in your list of boxes.",
      "How far does a ball reach along each axis?"),
    M("collect_contacts", "a ball's size as a box", with_(ball=lambda size: size),
      "The size of a ball is (r, 0, 0): it reaches r along all axes, not along x alone.",
      "How far does a ball reach along y?"),
    M("collect_contacts", "immovable pairs kept", with_(kept=lambda share, meet, i, j: meet[i, j]),
      "Two immovable bodies get contacts; no impulse can move either of them.",
      "What would an impulse between two walls do?"),
    M("collect_contacts", "immovable bodies left out",
      with_(kept=lambda share, meet, i, j: (share[i] > 0) & (share[j] > 0) & meet[i, j]),
      "Pairs with one immovable body are left out: nothing ever touches the floor.",
      "Can an impulse move a ball that lies on the floor?"),
    M("collect_contacts", "all of them meet", with_(kept=lambda share, meet, i, j: share[i] + share[j] > 0),
      "Bodies that do not meet collide all the same.",
      "Which part of `bodies` makes no difference to your answer?"),
    M("collect_contacts", "those that do not meet",
      with_(kept=lambda share, meet, i, j: (share[i] + share[j] > 0) & ~meet[i, j]),
      "Only bodies that do not meet are looked at.",
      "What does `meet[i, j]` say of two bodies?"),
    M("collect_contacts", "A and B turned round", with_(told=turned_round),
      "A and B have changed places. The lower kind is A, and the normal points to it.",
      "Which body should the normal point to?"),
    M("collect_contacts", "places on one surface", with_(told=on_a),
      "The places are on the surface of A and not halfway between the two.",
      "What does the given function return for the places?"),
)
# fmt: on
