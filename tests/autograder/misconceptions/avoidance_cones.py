"""Known mistakes about the cone of relative velocities with which two discs collide."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, flat, size
from solutions.avoidance import cap_of_cone


def both(a, b):
    return np.asarray(a, dtype=float) + b


def quarter(vector):
    return np.stack([-vector[..., 1], vector[..., 0]], axis=-1)


def outer(ahead, left, sine, cosine, sign):
    return col(sign * cosine) * left - col(sine) * ahead


def nearer(u, left):
    return np.where(flat(dot(u, left)) > 0, 1.0, -1.0)


def root_of_rest(sine):
    return np.sqrt(np.maximum(1 - sine**2, 0.0))


def from_zero(u, leg):
    return -flat(dot(u, leg))


def half_plane(
    relative=np.subtract, reach=both, leg=outer, sign=nearer, cosine=root_of_rest, change=from_zero, share=0.5,
    cap_share=None, round_end=True, sides=True, normal=lambda n: n, point=None, far=lambda x: flat(size(x)),
    towards=lambda a, b: b - a, times=lambda horizon, dt: (horizon, dt), moves=lambda c: c,
):  # fmt: skip
    """The half-plane from the parts of its making: relative velocity, sum of radii, legs, share of the change."""

    def found(pa, va, ra, pb, vb, rb, horizon, dt):
        pa, va, pb, vb = (np.asarray(each, dtype=float) for each in (pa, va, pb, vb))
        x, u, r = towards(pa, pb), relative(va, vb), reach(ra, rb)
        x, u = np.broadcast_arrays(x, u)
        capped, depth, out = cap_of_cone(u, x, r, *times(horizon, dt))
        overlaps = flat(size(x)) <= r
        capped = np.where(overlaps, capped, capped & round_end) | (not sides)
        long = np.where(far(x) > 0, far(x), 1.0)
        ahead = x / col(long)
        left, sine = quarter(ahead), np.where(overlaps, 0.0, r / long)
        side = leg(ahead, left, sine, cosine(sine), sign(u, left))
        n = np.where(col(capped) > 0, out, side)
        c = moves(np.where(capped, depth, change(u, side)))
        part = np.where(capped, share if cap_share is None else cap_share, share)
        return (va if point is None else point(va, u)) + col(part * c) * n, normal(n)

    return found


def inwards(ahead, left, sine, cosine, sign):
    return -outer(ahead, left, sine, cosine, sign)


def across(ahead, left, sine, cosine, sign):
    return col(sign) * left + 0 * col(sine) * ahead


def backwards(ahead, left, sine, cosine, sign):
    return col(sign * cosine) * left + col(sine) * ahead


def swapped(ahead, left, sine, cosine, sign):
    return col(sign * sine) * left - col(cosine) * ahead


def along_the_leg(ahead, left, sine, cosine, sign):
    return col(sign * sine) * left + col(cosine) * ahead


# fmt: off
BANK = (
    M("orca_half_plane", "all of the change", half_plane(share=1.0),
      "A makes all of the change. If B does so as well, both make twice as much as they need.",
      "How much of the change is left to B?"),
    M("orca_half_plane", "all of the change on the legs", half_plane(share=1.0, cap_share=0.5),
      "On the sides of the cone A makes all of the change, at its round end half.",
      "How much of the change is left to B?"),
    M("orca_half_plane", "all of the change at the cap", half_plane(cap_share=1.0),
      "At the round end A makes all of the change, on the sides of the cone half.",
      "How much of the change is left to B?"),
    M("orca_half_plane", "no change", half_plane(share=0.0),
      "The border goes through A's own velocity, so that A need not change anything.",
      "What must happen to u if it is inside the cone?"),
    M("orca_half_plane", "inwards", half_plane(leg=inwards),
      "The normal of a side points into the cone. A would be sent into the collision.",
      "Which way out of the cone is shorter? Does your normal point there?"),
    M("orca_half_plane", "normal turned round", half_plane(normal=lambda n: -n),
      "The normal points into the cone: velocities that collide are permitted.",
      "Which side of the border is permitted?"),
    M("orca_half_plane", "always the left side", half_plane(sign=lambda u, left: 1.0 + 0 * flat(dot(u, left))),
      "The left side of the cone is always taken, even if the right one is nearer.",
      "On which side of the axis is the relative velocity?"),
    M("orca_half_plane", "always the right side", half_plane(sign=lambda u, left: -1.0 + 0 * flat(dot(u, left))),
      "The right side of the cone is always taken, even if the left one is nearer.",
      "On which side of the axis is the relative velocity?"),
    M("orca_half_plane", "farther side", half_plane(sign=lambda u, left: -nearer(u, left)),
      "The farther side of the cone is taken.",
      "On which side of the axis is the relative velocity, and which side of the cone is nearer?"),
    M("orca_half_plane", "left where both are equally near", half_plane(
        sign=lambda u, left: np.where(flat(dot(u, left)) >= 0, 1.0, -1.0)),
      "Exactly head-on each disc turns to its left. The description says right; any rule will do, if both have the"
      " same.",
      "What does the description say where both sides are equally near?"),
    M("orca_half_plane", "A's velocity for the relative one", half_plane(relative=lambda a, b: a + 0 * b),
      "B is taken to be at rest.",
      "Which argument makes no difference to your answer?"),
    M("orca_half_plane", "velocities added", half_plane(relative=np.add),
      "The velocities are added. Seen from B, A moves with the difference.",
      "Both fly side by side. What is the relative velocity?"),
    M("orca_half_plane", "velocity of B from A", half_plane(relative=lambda a, b: b - a),
      "The relative velocity is that of B as seen from A.",
      "A comes nearer to B. In which direction does it move, as seen from B?"),
    M("orca_half_plane", "way from B to A", half_plane(towards=lambda a, b: a - b),
      "The cone opens towards A's own back: it is drawn along the way from B to A.",
      "With which relative velocities does A run into B?"),
    M("orca_half_plane", "A's radius alone", half_plane(reach=lambda a, b: np.asarray(a) + 0 * np.asarray(b)),
      "Only A's radius counts. The discs touch when their centres are both radii apart.",
      "How far are the centres apart when the discs touch?"),
    M("orca_half_plane", "B's radius alone", half_plane(reach=lambda a, b: np.asarray(b) + 0 * np.asarray(a)),
      "Only B's radius counts. The discs touch when their centres are both radii apart.",
      "How far are the centres apart when the discs touch?"),
    M("orca_half_plane", "cap left out", half_plane(round_end=False),
      "The sides of the cone are used even where its round end is nearer.",
      "What does `cap_of_cone` say first?"),
    M("orca_half_plane", "sides left out", half_plane(sides=False),
      "The round end is used even where a side of the cone is nearer.",
      "What does `cap_of_cone` say first?"),
    M("orca_half_plane", "across the axis", half_plane(leg=across),
      "The normal is at right angles to the way to B. It has to be at right angles to the side of the cone.",
      "Half the angle of the cone has the sine R/L. Which angle is between the normal and the way to B?"),
    M("orca_half_plane", "leans forwards", half_plane(leg=backwards),
      "The part along the way to B has the wrong sign: the normal points out of a cone that opens towards A.",
      "Is a slower A nearer to the border of the cone, or a faster one?"),
    M("orca_half_plane", "sine for cosine", half_plane(leg=swapped),
      "R/L and k/L are exchanged in the normal.",
      "What is the normal for two points, with R = 0?"),
    M("orca_half_plane", "along the side", half_plane(leg=along_the_leg),
      "The vector points along the side of the cone, and not out of it.",
      "What is the normal for two points, with R = 0?"),
    M("orca_half_plane", "never gives way", half_plane(moves=lambda c: np.maximum(c, 0.0)),
      "Outside the cone the change is cut off at zero. There it is negative: A may give up half of its room.",
      "Which vector leads from u to the border if u is outside?"),
    M("orca_half_plane", "size of the change", half_plane(moves=np.abs),
      "The change has lost its sign: outside the cone the border is put on the far side of A's velocity.",
      "Which vector leads from u to the border if u is outside?"),
    M("orca_half_plane", "change turned round", half_plane(change=lambda u, leg: -from_zero(u, leg)),
      "The change on the sides of the cone has the wrong sign.",
      "What is u·n for a velocity inside the cone? In which direction must it change?"),
    M("orca_half_plane", "point of relative velocities", half_plane(point=lambda va, u: u),
      "The point is that of the relative velocity plus half the change. A velocity of A is wanted.",
      "Whose velocities are divided into permitted ones and others?"),
    M("orca_half_plane", "change alone", half_plane(point=lambda va, u: 0 * va),
      "The point is half the change alone. A's velocity is to be added to it.",
      "What is the point if nothing has to change?"),
    M("orca_half_plane", "step for horizon", half_plane(times=lambda horizon, dt: (dt, dt)),
      "The step takes the place of the horizon even if the discs are apart.",
      "For how long are discs that are apart to avoid each other?"),
    M("orca_half_plane", "horizon for step", half_plane(times=lambda horizon, dt: (horizon, horizon)),
      "Discs that overlap are given the whole horizon to part.",
      "What does the description say of discs that overlap?"),
)
# fmt: on
