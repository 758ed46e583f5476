"""Known mistakes about the nodes of a mesh in a sphere, and about springs that may not stretch too far."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import dot, size

UP = np.array([0.0, 0.0, 1.0])


def outwards(away):
    """The unit vectors away from the centre; up at the centre itself."""
    far = size(away)
    return np.where(far > 0, away / np.where(far > 0, far, 1.0), UP)


def onto_surface(p, n, depth):
    return p + depth * n


def bounces(across, e):
    """The normal velocity afterwards, if the node approaches."""
    return np.where(across < 0, -e * across, across)


def most_of(across, e, mu):
    """The most that friction may take from the speed along the surface."""
    return np.where(across < 0, -mu * (1 + e) * across, 0.0)


def slowed(along, most):
    speed = size(along)
    return along * (1 - np.minimum(1.0, most / np.where(speed > 0, speed, 1.0)))


def touched(
    meets=lambda depth, across: depth > 0,
    moves=onto_surface,
    normal=outwards,
    after=bounces,
    most=most_of,
    slides=slowed,
    pins=True,
    reach=1.0,
    middle=1.0,
):
    """The right contact, with one part of it changed."""

    def found(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
        p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
        away = p - middle * np.asarray(centre, dtype=float)
        n = normal(away)
        depth = reach * np.asarray(radius) - size(away)
        across = dot(v, n)
        along = v - across * n
        hit = meets(depth, across) & ~(np.asarray(mesh[5])[:, None] & pins)
        new = slides(along, most(across, restitution, friction)) + after(across, restitution) * n
        return np.where(hit, moves(p, n, depth), p), np.where(hit, new, v)

    return found


def position_alone(mesh, position, velocity, *others):
    return touched()(mesh, position, velocity, *others)[0], np.asarray(velocity, dtype=float)


def velocity_alone(mesh, position, velocity, *others):
    return np.asarray(position, dtype=float), touched()(mesh, position, velocity, *others)[1]


def all_turned_round(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """What approaches flies back the way it came."""
    v = np.asarray(velocity, dtype=float)
    away = np.asarray(position, dtype=float) - centre
    hit = (size(away) < radius) & (dot(v, outwards(away)) < 0) & ~np.asarray(mesh[5])[:, None]
    return touched()(mesh, position, v, centre, radius)[0], np.where(hit, -restitution * v, v)


# Strain


def both_shares(w1, w2):
    """Which share of what is too long each end takes."""
    return w1 / (w1 + w2), w2 / (w1 + w2)


def fitted(
    longest=lambda rest, limit: rest * (1 + limit),
    shares=both_shares,
    goal=lambda rest, limit, long: rest * (1 + limit),
    together=False,
    order=1,
    rounds=lambda count: count,
    too_long=lambda long, most: long > most,
    slack=False,
    pins=True,
):
    """The right rounds, with one part of them changed.

    goal: how long a spring that is too long becomes. together: whether all springs see the places at the start of a
    round. slack: whether springs without a rest length count as well.
    """

    def found(mesh, position, limit=0.1, iterations=1000):
        edges, rest = np.asarray(mesh[0]), np.asarray(mesh[1], dtype=float)
        mass = np.asarray(mesh[4], dtype=float)
        w = np.where(np.asarray(mesh[5]) & pins, 0.0, 1 / mass)
        p = np.array(position, dtype=float)
        for _ in range(rounds(iterations)):
            seen = p.copy() if together else p
            for (one, other), at_rest in list(zip(edges.tolist(), rest, strict=True))[::order]:
                between = seen[one] - seen[other]
                long = np.sqrt(between @ between)
                if w[one] + w[other] > 0 and (at_rest > 0 or slack) and too_long(long, longest(at_rest, limit)):
                    over = (1 - goal(at_rest, limit, long) / long) * between if long > 0 else 0 * between
                    first, second = shares(w[one], w[other])
                    p[one] -= first * over
                    p[other] += second * over
        return p

    return found


def equal_shares(w1, w2):
    return (0.5, 0.5) if w1 > 0 and w2 > 0 else (float(w1 > 0), float(w2 > 0))


def halves_whatever_is_pinned(w1, w2):
    return (0.5 * (w1 > 0), 0.5 * (w2 > 0))


def heavier_moves(w1, w2):
    return (w2 / (w1 + w2), w1 / (w1 + w2)) if w1 > 0 and w2 > 0 else (float(w1 > 0), float(w2 > 0))


def first_end_moves(w1, w2):
    return (1.0, 0.0) if w1 > 0 else (0.0, 1.0)


def second_end_moves(w1, w2):
    return (0.0, 1.0) if w2 > 0 else (1.0, 0.0)


def both_all_of_it(w1, w2):
    return float(w1 > 0), float(w2 > 0)


# fmt: off
BANK = (
    M("mesh_sphere_contact", "velocity kept", position_alone,
      "The nodes are put back onto the surface, but keep their velocities. They are inside again after the next step,"
      " and get faster and faster.",
      "What happens to the velocity of a node that is put back in every step?"),
    M("mesh_sphere_contact", "position kept", velocity_alone,
      "The velocities change, but the nodes stay inside the sphere.",
      "Where should a node be afterwards that was inside?"),
    M("mesh_sphere_contact", "bounces on its way out", touched(
        after=lambda across, e: -e * across, most=lambda across, e, mu: mu * (1 + e) * np.abs(across)),
      "A node that is on its way out is turned round as well, and sticks.",
      "What should become of a node that already moves away?"),
    M("mesh_sphere_contact", "always outwards", touched(after=lambda across, e: e * np.abs(across)),
      "A node that is on its way out loses speed as well. The sphere pushes nodes that approach, and no others.",
      "What should become of a node that already moves away?"),
    M("mesh_sphere_contact", "e left out", touched(after=lambda across, e: np.maximum(across, 0.0)),
      "No node bounces: the normal velocity becomes zero whatever e is.",
      "Which of the arguments does your answer not depend on?"),
    M("mesh_sphere_contact", "perfect bounce", touched(after=lambda across, e: np.abs(across)),
      "Every bounce is perfect, whatever e is.",
      "Which of the arguments does your answer not depend on?"),
    M("mesh_sphere_contact", "wrong sign of e", touched(
        after=lambda across, e: np.where(across < 0, e * across, across)),
      "The normal velocity is multiplied by e and keeps its direction, so that the node moves on inwards.",
      "Which way should a node move along the normal after a bounce?"),
    M("mesh_sphere_contact", "friction left out", touched(
        after=lambda across, e: np.where(across < 0, -e * across, across),
        slides=lambda along, most: along, most=lambda across, e, mu: 0.0),
      "There is no friction: the velocity along the surface stays whatever μ is.",
      "Which of the arguments does your answer not depend on?"),
    M("mesh_sphere_contact", "v reversed", all_turned_round,
      "The whole velocity is multiplied by −e. Only the part across the surface is turned round.",
      "A node slides along the surface and just touches it. Which way should it go on?"),
    M("mesh_sphere_contact", "friction without 1 + e", touched(most=lambda a, e, mu: np.where(a < 0, -mu * a, 0.0)),
      "Friction is limited by μ |v_n|. The normal impulse is larger than that: it stops the node, and then it throws it"
      " back.",
      "By how much does the normal velocity change in a bounce with e = 1?"),
    M("mesh_sphere_contact", "friction with e alone", touched(most=lambda a, e, mu: np.where(a < 0, -mu * e * a, 0.0)),
      "Friction is limited by μ e |v_n|. The normal impulse also has to stop the node first.",
      "By how much does the normal velocity change in a bounce with e = 0?"),
    M("mesh_sphere_contact", "friction reverses", touched(
        slides=lambda along, most: along - most * along / np.where(size(along) > 0, size(along), 1.0)),
      "Friction is subtracted without a limit, so that a slow node slides back the way it came.",
      "A node slides slowly and hits hard. How much can friction take at most?"),
    M("mesh_sphere_contact", "a share of the sliding", touched(
        most=lambda a, e, mu: mu + 0 * a,
        slides=lambda along, most: along * (1 - np.minimum(1.0, most))),
      "Friction takes the share μ of the sliding, however hard the node hits.",
      "A node falls onto the sphere twice as fast. How much more can friction take?"),
    M("mesh_sphere_contact", "friction stops it", touched(
        slides=lambda along, most: np.where(most > 0, 0.0, along)),
      "Every sliding is stopped at once as soon as there is friction.",
      "How large may the impulse of friction be?"),
    M("mesh_sphere_contact", "friction on its way out", touched(most=lambda a, e, mu: mu * (1 + e) * np.abs(a)),
      "A node that moves away is slowed by friction as well. Without a normal impulse there is no friction.",
      "How hard is a node pressed against the sphere while it moves away?"),
    M("mesh_sphere_contact", "friction drives", touched(slides=lambda along, most: along * (
        1 + np.minimum(1.0, most / np.where(size(along) > 0, size(along), 1.0)))),
      "Friction makes the node slide faster.",
      "Against what does friction act?"),
    M("mesh_sphere_contact", "pinned nodes moved", touched(pins=False),
      "Pinned nodes are moved as well.",
      "Which of the arrays of the mesh does your answer not depend on?"),
    M("mesh_sphere_contact", "diameter for radius", touched(reach=0.5),
      "The radius is taken for a diameter.",
      "How far from the centre is the surface?"),
    M("mesh_sphere_contact", "twice the radius", touched(reach=2.0),
      "The sphere is twice as large as it should be.",
      "How far from the centre is the surface?"),
    M("mesh_sphere_contact", "centre at the origin", touched(middle=0.0),
      "The centre is left out: the sphere is around the origin.",
      "Move mesh and sphere by 10 m. What should change?"),
    M("mesh_sphere_contact", "deeper in", touched(moves=lambda p, n, depth: p - depth * n),
      "The node is moved towards the centre.",
      "In which direction is the nearest point of the surface?"),
    M("mesh_sphere_contact", "mirrored out", touched(moves=lambda p, n, depth: p + 2 * depth * n),
      "The node is moved out by twice its depth.",
      "Where should a node be afterwards that was 1 cm deep?"),
    M("mesh_sphere_contact", "straight up", touched(normal=lambda away: UP + 0 * away),
      "The normal is always up, as that of a floor. A sphere pushes away from its centre.",
      "A node is beside the centre. In which direction is the surface nearest?"),
    M("mesh_sphere_contact", "inside out", touched(meets=lambda depth, across: depth < 0),
      "The nodes outside are moved onto the sphere, and those inside are left alone.",
      "Which nodes are in the sphere: those that are nearer to its centre than the radius, or farther away?"),
    M("mesh_sphere_contact", "approaching ones alone", touched(meets=lambda depth, across: (depth > 0) & (across < 0)),
      "A node that is inside and moves away is not put back.",
      "What does the description say of a node inside that already moves away?"),
    M("mesh_sphere_contact", "touching counts", touched(
        meets=lambda depth, across: depth >= -1e-12),
      "A node exactly on the surface is treated as if it were inside.",
      "What does the description say of a node on the sphere?"),
    M("mesh_sphere_contact", "NaN at the centre", touched(normal=lambda away: away / size(away)),
      "At the centre the distance is zero, and the normal is NaN.",
      "What does the description say of a node exactly at the centre?"),
    M("mesh_sphere_contact", "normal not of unit length", touched(normal=lambda away: away),
      "The vector from the centre to the node is taken for the normal, and is not of length 1.",
      "How long is the vector along which you split the velocity?"),
    M("mesh_sphere_contact", "stops dead", lambda mesh, p, v, c, r, e=0.0, mu=0.0: touched(
        after=lambda a, e: 0 * a, slides=lambda along, most: 0 * along)(mesh, p, v, c, r, e, mu),
      "A node that is inside loses all of its velocity.",
      "A node slides on a smooth sphere. Which part of its velocity does the sphere change?"),

    M("limit_strain", "all at once", fitted(together=True),
      "All springs of a round are corrected from the places at its start. Each should find its ends where the spring"
      " before it has left them.",
      "The second spring begins at the node that the first one has moved. Where is that node?"),
    M("limit_strain", "equal shares", fitted(shares=equal_shares),
      "Both ends make half of the way, whatever their masses are, and the centre of mass moves.",
      "A marble and a bowling ball are drawn together. Which one moves farther?"),
    M("limit_strain", "heavy end moves", fitted(shares=heavier_moves),
      "The heavier end makes more of the way.",
      "A marble and a bowling ball are drawn together. Which one moves farther?"),
    M("limit_strain", "half beside a pin", fitted(shares=halves_whatever_is_pinned),
      "Each free end makes half of the way, also where the other end is pinned, so that the spring stays too long.",
      "One end is pinned. How far has the other one to move?"),
    M("limit_strain", "first end alone", fitted(shares=first_end_moves),
      "The first end makes the whole move, unless it is pinned.",
      "Where is the centre of mass of the two ends afterwards?"),
    M("limit_strain", "second end alone", fitted(shares=second_end_moves),
      "The second end makes the whole move, unless it is pinned.",
      "Where is the centre of mass of the two ends afterwards?"),
    M("limit_strain", "both ends all of it", fitted(shares=both_all_of_it),
      "Each end makes the whole move, so that the spring becomes too short by as much as it was too long.",
      "A spring is too long by 1 cm. How far do both ends have to move together?"),
    M("limit_strain", "apart", fitted(shares=lambda w1, w2: tuple(-each for each in both_shares(w1, w2))),
      "The ends are moved apart.",
      "In which direction is the second end, as seen from the first?"),
    M("limit_strain", "pins left out", fitted(pins=False),
      "Pinned nodes are moved as well.",
      "Which of the arrays of the mesh does your answer not depend on?"),
    M("limit_strain", "to the rest length", fitted(goal=lambda rest, limit, long: rest),
      "A spring that is too long is shortened to its rest length, and not to the limit.",
      "How long should a spring be afterwards that was too long?"),
    M("limit_strain", "limit in metres", fitted(lambda rest, limit: rest + limit,
                                                goal=lambda rest, limit, long: rest + limit),
      "The limit is taken for a length. It is a strain: a share of the rest length.",
      "How long may a spring of 2 m be with a limit of a tenth?"),
    M("limit_strain", "limit for the whole length", fitted(lambda rest, limit: rest * limit,
                                                           goal=lambda rest, limit, long: rest * limit),
      "A spring may be as long as the limit times its rest length. The limit is how much longer it may become.",
      "How long may a spring of 2 m be with a limit of a tenth?"),
    M("limit_strain", "limit left out", fitted(lambda rest, limit: rest, goal=lambda rest, limit, long: rest),
      "No spring may stretch at all: the limit is left out.",
      "Which of the arguments does your answer not depend on?"),
    M("limit_strain", "minus the limit", fitted(lambda rest, limit: rest * (1 - limit),
                                                goal=lambda rest, limit, long: rest * (1 - limit)),
      "Springs are shortened to less than their rest length.",
      "How long may a spring of 2 m be with a limit of a tenth?"),
    M("limit_strain", "all made as long as allowed", fitted(too_long=lambda long, most: True),
      "Every spring is made as long as the limit allows, also those that are shorter.",
      "What does the description say of springs that are not too long?"),
    M("limit_strain", "one round", fitted(rounds=lambda count: min(count, 1)),
      "There is a single round, however many are asked for.",
      "Which of the arguments does your answer not depend on?"),
    M("limit_strain", "one round more", fitted(rounds=lambda count: count + 1),
      "There is one round too many.",
      "How many rounds should there be if none is asked for?"),
    M("limit_strain", "from the last spring", fitted(order=-1),
      "The springs are corrected from the last one to the first.",
      "Which spring should find its ends where all others have left them?"),
    M("limit_strain", "rest length zero", fitted(slack=True),
      "A spring without a rest length is drawn together to a point.",
      "What does the description say of springs whose rest length is zero?"),
    M("limit_strain", "half of what is too long", fitted(shares=lambda w1, w2: tuple(
        each / 2 for each in both_shares(w1, w2))),
      "Only half of what is too long is taken away.",
      "How long is a spring after one round if it is alone?"),
)
# fmt: on
