"""Known mistakes about the planes of a polyhedron's faces and a point's heights above them."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M


def corners(v, f):
    return np.moveaxis(np.asarray(v)[f], 1, 0)


def long_normal(v, f):
    """(b − a)×(c − a), as long as twice the area."""
    a, b, c = corners(v, f)
    return np.cross(b - a, c - a)


def length(n):
    return np.linalg.norm(n, axis=-1, keepdims=True)


def plane(n, v, f):
    return n, -np.sum(n * corners(v, f)[0], axis=-1)


def right(v, f):
    n = long_normal(v, f)
    return plane(n / length(n), v, f)


def plane_with(normal):
    """The plane with another normal, made from the long one."""
    return lambda v, f: plane(normal(long_normal(v, f), v, f), v, f)


def unit(n):
    return n / length(n)


def over_more(n):
    """Divided by the length and a tiny area, against division by zero."""
    return n / (length(n) + 1e-12)


def away_from(place):
    """Turned so that the normal points away from a place of the solid."""

    def turned(n, v, f):
        side = np.sum(n * (corners(v, f)[0] - place(v, f)), axis=-1, keepdims=True)
        return unit(n) * np.where(side < 0, -1, 1)

    return turned


def without_difference(v, f):
    a, b, _ = corners(v, f)
    n = np.cross(a, b)
    return plane(n / np.where(length(n) > 0, length(n), 1.0), v, f)


def other_offset(offset):
    return lambda v, f: (right(v, f)[0], offset(v, f))


# Separation


def heights(p, v, f, planes=right):
    n, d = planes(v, f)
    return np.asarray(p) @ n.T + d


def taken(h, face):
    return np.take_along_axis(h, face[..., None], axis=-1)[..., 0], face


def separation(face_of=lambda h: np.argmax(h, axis=-1), planes=right, value=lambda s: s, number=lambda face: face):
    def found(p, v, f):
        s, face = taken(heights(p, v, f, planes), face_of(heights(p, v, f, planes)))
        return value(s), number(face)

    return found


def first_in_front(h):
    return np.where(np.any(h > 0, axis=-1), np.argmax(h > 0, axis=-1), np.argmax(h, axis=-1))


def last_of_equals(h):
    return h.shape[-1] - 1 - np.argmax(h[..., ::-1], axis=-1)


def nearest_on(a, b, c, p):
    """The nearest point of a triangle, by its sides and its inside."""
    n = np.cross(b - a, c - a)
    best = None
    inside = all(np.dot(np.cross(e - s, p - s), n) >= 0 for s, e in ((a, b), (b, c), (c, a)))
    if inside:
        return p - np.dot(p - a, n) / np.dot(n, n) * n
    for s, e in ((a, b), (b, c), (c, a)):
        t = np.clip(np.dot(p - s, e - s) / np.dot(e - s, e - s), 0, 1)
        place = s + t * (e - s)
        if best is None or np.linalg.norm(p - place) < np.linalg.norm(p - best):
            best = place
    return best


def true_distance(p, v, f):
    """Outside, the distance from the solid instead of the height above a plane."""
    s, face = separation()(p, v, f)
    p, v = np.asarray(p, dtype=float), np.asarray(v)
    rows = p.reshape(-1, 3)
    away = [min(np.linalg.norm(q - nearest_on(*v[each], q)) for each in f) for q in rows]
    return np.where(s > 0, np.reshape(away, p.shape[:-1]), s), face


# fmt: off
BANK = (
    M("face_planes", "a tiny number below", plane_with(lambda n, v, f: over_more(n)),
      "A tiny number is added to the length of the cross product, so that nothing is divided by zero. The length is an"
      " area: of a face of micrometres it is no larger than that number. A face without area is to be refused.",
      "How long is (b − a)×(c − a) for sides of a micrometre? And is your normal of unit length then?"),
    M("face_planes", "inwards", plane_with(lambda n, v, f: -unit(n)),
      "Every normal points into the solid. The two sides are multiplied in the wrong order, and in a cross product the"
      " order decides the direction.",
      "Curl the fingers of your right hand from the first side to the second. Which way does the thumb point if the"
      " corners run counter-clockwise as you see them?"),
    M("face_planes", "not of unit length", plane_with(lambda n, v, f: n),
      "The normal is as long as the cross product, which is twice the area of the face. The plane is right, but n·p + d"
      " is then no distance in metres.",
      "How long is the cross product of two sides of 3 m at right angles? How long should n be?"),
    M("face_planes", "offset without the minus", other_offset(lambda v, f: -right(v, f)[1]),
      "The offset has the wrong sign: the plane is on the other side of the origin.",
      "A corner a is in the plane. Put it into n·p + d: which d gives zero?"),
    M("face_planes", "offset of the long normal", other_offset(lambda v, f: plane(long_normal(v, f), v, f)[1]),
      "The normal is divided by its length, but the offset is still that of the long normal.",
      "Which n is in your offset: the one before the division, or the one that you return?"),
    M("face_planes", "offset left out", other_offset(lambda v, f: 0 * right(v, f)[1]),
      "Every plane goes through the origin, because the offset is zero.",
      "How far is the plane z = 2 from the origin?"),
    M("face_planes", "corners for sides", without_difference,
      "The cross product is that of two corners, not of two sides. It is at right angles to the ways from the origin to"
      " these corners, and that is the face's normal only if the face points at the origin.",
      "Move the solid by 10 m. Do the normals of its faces change?"),
    M("face_planes", "all upwards", plane_with(lambda n, v, f: unit(n) * np.where(n[:, 2:] < 0, -1, 1)),
      "Every normal is turned so that it points up. Those of the faces below then point into the solid.",
      "Which way is outwards for the floor of a house?"),
    M("face_planes", "away from the origin", plane_with(away_from(lambda v, f: 0)),
      "Every normal is turned away from the origin. That is outwards only for a solid around the origin. The order of"
      " the corners says which way is out for any solid.",
      "Put a cube 10 m beside the origin. Which way is outwards for the side that faces the origin?"),
    M("face_planes", "away from the middle", plane_with(away_from(lambda v, f: np.asarray(v).mean(axis=0))),
      "Every normal is turned away from the middle of the corners. In an L some walls look towards the middle.",
      "Draw an L and its middle. What do the two walls of its pocket see?"),
    M("face_planes", "largest component 1", plane_with(lambda n, v, f: n / np.max(np.abs(n), axis=-1, keepdims=True)),
      "The normal is divided by its largest component, not by its length.",
      "How long is (1, 1, 1)?"),
    M("face_planes", "divided by the area", plane_with(lambda n, v, f: 2 * unit(n)),
      "The normal is divided by the area of the face, and has the length 2: the cross product is twice the area.",
      "Which share of a parallelogram does the triangle between two of its sides have?"),
    M("convex_separation", "smallest height", separation(lambda h: np.argmin(h, axis=-1)),
      "It takes the smallest of the heights: that of the face farthest behind. A point may be behind one face and still"
      " outside, in front of another.",
      "A point is 1 m before the front of a cube. What is its height above the plane of the back, and which of the two"
      " says that it is outside?"),
    M("convex_separation", "nearest plane", separation(lambda h: np.argmin(np.abs(h), axis=-1)),
      "It takes the plane that is nearest, on whichever side. Outside, a point can be close to the plane of a face that"
      " is far away.",
      "A point is 5 m before a wall, and on a level with the roof. Which plane is nearest? How far away is the house?"),
    M("convex_separation", "distance from the solid", true_distance,
      "Outside it gives the distance from the nearest point of the solid. The separation is the height above one plane,"
      " and beyond an edge or a corner it is less.",
      "Read again what the separation is beyond an edge. Which of the two is cheaper to find?"),
    M("convex_separation", "sign turned round", separation(value=lambda s: -s),
      "The sign is turned round: it is positive inside. The face is right.",
      "What should be negative within the solid?"),
    M("convex_separation", "size", separation(value=np.abs),
      "The sign is lost: a point 1 m deep in the solid has the separation of one that is 1 m outside.",
      "How does your answer say that a point is inside?"),
    M("convex_separation", "nothing inside", separation(value=lambda s: np.maximum(s, 0)),
      "Inside, the separation is zero. It should say how deep the point is.",
      "How long is the way out of the solid?"),
    M("convex_separation", "long normals", separation(planes=lambda v, f: plane(long_normal(v, f), v, f)),
      "The heights are measured with normals that are not of unit length, so that a large face counts for more than a"
      " small one.",
      "Which of your face planes have a normal of length 1?"),
    M("convex_separation", "offset left out", separation(planes=lambda v, f: (right(v, f)[0], 0 * right(v, f)[1])),
      "The heights are n·p: every face is moved to the origin.",
      "What is the height of a corner of a face above the plane of this face?"),
    M("convex_separation", "offset subtracted", separation(planes=lambda v, f: (right(v, f)[0], -right(v, f)[1])),
      "The offset is subtracted. In n·p + d it is added.",
      "What is n·a + d for a corner a of the face?"),
    M("convex_separation", "first face in front", separation(first_in_front),
      "It stops at the first face that has the point in front of it. Another face may have it farther in front.",
      "You stand at the corner of a house, 1 m before the long wall and 3 m before the short one. Which wall is first"
      " in your list, and which number is the separation?"),
    M("convex_separation", "last of equals", separation(last_of_equals),
      "If several faces are equal, it gives the last of them, not the first.",
      "Which face does your comparison keep if a later one is just as high?"),
    M("convex_separation", "counted from one", separation(number=lambda face: face + 1),
      "The faces are counted from one. An index counts from zero.",
      "What is the index of the first face?"),
)
# fmt: on
