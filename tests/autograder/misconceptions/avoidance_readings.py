"""Loose readings and slips about avoidance: limits forgotten in part, other powers, other lengths, a wrong foot."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, dot, flat, formulas_of, size

STEERING, WAYS, CONES, FLOCK = map(formulas_of, ("avoidance", "avoidance_ways", "avoidance_cones", "avoidance_flock"))


def horizontal_length(way):
    length = size(way[..., :2])
    return way / np.where(length > 0, length, 1.0)


def at_least_a_metre(way):
    return way / np.maximum(size(way), 1.0)


def speed_by_share(position, target, max_speed, slowing_radius):
    """The lower of the full speed and the share of the radius, as if this were a speed."""
    way = STEERING.towards(position, target)
    return direction(way) * np.minimum(col(max_speed), size(way) / col(slowing_radius))


def nothing_at_the_surface(separation, normal, F0, reach):
    return np.where(col(separation) <= 0, 0.0, STEERING.pushes()(separation, normal, F0, reach))


def over_reach(separation, normal, F0, reach):
    return STEERING.pushes()(separation, normal, F0, reach) / col(reach)


def by_twice(share):
    return 2 * share


# Ways around


def by_arctan(r, far, way):
    return r * np.sin(np.arctan(r / far))


def beside_by_arctan(r, far, way):
    return r * np.cos(np.arctan(r / far))


def over_way(r, far, way):
    return r * r / np.where(way > 0, way, 1.0)


# Nearest approaches


def by_place_squared(pa, va, pb, vb, ra=0.0, rb=0.0):
    x, u = np.asarray(pa, dtype=float) - pb, np.asarray(va, dtype=float) - vb
    t = WAYS.first_time(-flat(dot(x, u)), flat(dot(x, x)))
    return t, flat(size(x + u * t[..., None])) - ra - rb


def gap_of_the_past(pa, va, pb, vb, ra=0.0, rb=0.0):
    """The time is cut off at zero, the gap is not."""
    t, gap = WAYS.approach(time=WAYS.not_cut)(pa, va, pb, vb, ra, rb)
    return np.maximum(t, 0.0), gap


def never_if_parting(pa, va, pb, vb, ra=0.0, rb=0.0):
    x, u = np.asarray(pa, dtype=float) - pb, np.asarray(va, dtype=float) - vb
    t, gap = WAYS.approach()(pa, va, pb, vb, ra, rb)
    return np.where(flat(dot(x, u)) > 0, np.inf, t), gap


def speeds_for_the_product(pa, va, pb, vb, ra=0.0, rb=0.0):
    """|x| |u| in the place of −x·u."""
    x, u = np.asarray(pa, dtype=float) - pb, np.asarray(va, dtype=float) - vb
    squared = flat(dot(u, u))
    t = WAYS.first_time(flat(size(x) * size(u)), squared)
    return t, flat(size(x + u * t[..., None])) - ra - rb


# Two discs


def one_less_square(sine):
    return np.maximum(1 - sine**2, 0.0)


def upright(sine):
    return 1.0 + 0 * sine


def from_the_tip(pa, va, ra, pb, vb, rb, horizon, dt):
    """The sides are taken to begin at the centre of the round end, x/τ, and not at zero."""
    x = np.asarray(pb, dtype=float) - pa
    tip = x / col(np.asarray(horizon, dtype=float))
    return CONES.half_plane(change=lambda u, leg: -flat(dot(u - tip, leg)))(pa, va, ra, pb, vb, rb, horizon, dt)


def larger(a, b):
    return np.maximum(a, b) + 0.0


# Flocks


def unit_sum(position, i, j):
    return direction(FLOCK.summed()(position, i, j))


def over_pairs(value, i, j):
    return np.full(len(value), max(len(i), 1))


def halved(ways):
    return ways / 2


# fmt: off
BANK = (
    M("seek", "towards the origin", STEERING.seeks(lambda position, target: 0 * target - position),
      "The direction is that to the origin, and the target is left out.",
      "Which argument makes no difference to your answer?"),
    M("seek", "over the horizontal length", STEERING.seeks(heads=horizontal_length),
      "The length is that of the first two components alone, so that the body is too fast in space.",
      "How long is (2, 1, −2)?"),
    M("seek", "slower within a metre", STEERING.seeks(heads=at_least_a_metre),
      "Lengths below 1 m are taken for 1 m, and within a metre of the target the body becomes slower.",
      "How fast should the body be a centimetre from the target?"),
    M("arrive", "share for a speed", speed_by_share,
      "The full speed is compared with the distance over the radius, which is no speed.",
      "Which units have the two numbers that you compare?"),
    M("arrive", "a sine for the share", STEERING.arrives(shares=lambda q: np.sin(np.pi / 2 * STEERING.capped(q))),
      "The speed follows a sine. It should be in proportion to the distance.",
      "How fast should the body be at half the slowing radius?"),
    M("arrive", "never quite slow", STEERING.arrives(shares=lambda q: np.maximum(STEERING.capped(q), 0.1)),
      "The body keeps a tenth of its speed however near it is, and runs past the target.",
      "How fast should the body be at a hundredth of the slowing radius?"),
    M("repelling_force", "nothing at the surface and inside", nothing_at_the_surface,
      "At the surface and inside there is no force. A body that gets in is never pushed out.",
      "What does the description say of a body at the surface, and inside?"),
    M("repelling_force", "over the reach", over_reach,
      "The force is divided by the reach once more.",
      "How large is your force at the surface?"),
    M("repelling_force", "twice the share", STEERING.pushes(power=by_twice),
      "The share is doubled. It should be squared.",
      "How large is your force at the surface?"),
    M("tangent_point", "tangent for sine", WAYS.tangent(by_arctan, beside_by_arctan),
      "r/L is taken for the tangent of the angle. L is the longest side of the triangle, so that r/L is its sine.",
      "Which side of the triangle is opposite to the right angle?"),
    M("tangent_point", "over the way", WAYS.tangent(over_way),
      "r² is divided by the way to the tangent point. It has to be divided by L.",
      "Which triangles have the same shape? Which of their sides belong together?"),
    M("tangent_point", "half-way to the centre", WAYS.tangent(lambda r, far, way: far / 2),
      "The foot of the perpendicular is taken to be half-way between the position and the centre.",
      "Where is the foot for a sphere that is very small?"),
    M("tangent_point", "aside without the foot", WAYS.tangent(aside=lambda r, far, way: r - r * r / far),
      "The part to the side is r − t. Both are sides of a right triangle whose longest side is r.",
      "How far is your point from the centre?"),
    M("nearest_approach", "over the distance squared", by_place_squared,
      "x·u is divided by x². The derivative of the squared distance has u² t in it.",
      "Which unit has x·u/x²?"),
    M("nearest_approach", "gap of the past", gap_of_the_past,
      "The time is cut off at zero, but the gap is still that of the past.",
      "Two bodies move apart. How near are they now?"),
    M("nearest_approach", "never if they part", never_if_parting,
      "Bodies that move apart are said to be nearest never. Of all times from now on, they are nearest now.",
      "What does the description say of bodies that move apart?"),
    M("nearest_approach", "lengths for the product", speeds_for_the_product,
      "The product of both lengths takes the place of −x·u, as if the two flew straight at each other.",
      "What is x·u for a body that flies straight past you?"),
    M("nearest_approach", "twice the radii", WAYS.approach(reach=lambda a, b: 2 * WAYS.both(a, b)),
      "Both radii are subtracted twice.",
      "How far are the centres apart when the surfaces touch?"),
    M("nearest_approach", "larger radius alone", WAYS.approach(reach=larger),
      "Only the larger radius is subtracted.",
      "How far are the centres apart when the surfaces touch?"),
    M("separation", "one over the cube", FLOCK.summed(FLOCK.over_power(4)),
      "The push is one over the cube of the distance.",
      "How long is a vector of 4 m over 4², and how long over 4⁴?"),
    M("separation", "one over the root", FLOCK.summed(FLOCK.over_power(1.5)),
      "The push is one over the root of the distance.",
      "How large should the push be at a distance of 4 m?"),
    M("separation", "no more than one", unit_sum,
      "The sum is made a vector of length 1. How strongly a boid is pushed is lost.",
      "Two boids are nearly at the same place. How strongly are they pushed?"),
    M("separation", "half to each", FLOCK.summed(lambda ways: FLOCK.one_over(ways) / 2),
      "Each boid gets half of the push. Each feels all of it, in opposite directions.",
      "How large is the push at a distance of 1 m?"),
    M("towards_mean", "half of the way", FLOCK.mean(over=lambda x, i, j: 2 * FLOCK.at_least_one(x, i, j)),
      "The result is half as large as it should be.",
      "You have one neighbour, at +2, and are at 0. How far is the mean of your neighbours?"),
    M("towards_mean", "half of each difference", FLOCK.summed(halved, first=-1, second=1),
      "For each pair the way to the middle of the pair is added. The mean is that of the neighbours, without oneself.",
      "You have one neighbour, at +2, and are at 0. How far is the mean of your neighbours?"),
    M("towards_mean", "over all pairs", FLOCK.mean(over=over_pairs),
      "The sum is divided by the number of all pairs.",
      "Two boids far away become neighbours of each other. Should this change your mean?"),
    M("towards_mean", "direction alone", lambda value, i, j: direction(FLOCK.mean()(value, i, j)),
      "The result is made a vector of length 1. How far the mean is has been lost.",
      "Which unit should your answer have?"),
    M("orca_half_plane", "a third of the change", CONES.half_plane(share=1 / 3),
      "A makes a third of the change. If B does so as well, they still collide.",
      "What do A and B do together?"),
    M("orca_half_plane", "root forgotten", CONES.half_plane(cosine=one_less_square),
      "The part across is 1 − (R/L)². That is the square of the cosine.",
      "How long is your normal?"),
    M("orca_half_plane", "part across of length one", CONES.half_plane(cosine=upright),
      "The part of the normal across the way to B is 1, so that the normal is longer than 1.",
      "How long is your normal?"),
    M("orca_half_plane", "sides from the round end's centre", from_the_tip,
      "The sides are taken to begin at the centre of the round end, x/τ. They are lines through zero, at which the"
      " cone would end if it were not cut off.",
      "With R = 0 and u along x, how far is u from a side of the cone?"),
    M("orca_half_plane", "size of the change on the sides", CONES.half_plane(
        change=lambda u, leg: np.abs(flat(dot(u, leg)))),
      "On the sides of the cone the change has lost its sign.",
      "Which vector leads from u to the border if u is outside?"),
    M("orca_half_plane", "whole speed for the change", CONES.half_plane(
        change=lambda u, leg: flat(size(u)) + 0 * flat(dot(u, leg))),
      "On the sides of the cone the change is as long as the relative velocity.",
      "How far is u from the side, if u lies on the side?"),
    M("orca_half_plane", "half of the relative velocity", CONES.half_plane(relative=lambda a, b: (a - b) / 2),
      "The relative velocity is halved. It is the change that is shared.",
      "Which of the two is divided between A and B?"),
    M("orca_half_plane", "twice the radii", CONES.half_plane(reach=lambda a, b: 2 * CONES.both(a, b)),
      "Both radii are counted twice.",
      "How far are the centres apart when the discs touch?"),
    M("orca_half_plane", "larger radius alone", CONES.half_plane(reach=larger),
      "Only the larger radius counts.",
      "How far are the centres apart when the discs touch?"),
)
# fmt: on
