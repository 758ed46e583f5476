"""Known mistakes of what is missed between two steps: how long a ball overlaps a wall, how often that is seen."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import over


def interval(x, u, front, back, dt, clip=True, empty=(np.inf, -np.inf), always=None):
    moves = np.asarray(u) != 0
    at_front, at_back = (front - x) / np.where(moves, u, 1.0), (back - x) / np.where(moves, u, 1.0)
    inside = (back <= x) & (x <= front)
    first = np.where(moves, np.minimum(at_front, at_back), 0.0 if clip else -np.inf)
    last = np.where(moves, np.maximum(at_front, at_back), np.where(inside, np.inf, -np.inf))
    start, end = (np.maximum(first, 0.0), np.minimum(last, dt)) if clip else (first, last)
    meets = start <= end
    return np.where(meets, start, empty[0]), np.where(meets, end, empty[1])


def instants(x, u, r, w, dt):
    """Overlap at the start, at the end, and nothing in between."""
    now, then = ((-(w + r) <= at) & (at <= r) for at in (x, x + u * dt))
    return np.where(now, 0.0, np.where(then, dt, np.inf)), np.where(then, dt, np.where(now, 0.0, -np.inf))


def ordered(x, u, r, w, dt):
    """Front first, whichever way it goes."""
    moves = np.asarray(u) != 0
    start = np.where(moves, (r - x) / np.where(moves, u, 1), 0)
    end = np.where(moves, (-(w + r) - x) / np.where(moves, u, 1), np.where((-(w + r) <= x) & (x <= r), np.inf, -np.inf))
    start, end = np.maximum(start, 0), np.minimum(end, dt)
    return np.where(start <= end, start, np.inf), np.where(start <= end, end, -np.inf)


def past(x, u, r, w, dt):
    """(whether they meet, raw, clipped) of start and end, the start not clipped."""
    start, end = interval(x, u, r, -(w + r), dt)
    first = interval(x, u, r, -(w + r), dt, clip=False)[0]
    return (start <= end, first, start), (start <= end, end, end)


def future(x, u, r, w, dt):
    start, end = interval(x, u, r, -(w + r), dt)
    last = interval(x, u, r, -(w + r), dt, clip=False)[1]
    return (start <= end, start, start), (start <= end, last, end)


def unguarded(x, u, r, w, dt):
    moves = np.asarray(u) != 0
    front, back = (r - x) / np.where(moves, u, 1.0), (-(w + r) - x) / np.where(moves, u, 1.0)
    inside = (-(w + r) <= x) & (x <= r)
    last = np.where(moves, np.maximum(front, back), np.where(inside, np.inf, -np.inf))
    return np.maximum(np.where(moves, np.minimum(front, back), 0.0), 0.0), np.minimum(last, dt)


def half_open(x, u, r, w, dt):
    start, end = interval(x, u, r, -(w + r), dt)
    return np.where(start < end, start, np.inf), np.where(start < end, end, -np.inf)


def within(x, u, r, w, dt):
    """Fractions of the step."""
    start, end = interval(x, u, r, -(w + r), dt)
    return over(start, dt, 0), over(end, dt, 0)


def missed(v, dt, caught, clamp=True):
    way = np.asarray(v * dt)
    chance = np.where(way > 0, 1 - over(caught, way, 0), 0)
    return np.maximum(chance, 0) if clamp else chance


# fmt: off
BANK = (
    M("overlap_interval", "two instants", instants,
      "It looks at the start and at the end of the step only: what goes through in between is not seen.",
      "When does the ball's front meet the wall's front? When does its back leave the wall's back?"),
    M("overlap_interval", "radius left out", lambda x, u, r, w, dt: interval(x, u, 0 * r, -w - 0 * r, dt),
      "The ball is treated as a point: it overlaps from one radius before the face on.",
      "Where is the centre when the ball's surface touches the wall?"),
    M("overlap_interval", "radius at the back left out", lambda x, u, r, w, dt: interval(x, u, r, -w, dt),
      "At the back the ball is treated as a point: it has left only when its centre is one radius behind the wall.",
      "Where is the centre when the ball leaves the wall's back?"),
    M("overlap_interval", "radius at the front left out", lambda x, u, r, w, dt: interval(x, u, 0 * r, -(w + r), dt),
      "At the front the ball is treated as a point: it touches when its centre is still one radius before the wall.",
      "Where is the centre when the ball first touches the wall?"),
    M("overlap_interval", "thickness left out", lambda x, u, r, w, dt: interval(x, u, r, -r - 0 * w, dt),
      "The wall is treated as a sheet: its thickness makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("overlap_interval", "thickness in front", lambda x, u, r, w, dt: interval(x, u, w + r, -r, dt),
      "The wall stands before its front face: the distance counts from the front, and the wall is behind it.",
      "On which side of x = 0 is the wall?"),
    M("overlap_interval", "wall about its middle", lambda x, u, r, w, dt: interval(x, u, w / 2 + r, -w / 2 - r, dt),
      "The distance is counted from the wall's middle; here it is counted from its front face.",
      "Where is x = 0?"),
    M("overlap_interval", "diameter", lambda x, u, r, w, dt: interval(x, u, 2 * r, -(w + 2 * r), dt),
      "The ball reaches a diameter from its centre instead of a radius.",
      "How far is the surface from the centre?"),
    M("overlap_interval", "not within the step", lambda x, u, r, w, dt: interval(x, u, r, -(w + r), dt, clip=False),
      "The instants are not limited to the step: some lie in the past or after its end.",
      "From when to when does the step last?"),
    M("overlap_interval", "from the front alone", ordered,
      "The ball is expected to come from the front. From behind, the back face is met first.",
      "Which of the two instants comes first for a ball that moves along the normal?"),
    M("overlap_interval", "velocity towards the wall", lambda x, u, r, w, dt: interval(x, -u, r, -(w + r), dt),
      "The velocity has the wrong sign: along the normal of the front face it leads away from the wall.",
      "What sign has the velocity of a ball that comes nearer?"),
    M("overlap_interval", "touching left out", half_open,
      "A ball that touches for an instant only is not seen: the interval is closed.",
      "Does touching count?"),
    M("overlap_interval", "share of the step", within,
      "The instants are given as shares of the step, not as times.",
      "What unit should come out?"),
    M("overlap_interval", "zeros for nothing", lambda x, u, r, w, dt: interval(x, u, r, -(w + r), dt, empty=(0, 0)),
      "Where they do not meet, 0 and 0 come out, which looks like a touch at the start.",
      "How would the caller tell that nothing was met?"),
    M("overlap_interval", "whole step for nothing",
      lambda x, u, r, w, dt: interval(x, u, r, -(w + r), dt, empty=(np.inf, np.inf)),
      "Where they do not meet, both are infinite: then the end is not before the start, and the interval is not empty.",
      "Which sign makes an interval empty?"),
    M("overlap_interval", "may begin in the past",
      lambda x, u, r, w, dt: tuple(np.where(met, raw, clipped) for met, raw, clipped in past(x, u, r, w, dt)),
      "The start may lie before the step: a ball that overlaps already starts at 0.",
      "From when does the step last?"),
    M("overlap_interval", "may end after the step",
      lambda x, u, r, w, dt: tuple(np.where(met, raw, clipped) for met, raw, clipped in future(x, u, r, w, dt)),
      "The end may lie after the step.",
      "Until when does the step last?"),
    M("overlap_interval", "distance's sign", lambda x, u, r, w, dt: interval(-np.asarray(x), u, r, -(w + r), dt),
      "The distance has the wrong sign: before the wall it is positive.",
      "Where is a ball whose distance is positive?"),
    M("overlap_interval", "never empty", unguarded,
      "Where they do not meet, the start lies after the end: that is not recognised.",
      "What should come out where they do not meet?"),
    M("missing_probability", "ball a point", lambda v, w, r, dt: missed(v, dt, w + 0 * r),
      "The ball is treated as a point: a large ball is caught more easily.",
      "On how long a way does the ball overlap the wall?"),
    M("missing_probability", "one radius", lambda v, w, r, dt: missed(v, dt, w + r),
      "The ball overlaps from one radius before the wall to one behind: that is the thickness and two radii.",
      "How far does the centre go between the first touch and the last?"),
    M("missing_probability", "seen, not missed", lambda v, w, r, dt: np.minimum(over(w + 2 * r, v * dt, 1), 1),
      "It is the share that is caught, not the share that is missed.",
      "A faster ball is missed more often. Is it so with yours?"),
    M("missing_probability", "below zero", lambda v, w, r, dt: missed(v, dt, w + 2 * r, clamp=False),
      "For a slow ball it comes out negative, which no probability is.",
      "What is the chance to miss a ball that moves less than its own width in a step?"),
    M("missing_probability", "step left out", lambda v, w, r, dt: missed(v, 1.0 + 0 * dt, w + 2 * r),
      "Lengths are divided by a speed: the step's length is missing.",
      "What unit has (w + 2r)/v?"),
    M("missing_probability", "yes or no", lambda v, w, r, dt: 1.0 * (v * dt > w + 2 * r),
      "It says whether a miss can happen at all, not how often it does.",
      "A ball moves twice as far as it overlaps. Is it always missed?"),
    M("missing_probability", "thickness twice", lambda v, w, r, dt: missed(v, dt, 2 * w + 2 * r),
      "The wall's thickness is counted twice; two are the radii.",
      "On how long a way does the ball overlap the wall?"),
    M("missing_probability", "thickness left out", lambda v, w, r, dt: missed(v, dt, 2 * r + 0 * w),
      "The wall is treated as a sheet: a thick wall is not missed as easily.",
      "Which argument makes no difference to your answer?"),
    M("missing_probability", "radius subtracted", lambda v, w, r, dt: missed(v, dt, w - 2 * r),
      "The ball's size is subtracted from the wall's: a larger ball is easier to catch, not harder.",
      "Does a larger ball overlap the wall on a longer way or on a shorter one?"),
    M("missing_probability", "half the ways",
      lambda v, w, r, dt: missed(v, dt, w / 2 + r),
      "Only the way to the wall's middle counts. "
      "That is how far an engine is right that pushes out by the nearest way; a test for overlap sees the whole wall.",
      "Up to where does the ball overlap the wall?"),
)
# fmt: on
