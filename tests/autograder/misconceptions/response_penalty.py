"""Known mistakes in responding to a collision with a plane by a spring and a dashpot."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col


def pushing(push, clamp=True, inside=lambda s: np.asarray(s) < 0):
    def force(s, v, n, k, c=0.0, adhesive=False):
        found = push(np.asarray(s), np.asarray(v), k, c)
        found = np.maximum(found, 0) if clamp and not adhesive else found
        return col(np.where(inside(s), found, 0.0)) * n

    return force


def right(s, v, k, c):
    return -k * s - c * v


def clamps_always(s, v, n, k, c=0.0, adhesive=False):
    return pushing(right)(s, v, n, k, c, False)


def clamps_spring_alone(s, v, n, k, c=0.0, adhesive=False):
    """Without asking whether there is contact: the dashpot acts at a distance."""
    push = k * np.maximum(-np.asarray(s), 0) - c * np.asarray(v)
    return col(push if adhesive else np.maximum(push, 0)) * n


def without_contact(s, v, n, k, c=0.0, adhesive=False):
    push = right(np.asarray(s), np.asarray(v), k, c)
    return col(push if adhesive else np.maximum(push, 0)) * n


def spring_and_nothing_else(s, v, n, k, c=0.0, adhesive=False):
    return col(k * np.asarray(s) + 0 * np.asarray(v) * c) * n


def depth_and_nothing_else(s, v, n, k, c=0.0, adhesive=False):
    return col(-k * np.asarray(s) + 0 * np.asarray(v) * c) * n


def adhesion_turned(s, v, n, k, c=0.0, adhesive=False):
    return pushing(right)(s, v, n, k, c, not adhesive)


def number(s, v, n, k, c=0.0, adhesive=False):
    """Everything in z, whatever the normal."""
    return pushing(right)(s, v, 0 * np.asarray(n) + np.array([0, 0, 1]), k, c, adhesive)


def omega(m, k):
    return np.sqrt(k / m)


def ratio(m, k, c):
    return c / (2 * np.sqrt(k * m))


def shortened(z):
    """√(1 + ζ²) − ζ with all its digits: a mistake in ω or ζ is not also that of losing them."""
    return 1 / (np.sqrt(1 + np.square(z)) + z)


def limit(size):
    return lambda m, k, c=0.0: size(omega(m, k), ratio(m, k, c), m, c)


# fmt: off
BANK = (
    M("penalty_force", "the slide's spring", spring_and_nothing_else,
      "It is the slide's F = k d with the signed distance for d: it pulls a body behind the plane deeper in, "
      "and there is neither damping nor an end of the contact.",
      "Which way does your force point when the body is inside?"),
    M("penalty_force", "spring without an end", depth_and_nothing_else,
      "The spring alone, and always there: in front of the plane it pulls the body in, and nothing is damped.",
      "What is the force on a body that does not touch?"),
    M("penalty_force", "no damping", pushing(lambda s, v, k, c: -k * s + 0 * v * c),
      "The damping makes no difference: nothing ever loses energy.",
      "Which arguments make no difference to your answer?"),
    M("penalty_force", "damping drives", pushing(lambda s, v, k, c: -k * s + c * v),
      "The dashpot has the wrong sign: it pushes less while the body moves in and more on its way out, "
      "so that every bounce gains energy.",
      "The body moves in, v_n is negative. Should the force be larger or smaller than the spring's?"),
    M("penalty_force", "damping of the speed", pushing(lambda s, v, k, c: -k * s + c * np.abs(v)),
      "The dashpot pushes out whichever way the body moves; on the way out it has to hold back.",
      "What does a dashpot do to a body that moves out?"),
    M("penalty_force", "damping on the way in alone", pushing(lambda s, v, k, c: -k * s - c * np.minimum(v, 0)),
      "The dashpot acts on the way in only.",
      "What does a dashpot do to a body that moves out?"),
    M("penalty_force", "pulls", pushing(right, clamp=False),
      "There is no clamp: on its way out the dashpot holds the body back, as if the plane were sticky.",
      "Can a floor pull?"),
    M("penalty_force", "never pulls", clamps_always,
      "The clamp is always there: with adhesion the contact may pull.",
      "Which argument makes no difference to your answer?"),
    M("penalty_force", "adhesion turned round", adhesion_turned,
      "`adhesive` is the wrong way round: where it is true the contact may pull.",
      "What should the flag allow?"),
    M("penalty_force", "acts at a distance", without_contact,
      "The force is not limited to contact: it acts in front of the plane as well.",
      "What is the force on a body that does not touch?"),
    M("penalty_force", "dashpot at a distance", clamps_spring_alone,
      "The spring ends where the contact does, but the dashpot brakes a body that has not arrived.",
      "What is the force on a body that does not touch?"),
    M("penalty_force", "acts in front", pushing(lambda s, v, k, c: k * s - c * v, inside=lambda s: np.asarray(s) > 0),
      "The sign of the separation is turned round: the force acts in front of the plane and not behind it.",
      "Which sign has the separation of a body that is in the wall?"),
    M("penalty_force", "into the plane",
      lambda s, v, n, k, c=0.0, adhesive=False: -pushing(right)(s, v, n, k, c, adhesive),
      "The force points into the plane.",
      "Where does the normal point to, and where should the body go?"),
    M("penalty_force", "half the spring", pushing(lambda s, v, k, c: -k * s / 2 - c * v),
      "½ k d² is the energy of a spring; its force is k d.",
      "What is the derivative of ½ k d²?"),
    M("penalty_force", "depth squared", pushing(lambda s, v, k, c: k * s**2 - c * v),
      "The spring's force grows with the square of the depth; Hooke's grows with the depth.",
      "Twice as deep: how much more force?"),
    M("penalty_force", "up whatever the normal", number,
      "The force points up, whatever the normal: right for a floor, for no other plane.",
      "Which argument makes no difference to your answer?"),
    M("penalty_force", "dashpot at the first touch", pushing(right, inside=lambda s: np.asarray(s) <= 0),
      "At the instant of touching, at depth zero, the dashpot acts already; the contact begins behind the plane.",
      "What does the description say of s = 0?"),
    M("penalty_force", "normal twice",
      lambda s, v, n, k, c=0.0, adhesive=False: pushing(right)(s, v, np.asarray(n) * np.abs(n), k, c, adhesive),
      "The normal comes in twice, component by component.",
      "How long is the force on a plane that leans, and how long on a floor?"),

    M("penalty_step_limit", "damping left out", limit(lambda w, z, m, c: 2 / w + 0 * np.asarray(z)),
      "2/ω is the limit without damping. In a penalty contact the dashpot makes the step shorter.",
      "Which argument makes no difference to your answer?"),
    M("penalty_step_limit", "damping helps", limit(lambda w, z, m, c: 2 / w * (np.sqrt(1 + z**2) + z)),
      "ζ has the wrong sign: damping would allow longer steps. With semi-implicit Euler it shortens them.",
      "What happens to the limit when the damping grows?"),
    M("penalty_step_limit", "1/ω", limit(lambda w, z, m, c: shortened(z) / w),
      "A factor of 2 is missing.",
      "What is the limit without damping?"),
    M("penalty_step_limit", "implicit damping",
      limit(lambda w, z, m, c: 2 / w * (np.sqrt(np.maximum(1 - z**2, 0)) + 0 * z)),
      "√(1 − ζ²) belongs to the frequency of a damped oscillation. It ends at ζ = 1, the limit does not.",
      "What is the limit for ζ = 2?"),
    M("penalty_step_limit", "root of 1 + ζ alone", limit(lambda w, z, m, c: 2 / w * (np.sqrt(1 + z) - z)),
      "Under the root ζ is not squared.",
      "What should the limit be close to for a lot of damping?"),
    M("penalty_step_limit", "ω squared",
      lambda m, k, c=0.0: 2 * m / k * shortened(ratio(m, k, c)),
      "k/m is ω², not ω: the root is missing.",
      "What unit has m/k?"),
    M("penalty_step_limit", "ω upside down",
      lambda m, k, c=0.0: 2 / np.sqrt(m / k) * shortened(ratio(m, k, c)),
      "The ratio of stiffness and mass is upside down: a stiffer contact would allow longer steps.",
      "Double the stiffness. Should the limit grow or fall?"),
    M("penalty_step_limit", "ζ without the 2",
      lambda m, k, c=0.0: 2 / omega(m, k) * shortened(2 * ratio(m, k, c)),
      "The damping ratio is c/(2√(k m)); the 2 is missing.",
      "At which c is the damping critical?"),
    M("penalty_step_limit", "ζ without the root",
      lambda m, k, c=0.0: 2 / omega(m, k) * shortened(c / (2 * k * m)),
      "The damping ratio is c/(2√(k m)); the root is missing.",
      "Has your ζ a unit?"),
    M("penalty_step_limit", "period", limit(lambda w, z, m, c: 2 * np.pi / w + 0 * np.asarray(z)),
      "2π/ω is the period of the oscillation, not the longest step.",
      "What is the limit without damping?"),
    M("penalty_step_limit", "explicit Euler",
      lambda m, k, c=0.0: np.asarray(c) / k + 0 * np.asarray(m),
      "c/k is the limit of explicit Euler on a damped spring: without damping it allows no step at all. "
      "Asked for is semi-implicit Euler, which holds an undamped one.",
      "Which method uses the new velocity to find the new place?"),
    M("penalty_step_limit", "damping alone", limit(lambda w, z, m, c: 2 / (w * (1 + z))),
      "It has the right ends, 2/ω and nearly none, but in between it is only near the truth.",
      "Which root does the description have?"),
    M("penalty_step_limit", "no root", limit(lambda w, z, m, c: 2 / w * (1 + z**2 - z)),
      "The root is missing: √(1 + ζ²).",
      "What should the limit be close to for a lot of damping?"),
    M("penalty_step_limit", "ζ not taken away", limit(lambda w, z, m, c: 2 / w * np.sqrt(1 + z**2)),
      "ζ is not taken away from the root: damping would allow longer steps.",
      "What happens to the limit when the damping grows?"),
)
# fmt: on
