"""Known mistakes about a ray against a box and against a capsule."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import direction, formulas_of

SWEEPING = formulas_of("sweeping")
inner, length, ray_sphere, met, first_ahead, never, root = (
    getattr(SWEEPING, name) for name in ("inner", "length", "right", "met", "first_ahead", "never", "root")
)


def crossings(x, u, h):
    """Times at the low and the high face of each slab; without end where the ray stays between them."""
    x, u, h = (np.asarray(each, dtype=float) for each in np.broadcast_arrays(x, u, h))
    low, high = (-h - x) / u, (h - x) / u
    still, within = u == 0, np.abs(x) <= h
    return np.where(still, np.where(within, -np.inf, np.inf), low), np.where(
        still, np.where(within, np.inf, -np.inf), high
    )


def divided(x, u, h):
    """The same, with whatever comes of a division by zero."""
    return (-np.asarray(h) - x) / u, (np.asarray(h) - x) / u


def in_order(low, high):
    return np.minimum(low, high), np.maximum(low, high)


def in_order_all(x, u, h, low, high):
    return in_order(low, high)


def kept(x, u, h, low, high):
    """Along an axis in which nothing moves, an empty interval stays empty."""
    still = np.broadcast_to(np.asarray(u) == 0, low.shape)
    first, last = in_order(low, high)
    return np.where(still, low, first), np.where(still, high, last)


def clip(entry):
    return np.maximum(entry, 0.0)


def is_met(entry, leaving):
    return entry <= leaving


def box(
    times=crossings,
    sort=kept,
    enters=lambda first: np.max(first, axis=-1),
    leaves=lambda last: np.min(last, axis=-1),
    starts=clip,
    meets=is_met,
    miss=(np.inf, -np.inf),
):
    def found(x, u, h):
        first, last = sort(x, u, h, *times(x, u, h))
        entry, leaving = starts(enters(first)), leaves(last)
        good = meets(entry, leaving)
        return np.where(good, entry, miss[0]), np.where(good, leaving, miss[1])

    return found


right = box()


def first_in(first):
    return np.min(first, axis=-1)


def last_out(last):
    return np.max(last, axis=-1)


def ends_ahead(entry, leaving):
    return (entry <= leaving) & (leaving >= 0)


def all_must_move(x, u, h):
    still = np.broadcast_to(np.asarray(u) == 0, np.broadcast(x, u, h).shape)
    low, high = crossings(x, u, h)
    return np.where(still, np.inf, low), np.where(still, -np.inf, high)


def still_is_fine(x, u, h):
    still = np.broadcast_to(np.asarray(u) == 0, np.broadcast(x, u, h).shape)
    low, high = crossings(x, u, h)
    return np.where(still, -np.inf, low), np.where(still, np.inf, high)


def slow_is_still(x, u, h):
    return right(x, np.where(np.abs(u) < 1e-9, 0.0, u), h)


def surface_twice(x, u, h):
    """From within, the first crossing of the surface is taken for the entry."""
    entry, leaving = right(x, u, h)
    within = np.all(np.abs(x) <= h, axis=-1)
    return np.where(within, leaving, entry), leaving


def on_two_axes(x, u, h):
    return right(np.asarray(x)[..., :2], np.asarray(u)[..., :2], np.asarray(h)[..., :2])


def behind_too(times=crossings, sort=kept):
    """Whether the line meets the box is asked; whether the ray still does, is not."""

    def found(x, u, h):
        first, last = sort(x, u, h, *times(x, u, h))
        entry, leaving = np.max(first, axis=-1), np.min(last, axis=-1)
        good = entry <= leaving
        return np.where(good, clip(entry), np.inf), np.where(good, leaving, -np.inf)

    return found


# Capsules


def split(x, u, a, b):
    """The segment's direction and length, place and rate along it, and what is left across it."""
    e, whole = direction(np.asarray(b) - a), length(np.asarray(b) - a)
    place, rate = inner(np.asarray(x) - a, e), inner(u, e)
    return e, whole, place, rate, np.asarray(x) - a - place[..., None] * e, u - rate[..., None] * e


def there(place, rate, time):
    return place + rate * np.where(np.isfinite(time), time, 0.0)


def between(whole, place, rate, time, r):
    return (there(place, rate, time) >= 0) & (there(place, rate, time) <= whole)


def capsule(side=ray_sphere, counts=between, first=True, second=True, ball=ray_sphere, across=lambda y, w, u: (y, w)):
    def found(x, u, a, b, r):
        r = np.asarray(r)
        e, whole, place, rate, y, w = split(x, u, a, b)
        time = side(*across(y, w, u), r) if side else np.full(np.broadcast(place, rate, r).shape, np.inf)
        times = [np.where(counts(whole, place, rate, time, r), time, np.inf)]
        times += [ball(np.asarray(x) - a, u + 0 * e, r)] if first else []
        times += [ball(np.asarray(x) - b, u + 0 * e, r)] if second else []
        return np.min(np.broadcast_arrays(*times), axis=0)

    return found


def last_of_three(x, u, a, b, r):
    r = np.asarray(r)
    e, whole, place, rate, y, w = split(x, u, a, b)
    side = ray_sphere(y, w, r)
    side = np.where(between(whole, place, rate, side, r), side, np.inf)
    times = np.stack(np.broadcast_arrays(side, ray_sphere(x - a, u + 0 * e, r), ray_sphere(x - b, u + 0 * e, r)))
    last = np.max(np.where(np.isfinite(times), times, -np.inf), axis=0)
    return np.where(last >= 0, last, np.inf)


def flat_ends(x, u, a, b, r):
    """A cylinder whose ends are cut off straight."""
    r = np.asarray(r)
    _, whole, place, rate, y, w = split(x, u, a, b)
    near, far = ((root(inner(w, w), inner(y, w), inner(y, y) - r**2, sign)) for sign in (-1, 1))
    still = inner(w, w) == 0
    inside = inner(y, y) <= r**2
    near = np.where(still, np.where(inside, -np.inf, np.inf), near)
    far = np.where(still, np.where(inside, np.inf, -np.inf), far)
    first, last = right((place - whole / 2)[..., None], rate[..., None], (whole / 2)[..., None])
    entry, leaving = np.maximum(near, first), np.minimum(far, last)
    return np.where((entry <= leaving) & (leaving >= 0), np.maximum(entry, 0), np.inf)


def nearest_ball(x, u, a, b, r):
    """One ball, at the point of the segment that is nearest to the start of the ray."""
    e, whole, place, _, _, _ = split(x, u, a, b)
    near = np.asarray(a) + np.clip(place, 0, whole)[..., None] * e
    return ray_sphere(np.asarray(x) - near, u + 0 * e, np.asarray(r))


def nearer_end(x, u, a, b, r):
    """Of the balls around the ends, the one nearer to the start of the ray."""
    first = length(np.asarray(x) - a) <= length(np.asarray(x) - b)
    return np.where(first, capsule(second=False)(x, u, a, b, r), capsule(first=False)(x, u, a, b, r))


def end_for_way(x, u, a, b, r):
    return capsule()(x, u, a, np.asarray(a) + b, r)


# fmt: off
BANK = (
    M("ray_box", "slow is still", slow_is_still,
      "A part of u below a fixed number counts as zero. The ray may be slow: it arrives late, and it arrives.",
      "Divide u by 10¹². By how much do the two times change?"),
    M("ray_box", "0/0 on a face", box(divided, in_order_all),
      "A ray that glides along a face divides zero by zero there. The result is NaN, every comparison with it fails,"
      " and the ray seems to miss.",
      "A ray has no part across a face and starts on it. When is it between this face and the opposite one?"),
    M("ray_box", "along an axis is a miss", box(all_must_move),
      "A ray that has no part along one of the axes is said to miss the box.",
      "Let the ray fly along x, straight at the box. What do the slabs of y and z say of it?"),
    M("ray_box", "along an axis is inside", box(still_is_fine),
      "A slab across which the ray does not move is left out, wherever the ray is. So a ray beside the box meets it.",
      "A ray flies along x, a metre above the box. Which slab should notice it?"),
    M("ray_box", "in any slab", box(enters=first_in, leaves=last_out),
      "The ray is said to be in the box as soon as it is in one of the slabs, and as long as it is in any.",
      "A slab goes on for ever. In how many of the three slabs is a point in the box?"),
    M("ray_box", "first entry", box(enters=first_in),
      "The entry is the time at which the ray enters its first slab. Only a point that is in all three slabs is in the"
      " box.",
      "A ray is in the slab of x since 1 s and in that of y since 2 s. Since when is it in both?"),
    M("ray_box", "last exit", box(leaves=last_out),
      "The exit is the time at which the ray leaves its last slab. The ray is out of the box as soon as it is out of"
      " one slab.",
      "A ray leaves the slab of x at 3 s and that of y at 4 s. Until when is it in both?"),
    M("ray_box", "faces in a fixed order", box(sort=lambda x, u, h, low, high: (low, high)),
      "The low face is taken for the entry and the high face for the exit. That is so only for a ray that flies along"
      " the axis; one that flies against it comes in through the high face.",
      "Turn the ray round. Through which face does it come in now?"),
    M("ray_box", "negative entry", box(starts=lambda entry: entry, meets=ends_ahead),
      "A ray that starts within has a negative time of entry. A ray begins at t = 0.",
      "What does the description say of a start within?"),
    M("ray_box", "line for ray", box(starts=lambda entry: entry),
      "Times before the start count as well: a box behind the ray is met at negative times.",
      "Let the ray fly away from the box. Between which times is it in the box?"),
    M("ray_box", "box behind, 0/0 on a face", behind_too(divided, in_order_all),
      "A box behind the ray is said to be met now: the entry is moved to 0, although the exit lies before that. And a"
      " ray that glides along a face divides zero by zero there.",
      "A box lies behind the ray. Which sign has the exit, and how does it compare with 0?"),
    M("ray_box", "box behind", behind_too(),
      "A box behind the ray is said to be met now: the entry is moved to 0, although the exit lies before that.",
      "A box lies behind the ray. Which sign has the exit, and how does it compare with 0?"),
    M("ray_box", "surface from within", surface_twice,
      "From within, the time at which the ray leaves is taken for the entry as well.",
      "What does the description say of a start within?"),
    M("ray_box", "miss not noticed", box(meets=lambda entry, leaving: np.isfinite(entry) | True),
      "The two times are returned as they come, also where the entry is after the exit.",
      "A ray enters the last slab at 3 s and leaves the first at 2 s. When is it in the box?"),
    M("ray_box", "two infinities", box(miss=(np.inf, np.inf)),
      "For a miss, both times are infinity. An interval from infinity to infinity is not empty: the exit has to come"
      " before the entry.",
      "What does the description say of a miss?"),
    M("ray_box", "zeros for a miss", box(miss=(0.0, 0.0)),
      "A miss gives two zeros, which is what a ray gives that starts on a face and leaves at once.",
      "How can anyone who calls your function tell a miss from a touch now?"),
    M("ray_box", "whole edges for half", lambda x, u, h: right(x, u, np.asarray(h) / 2),
      "The half edges are halved again: the box is half as large as it should be.",
      "How far is a face from the middle of the box?"),
    M("ray_box", "box of twice the size", lambda x, u, h: right(x, u, 2 * np.asarray(h)),
      "The half edges are doubled: the box is twice as large as it should be.",
      "How far is a face from the middle of the box?"),
    M("ray_box", "corner at the origin", lambda x, u, h: right(np.asarray(x) - h, u, h),
      "The box reaches from 0 to twice the half edges. Its middle should be at the origin.",
      "Between which two values of x does the box lie?"),
    M("ray_box", "z left out", on_two_axes,
      "The third slab is left out: the box goes on for ever along z.",
      "Let the ray fly a metre above the box. What does your function say?"),
    M("ray_box", "metres for seconds", lambda x, u, h: right(x, direction(u) + 0 * np.asarray(x), h),
      "The direction is made one of length 1, and so the results are how far the ray goes, not for how long.",
      "A ray starts 4 m from the box, and u is 2 m/s. Which number should come out?"),
    M("ray_box", "ray turned round", lambda x, u, h: right(x, -np.asarray(u), h),
      "The ray flies backwards: a box ahead is missed, and one behind it is met.",
      "A point starts at x = −3 and flies at 2 m/s. When is it at x = −1?"),
    M("ray_box", "touching is a miss", box(meets=lambda entry, leaving: entry < leaving),
      "A ray that only grazes the box, or that goes through a flat one, is said to miss. The faces belong to the box.",
      "What does the description say of a ray that grazes a corner?"),

    M("ray_capsule", "nearer end alone", nearer_end,
      "Of the balls around the ends, only the one that is nearer to the start of the ray is asked. A ray may fly past"
      " this end and meet the other one.",
      "A ray starts above the left end and falls slowly to the right. Which end does it meet?"),
    M("ray_capsule", "ends left out", capsule(first=False, second=False),
      "Only the side is tested. Around each end there is half a ball as well.",
      "Fly along the segment, straight at one of its ends. What do you meet?"),
    M("ray_capsule", "side left out", capsule(side=None),
      "Only the balls around the two ends are tested. Between them is a cylinder.",
      "Fly at the middle of a long capsule. What do you meet?"),
    M("ray_capsule", "endless cylinder", capsule(counts=lambda whole, place, rate, time, r: time <= np.inf),
      "The cylinder has no end: the ray meets it also beyond the ends of the segment.",
      "Fly past the capsule, ten metres beyond its end. What do you meet?"),
    M("ray_capsule", "second end left out", capsule(second=False),
      "The ball around the second end is left out.",
      "Turn the capsule round. Does the time change?"),
    M("ray_capsule", "first end left out", capsule(first=False),
      "The ball around the first end is left out.",
      "Turn the capsule round. Does the time change?"),
    M("ray_capsule", "flat ends", flat_ends,
      "The ends are cut off flat. What is within r of the end of a segment is half a ball.",
      "Which points are 1 m away from the end of a segment? Draw them."),
    M("ray_capsule", "longer by the radius",
      capsule(counts=lambda whole, place, rate, time, r: between(whole + 2 * r, place + r, rate, time, r)),
      "The cylinder is longer by r at both ends. There it covers more than the half balls do.",
      "Between which two planes is the nearest point of the segment not one of its ends?"),
    M("ray_capsule", "place at the start",
      capsule(counts=lambda whole, place, rate, time, r: between(whole, place + 0 * rate, 0 * rate, time, r)),
      "The function asks whether the ray starts between the ends. What matters is where it is when it meets the side.",
      "A ray flies along the segment and comes nearer to it slowly. Where is it when it meets the side?"),
    M("ray_capsule", "metres for a share",
      capsule(counts=lambda whole, place, rate, time, r: between(1 + 0 * whole, place, rate, time, r)),
      "The place along the segment is measured in metres and compared with 0 and 1, as if it were a share of the"
      " segment.",
      "Which number belongs to the second end of a segment of 6 m?"),
    M("ray_capsule", "far side", capsule(side=met(lambda a, b, c: root(a, b, c, 1))),
      "At the side the time is that at which the ray leaves the cylinder.",
      "A line crosses the cylinder twice. Which of the two times comes first?"),
    M("ray_capsule", "exit from within",
      capsule(side=met(first_ahead, starts=never), ball=met(first_ahead, starts=never)),
      "A ray that starts within is given the time at which it leaves one of the parts.",
      "What does the description say of a start within?"),
    M("ray_capsule", "nothing from within", capsule(side=met(starts=never), ball=met(starts=never)),
      "A ray that starts within is said to meet nothing, or to meet a part of the capsule in which it is not yet.",
      "Put the start on the segment. Is the ray within r of it?"),
    M("ray_capsule", "whole direction at the side", capsule(across=lambda y, w, u: (y, u + 0 * w)),
      "At the side the position is taken across the segment, but the direction is taken as a whole. What the ray moves"
      " along the segment brings it no nearer.",
      "Look along the segment. How fast do you see the ray move?"),
    M("ray_capsule", "nearest ball", nearest_ball,
      "Only one ball is tested, around the point of the segment that is nearest to the start. While the ray flies,"
      " another point becomes the nearest one.",
      "A ray starts beside one end and flies at the other one. Which ball does it meet?"),
    M("ray_capsule", "last of the three times", last_of_three,
      "The last of the three times is taken. The ray meets the capsule where it meets the first of its parts.",
      "A ray goes through one end and then through the side. When is it in the capsule for the first time?"),
    M("ray_capsule", "end for way", end_for_way,
      "The second end is taken for the way from the first end to it.",
      "Move the ray and the capsule by 10 m. Does the time change?"),
    M("ray_capsule", "half of the radius", lambda x, u, a, b, r: capsule()(x, u, a, b, np.asarray(r) / 2),
      "The radius is taken for a diameter.",
      "How far from the segment is the surface?"),
)
# fmt: on
