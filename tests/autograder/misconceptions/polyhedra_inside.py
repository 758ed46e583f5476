"""Known mistakes about what is inside: by crossings of a ray, and by solid angles."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from solutions.polyhedra import orient2d, orient3d, side_of_line, solid_angle


def flat_and_side(p, v, f):
    """Seen from above: which sides each point is of the three edges of each face; and of the face itself."""
    p, corners = np.asarray(p, dtype=float)[..., None, :], np.asarray(v)[f]
    a, b, c = (corners[:, k] for k in range(3))
    turns = np.stack([orient2d(s[:, :2], e[:, :2], p[..., :2]) for s, e in ((a, b), (b, c), (c, a))])
    return turns, orient3d(a, b, c, p)


def within(turns):
    """Within the face or on its border, seen from above, if the face is not upright."""
    return (np.all(turns >= 0, axis=0) | np.all(turns <= 0, axis=0)) & np.any(turns != 0, axis=0)


def strictly_within(turns):
    return np.all(turns > 0, axis=0) | np.all(turns < 0, axis=0)


def ahead(turns, side):
    """The face is above the point."""
    return np.sum(turns, axis=0) * side < 0


def counted(hit, odd=lambda count: count % 2 == 1):
    """Whether the number of faces that are hit is odd."""
    return lambda p, v, f: odd(np.sum(hit(*flat_and_side(p, v, f)), axis=-1))


def right(p, v, f, side_of=orient2d):
    """The ray starts at the point moved by tiny steps along x and y, and so meets no edge."""
    p, corners = np.asarray(p, dtype=float)[..., None, :], np.asarray(v)[f]
    a, b, c = (corners[:, k] for k in range(3))
    turns = []
    for s, e in ((a, b), (b, c), (c, a)):
        turn = side_of(s[:, :2], e[:, :2], p[..., :2])
        turn = np.where(turn == 0, np.sign(s[:, 1] - e[:, 1]), turn)
        turns.append(np.where(turn == 0, np.sign(e[:, 0] - s[:, 0]), turn))
    hit = strictly_within(np.stack(turns)) & ahead(np.stack(turns), orient3d(a, b, c, p))
    return np.sum(hit, axis=-1), np.sum(hit & (turns[0] > 0), axis=-1)


def by_winding(inside):
    """What a number of turns around the point says."""
    return lambda p, v, f: inside(np.abs(total(angles(p, v, f)) / (4 * np.pi)))


def moved(p, v, f):
    """The point is moved by some real length, such as a nanometre."""
    return counted(lambda t, s: strictly_within(t) & ahead(t, s))(np.add(p, [4e-10, 9e-10, 1e-10]), v, f)


def behind_all(p, v, f):
    """Slide 9, for any polyhedron."""
    a, b, c = np.moveaxis(np.asarray(v)[f], 1, 0)
    return np.all(np.sum(np.cross(b - a, c - a) * (np.asarray(p)[..., None, :] - a), axis=-1) <= 0, axis=-1)


def in_box(p, v, f):
    corners = np.asarray(v)[np.unique(f)] if len(f) else np.full((1, 3), np.nan)
    return np.all((p >= corners.min(axis=0)) & (p <= corners.max(axis=0)), axis=-1)


def on_planes(p, v, f):
    """Every plane above the point is counted, not every face."""
    _, side = flat_and_side(p, v, f)
    a, b, c = np.moveaxis(np.asarray(v)[f], 1, 0)
    looks_up = np.cross(b - a, c - a)[:, 2]
    return np.sum(np.sign(looks_up) * side < 0, axis=-1) % 2 == 1


# Winding numbers


def angles(p, v, f):
    return solid_angle(np.asarray(p)[..., None, :], np.asarray(v)[f])


def sphere(of):
    """Something made of the angles, over the whole sphere."""
    return lambda p, v, f: of(angles(p, v, f)) / (4 * np.pi)


def total(omega):
    return np.sum(omega, axis=-1)


def backs_less_fronts(p, v, f):
    """Every face has the same share, however large it looks."""
    return np.sum(np.sign(angles(p, v, f)), axis=-1) / max(1, len(f))


def without_quadrant(p, v, f):
    """The arctangent of a quotient, which knows half of the directions only."""
    return np.sum(2 * np.arctan(np.tan(angles(p, v, f) / 2)), axis=-1) / (4 * np.pi)


def flat_areas(p, v, f):
    """Area over the square of the distance, as for a small face that is seen from the front."""
    a, b, c = np.moveaxis(np.asarray(v)[f], 1, 0)
    away = (a + b + c) / 3 - np.asarray(p)[..., None, :]
    far = np.maximum(np.linalg.norm(away, axis=-1), 1e-12)
    return np.sum(np.sum(np.cross(b - a, c - a) / 2 * away, axis=-1) / far**3, axis=-1) / (4 * np.pi)


# fmt: off
BANK = (
    M("inside_by_parity", "behind all faces", behind_all,
      "It says whether the point is behind the planes of all faces, as slide 9 has it for any polyhedron. In an L the"
      " wall of one arm has most of the other arm in front of it.",
      "Stand in the arm of an L. Which of its walls have you in front of them?"),
    M("inside_by_parity", "border counted twice", counted(lambda t, s: within(t) & ahead(t, s)),
      "Where the ray goes through an edge, each of the faces there is counted. Through the diagonal of a cube's side it"
      " seems to cross the surface twice.",
      "How often does the ray cross the surface at a diagonal, and how many of your triangles does it meet there?"),
    M("inside_by_parity", "border left out", counted(lambda t, s: strictly_within(t) & ahead(t, s)),
      "Where the ray goes through an edge, none of the faces there is counted: it slips out between two triangles.",
      "Through which of its two triangles does a ray cross the side of a cube at the diagonal? Count one of them."),
    M("inside_by_parity", "moved by a number", moved,
      "The point is moved by a real length, so that its ray misses every edge. Whatever the length, there is a solid"
      " that is smaller, or so far from the origin that the sum is rounded back to the point. Nothing has to be added:"
      " the sign of a sum with ε in it is found without a value of ε.",
      "How wide is a solid that your point leaves by its step? And what are 1e9 + 1e-9 in floats?"),
    M("inside_by_parity", "sides in plain floats", lambda p, v, f: right(p, v, f, side_of_line)[0] % 2 == 1,
      "The sides of the edges are found in plain floats. Hardly beside an edge, rounding may put the point on the same"
      " side of it in both faces, or on none: the ray meets both of them or slips out between.",
      "Two faces share an edge, and run through it in opposite ways. Do your floats always see the point on opposite"
      " sides? Which function of the lab decides this without rounding?"),
    M("inside_by_parity", "winding number for parity", by_winding(lambda turns: np.round(turns) % 2 == 1),
      "It is the winding number, rounded. That needs faces which all look outwards. The number of crossings does not"
      " depend on which way a face is turned.",
      "Turn one face of a cube over. What do solid angles say close to this face, and what does a ray say?"),
    M("inside_by_parity", "winding number over a half", by_winding(lambda turns: turns > 0.5),
      "It is the winding number, and more than a half of a turn counts as inside. From a hollow that is surrounded"
      " twice a ray crosses the surface twice, and with a face turned over solid angles do not count crossings at all.",
      "One cube is within another, and the faces of both look outwards. Is the inner cube a part of the solid by"
      " parity? How often is a point in it surrounded?"),
    M("inside_by_parity", "line for ray", counted(lambda t, s: within(t) & (np.sum(t, axis=0) * s != 0)),
      "No point is inside. Are faces behind the start counted as well? A line goes into a closed surface as often as"
      " out of it, so that the number is always even.",
      "How often does a line through the whole solid cross its surface?"),
    M("inside_by_parity", "even for odd", lambda p, v, f: right(p, v, f)[0] % 2 == 0,
      "An odd number of crossings counts as outside, and an even one as inside.",
      "How often does a ray cross anything that starts far away and looks away?"),
    M("inside_by_parity", "any crossing", lambda p, v, f: right(p, v, f)[0] > 0,
      "One crossing is enough to be inside. A ray that goes right through a solid crosses its surface twice.",
      "Which points below a solid have a ray that crosses it?"),
    M("inside_by_parity", "one crossing", lambda p, v, f: right(p, v, f)[0] == 1,
      "Only a single crossing counts as inside. A ray may leave the solid, enter it again and leave it once more.",
      "How often does a ray from one arm of a U cross the surface if it goes through the other?"),
    M("inside_by_parity", "way out alone", lambda p, v, f: right(p, v, f)[1] % 2 == 1,
      "Only faces that look along the ray are counted: the ways out. Those that look against it are ways in.",
      "A ray from below goes into the solid and out again. How many of its crossings do you count?"),
    M("inside_by_parity", "planes for faces", on_planes,
      "Every plane that the ray crosses is counted. The plane of a face goes on for ever, and the face does not.",
      "How many of the planes of an L does a ray from far below cross, and how many faces?"),
    M("inside_by_parity", "box around the solid", in_box,
      "It says whether the point is in the box around the solid.",
      "Is the pocket of an L in the box around it?"),
    M("winding_number", "unsigned angles", sphere(lambda o: total(np.abs(o))),
      "The angles are added up without their signs. From outside, the fronts must take away what the backs add.",
      "From outside of a cube, what is the sum of its solid angles with their signs?"),
    M("winding_number", "unsigned angles, cut at one", sphere(lambda o: np.minimum(total(np.abs(o)), 4 * np.pi)),
      "The angles are added up without their signs, and what is more than 1 is cut off. Inside of a closed surface this"
      " gives 1, but outside it does not give 0.",
      "From outside of a cube, what is the sum of its solid angles with their signs?"),
    M("winding_number", "inwards", sphere(lambda o: -total(o)),
      "The sign is turned round: it is −1 inside of a surface whose faces look outwards.",
      "Does a point inside see the backs of the faces, or their fronts? And which of the two angles is positive?"),
    M("winding_number", "over the half sphere", lambda p, v, f: total(angles(p, v, f)) / (2 * np.pi),
      "The sum is divided by 2π, which is half of the sphere (or the whole circle).",
      "What is the area of a sphere of radius 1?"),
    M("winding_number", "over twice the sphere", lambda p, v, f: total(angles(p, v, f)) / (8 * np.pi),
      "The result is half of what it should be: the sphere is taken twice, or half of each angle is added up.",
      "From the middle of a cube, which part of the sphere does one side of it cover?"),
    M("winding_number", "in steradians", lambda p, v, f: total(angles(p, v, f)),
      "It gives the sum of the solid angles. The winding number is its share of the whole sphere.",
      "What is the sum inside of a closed surface, and what should be returned there?"),
    M("winding_number", "size of the sum", sphere(lambda o: np.abs(total(o))),
      "The sign of the sum is lost: a surface turned inside out cannot be told from a right one.",
      "What should be returned inside of a surface whose faces look inwards?"),
    M("winding_number", "rounded", sphere(lambda o: 4 * np.pi * np.round(total(o) / (4 * np.pi))),
      "The result is rounded to a whole number. A surface with a hole gives a fraction, and this makes it useful.",
      "What should be returned in the middle of a box without its lid?"),
    M("winding_number", "faces counted", backs_less_fronts,
      "Every face has the same share, however large it looks from the point.",
      "Which covers more of your sight: a wall 1 m away, or the same wall 10 m away?"),
    M("winding_number", "arctangent of a quotient", without_quadrant,
      "The angle is found by the arctangent of a quotient. Close to the face the denominator is negative, and there the"
      " angle is half a turn off.",
      "What are np.arctan(1/1) and np.arctan(−1/−1)? And np.arctan2 of the same numbers?"),
    M("winding_number", "flat areas", flat_areas,
      "The solid angle is taken as the area over the square of the distance, seen under its slant. This holds for faces"
      " that are small beside the distance.",
      "What is the solid angle of a large wall from close before it? What does your formula say?"),
    M("winding_number", "mean of the angles", sphere(lambda o: total(o) / max(1, o.shape[-1])),
      "The mean of the angles is taken. Together the faces cover the sphere, so their angles are added.",
      "Cut every face of a cube in two. Should the winding number change?"),
)
# fmt: on
