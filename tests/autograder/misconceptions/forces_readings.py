"""Slips and loose readings about forces: rounded constants, thresholds, one-sided dampers, springs miscounted."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, dot, formulas_of, size

FORCES, SPRINGS = formulas_of("forces"), formulas_of("forces_springs")


def as_it_came(p, v, a, dt):
    """The results are of the kind of what was given, and whole numbers are cut off."""
    found = FORCES.step(lambda v, a, dt: v * dt, lambda v, a, dt: a * dt)(p, v, a, dt)
    kinds = (np.asarray(given).dtype for given in (p, v))
    return tuple(each.astype(kind) for each, kind in zip(found, kinds, strict=True))


def far_apart_alone(m1, m2, x1, x2, softening=0.0):
    """Bodies within a millimetre are at the same place."""
    near = size(np.asarray(x2, dtype=float) - x1) < 1e-3
    return np.where(near, 0.0, FORCES.pull()(m1, m2, x1, x2, softening))


def along_own_motion(v, u, viscosity, radius):
    """The speeds are subtracted, and the drag is along the ball's own velocity."""
    v = np.asarray(v, dtype=float)
    size_of = 6 * np.pi * col(np.multiply(viscosity, radius)) * (size(v) - size(np.asarray(u, dtype=float)))
    return -size_of * direction(v)


def never_pushes(x1, x2, v1, v2, k, rest, c):
    """Spring and damper together pull or do nothing."""
    u = direction(np.asarray(x1, dtype=float) - x2)
    return np.minimum(dot(SPRINGS.spring()(x1, x2, v1, v2, k, rest, c), u), 0.0) * u


def nearly_unit(little):
    """The vector between the ends over a little more than its length."""
    return SPRINGS.spring(way=lambda d: d / (size(d) + little))


# The sum of all forces: which springs, and with which numbers


def counted(which, index=lambda at, ball, springs: at, of=(0, 1, 2)):
    """Some of the springs. index: where each one's numbers are looked up. of: which of the three numbers there."""

    def force(x, v, m, r, g, viscosity, stream, ends, *numbers):
        ends = np.asarray(ends, dtype=int)
        looked = [index(at, int(ball), len(ends)) for at, ball in enumerate(ends[:, 0])]
        numbers = [
            np.asarray(each, dtype=float)[looked if place in of else slice(None)] if len(ends) else np.zeros(0)
            for place, each in enumerate(numbers)
        ]
        kept = [at for at, pair in enumerate(ends) if which(at, pair, len(ends))]
        chosen = (np.asarray(each)[kept] for each in numbers)
        return SPRINGS.total()(x, v, m, r, g, viscosity, stream, ends[kept], *chosen)

    return force


def every_spring(at, pair, springs):
    return True


def of_the_ball(at, ball, springs):
    return min(ball, springs - 1)


def once_for_each_spring(x, v, m, r, g, viscosity, stream, ends, k, rest, c):
    """Weight and drag are added wherever a spring is."""
    alone = SPRINGS.total(used=lambda ends: ends[:0])(x, v, m, r, g, viscosity, stream, ends, k, rest, c)
    pulled = SPRINGS.springs_alone(x, v, m, r, g, viscosity, stream, ends, k, rest, c)
    how_often = np.bincount(np.asarray(ends, dtype=int).ravel(), minlength=len(alone))
    return pulled + how_often[:, None] * alone


# fmt: off
BANK = (
    M("explicit_euler", "whole numbers stay whole", as_it_came,
      "The results are arrays of the same kind as what was given, as `empty_like` and `zeros_like` make them. From"
      " whole numbers come whole numbers, and what is behind the point is lost.",
      "A body at (0, 0, 0) moves with (1, 0, 0) for half a second, all in whole numbers. Where is it?"),
    M("universal_gravity", "softening added to the distance", FORCES.pull(
        power=2, way=direction, softened=lambda r, e: r + e),
      "The softening length is added to the distance, and the force is G m1 m2/(d + ε)². The energy in the description"
      " has the root of the sum of their squares.",
      "How large is √(d² + ε²) for d = 3 m and ε = 4 m?"),
    M("universal_gravity", "nearer than a tolerance", far_apart_alone,
      "Bodies that are very near to each other are taken to be at the same place, where nothing pulls. Unsoftened,"
      " they pull each other the harder, the nearer they are.",
      "Let the whole scene be a thousandth of a millimetre wide. What does your function return?"),
    M("universal_gravity", "G to three digits", FORCES.pull(factor=6.67e-11),
      "Everything is right except for the constant of gravity, which is rounded to 6.67 · 10⁻¹¹. The lab has more"
      " of its digits.",
      "By which factor is your force wrong, and is it the same everywhere? What is the lab's constant called?"),
    M("universal_gravity", "G to four digits", FORCES.pull(factor=6.674e-11),
      "Everything is right except for the constant of gravity, which is rounded to 6.674 · 10⁻¹¹. The lab has more"
      " digits of it.",
      "By which factor is your force wrong, and is it the same everywhere? What is the lab's constant called?"),
    M("spring_damper_force", "damper against lengthening alone", SPRINGS.spring(
        damper=lambda c, w, u: -c * np.maximum(dot(w, u), 0.0) * u),
      "The damper acts only while the spring becomes longer. It resists every change of the length.",
      "Press the two ends together, quickly. What does the damper do?"),
    M("spring_damper_force", "damper against shortening alone", SPRINGS.spring(
        damper=lambda c, w, u: -c * np.minimum(dot(w, u), 0.0) * u),
      "The damper acts only while the spring becomes shorter. It resists every change of the length.",
      "Pull the two ends apart, quickly. What does the damper do?"),
    M("spring_damper_force", "never pushes, damper included", never_pushes,
      "Spring and damper together never push, like a rope. Both of them push as well as pull.",
      "Press a spring together. What do you feel?"),
    M("spring_damper_force", "tiny number in the denominator", nearly_unit(1e-6),
      "A tiny number is added to the length, so that nothing is divided by zero. A spring that is as short as that"
      " number gets a direction that is too short.",
      "How long is your unit vector for a spring of some micrometres?"),
    M("spring_damper_force", "tinier number in the denominator", nearly_unit(1e-9),
      "A tiny number is added to the length, so that nothing is divided by zero. It makes the direction of a very short"
      " spring too short.",
      "How long is your unit vector for a spring of some micrometres?"),
    M("stokes_drag", "difference of the speeds", along_own_motion,
      "The two speeds are subtracted, and the drag is along the ball's own velocity. What counts is the velocity"
      " through the fluid, a vector.",
      "A ball at rest is in a stream. Which way does the stream push it, and what does your function say?"),
    M("total_force", "last spring left out", counted(lambda at, pair, springs: at < springs - 1),
      "The last spring is left out: the loop ends one spring too early.",
      "How often does your loop run if there is one spring?"),
    M("total_force", "springs to later balls alone", counted(lambda at, pair, springs: pair[0] < pair[1]),
      "A spring counts only if its first ball comes before the second. Each spring is listed once, in either order.",
      "A spring is listed as (1, 0). Whom does it pull in your function?"),
    M("total_force", "stiffness by the ball's number", counted(every_spring, of_the_ball, of=(0,)),
      "The stiffness is looked up with the number of the ball. It belongs to the spring.",
      "Two springs begin at ball 0. Which stiffness does each have in your loop?"),
    M("total_force", "all numbers by the ball's number", counted(every_spring, of_the_ball),
      "Stiffness, rest length and damping are looked up with the number of the ball. They belong to the spring.",
      "Two springs begin at ball 0. Which stiffness does each have in your loop?"),
    M("total_force", "weight once for each spring", once_for_each_spring,
      "Weight and drag are added inside the loop over the springs: a ball with two springs has them twice, and a ball"
      " without a spring has none.",
      "How heavy is a ball of 1 kg on which two springs pull? And one without any spring?"),
)
# fmt: on
