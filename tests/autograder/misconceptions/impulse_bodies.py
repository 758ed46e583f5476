"""Known mistakes of an impact of two bodies."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, dot, flat, over, size


def turned(matrix, vector):
    return np.matvec(matrix, vector)


def soft(body, n):
    """One body's part of the denominator."""
    _, _, r, share, k = body
    return share + flat(dot(n, np.cross(turned(k, np.cross(r, n)), r)))


def mass(share):
    """1/M turned over; 0 for an immovable body, as those write who forget it."""
    return over(1.0, share, 0.0)


def inertia(k):
    return np.linalg.pinv(k)


def point(body, cross=1, spin=1):
    v, w, r = body[:3]
    return v + spin * cross * np.cross(w, r)


def closing(a, b, n, **parts):
    return flat(dot(point(a, **parts) - point(b, **parts), n))


def crossed(a, b, n):
    return closing(a, b, n, cross=-1)


def of_centres(a, b, n):
    return flat(dot(np.asarray(a[0]) - b[0], n)) + 0 * closing(a, b, n)


def both(of):
    return lambda a, b, n: of(a, n) + of(b, n)


def lever(r, n):
    return np.cross(r, n)


def turning(body, n):
    _, _, r, _, k = body
    return flat(dot(n, np.cross(turned(k, lever(r, n)), r)))


def share_alone(body, n):
    return body[3] + 0 * turning(body, n)


def inverted_once_more(body, n):
    return soft((*body[:4], inertia(body[4])), n)


def diagonal(k):
    return k * np.eye(3)


denominator = both(soft)


def magnitude(a, b, n, e, below=denominator, factor=lambda e: -(1 + e), speed=closing):
    return over(factor(np.asarray(e)) * speed(a, b, n), below(a, b, n), 0.0)


def undivided(a, b, n, e):
    """0/0 between immovable bodies."""
    return -(1 + np.asarray(e)) * closing(a, b, n) / np.asarray(soft(a, n) + soft(b, n))


def size_with(**parts):
    return lambda a, b, n, e: magnitude(a, b, n, e, **parts)


def changes(body, j):
    _, _, r, share, k = body
    return col(share) * j, turned(k, np.cross(r, j))


def applied(a, b, j, change=changes, b_sign=-1, b_turn=None):
    j = np.asarray(j)
    (dv_a, dw_a), (dv_b, dw_b) = change(a, j), change(b, j)
    turn = b_sign if b_turn is None else b_turn
    return a[0] + dv_a, a[1] + dw_a, b[0] + b_sign * dv_b, b[1] + turn * dw_b


def apply_with(**parts):
    return lambda a, b, j: applied(a, b, j, **parts)


def change_with(linear=lambda s, k, r, j: col(s) * j, angular=lambda s, k, r, j: turned(k, np.cross(r, j))):
    def change(body, j):
        _, _, r, share, k = body
        return linear(share, k, r, j) + 0 * np.asarray(r), angular(share, k, r, j)

    return change


without_spin = change_with(angular=lambda s, k, r, j: 0 * np.cross(r, j) + 0 * turned(k, r))


def along_the_arm(body, j):
    """The velocity changes by the part of J along r alone."""
    _, _, r, share, _ = body
    _, dw = changes(body, j)
    return col(share) * np.where(size(r) > 0, dot(j, direction(r)) * direction(r), j), dw


def impact(
    a, b, n, e, threshold=0.0, j_of=magnitude, apply=applied, hits=lambda u, t: u < -np.asarray(t), speed=closing
):
    hit = hits(speed(a, b, n), threshold)
    return apply(a, b, col(np.where(hit, j_of(a, b, n, e), 0)) * n)


def collide_with(**parts):
    return lambda a, b, n, e, threshold=0.0: impact(a, b, n, e, threshold, **parts)


def separate_impulses(a, b, n, e, threshold=0.0):
    """Each body with its own velocity and its own denominator."""

    def one_body(body, sign):
        speed = flat(dot(point(body), n))
        j = over(-(1 + np.asarray(e)) * speed, soft(body, n), 0)
        dv, dw = changes(body, col(j) * n)
        hit = closing(a, b, n) < -np.asarray(threshold)
        return body[0] + np.where(col(hit), dv, 0), body[1] + np.where(col(hit), dw, 0)

    return (*one_body(a, 1), *one_body(b, -1))


def one_dimension(a, b, n, e, threshold=0.0):
    """The textbook's formula for masses on a line, with restitution."""
    return impact(a, b, n, e, threshold, j_of=size_with(below=both(share_alone)))


def swapped_normals(a, b, n, e, threshold=0.0):
    """The normal velocities swap, whatever the masses."""
    u = dot(point(a) - point(b), n)
    hit = u < -col(threshold)
    return tuple(
        np.where(hit, new, old) for new, old in ((a[0] - u * n, a[0]), (a[1], a[1]), (b[0] + u * n, b[0]), (b[1], b[1]))
    )


# fmt: off
BANK = (
    M("inverse_effective_mass", "masses alone", both(share_alone),
      "The bodies cannot turn: the two terms with the inertia are missing. "
      "Right only where the normal goes through both centres.",
      "Push a door near its hinge and at its handle. Which is easier?"),
    M("inverse_effective_mass", "masses for their inverses", both(lambda body, n: mass(body[3]) + turning(body, n)),
      "M_A + M_B stands in place of 1/M_A + 1/M_B: the bodies are given with 1/M.",
      "What unit has each of your terms?"),
    M("inverse_effective_mass", "masses for their inverses, infinite",
      both(lambda body, n: over(1.0, body[3]) + turning(body, n)),
      "M_A + M_B stands in place of 1/M_A + 1/M_B: the bodies are given with 1/M, and of an immovable one 1/0 is inf.",
      "What unit has each of your terms?"),
    M("inverse_effective_mass", "inertia for its inverse",
      both(inverted_once_more),
      "The inverse inertia is inverted once more.",
      "What unit has each of your terms?"),
    M("inverse_effective_mass", "sign of the turning", both(lambda body, n: body[3] - turning(body, n)),
      "The terms with the inertia have the wrong sign, or one of the two cross products the wrong order: "
      "a body that can turn would be harder to move at its rim.",
      "Push a door near its hinge and at its handle. Which is easier?"),
    M("inverse_effective_mass", "B taken away", lambda a, b, n: soft(a, n) - soft(b, n),
      "B's terms are taken away: its minus in the impulse and the minus of the relative velocity make a plus.",
      "Two equal bodies: is your number zero? Would any impulse stop them then?"),
    M("inverse_effective_mass", "B's turning taken away", lambda a, b, n: a[3] + turning(a, n) + b[3] - turning(b, n),
      "B's turning is taken away: its minus in the impulse and the minus of the relative velocity make a plus.",
      "Swap A and B. Should the number change?"),
    M("inverse_effective_mass", "A alone", lambda a, b, n: soft(a, n) + 0 * soft(b, n),
      "B makes no difference: it is taken to be immovable.",
      "Which argument makes no difference to your answer?"),
    M("inverse_effective_mass", "no inertia",
      both(lambda body, n: body[3] + flat(dot(lever(body[2], n), lever(body[2], n)))),
      "The inertia makes no difference: the lever is squared, but not multiplied with I⁻¹.",
      "Which part of the bodies makes no difference to your answer?"),
    M("inverse_effective_mass", "mass for the inertia",
      both(lambda body, n: body[3] * (1 + flat(dot(lever(body[2], n), lever(body[2], n))))),
      "The turning is divided by the mass in place of the inertia.",
      "What unit has each of your terms?"),
    M("inverse_effective_mass", "without the last cross product",
      both(lambda body, n: body[3] + flat(dot(n, turned(body[4], lever(body[2], n))))),
      "The last × r is missing: I⁻¹(r × n) is a change of spin, not yet one of the point's velocity. "
      "For a body that turns alike about all axes the term is zero then.",
      "How does a change of spin change the velocity of the point?"),
    M("inverse_effective_mass", "the effective mass", lambda a, b, n: over(1, soft(a, n) + soft(b, n), 0),
      "It is the effective mass itself, one over what is asked for.",
      "What unit should come out?"),
    M("inverse_effective_mass", "diagonal of the inertia",
      both(lambda body, n: soft((*body[:4], diagonal(body[4])), n)),
      "Only the diagonal of the inverse inertia is used: a body that does not stand along the axes has more.",
      "What does the inverse inertia of a turned box look like?"),
    M("inverse_effective_mass", "whole arm",
      both(lambda body, n: body[3] + flat(dot(body[2], turned(body[4], body[2])))),
      "The whole arm is used in place of the lever r × n: an impulse through the centre would turn the body.",
      "An impulse straight at the centre: does it turn the body?"),
    M("inverse_effective_mass", "lever not squared",
      both(lambda body, n: body[3] + flat(size(turned(body[4], lever(body[2], n))))),
      "The lever comes in once; it comes in twice: once for the torque, once for the velocity of the point.",
      "What unit has each of your terms?"),
    M("inverse_effective_mass", "half the sum", lambda a, b, n: (soft(a, n) + soft(b, n)) / 2,
      "It is the mean of the two bodies; both give way, so that the terms add up.",
      "A ball hits one of its own mass, or a wall. What is the number for each?"),
    M("inverse_effective_mass", "masses added",
      lambda a, b, n: over(1, mass(a[3]) + mass(b[3]), 0) + turning(a, n) + turning(b, n),
      "1/(M_A + M_B) stands in place of 1/M_A + 1/M_B.",
      "What is left of it when B is immovable?"),
    M("inverse_effective_mass", "turning alone", both(lambda body, n: turning(body, n) + 0 * np.asarray(body[3])),
      "The masses make no difference: only the turning is there.",
      "What is the number where the normal goes through both centres?"),
    M("inverse_effective_mass", "lever from the wrong side",
      both(lambda body, n: body[3] + flat(dot(lever(body[2], n), np.cross(body[2], turned(body[4], n))))),
      "I⁻¹ acts on the normal, or on the result of both cross products. "
      "On slide 18 it acts on r × J, and slide 14's cross product follows.",
      "What does an impulse do to the spin: I⁻¹ of what?"),
    M("inverse_effective_mass", "(I⁻¹ r) × n",
      both(lambda body, n: body[3] + flat(dot(n, np.cross(np.cross(turned(body[4], body[2]), n), body[2])))),
      "I⁻¹ has to act on r × n, not on r.",
      "What does an impulse do to the spin: I⁻¹ of what?"),
    M("impulse_magnitude", "sign", size_with(factor=lambda e: 1 + e),
      "The minus is missing: the impulse drives the bodies into each other.",
      "They approach, u_n is negative. Which sign should j have, with n from B to A?"),
    M("impulse_magnitude", "e for 1 + e", size_with(factor=lambda e: -e),
      "e stands in place of 1 + e: for e = 0 no impulse stops them.",
      "How large must j be to stop them? And how much more to part them?"),
    M("impulse_magnitude", "1 − e", size_with(factor=lambda e: -(1 - e)),
      "1 − e stands in place of 1 + e: with e = 1 nothing happens at all.",
      "What should u_n be afterwards with e = 1?"),
    M("impulse_magnitude", "e − 1", size_with(factor=lambda e: 1 - e),
      "1 − e stands in place of −(1 + e): the brackets around 1 + e are lost, or its sign.",
      "Write −(1 + e) without brackets."),
    M("impulse_magnitude", "always perfect", size_with(factor=lambda e: -2 + 0 * e),
      "Every impact is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("impulse_magnitude", "no rebound", size_with(factor=lambda e: -1 + 0 * e),
      "The impulse stops them and no more: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("impulse_magnitude", "2 e", size_with(factor=lambda e: -2 * e),
      "2 e stands in place of 1 + e: right for e = 1, but for e = 0 nothing stops them.",
      "Try e = 0."),
    M("impulse_magnitude", "e squared", size_with(factor=lambda e: -(1 + e**2)),
      "e² is the share of the energy, or of the height; of the velocity it is e.",
      "Of which quantity is e the fraction?"),
    M("impulse_magnitude", "root of e", size_with(factor=lambda e: -(1 + np.sqrt(e))),
      "The root of e would be right if e were a share of the energy. It is one of the velocity.",
      "Of which quantity is e the fraction?"),
    M("impulse_magnitude", "loses e", size_with(factor=lambda e: -(2 - e)),
      "e is taken for the share that is lost; it is the share that is kept.",
      "What does e = 1 stand for?"),
    M("impulse_magnitude", "masses alone", size_with(below=both(share_alone)),
      "The terms with the inertia are missing: right only where the normal goes through both centres.",
      "Push a door near its hinge and at its handle. Which is easier?"),
    M("impulse_magnitude", "centres' velocities",
      size_with(speed=of_centres),
      "The velocities of the centres are used in place of those of the points of contact: "
      "the spin makes no difference.",
      "A ball spins on the spot and its rim touches a wall. Does it approach?"),
    M("impulse_magnitude", "r × ω", size_with(speed=crossed),
      "The velocities of the points have r × ω in place of ω × r.",
      "A wheel turns to the left, seen from above. Which way does its rightmost point move?"),
    M("impulse_magnitude", "sum of the velocities", size_with(speed=lambda a, b, n: flat(dot(point(a) + point(b), n))),
      "The velocities of the points are added in place of subtracted.",
      "Two bodies move side by side. Do they come nearer?"),
    M("impulse_magnitude", "A's velocity alone",
      size_with(speed=lambda a, b, n: flat(dot(point(a), n)) + 0 * closing(a, b, n)),
      "B's velocity makes no difference.",
      "B comes up to A, which is at rest. Do they collide?"),
    M("impulse_magnitude", "speed for normal velocity",
      size_with(speed=lambda a, b, n: -flat(size(point(a) - point(b)))),
      "The whole relative speed is used in place of its part along the normal.",
      "A puck grazes another. How large is the impulse?"),
    M("impulse_magnitude", "approach alone", size_with(speed=lambda a, b, n: np.minimum(closing(a, b, n), 0)),
      "It is guarded: of points that separate it is 0. Here j is to have no guard, `collide` has one.",
      "What does the description say of points that separate?"),
    M("impulse_magnitude", "size of j", lambda a, b, n, e: np.abs(magnitude(a, b, n, e)),
      "The sign of j is lost: of points that separate it is negative.",
      "What does the description say of points that separate?"),
    M("impulse_magnitude", "masses for their inverses",
      size_with(below=both(lambda body, n: mass(body[3]) + turning(body, n))),
      "The masses are in the denominator in place of their inverses: a heavy body would need a small impulse.",
      "What unit has each of the terms below the line?"),
    M("impulse_magnitude", "inertia for its inverse",
      size_with(below=both(inverted_once_more)),
      "The inverse inertia is inverted once more.",
      "What unit has each of the terms below the line?"),
    M("impulse_magnitude", "sign of the turning", size_with(below=both(lambda body, n: body[3] - turning(body, n))),
      "The terms with the inertia have the wrong sign, or one of the cross products the wrong order.",
      "Push a door near its hinge and at its handle. Which is easier?"),
    M("impulse_magnitude", "A alone below", size_with(below=lambda a, b, n: soft(a, n) + 0 * soft(b, n)),
      "Below the line B makes no difference: it is taken to be immovable.",
      "A ball hits one of its own mass, or a wall. Is the impulse the same?"),
    M("impulse_magnitude", "times, not over",
      lambda a, b, n, e: -(1 + np.asarray(e)) * closing(a, b, n) * (soft(a, n) + soft(b, n)),
      "It is multiplied with the inverse effective mass in place of divided by it.",
      "Heavier bodies: should the impulse be larger or smaller?"),
    M("impulse_magnitude", "not over anything",
      lambda a, b, n, e: -(1 + np.asarray(e)) * closing(a, b, n) + 0 * soft(a, n) + 0 * soft(b, n),
      "It is the change of the velocity: to become an impulse it has to be divided by what a unit impulse changes.",
      "What unit should come out?"),
    M("impulse_magnitude", "sum of the masses",
      size_with(below=lambda a, b, n: over(1, mass(a[3]) + mass(b[3]), 0) + turning(a, n) + turning(b, n)),
      "1/(M_A + M_B) stands in place of 1/M_A + 1/M_B.",
      "What is left of it when B is immovable?"),
    M("impulse_magnitude", "no inertia",
      size_with(below=both(lambda body, n: body[3] + flat(dot(lever(body[2], n), lever(body[2], n))))),
      "The inertia makes no difference: the lever is squared, but not multiplied with I⁻¹.",
      "Which part of the bodies makes no difference to your answer?"),
    M("impulse_magnitude", "first term alone below",
      lambda a, b, n, e: over(-(1 + np.asarray(e)) * closing(a, b, n), a[3], 0) + soft(a, n) - a[3] + soft(b, n),
      "It is divided by the first term alone, and the others are added: brackets are missing.",
      "Which terms stand below the line, and what does your line of code divide by?"),
    M("impulse_magnitude", "(I⁻¹ r) × n",
      size_with(below=both(
        lambda body, n: body[3] + flat(dot(n, np.cross(np.cross(turned(body[4], body[2]), n), body[2]))))),
      "Below the line I⁻¹ has to act on r × n, not on r.",
      "What does an impulse do to the spin: I⁻¹ of what?"),
    M("impulse_magnitude", "without the last cross product",
      size_with(below=both(lambda body, n: body[3] + flat(dot(n, turned(body[4], lever(body[2], n)))))),
      "The last × r is missing below the line: I⁻¹(r × n) is a change of spin, not yet one of the point's velocity.",
      "How does a change of spin change the velocity of the point?"),
    M("impulse_magnitude", "B taken away below", size_with(below=lambda a, b, n: soft(a, n) - soft(b, n)),
      "Below the line B's terms are taken away: "
      "its minus in the impulse and the minus of the relative velocity make a plus.",
      "Two equal bodies: is your denominator zero?"),
    M("impulse_magnitude", "masses left out below",
      size_with(below=both(lambda body, n: turning(body, n) + 0 * np.asarray(body[3]))),
      "Below the line the masses make no difference: only the turning is there.",
      "What is below the line where the normal goes through both centres?"),
    M("impulse_magnitude", "0/0",
      undivided,
      "Of two immovable bodies it divides by zero: no impulse stops them, and 0 is to be returned.",
      "What is below the line when both are immovable?"),
    M("apply_impulse", "+J to both", apply_with(b_sign=1),
      "+J went to both bodies, as the slide prints it: momentum is not conserved.",
      "Add up the momenta before and after."),
    M("apply_impulse", "swapped", lambda a, b, j: applied(a, b, -np.asarray(j)),
      "A gets −J and B gets +J: the impulse given is the one on A.",
      "On which body does the impulse given act?"),
    M("apply_impulse", "+J turns both", apply_with(b_turn=1),
      "B's spin changes by +J, as slide 18 prints it, or by J × r; B's velocity gets −J.",
      "Add up the angular momenta before and after."),
    M("apply_impulse", "+J moves both", apply_with(b_sign=1, b_turn=-1),
      "B's velocity changes by +J, as slide 18 prints it; B's spin gets −J.",
      "Add up the momenta before and after."),
    M("apply_impulse", "J × r", apply_with(change=change_with(angular=lambda s, k, r, j: turned(k, np.cross(j, r)))),
      "The cross product has the wrong order: it is r × J.",
      "Push a door at its handle. Which way does it turn?"),
    M("apply_impulse", "(I⁻¹ r) × J",
      apply_with(change=change_with(angular=lambda s, k, r, j: np.cross(turned(k, r), j))),
      "I⁻¹ has to act on r × J, not on r.",
      "What changes when the body is struck: L by r × J. And ω = I⁻¹ of what?"),
    M("apply_impulse", "r × (I⁻¹ J)",
      apply_with(change=change_with(angular=lambda s, k, r, j: np.cross(r, turned(k, j)))),
      "I⁻¹ has to act on r × J, not on J.",
      "What changes when the body is struck: L by r × J. And ω = I⁻¹ of what?"),
    M("apply_impulse", "no inverse inertia",
      apply_with(change=change_with(angular=lambda s, k, r, j: np.cross(r, j) + 0 * turned(k, r))),
      "The spin changes by r × J: the inverse inertia is missing.",
      "Which part of the bodies makes no difference to your answer?"),
    M("apply_impulse", "inertia for its inverse",
      apply_with(change=change_with(angular=lambda s, k, r, j: turned(inertia(k), np.cross(r, j)))),
      "The inverse inertia is inverted once more.",
      "A body that is hard to turn: does its spin change more or less?"),
    M("apply_impulse", "mass for its inverse",
      apply_with(change=change_with(linear=lambda s, k, r, j: col(mass(s)) * j)),
      "The velocity changes by the impulse times the mass, or over its inverse: a heavy body should change less.",
      "What unit has J/M?"),
    M("apply_impulse", "no mass", apply_with(change=change_with(linear=lambda s, k, r, j: j + 0 * col(s))),
      "The velocity changes by the impulse itself: the mass is missing.",
      "What unit has J?"),
    M("apply_impulse", "no spin",
      apply_with(change=without_spin),
      "The spins do not change: off the centre an impulse turns the body as well.",
      "Which parts of the bodies make no difference to your answer?"),
    M("apply_impulse", "mass for the inertia",
      apply_with(change=change_with(angular=lambda s, k, r, j: col(s) * np.cross(r, j) + 0 * turned(k, r))),
      "The change of the spin is divided by the mass in place of the inertia.",
      "Which part of the bodies makes no difference to your answer?"),
    M("apply_impulse", "diagonal of the inertia",
      apply_with(change=change_with(angular=lambda s, k, r, j: np.diagonal(k, axis1=-2, axis2=-1) * np.cross(r, j))),
      "Only the diagonal of the inverse inertia is used: a body that does not stand along the axes has more.",
      "What does the inverse inertia of a turned box look like?"),
    M("apply_impulse", "A alone",
      lambda a, b, j: (*applied(a, b, j)[:2], b[0] + 0 * np.asarray(j), b[1] + 0 * np.asarray(j)),
      "B does not change.",
      "What does Newton's third law say of the two?"),
    M("apply_impulse", "changes alone",
      lambda a, b, j: tuple(new - old for new, old in zip(applied(a, b, j), (a[0], a[1], b[0], b[1]), strict=True)),
      "They are the changes alone: the velocities from before are lost.",
      "What should come out when there is no impulse?"),
    M("apply_impulse", "A's arm for both",
      lambda a, b, j: (*applied(a, b, j)[:3], b[1] - turned(b[4], np.cross(a[2], j))),
      "B's spin is found with A's arm; each body has its own, from its own centre.",
      "How far is B's centre from the contact?"),
    M("apply_impulse", "A's mass for both",
      lambda a, b, j: (*applied(a, b, j)[:2], b[0] - col(a[3]) * j, applied(a, b, j)[3]),
      "B's velocity is found with A's mass.",
      "A ball hits a wall. How does the wall change?"),
    M("apply_impulse", "inertia transformed twice",
      apply_with(change=change_with(angular=lambda s, k, r, j: turned(k, turned(k, np.cross(r, j))))),
      "The inverse inertia comes in twice.",
      "What unit has I⁻¹(r × J)?"),
    M("apply_impulse", "−J to both", lambda a, b, j: applied(a, b, -np.asarray(j), b_sign=1),
      "−J went to both bodies: momentum is not conserved.",
      "Add up the momenta before and after."),
    M("apply_impulse", "half each", lambda a, b, j: applied(a, b, np.asarray(j) / 2),
      "Each body gets half; the same J acts on both.",
      "You push a friend with 100 N. With how much are you pushed?"),
    M("apply_impulse", "size of the impulse", lambda a, b, j: applied(a, b, np.abs(j)),
      "The components of the impulse lose their signs.",
      "What should become of A if the impulse points down?"),
    M("apply_impulse", "no arm",
      apply_with(change=change_with(angular=lambda s, k, r, j: turned(k, np.asarray(j)) + 0 * np.asarray(r))),
      "The spin changes by I⁻¹ J: the arm is missing, and an impulse through the centre would turn the body.",
      "What unit has L, and what unit has J?"),
    M("apply_impulse", "component by component",
      apply_with(change=change_with(angular=lambda s, k, r, j: turned(k, np.asarray(r) * j))),
      "Arm and impulse are multiplied component by component; it is a cross product.",
      "About which axis does an impulse along z turn a body whose arm is along x?"),
    M("apply_impulse", "lever shares it", apply_with(change=along_the_arm),
      "Only the part of the impulse along the arm moves the body, as if the rest were used up for turning. "
      "All of it does both.",
      "A rod in space is struck at its end. How much momentum has it afterwards?"),
    M("collide", "+J to both", collide_with(apply=apply_with(b_sign=1)),
      "+J went to both bodies, as slide 18 prints it: momentum is not conserved.",
      "Add up the momenta before and after."),
    M("collide", "no guard", collide_with(hits=lambda u, t: np.isfinite(u + np.asarray(t))),
      "An impulse is given whether or not they approach: bodies that part are pulled back.",
      "What should become of bodies that move apart?"),
    M("collide", "guard turned round", collide_with(hits=lambda u, t: u > np.asarray(t)),
      "The test is the slide's V_rel > threshold, which presumes a normal from A to B: "
      "bodies that approach go through each other.",
      "Which sign has u_n of bodies that approach, with the normal from B to A?"),
    M("collide", "threshold left out", collide_with(hits=lambda u, t: u < 0 * np.asarray(t)),
      "The threshold makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("collide", "at the threshold", collide_with(hits=lambda u, t: u <= -np.asarray(t)),
      "At exactly the threshold they collide; up to and with it they rest.",
      "What does the description say of a closing speed that is just the threshold?"),
    M("collide", "threshold's sign", collide_with(hits=lambda u, t: u < np.asarray(t)),
      "The threshold lacks its minus, or only V_rel above it is counted as separating: "
      "bodies that rest, and some that move apart, are said to collide.",
      "On slide 21, which velocities lie between the two tests?"),
    M("collide", "e for 1 + e", collide_with(j_of=size_with(factor=lambda e: -e)),
      "e stands in place of 1 + e: for e = 0 nothing stops them.",
      "How large must j be to stop them? And how much more to part them?"),
    M("collide", "always perfect", collide_with(j_of=size_with(factor=lambda e: -2 + 0 * e)),
      "Every impact is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("collide", "no rebound", collide_with(j_of=size_with(factor=lambda e: -1 + 0 * e)),
      "The impulse stops them and no more: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("collide", "sign of j", collide_with(j_of=size_with(factor=lambda e: 1 + e)),
      "The impulse has the wrong sign: it drives the bodies into each other.",
      "Which way must A be pushed, with the normal from B to A?"),
    M("collide", "1 − e", collide_with(j_of=size_with(factor=lambda e: -(1 - e))),
      "1 − e stands in place of 1 + e: with e = 1 nothing happens at all.",
      "What should u_n be afterwards with e = 1?"),
    M("collide", "masses alone below", one_dimension,
      "Below the line the terms with the inertia are missing: the impulse is too large wherever the bodies turn.",
      "How fast do the points part after your impact?"),
    M("collide", "bodies do not turn",
      collide_with(j_of=size_with(below=both(share_alone)), apply=apply_with(change=without_spin)),
      "The bodies are treated as points: nothing turns.",
      "Which parts of the bodies make no difference to your answer?"),
    M("collide", "no spin",
      collide_with(apply=apply_with(change=without_spin)),
      "The spins do not change: off the centre an impulse turns the body as well.",
      "Add up the angular momenta before and after."),
    M("collide", "J × r",
      collide_with(apply=apply_with(change=change_with(angular=lambda s, k, r, j: turned(k, np.cross(j, r))))),
      "The spin is changed by J × r in place of r × J.",
      "Push a door at its handle. Which way does it turn?"),
    M("collide", "(I⁻¹ r) × J",
      collide_with(apply=apply_with(change=change_with(angular=lambda s, k, r, j: np.cross(turned(k, r), j)))),
      "I⁻¹ has to act on r × J, not on r.",
      "What changes when the body is struck: L by r × J. And ω = I⁻¹ of what?"),
    M("collide", "no inverse inertia",
      collide_with(apply=apply_with(change=change_with(angular=lambda s, k, r, j: np.cross(r, j) + 0 * turned(k, r)))),
      "The spin changes by r × J: the inverse inertia is missing.",
      "How fast do the points part after your impact?"),
    M("collide", "centres' velocities",
      collide_with(j_of=size_with(speed=of_centres), speed=of_centres),
      "The velocities of the centres are used in place of those of the points of contact: "
      "the spin makes no difference to the impact.",
      "A ball spins on the spot and its rim touches a wall. Does it approach?"),
    M("collide", "each for itself", separate_impulses,
      "Each body gets an impulse of its own, as if it had hit a wall: they are not equal and opposite.",
      "Add up the momenta before and after."),
    M("collide", "normal velocities swapped", swapped_normals,
      "The normal velocities are swapped: right for two equal balls without spin and with e = 1 only.",
      "A light ball hits a heavy one. What then?"),
    M("collide", "impulse halved", collide_with(j_of=lambda a, b, n, e: magnitude(a, b, n, e) / 2),
      "The impulse is shared out, half to each body; the same J acts on both.",
      "How fast do the points part after your impact?"),
    M("collide", "r × ω",
      collide_with(j_of=size_with(speed=crossed), speed=crossed),
      "The velocities of the points have r × ω in place of ω × r.",
      "A wheel turns to the left, seen from above. Which way does its rightmost point move?"),
    M("collide", "0/0",
      collide_with(j_of=undivided),
      "Two immovable bodies: it divides by zero. No impulse stops them, and they are to stay unchanged.",
      "What is below the line when both are immovable?"),
    M("collide", "unchanged",
      collide_with(j_of=lambda a, b, n, e: 0 * magnitude(a, b, n, e)),
      "The velocities come back unchanged: nothing has been answered.",
      "What should be different afterwards?"),
    M("collide", "masses for their inverses",
      collide_with(j_of=size_with(below=both(lambda body, n: mass(body[3]) + turning(body, n)))),
      "Below the line the masses stand in place of their inverses.",
      "What unit has each of the terms below the line?"),
)
# fmt: on
