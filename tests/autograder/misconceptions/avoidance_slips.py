"""Slips about avoidance: fixed tolerances, borders, counts of one half of the pairs, a heading taken for a place."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import dot, flat, formulas_of

STEERING, WAYS, CONES, FLOCK = map(formulas_of, ("avoidance", "avoidance_ways", "avoidance_cones", "avoidance_flock"))


def to_a_place(position, heading, centre, radius):
    """The side is that of the way from the position to the heading."""
    return WAYS.tangent()(position, np.asarray(heading, dtype=float) - position, centre, radius)


def padded(little):
    """One over the squared distance and a little more."""
    return FLOCK.summed(lambda ways: ways / (FLOCK.lengths(ways) ** 2 + little))


def who_push(p, i, j):
    """Only neighbours at another place count."""
    apart = np.any(p[i] != p[j], axis=-1)
    return FLOCK.at_least_one(p, i[apart], j[apart])


def count_of(which):
    def over(value, i, j):
        return np.maximum(np.bincount((i, j)[which], minlength=len(value)), 1)

    return over


# fmt: off
BANK = (
    M("seek", "rests within millimetres", STEERING.seeks(heads=STEERING.rests_within(1e-3)),
      "A body that is within a fixed small distance of the target is said to be there. It has arrived at the target"
      " itself alone.",
      "Let the whole scene be a millimetre wide. What does your function return?"),
    M("arrive", "what is left of the radius, on it as well", STEERING.arrives(
        shares=lambda q: np.where(q <= 1, 1 - q, 1.0)),
      "Inside the radius and on it the share is 1 − d/R, which grows towards the target.",
      "How fast is your body just before the target?"),
    M("tangent_point", "heading for a place", to_a_place,
      "The heading is taken for a place, and the side is that of the way to it. A heading is a direction already.",
      "Move the body and the sphere by 10 m. Should the side change?"),
    M("separation", "mean of the pushes that there are", FLOCK.summed(over=who_push),
      "The sum is divided by the number of neighbours that push. More neighbours should push more.",
      "Two neighbours on the same side push. Is this more than one of them does?"),
    M("separation", "tiny number in the denominator", padded(1e-6),
      "A tiny number is added to the squared distance, so that nothing is divided by zero. Very near neighbours"
      " push too weakly.",
      "Two boids are a millimetre apart. How large is the push, and how large is yours?"),
    M("separation", "tinier number in the denominator", padded(1e-9),
      "A tiny number is added to the squared distance, so that nothing is divided by zero. It makes the push of very"
      " near neighbours too weak.",
      "Two boids are a tenth of a millimetre apart. How large is the push, and how large is yours?"),
    M("towards_mean", "counted where it comes first", FLOCK.mean(over=count_of(0)),
      "The sum is over all neighbours, but it is divided by the number of pairs in which the boid comes first.",
      "Boid 1 is the second one of a pair. How many neighbours does it have in your count?"),
    M("towards_mean", "counted where it comes second", FLOCK.mean(over=count_of(1)),
      "The sum is over all neighbours, but it is divided by the number of pairs in which the boid comes second.",
      "Boid 0 is the first one of a pair. How many neighbours does it have in your count?"),
    M("orca_half_plane", "no side where both are equally near", CONES.half_plane(
        sign=lambda u, left: np.sign(flat(dot(u, left)))),
      "Exactly head-on `np.sign` is zero, so that no side is chosen and the normal does not have the length 1.",
      "Which of its three values has `np.sign` for two discs exactly head-on?"),
)
# fmt: on
