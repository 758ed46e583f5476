"""Loose readings of the slide about polyhedra: distances for heights, one look for all, and what lies within."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import formulas_of
from solutions.polyhedra import orient2d, segment_meets_triangle

PLANES, SEGMENTS, INSIDE, SOLIDS = map(
    formulas_of, ("polyhedra", "polyhedra_segments", "polyhedra_inside", "polyhedra_solids")
)
FAR = np.array([3.713, 5.279, 7.639])
"""A way of 10 m, along no axis."""


def nearest_corner(p, v, f):
    """Outside, the distance from the nearest corner instead of the height above a plane."""
    s, face = PLANES.separation()(p, v, f)
    away = np.linalg.norm(np.asarray(p, dtype=float)[..., None, :] - np.asarray(v)[np.unique(f)], axis=-1)
    return np.where(s > 0, away.min(axis=-1), s), face


def nearest_middle(p, v, f):
    """The height above the face whose middle is nearest."""
    away = np.asarray(p, dtype=float)[..., None, :] - np.asarray(v)[f].mean(axis=1)
    return PLANES.taken(PLANES.heights(p, v, f), np.argmin(np.linalg.norm(away, axis=-1), axis=-1))


def seen_from_above(start, end, triangle):
    """An upright triangle has no area seen from above, and is missed."""
    corners = np.asarray(triangle, dtype=float)
    a, b, c = (corners[..., k, :] for k in range(3))
    t, w = SEGMENTS.solved(start, end, triangle)
    hit = SEGMENTS.both(t, w) & (np.cross(b - a, c - a)[..., 2] != 0)
    return np.where(hit, t, np.inf), np.where(hit[..., None], w, np.nan)


def ten_metres_far(p, v, f):
    p = np.asarray(p, dtype=float)[..., None, :]
    return np.sum(segment_meets_triangle(p, p + FAR, np.asarray(v)[f]), axis=-1) % 2 == 1


def moved_turns(p, v, f, twice=True):
    """Sides of the edges, of a point moved by tiny steps along x and y, or along x alone; and the side of the face."""
    _, side = INSIDE.flat_and_side(p, v, f)
    p, corners = np.asarray(p, dtype=float)[..., None, :], np.asarray(v)[f]
    turns = []
    for s, e in ((0, 1), (1, 2), (2, 0)):
        start, end = corners[:, s], corners[:, e]
        turn = orient2d(start[:, :2], end[:, :2], p[..., :2])
        turn = np.where(turn == 0, np.sign(start[:, 1] - end[:, 1]), turn)
        turns.append(np.where((turn == 0) & twice, np.sign(end[:, 0] - start[:, 0]), turn))
    return np.stack(turns), side


def between_two(p, v, f):
    turns, side = moved_turns(p, v, f)
    on, up = INSIDE.strictly_within(turns), INSIDE.ahead(turns, side)
    return np.any(on & up, axis=-1) & np.any(on & ~up, axis=-1)


def moved_along_x(p, v, f):
    turns, side = moved_turns(p, v, f, twice=False)
    return np.sum(INSIDE.strictly_within(turns) & INSIDE.ahead(turns, side), axis=-1) % 2 == 1


def first_corner(a):
    return a[0][a[1][0, 0]]


def in_box(a, b):
    """All corners of A are in the box around B."""
    if not len(a[1]) or not len(b[1]):
        return False
    these, those = a[0][np.unique(a[1])], b[0][np.unique(b[1])]
    return bool(np.all((these >= those.min(axis=0)) & (these <= those.max(axis=0))))


of_two, turned, edges_through, corners_inside = (
    getattr(SOLIDS, name) for name in ("of_two", "turned", "edges_through", "corners_inside")
)
one_corner = SOLIDS.inside_with(of=first_corner)

# fmt: off
BANK = (
    M("face_planes", "distance for offset", PLANES.other_offset(lambda v, f: -np.abs(PLANES.right(v, f)[1])),
      "The offset is minus the distance of the plane from the origin, as if the origin were always behind the plane.",
      "Move a cube 10 m along x. Before which of its faces is the origin now, and which sign has n·p + d there?"),
    M("face_planes", "one length for all", PLANES.plane_with(lambda n, v, f: n / np.linalg.norm(n)),
      "All normals are divided by one number, the size of all their components together. Each has its own length.",
      "Over which axis of the array do you add up the squares? How long is each of your normals?"),
    M("convex_separation", "nothing outside", PLANES.separation(value=lambda s: np.minimum(s, 0)),
      "Outside, the separation is zero. It should say how far the point is in front of the solid.",
      "How does your answer tell a point on the surface from one that is 1 m away?"),
    M("convex_separation", "nearest corner", nearest_corner,
      "Outside it gives the distance from the nearest corner. The separation is the height above the plane of a face.",
      "A point is 1 m before the middle of a large wall. How far is it from the corners of the house?"),
    M("convex_separation", "nearest middle", nearest_middle,
      "The face that decides is said to be the one whose middle is nearest. A long wall may be close although its"
      " middle is far away.",
      "You stand close to the end of a long wall. Which middle is nearest: that of this wall or of the gable?"),
    M("segment_triangle", "weights of the wrong corners", SEGMENTS.meeting(
        SEGMENTS.both, lambda t, w, p, q: (t, np.roll(w, 1, axis=-1))),
      "Each weight is given to a corner next to it. The small triangle between the point and a side belongs to the"
      " corner opposite that side.",
      "The point is at the corner a. Which of the three small triangles has all the area then?"),
    M("segment_triangle", "seen from above alone", seen_from_above,
      "The areas are those seen from above. An upright triangle has none from there, and seems never to be met.",
      "How large does an upright wall look from straight above? From which side is it best seen?"),
    M("inside_by_parity", "far away is near", ten_metres_far,
      "The ray ends after a certain way, as if everything were outside of the solid by then. A large solid goes on.",
      "Let all lengths be in millimetres, so that the numbers are a thousand times larger. Where does your ray end?"),
    M("inside_by_parity", "between two faces", between_two,
      "A point with a face above it and a face below it counts as inside. That also holds between two solids, and in a"
      " hollow.",
      "You stand on the ground floor of a house without an inside: two slabs, one below you and one above. Are you in"
      " one of them?"),
    M("inside_by_parity", "moved along x alone", moved_along_x,
      "The start of the ray is moved a tiny step along x, off the edges that it would meet. An edge along x is met all"
      " the same.",
      "Which edges does a ray still meet if you move it along x?"),
    M("polyhedra_intersect", "from A alone", of_two(edges_through, corners_inside),
      "Only edges and corners of A are looked at. B may push an edge through A, or lie within it.",
      "Exchange A and B. Does the answer change?"),
    M("polyhedra_intersect", "one corner of each", of_two(edges_through, turned(edges_through), one_corner,
                                                          turned(one_corner)),
      "One corner of each solid is asked whether it lies within the other. A solid may consist of several parts, and"
      " only one of them may lie within.",
      "Two dice are one solid A, and the second of them lies in the box B. Which corner do you look at?"),
    M("polyhedra_intersect", "within the box around it", of_two(edges_through, turned(edges_through), in_box,
                                                                turned(in_box)),
      "A solid that lies in the box around the other counts as within it. The other one may be hollow, or be bent round"
      " it.",
      "A ball lies in a cup. Is it in the box around the cup? And in the cup's material?"),
)
# fmt: on
