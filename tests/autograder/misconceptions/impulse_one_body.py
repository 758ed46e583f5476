"""Known mistakes about one of the two bodies of an impact: one arm for both, or a term of one body lost or turned."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import dot, flat, formulas_of

BODIES = formulas_of("impulse_bodies")
closing, denominator, magnitude, soft, turning = (
    getattr(BODIES, name) for name in ("closing", "denominator", "magnitude", "soft", "turning")
)
applied, point, size_with, both = BODIES.applied, BODIES.point, BODIES.size_with, BODIES.both
collide = BODIES.collide_with()


def with_arm_of(other, body):
    """A body whose arm is the other's."""
    return *body[:2], other[2] + 0 * np.asarray(body[2]), *body[3:]


def arm_of_a(function):
    """One r for both bodies: A's."""
    return lambda a, b, *given: function(a, with_arm_of(a, b), *given)


def arm_of_b(function):
    """One r for both bodies: B's."""
    return lambda a, b, *given: function(with_arm_of(b, a), b, *given)


def unturnable(body):
    """A body of infinite inertia."""
    return *body[:4], 0 * np.asarray(body[4])


def centred(body):
    """A body that is touched at its centre."""
    return *body[:2], 0 * np.asarray(body[2]), *body[3:]


def arm_left_out(function, of_a=False, of_b=False):
    return lambda a, b, *given: function(centred(a) if of_a else a, centred(b) if of_b else b, *given)


def only_a_turns(function):
    return lambda a, b, *given: function(a, unturnable(b), *given)


def only_b_turns(function):
    return lambda a, b, *given: function(unturnable(a), b, *given)


def speed(cross_a=1, cross_b=1):
    """The normal velocity with one of the two cross products turned round, or left out."""
    return lambda a, b, n: flat(dot(point(a, cross=cross_a) - point(b, cross=cross_b), n))


def less_turning_of_a(a, b, n):
    return soft(a, n) - 2 * turning(a, n) + soft(b, n)


def less_turning_of_b(a, b, n):
    return soft(a, n) + soft(b, n) - 2 * turning(b, n)


def on_normal(body, n):
    """n·((r × (I⁻¹ n)) × r) for the turning."""
    _, _, r, share, k = body
    return share + flat(dot(n, np.cross(np.cross(r, BODIES.turned(k, n)), r)))


def turned_round_on_a(a, b, j):
    """J × r on A, r × J on B."""
    v_a, w_a, v_b, w_b = applied(a, b, j)
    return v_a, 2 * np.asarray(a[1]) - w_a, v_b, w_b


def inertia_left_out(of_a=False, of_b=False):
    """The change of one body's spin is r × J itself."""
    return lambda a, b, j: applied(of_unit_inertia(a) if of_a else a, of_unit_inertia(b) if of_b else b, j)


def of_unit_inertia(body):
    return *body[:4], np.eye(3) + 0 * np.asarray(body[4])


ONE_ARM = "There is one r for both bodies: {0}'s. On slide 14 each r begins at the centre of its own body."
EACH_CENTRE = "How far is the contact from A's centre, and how far from B's?"
NO_TURN = "{0}'s inertia is not used, as if {0} could not turn. On slide 18 the spins of both bodies change."
NO_ARM = (
    "{0}'s arm is used nowhere, as if the contact were at {0}'s centre: "
    "its spin does not move the contact on slide 14, and the impulse does not turn it on slide 18."
)
NO_INERTIA = "{0}'s spin changes by r × J itself: its inverse inertia is missing. Slide 18 has one for each body."
SWAP = "Swap the two bodies, and turn the normal round. Should the result change?"
TURNS_BACK = ("{0}'s term with the inertia has the wrong sign, or one of its two cross products the wrong order. "
              "On slide 20 both bodies give way.")  # fmt: skip
WRONG_ORDER = "The velocity of {0}'s point has r × ω in place of slide 14's ω × r; the other body's is right."
WHEEL = "A wheel turns to the left, seen from above. Which way does its rightmost point move?"
ONE_SPIN = "The spin of {0} is left out of the velocity of its point. Slide 14 has it for both bodies."


def below(text, body):
    """A rationale about the denominator."""
    said = text.format(body)
    return "Below the line, " + (said if said.startswith(body) else said[0].lower() + said[1:])


# fmt: off
BANK = (
    M("normal_velocity", "A's arm for both", arm_of_a(closing), ONE_ARM.format("A"), EACH_CENTRE),
    M("normal_velocity", "B's arm for both", arm_of_b(closing), ONE_ARM.format("B"), EACH_CENTRE),
    M("normal_velocity", "r × ω on A", speed(cross_a=-1), WRONG_ORDER.format("A"), WHEEL),
    M("normal_velocity", "r × ω on B", speed(cross_b=-1), WRONG_ORDER.format("B"), WHEEL),
    M("normal_velocity", "only A's spin counts", speed(cross_b=0), ONE_SPIN.format("B"), SWAP),
    M("normal_velocity", "only B's spin counts", speed(cross_a=0), ONE_SPIN.format("A"), SWAP),
    M("inverse_effective_mass", "A's arm for both", arm_of_a(denominator), ONE_ARM.format("A"), EACH_CENTRE),
    M("inverse_effective_mass", "B's arm for both", arm_of_b(denominator), ONE_ARM.format("B"), EACH_CENTRE),
    M("inverse_effective_mass", "only A turns", only_a_turns(denominator), NO_TURN.format("B"), SWAP),
    M("inverse_effective_mass", "only B turns", only_b_turns(denominator), NO_TURN.format("A"), SWAP),
    M("inverse_effective_mass", "A's turning taken away", less_turning_of_a, TURNS_BACK.format("A"), SWAP),
    M("impulse_magnitude", "A's arm for both", arm_of_a(magnitude), ONE_ARM.format("A"), EACH_CENTRE),
    M("impulse_magnitude", "B's arm for both", arm_of_b(magnitude), ONE_ARM.format("B"), EACH_CENTRE),
    M("impulse_magnitude", "A's arm for both below", size_with(below=arm_of_a(denominator)),
      below(ONE_ARM, "A"), EACH_CENTRE),
    M("impulse_magnitude", "B's arm for both below", size_with(below=arm_of_b(denominator)),
      below(ONE_ARM, "B"), EACH_CENTRE),
    M("impulse_magnitude", "A's arm for both points", size_with(speed=arm_of_a(closing)),
      "Above the line, the velocities of both points are found with A's arm. "
      "On slide 14 each r begins at the centre of its own body.", EACH_CENTRE),
    M("impulse_magnitude", "B's arm for both points", size_with(speed=arm_of_b(closing)),
      "Above the line, the velocities of both points are found with B's arm. "
      "On slide 14 each r begins at the centre of its own body.", EACH_CENTRE),
    M("impulse_magnitude", "only A turns below", size_with(below=only_a_turns(denominator)),
      below(NO_TURN, "B"), SWAP),
    M("impulse_magnitude", "only B turns below", size_with(below=only_b_turns(denominator)),
      below(NO_TURN, "A"), SWAP),
    M("impulse_magnitude", "A's turning taken away below", size_with(below=less_turning_of_a),
      below(TURNS_BACK, "A"), SWAP),
    M("impulse_magnitude", "B's turning taken away below", size_with(below=less_turning_of_b),
      below(TURNS_BACK, "B"), SWAP),
    M("impulse_magnitude", "r × ω on A", size_with(speed=speed(cross_a=-1)), WRONG_ORDER.format("A"), WHEEL),
    M("impulse_magnitude", "r × ω on B", size_with(speed=speed(cross_b=-1)), WRONG_ORDER.format("B"), WHEEL),
    M("impulse_magnitude", "only A's spin counts", size_with(speed=speed(cross_b=0)), ONE_SPIN.format("B"), SWAP),
    M("impulse_magnitude", "only B's spin counts", size_with(speed=speed(cross_a=0)), ONE_SPIN.format("A"), SWAP),
    M("impulse_magnitude", "r × (I⁻¹ n)", size_with(below=both(on_normal)),
      "Below the line, I⁻¹ acts on the normal, or on the result of both cross products. "
      "On slide 18 it acts on r × J, and slide 14's cross product follows.",
      "What does an impulse do to the spin: I⁻¹ of what?"),
    M("impulse_magnitude", "B's arm left out", arm_left_out(magnitude, of_b=True), NO_ARM.format("B"), SWAP),
    M("impulse_magnitude", "A's arm left out", arm_left_out(magnitude, of_a=True), NO_ARM.format("A"), SWAP),
    M("apply_impulse", "only A turns", only_a_turns(applied), NO_TURN.format("B"),
      "Add up the angular momenta before and after."),
    M("apply_impulse", "only B turns", only_b_turns(applied), NO_TURN.format("A"),
      "Add up the angular momenta before and after."),
    M("apply_impulse", "no inverse inertia on A", inertia_left_out(of_a=True), NO_INERTIA.format("A"),
      "Which part of A does your answer not depend on?"),
    M("apply_impulse", "no inverse inertia on B", inertia_left_out(of_b=True), NO_INERTIA.format("B"),
      "Which part of B does your answer not depend on?"),
    M("apply_impulse", "J × r on A", turned_round_on_a,
      "A's spin is changed by J × r, B's by r × J. The order of slide 18's cross product matters for both.",
      "Push a door at its handle. Which way does it turn?"),
    M("apply_impulse", "B's arm for both", lambda a, b, j: applied(with_arm_of(b, a), b, j),
      "A's spin is found with B's arm. On slide 18 each body has its own, from its own centre.", EACH_CENTRE),
    M("collide", "A's arm for both", arm_of_a(collide), ONE_ARM.format("A"), EACH_CENTRE),
    M("collide", "B's arm for both", arm_of_b(collide), ONE_ARM.format("B"), EACH_CENTRE),
    M("collide", "only A turns", only_a_turns(collide), NO_TURN.format("B"), SWAP),
    M("collide", "only B turns", only_b_turns(collide), NO_TURN.format("A"), SWAP),
    M("collide", "J × r on A", BODIES.collide_with(apply=turned_round_on_a),
      "A's spin is changed by J × r, B's by r × J. The order of slide 18's cross product matters for both.",
      "Push a door at its handle. Which way does it turn?"),
    M("collide", "B's arm left out", arm_left_out(collide, of_b=True), NO_ARM.format("B"), SWAP),
    M("collide", "A's arm left out", arm_left_out(collide, of_a=True), NO_ARM.format("A"), SWAP),
    M("collide", "r × ω on A", BODIES.collide_with(j_of=size_with(speed=speed(cross_a=-1)), speed=speed(cross_a=-1)),
      WRONG_ORDER.format("A"), WHEEL),
    M("collide", "r × ω on B", BODIES.collide_with(j_of=size_with(speed=speed(cross_b=-1)), speed=speed(cross_b=-1)),
      WRONG_ORDER.format("B"), WHEEL),
    M("collide", "only A's spin counts",
      BODIES.collide_with(j_of=size_with(speed=speed(cross_b=0)), speed=speed(cross_b=0)), ONE_SPIN.format("B"), SWAP),
    M("collide", "only B's spin counts",
      BODIES.collide_with(j_of=size_with(speed=speed(cross_a=0)), speed=speed(cross_a=0)), ONE_SPIN.format("A"), SWAP),
)
# fmt: on
