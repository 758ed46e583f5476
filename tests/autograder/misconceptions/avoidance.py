"""Known mistakes about steering to a target, and about the force of a repelling field."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, size


def towards(position, target):
    return np.asarray(target) - position


def away(position, target):
    return np.asarray(position) - target


def unit(way):
    return direction(way)


def without_guard(way):
    return way / size(way)


def over_largest(way):
    return way / np.maximum(np.max(np.abs(way), axis=-1, keepdims=True), 1e-300)


def over_sum(way):
    return way / np.maximum(np.sum(np.abs(way), axis=-1, keepdims=True), 1e-300)


def over_square(way):
    return direction(way) / np.maximum(size(way), 1e-300)


def along_x_for_none(way):
    e = np.eye(way.shape[-1])[0]
    return np.where(size(way) > 0, direction(way), e)


def rests_within(near):
    return lambda way: np.where(size(way) < near, 0.0, direction(way))


def first_two(way):
    kept = way * np.where(np.arange(way.shape[-1]) < 2, 1.0, 0.0)
    return direction(kept)


def seeks(way=towards, heads=unit, speed=col):
    """A velocity from the vector to the target: its direction, times the speed."""

    def found(position, target, max_speed):
        vector = way(np.asarray(position, dtype=float), np.asarray(target, dtype=float))
        return heads(vector) * speed(max_speed)

    return found


def slower_near(position, target, max_speed):
    """As far in a second as there is to go, at most."""
    way = towards(position, target)
    return direction(way) * np.minimum(size(way), col(max_speed))


def each_axis(position, target, max_speed):
    return np.clip(towards(position, target), -col(max_speed), col(max_speed))


# Arriving


def capped(share):
    return np.minimum(share, 1.0)


def arrives(way=towards, shares=capped, heads=unit, speed=col, radius=col):
    """The speed of seeking times a share of it, which depends on the distance over the radius."""

    def found(position, target, max_speed, slowing_radius):
        vector = way(np.asarray(position, dtype=float), np.asarray(target, dtype=float))
        return heads(vector) * shares(size(vector) / radius(slowing_radius)) * speed(max_speed)

    return found


def axis_by_axis(position, target, max_speed, slowing_radius):
    rate = col(max_speed) / col(slowing_radius)
    return np.clip(rate * towards(position, target), -col(max_speed), col(max_speed))


def in_a_second(position, target, max_speed, slowing_radius):
    return slower_near(position, target, max_speed) + 0 * col(slowing_radius)


# Fields


def square(share):
    return share**2


def left(s, reach):
    return 1 - s / reach


def between(share):
    return np.clip(share, 0.0, 1.0)


def pushes(share=left, limits=between, power=square, strength=np.asarray, sign=1):
    """A force along the normal, by the share of the reach that is left."""

    def found(separation, normal, F0, reach):
        s, reach = np.asarray(separation, dtype=float), np.asarray(reach, dtype=float)
        size_of = strength(F0) * power(limits(share(s, reach)))
        return sign * size_of[..., None] * np.asarray(normal)

    return found


def nothing_inside(separation, normal, F0, reach):
    return np.where(col(separation) < 0, 0.0, pushes()(separation, normal, F0, reach))


def all_within(share):
    return np.where(share > 0, 1.0, 0.0)


# fmt: off
BANK = (
    M("seek", "flees", seeks(away),
      "The direction is position − target, as in a text that has been copied widely. This is the way from the target to"
      " the body, so that the body flees.",
      "You are at 0 and the target is at +3. Which sign has your velocity?"),
    M("seek", "the way for the direction", seeks(heads=lambda way: way),
      "The vector to the target is not divided by its length, so that the body is the faster the farther it is.",
      "How long is a direction? How fast is your body from 100 m away?"),
    M("seek", "flees, and faster from farther", seeks(away, heads=lambda way: way),
      "The vector points away from the target, and it is not divided by its length.",
      "You are at 0 and the target is at +3. What does your function return at a speed of 1?"),
    M("seek", "speed left out", seeks(speed=lambda v: 1 + 0 * col(v)),
      "The direction is right, but it is not multiplied by the speed.",
      "Which argument makes no difference to your answer?"),
    M("seek", "the way itself", seeks(heads=lambda way: way, speed=lambda v: 1 + 0 * col(v)),
      "The result is the vector to the target, in metres. A velocity is wanted.",
      "Which unit does your answer have?"),
    M("seek", "twice over the length", seeks(heads=over_square),
      "The vector is divided by the square of its length, so that the body is slower the farther it is.",
      "How long is your direction for a target that is 10 m away?"),
    M("seek", "over the largest component", seeks(heads=over_largest),
      "The vector is divided by its largest component. Its length is something else where it points along no axis.",
      "How long is (3, 4)?"),
    M("seek", "over the sum of components", seeks(heads=over_sum),
      "The vector is divided by the sum of its components. Its length is the root of the sum of their squares.",
      "How long is (3, 4)?"),
    M("seek", "each axis at full speed", seeks(heads=np.sign),
      "Each component has the full speed. The body is too fast, and moves along a diagonal.",
      "How fast is a body whose components are all 2 m/s?"),
    M("seek", "limited axis by axis", each_axis,
      "Each component of the way is cut off at the speed. That changes the direction, and near the target the body is"
      " slow.",
      "Which direction has (9, 1) if each component is cut off at 2?"),
    M("seek", "slower near the target", slower_near,
      "Near the target the body becomes slower. A body that seeks does not; one that arrives does.",
      "How fast should the body be a centimetre from the target?"),
    M("seek", "no number at the target", seeks(heads=without_guard),
      "At the target the length is zero, and 0/0 is not a number.",
      "What does the description say of a body that is at the target?"),
    M("seek", "along x at the target", seeks(heads=along_x_for_none),
      "A body at the target wants to leave it along x.",
      "What does the description say of a body that is at the target?"),
    M("seek", "rests within a tolerance", seeks(heads=rests_within(1e-8)),
      "A body that is within a tiny distance of the target is said to be there. It has arrived at the target itself"
      " alone.",
      "Let the whole scene be a nanometre wide. What does your function return?"),
    M("seek", "rests near the target", seeks(heads=rests_within(0.1)),
      "A body that is some centimetres from the target is said to be there. It has arrived at the target itself alone.",
      "Let the whole scene be a millimetre wide. What does your function return?"),
    M("seek", "the target's own direction", seeks(lambda position, target: target + 0 * position),
      "The direction is that of the target from the origin. It should be that from the body.",
      "What changes in your answer if the body moves and the target does not?"),
    M("seek", "horizontal alone", seeks(heads=first_two),
      "The third component is left out.",
      "The target is straight above the body. Which way should it fly?"),
    M("seek", "positive components", seeks(lambda position, target: np.abs(target - position)),
      "The components of the way have lost their signs.",
      "The target is to the left of the body. Which sign has the first component?"),

    M("arrive", "flees", arrives(away),
      "The direction is position − target. This is the way from the target to the body, so that the body flees.",
      "You are at 0 and the target is at +3. Which sign has your velocity?"),
    M("arrive", "never slows", arrives(shares=lambda q: 1 + 0 * q),
      "The body has full speed everywhere, as if it sought the target. Inside the slowing radius it should be slower.",
      "How fast should the body be at half the slowing radius?"),
    M("arrive", "faster from farther", arrives(shares=lambda q: q),
      "The speed is in proportion to the distance everywhere. Outside the slowing radius the body is too fast.",
      "How fast is your body at ten times the slowing radius?"),
    M("arrive", "larger of both", arrives(shares=lambda q: np.maximum(q, 1.0)),
      "The larger of the two speeds is taken: inside the radius the body has full speed, and outside it has more.",
      "Which of the two speeds should win at twice the radius, and which at half of it?"),
    M("arrive", "radius over distance", arrives(shares=lambda q: np.minimum(1 / np.maximum(q, 1e-300), 1.0)),
      "The share is the radius over the distance. So the body becomes slower outside the radius and not inside.",
      "What is your share at half the radius?"),
    M("arrive", "square of the share", arrives(shares=lambda q: capped(q) ** 2),
      "The speed goes with the square of the distance. It should be in proportion to the distance.",
      "How fast should the body be at half the slowing radius?"),
    M("arrive", "root of the share", arrives(shares=lambda q: np.sqrt(capped(q))),
      "The speed goes with the root of the distance, as for a body that brakes evenly. It should be in proportion to"
      " the distance.",
      "How fast should the body be at half the slowing radius?"),
    M("arrive", "stops at the radius", arrives(shares=lambda q: np.where(q < 1, 0.0, 1.0)),
      "Inside the slowing radius the body stops. It should slow down there, and arrive at the target.",
      "How fast should the body be at half the slowing radius?"),
    M("arrive", "what is left of the radius", arrives(shares=lambda q: np.where(q < 1, 1 - q, 1.0)),
      "Inside the radius the share is 1 − d/R, which grows towards the target.",
      "How fast is your body just before the target?"),
    M("arrive", "smooth from the start", arrives(shares=lambda q: q / (1 + q)),
      "The share is d/(R + d), so that the body never reaches its full speed.",
      "How fast should the body be at twice the slowing radius?"),
    M("arrive", "the way for the direction", arrives(heads=lambda way: way),
      "The vector to the target is not divided by its length.",
      "How long is a direction?"),
    M("arrive", "speed left out", arrives(speed=lambda v: 1 + 0 * col(v)),
      "The share of the speed is right, but it is not multiplied by the speed.",
      "Which argument makes no difference to your answer?"),
    M("arrive", "radius left out", in_a_second,
      "The speed inside is the distance itself, in metres, whatever the slowing radius.",
      "Which argument makes no difference to your answer?"),
    M("arrive", "limited axis by axis", axis_by_axis,
      "Each component is cut off at the full speed. That changes the direction outside the radius.",
      "Which direction has (9, 1) if each component is cut off at 2?"),
    M("arrive", "half of the radius", arrives(radius=lambda r: col(r) / 2),
      "The body begins to slow at half the radius, as if the radius were a diameter.",
      "At which distance should the speed begin to fall?"),
    M("arrive", "twice the radius", arrives(radius=lambda r: 2 * col(r)),
      "The body begins to slow at twice the radius.",
      "At which distance should the speed begin to fall?"),
    M("arrive", "no number at the target", arrives(heads=without_guard),
      "At the target the length is zero, and 0/0 is not a number.",
      "What does the description say of a body that is at the target?"),

    M("repelling_force", "attracts", pushes(sign=-1),
      "The force points towards the obstacle. It should point along the normal, away from it.",
      "Which way does n point? Which way should the body be pushed?"),
    M("repelling_force", "not squared", pushes(power=lambda q: q),
      "The share of the reach that is left is not squared. The force then sets in with a kink.",
      "How large should the force be halfway, as a share of F0?"),
    M("repelling_force", "cubed", pushes(power=lambda q: q**3),
      "The share of the reach that is left is cubed. It should be squared.",
      "How large should the force be halfway, as a share of F0?"),
    M("repelling_force", "no end", pushes(limits=lambda q: np.minimum(q, 1.0)),
      "Beyond the reach the square grows again, and the field pushes from far away.",
      "What is 1 − s/R at twice the reach? And its square?"),
    M("repelling_force", "grows inside", pushes(limits=lambda q: np.maximum(q, 0.0)),
      "Inside the obstacle the force grows beyond F0. It should stay as it is at the surface.",
      "What does the description say of a body inside the obstacle?"),
    M("repelling_force", "no limits", pushes(limits=lambda q: q),
      "The formula is used everywhere. Inside the force grows beyond F0, and beyond the reach it grows again.",
      "What is your force at twice the reach? And inside the obstacle?"),
    M("repelling_force", "linear without limits", pushes(limits=lambda q: q, power=lambda q: q),
      "The share is neither squared nor limited. Beyond the reach the force pulls.",
      "What is 1 − s/R at twice the reach?"),
    M("repelling_force", "nothing inside", nothing_inside,
      "Inside the obstacle there is no force. A body that gets in is never pushed out.",
      "What does the description say of a body inside the obstacle?"),
    M("repelling_force", "one less the square", pushes(power=lambda q: 1 - (1 - q) ** 2),
      "The force falls with 1 − (s/R)². The square is that of what is left, 1 − s/R.",
      "How large should the force be halfway, as a share of F0?"),
    M("repelling_force", "grows outwards", pushes(share=lambda s, reach: np.where(s < reach, s / reach, 0.0)),
      "The force grows with the distance. It should be largest at the surface.",
      "How large is your force at the surface?"),
    M("repelling_force", "whole force up to the reach", pushes(power=all_within),
      "The force is F0 up to the reach and nothing beyond. It should fall on the way.",
      "How large should the force be halfway, as a share of F0?"),
    M("repelling_force", "strength left out", pushes(strength=lambda f: 1 + 0 * np.asarray(f)),
      "The share is right, but it is not multiplied by F0.",
      "Which argument makes no difference to your answer?"),
    M("repelling_force", "reach left out", pushes(share=lambda s, reach: np.where(s < reach, 1 - s, 0.0)),
      "The separation is not divided by the reach: a number and a length are subtracted.",
      "Which units do 1 and s have?"),
    M("repelling_force", "not over the reach", pushes(
        share=lambda s, reach: reach - s, limits=lambda q: np.maximum(q, 0.0)),
      "The square of the length that is left is taken, in square metres. A share has no unit.",
      "Which unit does your force have?"),
    M("repelling_force", "size of the separation", pushes(share=lambda s, reach: 1 - np.abs(s) / reach),
      "The separation has lost its sign, so that the force falls inside the obstacle as well.",
      "How large should the force be deep inside the obstacle?"),
    M("repelling_force", "fades for ever", pushes(share=lambda s, reach: 1 / (1 + np.maximum(s, 0.0) / reach)),
      "The force falls like one over the square of a distance. It never ends, and pushes bodies that are far away.",
      "How large should the force be at the reach?"),
    M("repelling_force", "exponential", pushes(
        share=lambda s, reach: np.exp(-np.maximum(s, 0.0) / reach), power=lambda q: q),
      "The force falls exponentially. It never ends, and pushes bodies that are far away.",
      "How large should the force be at the reach?"),
)
# fmt: on
