"""Known mistakes about what looks miss, about the bound of a body's motion, and about looks that miss nothing."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import dot, flat, size
from solutions.sweeping import rotated, separation_of_hulls


def short(d, r):
    return (d / np.where(r > 0, r, 1.0)) ** 2 / 12


def long(d, r):
    return 1 - 4 * r / (3 * np.where(d > 0, d, 1.0))


def share(of=lambda d, r: np.where(d <= 2 * r, short(d, r), long(d, r)), reach=lambda a, b: np.asarray(a) + b,
          way=lambda v, dt: np.asarray(v) * dt):  # fmt: skip
    def found(v, a, b, dt):
        d, r = way(v, dt), reach(a, b)
        return np.where(np.asarray(v) * dt > 0, of(d, r) + 0 * np.asarray(b), 0.0)

    return found


right = share()


def evenly_on_a_line(d, r):
    """Offsets spread evenly from 0 to R, not over the area."""
    d, r = np.broadcast_arrays(d, np.where(r > 0, r, 1e-9))
    b = np.sqrt(np.maximum(r**2 - d**2 / 4, 0))
    chords = r**2 * (np.pi / 2 - np.arcsin(b / r)) - b * np.sqrt(r**2 - b**2)
    return 1 - b / r - chords / np.where(d > 0, d, 1.0) / r


def half_chords(d, r):
    return np.where(d <= r, 4 * short(d, r), 1 - 2 * r / (3 * np.where(d > 0, d, 1.0)))


def not_of_points(d, r):
    return np.where(r > 0, np.where(d <= 2 * r, short(d, r), long(d, r)), 0.0)


def not_squared(d, r):
    return np.where(d <= 2 * r, d / np.where(r > 0, r, 1.0) / 12, long(d, r))


def head_on(d, r):
    return np.maximum(0, 1 - 2 * r / np.where(d > 0, d, 1.0))


# Motion


def along(v, n):
    return flat(dot(v, n))


def turning(w, n):
    return flat(size(np.cross(n, w)))


def bound(flies=along, turns=turning, reach=lambda r: np.asarray(r, dtype=float), total=np.add):
    return lambda v, w, r, n: total(flies(v, n) + 0 * along(w, n), turns(w, n) * reach(r))


fastest = bound()


# Looks


def farthest(points):
    return float(np.max(np.linalg.norm(points, axis=-1)))


def nearest(points):
    return float(np.min(np.linalg.norm(points, axis=-1)))


def mean(points):
    return float(np.mean(np.linalg.norm(points, axis=-1)))


def by_one_second(points, position, v, w, t):
    return position + v * t + rotated(points, w * (t > 0))


def about_the_origin(points, position, v, w, t):
    return rotated(points + position + v * t, w * t)


def placed(points, position, v, w, t):
    return position + v * t + rotated(points, w * t)


def loop(
    place=placed,
    reach=farthest,
    speed=fastest,
    direction=lambda n: -n,
    touches=lambda s, tolerance: s <= tolerance,
    room=lambda s, tolerance: s,
    clock=lambda t, step: t + step,
    apart_for_ever=np.inf,
    late=lambda t, dt: np.inf if t > dt else None,
    result=lambda t, before: t,
    count=lambda used: used,
    none_left=lambda t, dt: np.nan,
    separation=separation_of_hulls,
):
    """Conservative advancement, with one of its parts put in the place of another."""

    def found(points, position, v, w, target, dt, tolerance, looks):
        points, position, v, w = (np.asarray(each, dtype=float) for each in (points, position, v, w))
        t = before = 0.0
        kept = None
        for used in range(1, looks + 1):
            s, n = separation(place(points, position, v, w, t), np.asarray(target, dtype=float))
            if touches(s, tolerance):
                return result(t, before), count(used)
            kept = n if kept is None else kept
            near = float(speed(v, w, reach(points), direction(n if direction is not first_direction else kept)))
            before, t = t, clock(t, room(float(s), tolerance) / near) if near > 0 else apart_for_ever
            if (end := late(t, dt)) is not None:
                return end, count(used)
        return none_left(t, dt), count(looks)

    return found


def first_direction(n):
    """Stands for the direction of the first look, in every look."""
    return -n


def without_guard(points, position, v, w, target, dt, tolerance, looks):
    """A body that goes away is looked at in the past."""
    t = 0.0
    for used in range(1, looks + 1):
        s, n = separation_of_hulls(placed(*map(np.asarray, (points, position, v, w)), t), np.asarray(target))
        if s <= tolerance:
            return t, used
        t = t + np.divide(s, fastest(np.asarray(v), np.asarray(w), farthest(points), -n))
        if not t <= dt:
            return np.inf, used
    return np.nan, looks


def last_look_wasted(*given):
    """After the last look it is not asked whether the step ends before anything can happen."""
    *bodies, _, tolerance, looks = given
    time, used = loop()(*given)
    goes_on = not np.isinf(loop()(*bodies, 1e300, tolerance, looks)[0])  # a step that ends later than any approach
    return np.nan if used == looks and np.isinf(time) and goes_on else time, used


def at_even_times(points, position, v, w, target, dt, tolerance, looks):
    """The step is divided by the number of looks."""
    points, position, v, w = (np.asarray(each, dtype=float) for each in (points, position, v, w))
    for used in range(1, looks + 1):
        t = dt * (used - 1) / looks
        if separation_of_hulls(placed(points, position, v, w, t), np.asarray(target))[0] <= tolerance:
            return t, used
    return np.inf, looks


def between_corners(a, b):
    """From the nearest corner of one to the nearest corner of the other."""
    ways = a[:, None] - b[None]
    far = np.linalg.norm(ways, axis=-1)
    i, j = np.unravel_index(np.argmin(far), far.shape)
    return far[i, j], ways[i, j] / max(far[i, j], 1e-12)


# fmt: off
BANK = (
    M("missed_share", "short ways only", share(short),
      "The formula for short ways is taken for long ones too, where the share grows beyond 1. Once the way is longer"
      " than the longest chord, every chord can be missed.",
      "How long is the longest chord? And what changes in your integral once the way is longer?"),
    M("missed_share", "long ways only", share(long),
      "The formula for long ways is taken for short ones too, where it becomes negative. A chord longer than the way is"
      " never missed.",
      "What is your share for a very short way?"),
    M("missed_share", "mean chord", share(lambda d, r: np.maximum(0, long(d, r))),
      "The mean chord is compared with the way. Where the mean chord is longer, there are still short ones near the rim"
      " that are missed.",
      "Two balls hardly graze each other. How long do they overlap?"),
    M("missed_share", "twice both radii", share(reach=lambda a, b: 2 * (np.asarray(a) + b)),
      "The disk is twice as large as it should be.",
      "At which offset do two balls just touch as they pass?"),
    M("missed_share", "A's radius alone", share(reach=lambda a, b: a + 0 * np.asarray(b)),
      "Only A's radius counts. The balls overlap while their centres are less than both radii apart.",
      "At which offset do two balls just touch as they pass?"),
    M("missed_share", "B's radius alone", share(reach=lambda a, b: b + 0 * np.asarray(a)),
      "Only B's radius counts. The balls overlap while their centres are less than both radii apart.",
      "At which offset do two balls just touch as they pass?"),
    M("missed_share", "seen, not missed", lambda v, a, b, dt: 1 - right(v, a, b, dt),
      "The result is the share of the collisions that are seen.",
      "How many collisions are missed if the looks follow each other at once?"),
    M("missed_share", "line for disk", share(evenly_on_a_line),
      "The offsets are spread evenly along a line from the middle to the rim. In space a large offset is more frequent:"
      " the farther out a ring of the disk is, the larger is its area.",
      "How large is the area between the offsets b and b + db?"),
    M("missed_share", "chords of half the length", share(half_chords),
      "Every chord is half as long as it should be. Either it ends at its middle, or the disk has half the radius. As"
      " long as the balls overlap, a look sees them.",
      "How long is the way straight through the middle of the other ball, from the first touch to the last?"),
    M("missed_share", "speed for way", share(way=lambda v, dt: v + 0 * np.asarray(dt)),
      "The time between two looks is left out: a speed is compared with a length.",
      "Which units do the two numbers have that you compare?"),
    M("missed_share", "one or nothing", share(lambda d, r: np.where(d > 2 * r, 1.0, 0.0)),
      "All collisions are missed if the way is longer than the longest chord, and none otherwise. Whether a look"
      " falls on a chord is a matter of luck, and most chords are shorter than the longest.",
      "A ball overlaps another one along half of the way between two looks. How often is it seen?"),
    M("missed_share", "nothing of points", share(not_of_points),
      "Two points are said to be seen always. They meet for no time at all.",
      "How long do two points overlap?"),
    M("missed_share", "not squared", share(not_squared),
      "The quotient is not squared, so that the share jumps where the way is as long as the longest chord.",
      "What do your two formulas give at D = 2R?"),

    M("motion_bound", "turning left out", bound(turns=lambda w, n: 0 * turning(w, n)),
      "The body is taken to fly without turning. Its ends may be much faster than the point about which it turns.",
      "A rod spins on the spot. How fast is its end?"),
    M("motion_bound", "flight left out", bound(flies=lambda v, n: 0 * along(v, n)),
      "The velocity is left out: the body is taken to turn on the spot.",
      "A ball flies without turning. How fast does it come nearer?"),
    M("motion_bound", "whole turning", bound(turns=lambda w, n: flat(size(w)) + 0 * along(w, n)),
      "All of the angular velocity counts. A body that turns about n itself moves no point along n, so that this bound"
      " is safe, but larger than it has to be.",
      "A top spins upright. How fast do its points move upwards?"),
    M("motion_bound", "whole velocity", bound(flies=lambda v, n: flat(size(v)) + 0 * along(v, n)),
      "The speed counts in every direction. A body that flies sideways or away does not come nearer along n.",
      "A train passes you. How fast does it come nearer when it is beside you?"),
    M("motion_bound", "speeds alone",
      bound(flies=lambda v, n: flat(size(v)) + 0 * along(v, n), turns=lambda w, n: flat(size(w)) + 0 * along(w, n)),
      "The result is the highest speed of any point in any direction. Only what is along n counts.",
      "Which argument makes no difference to your answer?"),
    M("motion_bound", "size along n", bound(flies=lambda v, n: np.abs(along(v, n))),
      "The sign of the velocity along n is lost: a body that goes away seems to come.",
      "What is the bound of a ball that flies away from you?"),
    M("motion_bound", "turning taken off", bound(total=np.subtract),
      "The turning is subtracted. This is the slowest that a point can be, not the fastest.",
      "A rod flies and spins. Is its fastest end faster or slower than its middle?"),
    M("motion_bound", "n·ω for n × ω", bound(turns=lambda w, n: np.abs(along(w, n))),
      "The angular velocity along n counts. Turning about n moves the points across n, and only the other part of ω"
      " moves them along it.",
      "A top spins upright. How fast do its points move upwards?"),
    M("motion_bound", "n·ω with its sign", bound(turns=lambda w, n: along(w, n)),
      "The angular velocity is treated like a velocity: its part along n is taken.",
      "A top spins upright. How fast do its points move upwards?"),
    M("motion_bound", "reach left out", bound(reach=lambda r: 1 + 0 * np.asarray(r, dtype=float)),
      "The reach is left out: an angular velocity is added to a velocity.",
      "Which units do your two terms have?"),
    M("motion_bound", "reach squared", bound(reach=lambda r: np.asarray(r, dtype=float) ** 2),
      "The reach enters twice.",
      "Which units do your two terms have?"),
    M("motion_bound", "half of the reach", bound(reach=lambda r: np.asarray(r, dtype=float) / 2),
      "The reach is taken for a diameter. It is measured from the point about which the body turns.",
      "A rod of 2 m turns about its middle. How far is its end from there?"),
    M("motion_bound", "never negative", lambda v, w, r, n: np.maximum(fastest(v, w, r, n), 0),
      "The bound is cut off at zero. A body all of whose points go away has a negative one.",
      "What does the description say of a body all of whose points move backwards?"),
    M("motion_bound", "by Pythagoras", bound(total=np.hypot),
      "The two parts are combined as if they were at right angles. Both are along n, and at the fastest point they"
      " add up.",
      "A point flies at 3 m/s along n, and turning moves it at 4 m/s along n as well. How fast is it?"),
    M("motion_bound", "sum of components", bound(turns=lambda w, n: np.sum(np.cross(n, w), axis=-1)),
      "The components of n × ω are added up. The length of a vector is something else.",
      "What is the sum of the components of (3, −3, 0), and how long is it?"),

    M("advance", "turning left out of the bound", loop(speed=bound(turns=lambda w, n: 0 * turning(w, n))),
      "The bound has no turning in it. The end of a rod that spins comes sooner than this bound allows, and the next"
      " look is too late.",
      "A rod spins on the spot beside a wall. How fast can its end come nearer to the wall?"),
    M("advance", "looks along the wrong direction", loop(direction=lambda n: n),
      "The bound is taken along the normal from B to A, and so it says how fast A goes away. An A that comes nearer"
      " seems to be no danger.",
      "Which way does the normal point? Which way would A have to move to touch B?"),
    M("advance", "first direction kept", loop(direction=first_direction),
      "The direction is found once, before the loop. When A has moved on, the hulls are apart along another direction.",
      "Which of your lines have to run again for every look?"),
    M("advance", "does not turn", loop(place=lambda points, position, v, w, t: points + position + v * t),
      "A flies without turning: its corners are those of the start.",
      "A rod spins on the spot. Where are its corners after a quarter of a turn?"),
    M("advance", "does not fly", loop(place=lambda points, position, v, w, t: position + rotated(points, w * t)),
      "A turns on the spot: its position is that of the start.",
      "Where is the point about which A turns at the time t?"),
    M("advance", "turned by ω", loop(place=by_one_second),
      "The corners are turned by ω, as if each look came a second after the start.",
      "By which angle has A turned at the time t?"),
    M("advance", "turned about the origin", loop(place=about_the_origin),
      "The corners are put at their places first and turned then. So they circle about the origin of the world.",
      "About which point does A turn?"),
    M("advance", "time not added up", loop(clock=lambda t, step: step),
      "The free time replaces the clock. It has to be added: the second look starts from where the first one ended.",
      "The first look leaves 2 s and the second 0.5 s. At which time is the third?"),
    M("advance", "beyond the step", loop(late=lambda t, dt: np.inf if t == np.inf else None),
      "The loop does not stop at the end of the step, and reports what comes after it.",
      "What has to be true of the time before you look again?"),
    M("advance", "dt for infinity", loop(late=lambda t, dt: dt if t > dt else None),
      "Hulls that stay apart are said to touch at the end of the step.",
      "How can anyone who calls your function tell a touch at the end from none?"),
    M("advance", "last look wasted", last_look_wasted,
      "NaN is returned after the last look even if this look has shown that nothing happens in the step.",
      "The hulls are 5 m apart, come nearer at 1 m/s, and the step lasts 2 s. How many looks does that take?"),
    M("advance", "apart when undecided", loop(none_left=lambda t, dt: np.inf),
      "When the looks are used up, the hulls are said to stay apart. Nobody knows that yet.",
      "What does the description say of looks that are used up?"),
    M("advance", "touching when undecided", loop(none_left=lambda t, dt: t),
      "When the looks are used up, the time of the last one is returned as if the hulls touched then. Nobody knows"
      " that.",
      "What does the description say of looks that are used up?"),
    M("advance", "counted from zero", loop(count=lambda used: used - 1),
      "The looks are counted from zero, and so the number is one too small.",
      "How many looks has a loop taken that ends in its first round?"),
    M("advance", "goes back in time", without_guard,
      "Where A goes away, the free time comes out negative, and the clock runs back.",
      "What does it mean for the hulls if the bound is not positive?"),
    M("advance", "nearest corner for the reach", loop(reach=nearest),
      "The reach is that of A's nearest corner. A corner farther out is faster.",
      "Which point of a spinning rod is the fastest?"),
    M("advance", "mean reach", loop(reach=mean),
      "The reach is the mean of all corners. The farthest one is faster than the mean.",
      "Which point of a spinning rod is the fastest?"),
    M("advance", "reach from the middle", loop(reach=lambda points: farthest(points - np.mean(points, axis=0))),
      "The reach is measured from the middle of the corners, not from the point about which A turns.",
      "A door turns about its hinge. How far is its farthest corner from there?"),
    M("advance", "touches at zero alone", loop(touches=lambda s, tolerance: s <= 0),
      "The tolerance is left out: the loop waits until the hulls overlap. Each look leaves a part of the gap, so that"
      " this takes far more looks.",
      "Which argument makes no difference to your answer?"),
    M("advance", "tolerance taken off", loop(room=lambda s, tolerance: s - tolerance),
      "The clock advances only until the hulls may be as far apart as the tolerance. Then a flight without turning ends"
      " exactly there, where rounding decides, and each turn takes more looks than it needs.",
      "How much of the separation may be used up before anything can have happened?"),
    M("advance", "look before", loop(result=lambda t, before: before),
      "The time is that of the last look but one.",
      "At which time were the hulls found within the tolerance?"),
    M("advance", "looks at even times", at_even_times,
      "The looks are spread evenly over the step. A fast body passes through between two of them.",
      "How far does A move between two looks? How far apart are the hulls?"),
    M("advance", "corner to corner", loop(separation=between_corners),
      "The separation is that of the two nearest corners. A corner may be near the middle of a face, far from all of"
      " its corners.",
      "A ball lies on a large table. How far is it from the nearest corner of the table?"),
)
# fmt: on
