"""Known mistakes of boxes that overlap, and of the contacts of a world."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from solutions.impulse import rotation_matrix
from solutions.world import candidate_pairs, manifolds


def pairs(order=lambda found: found, table=lambda begins: begins & begins.T, axes=slice(None), first=1, begin=None):
    """Pairs of boxes; each part may be another one."""

    def found(low, high):
        low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
        begins = (begin or np.less_equal)(low[:, None, axes], high[None, :, axes])
        return order(np.argwhere(np.triu(table(np.all(begins, axis=-1)), first)))

    return found


def with_a_corner_inside(low, high):
    """Pairs of which one box has its lower or upper corner inside the other."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    inside = np.zeros((len(low), len(low)), dtype=bool)
    for corner in (low, high):
        inside |= np.all((low[:, None] <= corner[None]) & (corner[None] <= high[:, None]), axis=-1)
    return np.argwhere(np.triu(inside | inside.T, 1))


def along_any_axis(low, high):
    """Pairs that overlap along one axis at least."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    both = (low[:, None] <= high[None]) & (low[None] <= high[:, None])
    return np.argwhere(np.triu(np.any(both, axis=-1), 1))


def with_one_strict(low, high):
    """Pairs that overlap, but not those of which the second box begins where the first one ends."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    loose, strict = low[:, None] <= high[None], low[:, None] < high[None]
    return np.argwhere(np.triu(np.all(loose, axis=-1) & np.all(strict, axis=-1).T, 1))


def finite_alone(low, high):
    """Pairs of boxes that have an end."""
    found = candidate_pairs(low, high)
    whole = np.isfinite(np.asarray(low, dtype=float)).all(axis=-1)
    return found[np.all(whole[found], axis=-1)]


def without_the_last(low, high):
    """The second loop ends one too early."""
    found = candidate_pairs(low, high)
    return found[found[:, 1] < len(low) - 1]


def both_ways(low, high):
    """Each pair twice."""
    found = candidate_pairs(low, high)
    twice = np.concatenate([found, found[:, ::-1]])
    return twice[np.lexsort((twice[:, 1], twice[:, 0]))]


def of_a_box(rotation, size):
    return np.matvec(np.abs(rotation), size)


def contacts(
    bodies,
    state,
    margin,
    kept=lambda meet, i, j: meet[i, j],
    moved=lambda share, i, j: share[i] + share[j] > 0,
    box=of_a_box,
    ball=lambda size: size[:, :1],
    plane=lambda size: np.inf,
    widened=lambda margin: margin / 2,
    looks=lambda margin: margin,
    told=lambda found: found,
    order=(0, 1),
):
    """Boxes around bodies, pairs, places; each part may be another one."""
    share, *_, meet, kind, size = bodies
    wide = box(rotation_matrix(state[1]), size)
    reach = np.where(kind[:, None] == 0, ball(size), np.where(kind[:, None] == 1, wide, plane(size)))
    reach = np.maximum(reach + widened(margin), 0)
    i, j = candidate_pairs(state[0] - reach, state[0] + reach).T
    pairs = np.stack([i, j], axis=-1)[moved(share, i, j) & kept(meet, i, j)]
    return told(manifolds(bodies, state, pairs[:, order], looks(margin)))


def with_(**parts):
    return lambda bodies, state, margin: contacts(bodies, state, margin, **parts)


def turned_round(found):
    a, b, point, normal, gap, key = found
    return b, a, point, -normal, gap, key


def on_a(found):
    a, b, point, normal, gap, key = found
    return a, b, point - normal * gap[:, None] / 2, normal, gap, key


def first_place(found):
    """The first place of each two bodies."""
    pairs = np.stack(found[:2], axis=-1)
    first = [k for k in range(len(pairs)) if k == 0 or np.any(pairs[k] != pairs[k - 1])]
    return tuple(part[first] for part in found)


# fmt: off
BANK = (
    M("candidate_pairs", "the larger first", pairs(lambda found: found[:, ::-1]),
      "The larger number comes first in each pair.",
      "Which of the two numbers should come first?"),
    M("candidate_pairs", "by the second",
      pairs(lambda found: found[np.lexsort((found[:, 0], found[:, 1]))]),
      "The pairs are sorted by their second number.",
      "Which of (0, 5) and (1, 2) comes first?"),
    M("candidate_pairs", "from the last", pairs(lambda found: found[::-1]),
      "The pairs come in descending order.",
      "Which pair should come first?"),
    M("candidate_pairs", "numbered from one", pairs(lambda found: found + 1),
      "The boxes are numbered from 1.",
      "Which number has the first box?"),
    M("candidate_pairs", "touching left out", pairs(begin=np.less),
      "Boxes that only touch are left out: < stands in place of ≤.",
      "One box ends at x = 2, and another begins there. Do they overlap, as the description has it?"),
    M("candidate_pairs", "touching left out one way", with_one_strict,
      "One of the two comparisons has < in place of ≤: of boxes that only touch, some are left out.",
      "One box ends at x = 2, and another begins there. Do both of your comparisons say that they overlap?"),
    M("candidate_pairs", "along any axis", along_any_axis,
      "It is enough for it that two boxes overlap along one axis. They have to along all three.",
      "Two boxes are side by side on the floor, 3 m apart. Along which axes do they overlap?"),
    M("candidate_pairs", "z forgotten", pairs(axes=slice(2)),
      "Only x and y are compared: a box high above another one counts as a pair.",
      "How many axes have to agree?"),
    M("candidate_pairs", "one condition of two", pairs(table=lambda begins: begins),
      "Only one of the two conditions is asked: the first box begins before the second one ends.",
      "Two intervals: which other comparison do you need, so that neither is beyond the other?"),
    M("candidate_pairs", "each pair twice", both_ways,
      "Each pair comes in both orders.",
      "How often should a pair of boxes be in the list?"),
    M("candidate_pairs", "each with itself", pairs(first=0),
      "Each box counts as a pair with itself.",
      "May both numbers of a pair be the same?"),
    M("candidate_pairs", "neighbours left out", pairs(first=2),
      "Boxes that follow one another in the list are never a pair.",
      "With two boxes, how many pairs does your function look at?"),
    M("candidate_pairs", "the last box left out", without_the_last,
      "The last box is never the second one of a pair: a loop ends one too early.",
      "With two boxes, how many pairs does your function look at?"),
    M("candidate_pairs", "a corner inside", with_a_corner_inside,
      "It asks whether a corner of one box is inside the other. Two boxes that cross have none.",
      "Lay two rods across each other. Where are their corners?"),
    M("candidate_pairs", "no pair without an end", finite_alone,
      "Boxes without an end are in no pair: nothing would ever touch the floor.",
      "A box without an end has infinite corners, and no middle. Are your comparisons still true with them?"),
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
    M("collect_contacts", "margin forgotten in the boxes", with_(widened=lambda margin: 0.0),
      "The boxes are not widened: bodies whose gap is less than the margin are not found.",
      "Two balls are 1 mm apart, and the margin is 2 mm. Do your boxes overlap?"),
    M("collect_contacts", "boxes made smaller", with_(widened=lambda margin: -margin / 2),
      "Half the margin is subtracted from the boxes: they have to become larger by it.",
      "Should bodies with a gap between them be found, or missed?"),
    M("collect_contacts", "margin left out of the places", with_(looks=lambda margin: 0.0),
      "`manifolds` gets no margin: bodies that are near each other without touching have no contact.",
      "Which of the given functions wants to know the margin?"),
    M("collect_contacts", "half the margin for the places", with_(looks=lambda margin: margin / 2),
      "`manifolds` gets half the margin. Half of it is for the boxes, of which there are two at each gap.",
      "Up to which gap should two bodies be in touch?"),
    M("collect_contacts", "boxes not turned", with_(box=lambda rotation, size: size),
      "The boxes around boxes have the half extents, however these lie.",
      "A rod along x has been turned until it stands upright. How far does it reach along z?"),
    M("collect_contacts", "turned the other way", with_(box=lambda rotation, size: np.vecmat(size, np.abs(rotation))),
      "Rᵀ stands in place of R: the body would have to be turned the other way.",
      "Which row of R has the x components of the body's three axes?"),
    M("collect_contacts", "size of R h", with_(box=lambda rotation, size: np.abs(np.matvec(rotation, size))),
      "R h is one corner of the box, and another one may reach farther: the terms have to be made positive one by one.",
      "A box has eight corners. Which of them reaches farthest along x?"),
    M("collect_contacts", "a ball along x alone", with_(ball=lambda size: size),
      "The ball reaches as far as its radius along x, and not at all along y and z.",
      "What are the second and the third number of a ball's size?"),
    M("collect_contacts", "planes with an end", with_(plane=lambda size: size),
      "The box around a half-space is as large as its normal. A half-space has no end.",
      "A ball lies on the floor 5 m away from the floor's own place. Do your two boxes overlap?"),
    M("collect_contacts", "floors alone", with_(plane=lambda size: np.array([np.inf, np.inf, 0.0])),
      "A half-space has no end along x and y, and no height: right for a level floor, and for nothing else.",
      "How far does a wall reach along z? And how far down does the floor reach?"),
    M("collect_contacts", "only what moves", with_(moved=lambda share, i, j: (share[i] > 0) & (share[j] > 0)),
      "A pair is left out if one of its bodies is immovable: nothing would ever touch the floor.",
      "Which pairs cannot be moved by any impulse?"),
    M("collect_contacts", "the immovable too", with_(moved=lambda share, i, j: np.ones(len(i), dtype=bool)),
      "Pairs of two immovable bodies are kept.",
      "What would an impulse between a wall and the floor do?"),
    M("collect_contacts", "meet ignored", with_(kept=lambda meet, i, j: np.ones(len(i), dtype=bool)),
      "Bodies that do not meet have contacts all the same.",
      "Which part of `bodies` makes no difference to your answer?"),
    M("collect_contacts", "each with itself", with_(kept=lambda meet, i, j: meet[i, i] & meet[j, j]),
      "A pair is kept if each of its bodies meets itself: `meet` is asked about i and i, and about j and j.",
      "Which entry of the table says whether bodies i and j meet?"),
    M("collect_contacts", "one place a pair", with_(told=first_place),
      "Only the first place of each two bodies is kept: a box would stand on one corner.",
      "At how many places does a box touch the floor on which it stands?"),
    M("collect_contacts", "longest reach", with_(box=lambda rotation, size: np.max(size, axis=-1, keepdims=True)),
      "A box reaches as far as its longest half extent along every axis; its corners may reach farther.",
      "A cube stands on one corner. How high is its middle above the floor?"),
    M("collect_contacts", "shortest reach", with_(box=lambda rotation, size: np.min(size, axis=-1, keepdims=True)),
      "A box reaches as far as its shortest half extent along every axis.",
      "A rod lies along x. How far does it reach along x?"),
)
# fmt: on
