"""Known mistakes of the normal velocity of two bodies, and of the normal of two edges."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import dot, flat, formulas_of, size

BODIES = formulas_of("impulse_bodies")
point, closing = BODIES.point, BODIES.closing


def towards(normal, a, b, flip=np.less):
    return np.where(flip(dot(normal, np.asarray(a) - b), 0), -normal, normal)


def unit(v):
    return np.asarray(v) / size(v)


def edges(a, b):
    return unit(np.cross(a, b))


def speed_of(moves):
    """The normal velocity, with something else as the velocity of a body's point."""
    return lambda a, b, n: flat(dot(moves(*map(np.asarray, a[:3])) - moves(*map(np.asarray, b[:3])), n))


def relative(combined):
    """The part along the normal of something else than the difference of the two points' velocities."""
    return lambda a, b, n: flat(dot(combined(point(a), point(b)), n))


def along_the_surface(a, b, n):
    u = point(a) - point(b)
    return flat(size(u - dot(u, n) * n))


WHEEL = "A wheel turns to the left, seen from above. Which way does its rightmost point move?"
DEPENDS = "Which parts of the bodies does your answer not depend on?"


# fmt: off
BANK = (
    M("normal_velocity", "B less A", lambda a, b, n: -closing(a, b, n),
      "The order is wrong: it is A less B along the normal from B to A, so that it is negative when approaching. "
      "The slide does not fix it.",
      "A comes down on B. Which sign should come out?"),
    M("normal_velocity", "sum", relative(np.add),
      "The velocities are added in place of subtracted.",
      "Two bodies move side by side. Do they come nearer?"),
    M("normal_velocity", "vector", lambda a, b, n: flat(size(point(a) - point(b))) + 0 * flat(dot(n, n)),
      "It is the speed of the whole relative velocity; asked for is its part along the normal.",
      "Which argument makes no difference to your answer?"),
    M("normal_velocity", "size", lambda a, b, n: np.abs(closing(a, b, n)),
      "The sign is lost: nobody can tell any more whether they come nearer.",
      "What tells an approach from moving apart?"),
    M("normal_velocity", "A alone", relative(lambda a, b: a + 0 * b),
      "B's velocity makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("normal_velocity", "B alone", relative(lambda a, b: 0 * a - b),
      "A's velocity makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("normal_velocity", "along the surface", along_the_surface,
      "It is the speed along the surface.",
      "A falls straight down on B. How fast do they come nearer?"),
    M("normal_velocity", "approach alone", lambda a, b, n: np.minimum(closing(a, b, n), 0),
      "Where they move apart 0 comes out; asked for is the rate, whatever its sign.",
      "How fast do two points part that move apart at 2 m/s?"),
    M("normal_velocity", "vertical part", lambda a, b, n: (point(a) - point(b))[..., 2] + 0 * flat(dot(n, n)),
      "The z component is taken, whatever the normal.",
      "Which argument makes no difference to your answer?"),
    M("normal_velocity", "speeds", lambda a, b, n: flat(size(point(a)) - size(point(b))) + 0 * flat(dot(n, n)),
      "The difference of the speeds is taken in place of the velocities'.",
      "Two bodies come head on, each at 2 m/s. How fast do they come nearer?"),
    M("normal_velocity", "only B's normal part", lambda a, b, n: flat(dot(point(a), n)) - flat(size(point(b))),
      "Of A the part along the normal is taken, of B the whole speed.",
      "What counts of B's velocity?"),
    M("normal_velocity", "components without signs", relative(lambda a, b: np.abs(a - b)),
      "The components of the relative velocity lose their signs before the product with the normal.",
      "What does the absolute value do to a direction?"),
    M("normal_velocity", "of the sizes", relative(lambda a, b: np.abs(a) - np.abs(b)),
      "The sizes of the components are subtracted: head on they would cancel.",
      "Two bodies come head on, each at 2 m/s. How fast does A move, seen from B?"),
    M("normal_velocity", "half", lambda a, b, n: closing(a, b, n) / 2,
      "There is a half: it is the velocity against the mean of the two.",
      "A moves at 2 m/s, B is at rest. How fast does A move, seen from B?"),
    M("normal_velocity", "r × ω", BODIES.crossed,
      "The cross product has the wrong order: r × ω turns the points the other way round.", WHEEL),
    M("normal_velocity", "spin left out", BODIES.of_centres,
      "It is the velocity of the centres: the spin makes no difference.", DEPENDS),
    M("normal_velocity", "spin alone", speed_of(lambda v, w, r: np.cross(w, r) + 0 * v),
      "Only the turning is there: the centres move as well.", DEPENDS),
    M("normal_velocity", "a place", speed_of(lambda v, w, r: r + np.cross(w, r) + 0 * v),
      "It starts from the arm, a place, as the slide's p without its dot suggests: asked for is a velocity.",
      "What units have the two terms?"),
    M("normal_velocity", "component by component", speed_of(lambda v, w, r: v + w * r),
      "ω and r are multiplied component by component; it is a cross product.",
      "A point turns about z at a distance along x. In which direction does it move?"),
    M("normal_velocity", "dot product", speed_of(lambda v, w, r: v + dot(w, r)),
      "ω·r is a number; the velocity that turning adds is the cross product ω × r, at right angles to both.",
      "A point turns about z at a distance along x. In which direction does it move?"),
    M("normal_velocity", "v × r", speed_of(lambda v, w, r: w + np.cross(v, r)),
      "Velocity and angular velocity are swapped.",
      "Which of the two is multiplied with the arm?"),
    M("normal_velocity", "stretched arm", speed_of(lambda v, w, r: v + size(w) * r),
      "The arm is stretched by the speed of turning: that is the right size at right angles, but the wrong direction.",
      "Does the rim of a wheel move outwards?"),
    M("normal_velocity", "acceleration", speed_of(lambda v, w, r: v + np.cross(w, np.cross(w, r))),
      "ω × (ω × r) is the acceleration towards the axis, not the velocity.",
      "What unit has ω × (ω × r)?"),
    M("normal_velocity", "arm added", speed_of(lambda v, w, r: v + np.cross(w, r) + r),
      "The arm itself is added: a length to velocities.",
      "What units have the three terms?"),
    M("normal_velocity", "spin added", speed_of(lambda v, w, r: v + w + 0 * r),
      "The angular velocity is added to the velocity: it needs the arm to become one.",
      "What units have the two terms?"),
    M("edge_edge_normal", "not unit", lambda e, f, a, b: towards(np.cross(e, f), a, b),
      "The cross product is not made a unit vector: its length is ‖A‖‖B‖ sin φ.",
      "How long is your answer?"),
    M("edge_edge_normal", "as they run", lambda e, f, a, b: edges(e, f) + 0 * np.asarray(a) + 0 * np.asarray(b),
      "It is the slide's A × B, which points to A or to B as the edges happen to run.",
      "Turn one of the edges round. Should the normal change?"),
    M("edge_edge_normal", "towards B", lambda e, f, a, b: towards(edges(e, f), b, a),
      "It points towards B: the lab's normals point from B to A.",
      "Which way should the normal push A?"),
    M("edge_edge_normal", "B × A", lambda e, f, a, b: edges(f, e) + 0 * np.asarray(a) + 0 * np.asarray(b),
      "It is B × A, and not oriented by the centres.",
      "Which arguments make no difference to your answer?"),
    M("edge_edge_normal", "flipped when level", lambda e, f, a, b: towards(edges(f, e), a, b),
      "Where the centres cannot tell, it lies along B × A, or is flipped; the description has A × B there.",
      "Which order does the slide's product have? And what of centres in one plane across the normal?"),
    M("edge_edge_normal", "of the centres",
      lambda e, f, a, b: unit(np.asarray(a) - b) + 0 * np.asarray(e) + 0 * np.asarray(f),
      "It is the direction from B's centre to A's: the edges make no difference.",
      "Which way can two crossed rods push each other?"),
    M("edge_edge_normal", "between the edges", lambda e, f, a, b: towards(unit(np.asarray(e) + f), a, b),
      "It is the sum of the edges: the normal is at right angles to both.",
      "Which vector is at right angles to both edges?"),
    M("edge_edge_normal", "unit edges alone", lambda e, f, a, b: towards(np.cross(unit(e), unit(f)), a, b),
      "The edges are made unit vectors, and not their product: its length is still sin φ.",
      "How long is the product of two unit vectors?"),
    M("edge_edge_normal", "difference of the edges", lambda e, f, a, b: towards(unit(np.asarray(e) - f), a, b),
      "It is the difference of the edges: the normal is at right angles to both.",
      "Which vector is at right angles to both edges?"),
    M("edge_edge_normal", "up",
      lambda e, f, a, b: np.where(edges(e, f)[..., 2:] < 0, -1, 1) * edges(e, f) + 0 * np.add(a, b),
      "The normal is made to point up; it should point towards A, which may be below.",
      "A ball hits the ceiling. Which way is it pushed?"),
    M("edge_edge_normal", "flipped by A's place", lambda e, f, a, b: towards(edges(e, f), a, 0 * np.asarray(b)),
      "A's place alone decides, as if B were at the origin.",
      "Which argument makes no difference to your answer?"),
    M("edge_edge_normal", "over the square",
      lambda e, f, a, b: towards(np.cross(e, f) / dot(np.cross(e, f), np.cross(e, f)), a, b),
      "The product is divided by the square of its length.",
      "How long is your answer for edges of length 2?"),
    M("edge_edge_normal", "one length for all",
      lambda e, f, a, b: towards(np.cross(e, f) / np.linalg.norm(np.cross(e, f)), a, b),
      "With several pairs of edges in one call, one length is taken of all their products together.",
      "Along which axis do the components of a single normal lie?"),
    M("edge_edge_normal", "absolute components", lambda e, f, a, b: towards(np.abs(edges(e, f)), a, b),
      "The components lose their signs: the direction is another one.",
      "Is (1, 1, 0) the same direction as (1, −1, 0)?"),
)
# fmt: on
