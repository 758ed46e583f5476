"""Loose readings of the slides about impulses: the tests of slide 21, the whole vector reversed, no mass."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, flat, formulas_of, over

BODIES = formulas_of("impulse_bodies")
apply_with, change_with, collide_with = BODIES.apply_with, BODIES.change_with, BODIES.collide_with


def along_the_relative_velocity(a, b, n, e, threshold=0.0):
    """−(1 + e) u/k as the impulse: the whole relative velocity in place of u_n n."""
    hit = BODIES.closing(a, b, n) < -np.asarray(threshold)
    u = BODIES.point(a) - BODIES.point(b)
    j = over(-(1 + col(e)), col(BODIES.denominator(a, b, n)), 0) * u
    return BODIES.applied(a, b, np.where(col(hit), j, 0))


def each_turned_back(a, b, n, e, threshold=0.0):
    """−e v of both bodies; the spins stay."""
    hit = col(BODIES.closing(a, b, n) < -np.asarray(threshold))
    blank = 0 * BODIES.denominator(a, b, n)[..., None] + 0 * col(e)
    after = [np.where(hit, -col(e) * body[0], body[0]) + blank for body in (a, b)]
    return after[0], a[1] + blank, after[1], b[1] + blank


def throughout(turning=None, share=lambda s: s, angular=None):
    """One mistake below the line and in the update: of the turning of the normal, of 1/M, and of the change of spin."""

    def soft(body, n):
        return share(body[3]) + (BODIES.turning(body, n) if turning is None else turning(body, n))

    linear = lambda s, k, r, j: col(share(s)) * j  # noqa: E731
    change = change_with(linear=linear) if angular is None else change_with(linear=linear, angular=angular)
    return collide_with(j_of=BODIES.size_with(below=BODIES.both(soft)), apply=apply_with(change=change))


def turning_by(angular):
    """n·(Δω × r), with the change of spin that a unit impulse gives."""
    return lambda body, n: flat(dot(n, np.cross(angular(body[3], body[4], body[2], n), body[2])))


def in_all(angular):
    return throughout(turning_by(angular), angular=angular)


without_inertia = lambda s, k, r, j: np.cross(r, j) + 0 * BODIES.turned(k, r)  # noqa: E731
inertia_on_r = lambda s, k, r, j: np.cross(BODIES.turned(k, r), j)  # noqa: E731
inertia_on_j = lambda s, k, r, j: np.cross(r, BODIES.turned(k, j))  # noqa: E731
turned_round = lambda s, k, r, j: BODIES.turned(k, np.cross(j, r))  # noqa: E731
without_mass = change_with(linear=lambda s, k, r, j: j + 0 * col(s))
mass_for_inverse = change_with(linear=lambda s, k, r, j: col(BODIES.mass(s)) * j)


# fmt: off
BANK = (
    M("collide", "size alone", collide_with(hits=lambda u, t: np.abs(u) > np.asarray(t)),
      "The size of the normal velocity is compared with the threshold, and no test asks for its sign: "
      "bodies that fly apart are pulled back.",
      "On slide 21, what does the sign of V_rel say?"),
    M("collide", "threshold's sign, turned round", collide_with(hits=lambda u, t: u > -np.asarray(t)),
      "The impulse is given where V_rel is above −threshold. That is the test for bodies that rest or separate: "
      "those that approach fast go through each other.",
      "Which sign does u_n have for bodies that approach, with the normal from B to A?"),
    M("collide", "along the relative velocity", along_the_relative_velocity,
      "The impulse is along the whole relative velocity. Slides 12 and 16 reverse only its component along the "
      "normal: there is no friction that could push along the surface.",
      "In which direction can two smooth surfaces push each other?"),
    M("collide", "each velocity reversed", each_turned_back,
      "Each body gets its own velocity back, reversed and scaled by e. "
      "Slide 12 is about the relative velocity of the two points, and only about its component along the normal.",
      "A ball at rest is hit by another one. Does it stay where it is?"),
    M("collide", "+J turns both", collide_with(apply=apply_with(b_turn=1)),
      "B's spin changes by +J, as slide 18 prints it, or by J × r; B's velocity gets −J.",
      "Add up the angular momenta before and after."),
    M("collide", "+J moves both", collide_with(apply=apply_with(b_sign=1, b_turn=-1)),
      "B's velocity changes by +J, as slide 18 prints it; B's spin gets −J.",
      "Add up the momenta before and after."),
    M("collide", "no mass", collide_with(apply=apply_with(change=without_mass)),
      "The velocities change by the impulse itself: the mass of slide 18 is missing.",
      "What unit does J have, and what unit the change of a velocity?"),
    M("collide", "mass for its inverse", collide_with(apply=apply_with(change=mass_for_inverse)),
      "The velocities change by the impulse times the mass. The bodies are given with 1/M.",
      "A marble and a cannon ball get the same impulse. Which velocity changes more?"),
    M("collide", "r × (I⁻¹ J)", collide_with(apply=apply_with(change=change_with(angular=inertia_on_j))),
      "In the update, I⁻¹ acts on J, inside the cross product. On slide 18 it acts on the result of r × J.",
      "What changes when the body is struck: L by r × J. And ω = I⁻¹ of what?"),
    M("collide", "no inverse inertia throughout", in_all(without_inertia),
      "The inverse inertia is used nowhere, neither below the line nor in the update of the spins on slide 18.",
      "Which part of the bodies does your answer not depend on?"),
    M("collide", "no mass throughout", throughout(share=lambda s: 1 + 0 * np.asarray(s)),
      "The masses are used nowhere, as if each body had 1 kg: neither below the line nor in the update on slide 18.",
      "Which part of the bodies does your answer not depend on?"),
    M("collide", "(I⁻¹ r) × J throughout", in_all(inertia_on_r),
      "I⁻¹ acts on r, below the line and in the update. On slide 18 it acts on the result of r × J.",
      "What changes when the body is struck: L by r × J. And ω = I⁻¹ of what?"),
    M("collide", "r × (I⁻¹ J) throughout", in_all(inertia_on_j),
      "I⁻¹ acts on J, or on n below the line, inside the cross product. On slide 18 it acts on the result of r × J.",
      "What changes when the body is struck: L by r × J. And ω = I⁻¹ of what?"),
    M("collide", "J × r throughout", in_all(turned_round),
      "The cross product has the wrong order, below the line and in the update: on slide 18 it is r × J.",
      "Push a door at its handle. Which way does it turn, and does it give way more easily there or near the hinge?"),
)
# fmt: on
