"""Known mistakes about the tangent point of a sphere, and about nearest approaches."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import along, col, direction, dot, flat, size
from solutions.avoidance import side_of

UP = np.array([0.0, 0.0, 1.0])


def by_heading(towards, heading):
    return side_of(towards, heading)


def short_by(r, distance, way):
    return r * r / distance


def aside_by(r, distance, way):
    return r * way / distance


def nearest_of_surface(p, c, r, towards):
    return c - r * towards


def top(p, c, r):
    return c + r * UP


def tangent(short=short_by, aside=aside_by, side=by_heading, inside=nearest_of_surface, middle=top, start=None,
            radius=col, root=np.subtract):  # fmt: skip
    """The tangent point, from its parts along the line to the centre and across it. start: of both, or the centre."""

    def found(position, heading, centre, r):
        p, c, r = np.asarray(position, dtype=float), np.asarray(centre, dtype=float), radius(r)
        towards, distance = direction(c - p), size(c - p)
        long = np.where(distance > 0, distance, 1.0)
        way = np.sqrt(np.maximum(root(distance**2, r**2), 0.0))
        across = side(towards, np.asarray(heading, dtype=float) + 0 * p)
        touches = (c if start is None else start(p, c)) - short(r, long, way) * towards + aside(r, long, way) * across
        answer = np.where(distance < r, inside(p, c, r, towards), touches)
        return np.where(distance == 0, middle(p, c, r) + 0 * p, answer)

    return found


def as_outside(p, c, r, towards):
    """What the formula gives inside, without a way to the side."""
    distance = size(c - p)
    return c - r * r / np.where(distance > 0, distance, 1.0) * towards


def no_number(p, c, r, *rest):
    return p * np.nan


def stays(p, c, r, *rest):
    return p


def always_left(towards, heading):
    return side_of(towards)


def other_side(towards, heading):
    return -side_of(towards, heading)


def right_for_none(towards, heading):
    named = size(along(heading, towards)) > 1e-9 * size(heading)
    return np.where(named, side_of(towards, heading), -side_of(towards))


def nowhere_for_none(towards, heading):
    named = size(along(heading, towards)) > 1e-9 * size(heading)
    return np.where(named, side_of(towards, heading), 0.0)


def whole_heading(towards, heading):
    return direction(heading)


def horizontal(towards, heading):
    """Left or right, whichever is nearer to the heading."""
    return side_of(towards) * np.where(dot(heading, side_of(towards)) < 0, -1.0, 1.0)


# Nearest approaches


def first_time(closing, squared):
    return np.where(squared > 0, np.maximum(closing, 0) / np.where(squared > 0, squared, 1), 0.0)


def both(a, b):
    return np.asarray(a, dtype=float) + b


def approach(
    place=np.subtract, velocity=np.subtract, time=first_time, reach=both, at=None, sign=1, gap=lambda d: d, apart=size
):
    """Time and gap. at: the relative place at the time, for those who find it in another way."""

    def found(pa, va, pb, vb, ra=0.0, rb=0.0):
        x, u = place(np.asarray(pa, dtype=float), pb), velocity(np.asarray(va, dtype=float), vb)
        closing, squared = -sign * flat(dot(x, u)), flat(dot(u, u))
        t = time(closing, squared)
        then = (x + u * t[..., None]) if at is None else at(x, u, t[..., None], va, vb)
        return t, gap(flat(apart(then)) - reach(ra, rb))

    return found


def over_speed(closing, squared):
    return np.where(squared > 0, np.maximum(closing, 0) / np.sqrt(np.where(squared > 0, squared, 1)), 0.0)


def half(closing, squared):
    return first_time(closing, squared) / 2


def not_cut(closing, squared):
    return np.where(squared > 0, closing / np.where(squared > 0, squared, 1), 0.0)


def turned_round(closing, squared):
    return np.abs(not_cut(closing, squared))


def never_for_none(closing, squared):
    return np.where(squared > 0, first_time(closing, squared), np.inf)


def unguarded(closing, squared):
    return np.maximum(closing / squared, 0.0)


def of_distance(pa, va, pb, vb, ra=0.0, rb=0.0):
    """As if they flew straight at each other."""
    x, u = np.asarray(pa, dtype=float) - pb, np.asarray(va, dtype=float) - vb
    speed, closing = size(u), -dot(x, u)
    t = np.where((speed > 0) & (closing > 0), size(x) / np.where(speed > 0, speed, 1.0), 0.0)
    return flat(t), flat(size(x + u * t)) - ra - rb


def at_touch(pa, va, pb, vb, ra=0.0, rb=0.0):
    """The time at which they touch, if they do."""
    t, gap = approach()(pa, va, pb, vb, ra, rb)
    u, reach = flat(size(np.asarray(va, dtype=float) - vb)), both(ra, rb)
    across = np.maximum(gap + reach, 0)
    early = np.sqrt(np.maximum(reach**2 - across**2, 0)) / np.where(u > 0, u, 1)
    return np.where((gap < 0) & (t > 0), np.maximum(t - early, 0), t), gap


# fmt: off
BANK = (
    M("tangent_point", "other side", tangent(side=other_side),
      "The point is on the side away from the heading, so that the body has to turn round.",
      "On which side of the line to the centre does the heading point?"),
    M("tangent_point", "always to the left", tangent(side=always_left),
      "The heading is left out: the point is always on the left.",
      "Which argument makes no difference to your answer?"),
    M("tangent_point", "horizontal alone", tangent(side=horizontal),
      "The point is to the left or to the right, whichever is nearer to the heading. Up and down are sides as well.",
      "The body heads above the centre. On which side should it pass?"),
    M("tangent_point", "whole heading for the side", tangent(side=whole_heading),
      "The whole heading is taken for the side. Only its part at right angles to the line to the centre is one.",
      "Is the angle between your side and the line to the centre 90°?"),
    M("tangent_point", "right where no side is named", tangent(side=right_for_none),
      "Where the heading names no side, the point is on the right.",
      "What does `side_of` say where no wish names a side?"),
    M("tangent_point", "no side where none is named", tangent(side=nowhere_for_none),
      "Where the heading names no side, the point lies on the line to the centre, inside the sphere.",
      "What does `side_of` say where no wish names a side?"),
    M("tangent_point", "beside the centre", tangent(short=lambda r, far, way: 0 * r * far, aside=lambda r, far, way: r),
      "The point is straight beside the centre. The line to it cuts through the sphere, because the right angle of the"
      " triangle is at the tangent point and not at the centre.",
      "Where is the right angle in the triangle of position, centre and tangent point?"),
    M("tangent_point", "behind the centre", tangent(short=lambda r, far, way: -r * r / far),
      "The point is beyond the centre. Seen from the body, the tangent touches the near half of the sphere.",
      "Is the tangent point nearer to the body than the centre, or farther away?"),
    M("tangent_point", "from the position", tangent(start=lambda p, c: p, short=lambda r, far, way: -r * r / far),
      "r²/L is measured from the position. It is the distance of the perpendicular's foot from the centre.",
      "What is r²/L for a sphere that is very far away? Where must the foot be then?"),
    M("tangent_point", "way for the part aside", tangent(aside=lambda r, far, way: way),
      "The way to the tangent point is taken for the part to the side.",
      "How far to the side can a point of the sphere be?"),
    M("tangent_point", "radius for the part aside", tangent(aside=lambda r, far, way: r),
      "The part to the side is the whole radius, so that the point is outside of the sphere.",
      "How far is your point from the centre?"),
    M("tangent_point", "parts swapped", tangent(aside_by, short_by),
      "The parts along the line to the centre and across it are exchanged.",
      "Which of the two parts becomes small if the sphere is far away?"),
    M("tangent_point", "plus under the root", tangent(root=np.add),
      "The way is computed as √(L² + r²). The longest side of the triangle is L, from the position to the centre.",
      "Which of the three sides is opposite to the right angle?"),
    M("tangent_point", "r over L, not squared", tangent(short=lambda r, far, way: r / far),
      "The part along the line is r/L, which is no length.",
      "Which unit has r/L, and which r²/L?"),
    M("tangent_point", "nearest point always", tangent(
        short=lambda r, far, way: r, aside=lambda r, far, way: 0 * r),
      "The point is the one of the sphere that is nearest to the body. A line to it runs into the sphere.",
      "Does the line to your point touch the sphere or enter it?"),
    M("tangent_point", "as far as the centre", tangent(
        start=lambda p, c: p, short=lambda r, far, way: -way, aside=lambda r, far, way: r),
      "The direction is that of the tangent, but the point is as far away as the centre. The way to the tangent point"
      " is shorter.",
      "How long are the three sides of the triangle?"),
    M("tangent_point", "from the origin", tangent(start=lambda p, c: 0 * p),
      "The parts are right, and the centre is not added to them.",
      "Where is the tangent point of a sphere around the origin? And if everything is moved by 10 m?"),
    M("tangent_point", "radius for a diameter", tangent(radius=lambda r: col(r) / 2),
      "Half of the radius is used, as if it were a diameter.",
      "How far is your point from the centre?"),
    M("tangent_point", "formula inside as well", tangent(inside=as_outside),
      "Inside the sphere the part r²/L is more than r, so that the point is outside of the sphere.",
      "What does the description say of a position inside?"),
    M("tangent_point", "no number inside", tangent(inside=no_number, middle=no_number),
      "Inside the sphere the number under the root is negative.",
      "What does the description say of a position inside?"),
    M("tangent_point", "stays inside", tangent(inside=stays, middle=stays),
      "From inside the body is to stay where it is.",
      "What does the description say of a position inside?"),
    M("tangent_point", "no number at the centre", tangent(middle=no_number),
      "At the centre no direction leads to the centre, and 0/0 is not a number.",
      "What does the description say of a position at the centre?"),
    M("tangent_point", "stays at the centre", tangent(middle=stays),
      "At the centre the result is the centre itself, which is no point of the surface.",
      "What does the description say of a position at the centre?"),

    M("nearest_approach", "time turned round", approach(sign=-1),
      "The sign of the time is wrong. Bodies that approach have a negative x·u, and bodies that part a positive one.",
      "A is at −3 and comes with +1, B is at 0. What is x·u?"),
    M("nearest_approach", "in the past", approach(time=not_cut),
      "The time may be negative. Bodies that move apart were nearest in the past; of all times from now on, they are"
      " nearest now.",
      "What does the description say of bodies that move apart?"),
    M("nearest_approach", "past for future", approach(time=turned_round),
      "The sign of the time is lost: bodies that move apart are said to be nearest some day.",
      "Two bodies move apart. Are they nearer in a second or now?"),
    M("nearest_approach", "speed not squared", approach(time=over_speed),
      "x·u is divided by the speed once. It has to be divided by its square.",
      "Which unit has x·u/u? And x·u/u²?"),
    M("nearest_approach", "half of the time", approach(time=half),
      "The time is half as long as it should be. In 2 x·u + 2 u² t both terms have the factor 2.",
      "Where does the derivative of the squared distance vanish?"),
    M("nearest_approach", "as if straight at each other", of_distance,
      "The time is the distance over the speed, as if the two flew straight at each other.",
      "Two bodies pass each other a kilometre apart. When are they nearest?"),
    M("nearest_approach", "time of the touch", at_touch,
      "Where they will overlap, the time is that of the first touch. Their centres are nearest later.",
      "Two balls fly head-on through each other. When is the distance of their centres smallest?"),
    M("nearest_approach", "gap of now", approach(at=lambda x, u, t, va, vb: x + 0 * u),
      "The gap is that of now, and not that at the time.",
      "Where are the two at that time?"),
    M("nearest_approach", "A moves alone until then", approach(at=lambda x, u, t, va, vb: x + np.asarray(va) * t),
      "The time is right. For the gap A moves on until then, but B stays where it is now.",
      "Where is B at that time?"),
    M("nearest_approach", "goes backwards", approach(at=lambda x, u, t, va, vb: x - u * t),
      "The time is right, but for the gap the two move backwards.",
      "Where is A at that time, as seen from B?"),
    M("nearest_approach", "A's velocity alone", approach(velocity=lambda a, b: a + 0 * np.asarray(b)),
      "Only A moves, as if B were at rest.",
      "Which argument makes no difference to your answer?"),
    M("nearest_approach", "B's velocity alone", approach(velocity=lambda a, b: -np.asarray(b) + 0 * a),
      "Only B moves, as if A were at rest.",
      "Which argument makes no difference to your answer?"),
    M("nearest_approach", "velocities added", approach(velocity=np.add),
      "The velocities are added. Seen from B, A moves with the difference.",
      "Both fly side by side at 10 m/s. How fast does A come nearer?"),
    M("nearest_approach", "velocity of B from A", approach(velocity=lambda a, b: np.asarray(b) - a),
      "The place is that of A from B, but the velocity is that of B from A.",
      "Which of the two is subtracted, for the place and for the velocity?"),
    M("nearest_approach", "places added", approach(place=np.add),
      "The places are added. The way from B to A is their difference.",
      "Both are at 10 m. How far are they apart?"),
    M("nearest_approach", "A's radius alone", approach(reach=lambda a, b: np.asarray(a) + 0 * np.asarray(b)),
      "Only A's radius is subtracted.",
      "How far are the centres apart when the surfaces touch?"),
    M("nearest_approach", "B's radius alone", approach(reach=lambda a, b: np.asarray(b) + 0 * np.asarray(a)),
      "Only B's radius is subtracted.",
      "How far are the centres apart when the surfaces touch?"),
    M("nearest_approach", "centre to centre", approach(reach=lambda a, b: 0 * both(a, b)),
      "The distance is that of the centres. That of the surfaces is wanted.",
      "How far are the centres apart when the surfaces touch?"),
    M("nearest_approach", "radii added", approach(reach=lambda a, b: -both(a, b)),
      "The radii are added to the distance of the centres.",
      "How far are the centres apart when the surfaces touch?"),
    M("nearest_approach", "difference of the radii", approach(reach=np.subtract),
      "One radius is subtracted, and the other one is added.",
      "How far are the centres apart when the surfaces touch?"),
    M("nearest_approach", "never negative", approach(gap=lambda gap: np.maximum(gap, 0.0)),
      "An overlap is cut off at zero.",
      "What does the description say of spheres that will overlap?"),
    M("nearest_approach", "no number side by side", approach(time=unguarded),
      "At equal velocities 0/0 is not a number.",
      "What does the description say of equal velocities?"),
    M("nearest_approach", "never side by side", approach(
        time=never_for_none, at=lambda x, u, t, va, vb: x + u * np.where(np.isfinite(t), t, 0.0)),
      "At equal velocities the time is infinite. They keep their distance, and it is no smaller later than it is now.",
      "What does the description say of equal velocities?"),
)
# fmt: on
