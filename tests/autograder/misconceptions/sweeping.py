"""Known mistakes about a ray against a sphere, and about two balls that move."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import direction, dot, flat, size


def inner(a, b):
    return flat(dot(a, b))


def length(a):
    return flat(size(a))


def squares(x, u, r):
    """u², x·u and x² − r² of the quadratic equation."""
    return inner(u, u), inner(x, u), inner(x, x) - np.asarray(r) ** 2


def root(a, b, c, sign=-1):
    """A root of a t² + 2 b t + c; NaN where there is none."""
    return (-b + sign * np.sqrt(b * b - a * c)) / a


def ahead(t):
    return np.where(t >= 0, t, np.inf)


def inside(x, u, r):
    return (length(x) <= r) & (inner(u, u) >= 0)


def hardly_outside(x, u, r):
    """Within by a number of square metres."""
    return inner(x, x) - np.asarray(r) ** 2 + 0 * inner(u, u) <= 1e-9


def never(x, u, r):
    return inside(x, u, r) & False


def met(when=root, starts=inside, terms=squares, counts=ahead):
    """The time of a root, where it counts; 0 from within."""

    def found(x, u, r):
        return np.where(starts(x, u, r), 0.0, counts(when(*terms(x, u, r))))

    return found


right = met()


def first_ahead(a, b, c):
    """The smaller of the roots that are ahead."""
    near, far = root(a, b, c), root(a, b, c, 1)
    return np.where(near >= 0, near, far)


def double_b(a, b, c):
    """The formula with b² − 4 a c and 2 a, although b = x·u here."""
    return (-b - np.sqrt(b * b - 4 * a * c)) / (2 * a)


def unit_direction(x, u, r):
    a, b, c = squares(x, u, r)
    return np.where(a > 0, 1.0, a), b, c


def no_root_is_zero(a, b, c):
    return (-b - np.sqrt(np.maximum(b * b - a * c, 0))) / a


def in_metres(x, u, r):
    return np.where(inside(x, u, r), 0.0, right(x, direction(u), r))


def nearest(a, b, c):
    """The time of the nearest point, where this is within the sphere."""
    return np.where(b * b - a * c >= 0, -b / a, np.inf)


def as_it_comes(t):
    """NaN for a miss, and a negative time for a sphere behind the ray."""
    return t


def minus_one(t):
    return np.where(t >= 0, t, -1.0)


def zero_for_a_miss(t):
    return np.where(t >= 0, t, 0.0)


# Two balls


def late(t, dt):
    """Infinity after the step."""
    return np.where(t <= dt, t, np.inf)


def swept(
    ray=right,
    place=lambda a, b: np.asarray(a) - b,
    velocity=lambda a, b: np.asarray(a) - b,
    radius=lambda a, b: np.asarray(a) + b,
    ends=late,
):
    def found(xa, va, ra, xb, vb, rb, dt):
        x, u = place(xa, xb) + 0 * np.asarray(xb), velocity(va, vb) + 0 * np.asarray(vb)
        r = radius(ra, rb) + 0 * np.asarray(rb)
        return ends(ray(x, u, r), np.asarray(dt, dtype=float))

    return found


def looks_at_the_ends(xa, va, ra, xb, vb, rb, dt):
    x, u, r = np.asarray(xa) - xb, np.asarray(va) - vb, np.asarray(ra) + rb
    now, then = length(x) <= r, length(x + u * np.asarray(dt, dtype=float)[..., None]) <= r
    return np.where(now, 0.0, np.where(then, dt, np.inf))


def straight(x, u, r):
    """As if they flew straight at each other."""
    return np.where(inside(x, u, r), 0.0, ahead((length(x) - r) / length(u)))


def towards(x, u, r):
    """As if the speed of approach stayed what it is now."""
    return np.where(inside(x, u, r), 0.0, ahead(-(length(x) - r) * length(x) / inner(x, u)))


# fmt: off
BANK = (
    M("ray_sphere", "hardly outside is inside", met(starts=hardly_outside),
      "A start whose x² − r² is below a fixed number counts as one on the surface. The number is an area: around a"
      " grain of dust it is always small.",
      "How large is x² − r², in square metres, one micrometre before a ball of a micrometre?"),
    M("ray_sphere", "far root", met(lambda a, b, c: root(a, b, c, 1)),
      "The time is that at which the ray leaves the sphere. A line crosses a sphere twice, and the ray comes in at the"
      " earlier of the two times.",
      "Which of the two roots is smaller? And on which side of the sphere is the ray then?"),
    M("ray_sphere", "time of leaving", met(lambda a, b, c: root(a, b, c, 1), starts=never),
      "The time is that at which the ray leaves the sphere, from outside and from within. A line crosses a sphere"
      " twice, and a ray that starts within is inside already.",
      "Which of the two roots is smaller? And how long does a ray wait that starts in the middle?"),
    M("ray_sphere", "exit from within", met(first_ahead, starts=never),
      "A ray that starts inside is given the time at which it leaves. The question is when it is inside for the first"
      " time, and that is now.",
      "Put the start in the middle of the sphere. How long does the ray have to wait until it is inside?"),
    M("ray_sphere", "nothing from within", met(starts=never),
      "A ray that starts inside is said to miss: its entry lies in the past, and nothing else is asked.",
      "Put the start in the middle of the sphere. Is the ray inside at t = 0?"),
    M("ray_sphere", "behind the start",
      met(counts=lambda t: np.where(np.isnan(t), np.inf, t)),
      "A sphere behind the ray is met at a negative time. A ray has a start, and a line has none.",
      "Let the ray fly away from the sphere. When will it meet the sphere?"),
    M("ray_sphere", "x·u for 2 x·u", met(double_b),
      "The formula with b² − 4ac and 2a belongs to the equation a t² + b t + c = 0. Your b is not the number that"
      " stands before t in the equation of the ray.",
      "Multiply out (x + u t)·(x + u t). Which number stands before t?"),
    M("ray_sphere", "direction of length 1", met(terms=unit_direction),
      "The result is right only for a direction of length 1. The direction may have any length: twice as fast, and the"
      " ray is there in half the time.",
      "Which number stands before t² in your equation?"),
    M("ray_sphere", "metres for seconds", in_metres,
      "The direction is made one of length 1, and so the result is how far the ray goes, not for how long.",
      "A ray starts 4 m from the sphere, and u is 2 m/s. Which number should come out?"),
    M("ray_sphere", "radius not squared",
      met(terms=lambda x, u, r: (inner(u, u), inner(x, u), inner(x, x) - r)),
      "The square of the distance is compared with the radius, not with its square.",
      "Which units have the two sides of your equation?"),
    M("ray_sphere", "nearest point", met(nearest),
      "The time is that at which the ray is nearest to the middle. By then it has been inside for half a chord.",
      "Where on the ray is it for the first time as far from the middle as the radius?"),
    M("ray_sphere", "no root as zero", met(no_root_is_zero),
      "A number below the root that is negative is taken for zero, and so a ray that misses meets the sphere at its"
      " nearest point.",
      "What does it mean that a quadratic equation has no root?"),
    M("ray_sphere", "NaN for a miss", met(counts=as_it_comes),
      "The root is taken of whatever there is, and the smaller solution is returned as it comes: NaN for a miss, and"
      " a negative time where the sphere lies behind.",
      "What does the description say of a miss? And which times can a ray have?"),
    M("ray_sphere", "NaN for a miss alone", met(counts=lambda t: np.where(t < 0, np.inf, t)),
      "The root is taken of whatever there is. It is NaN for a ray that misses.",
      "What does the description say of a miss?"),
    M("ray_sphere", "−1 for a miss", met(counts=minus_one),
      "A miss is reported as −1. The description wants infinity, which is later than the end of any step.",
      "Which of your later lines would take −1 for a time before the end of the step?"),
    M("ray_sphere", "0 for a miss", met(counts=zero_for_a_miss),
      "A miss gives the time 0, as if the ray were inside now.",
      "How can anyone who calls your function tell a miss from a start within?"),
    M("ray_sphere", "ray turned round", met(terms=lambda x, u, r: squares(x, -np.asarray(u), r)),
      "The ray flies backwards: a sphere ahead is missed, and one behind it is met.",
      "Which sign has x·u for a ray that comes nearer? And −x·u?"),
    M("ray_sphere", "half of the radius", lambda x, u, r: right(x, u, np.asarray(r) / 2),
      "The radius is taken for a diameter.",
      "How far from the middle is the surface?"),
    M("ray_sphere", "twice the radius", lambda x, u, r: right(x, u, 2 * np.asarray(r)),
      "The sphere is twice as large as it should be.",
      "How far from the middle is the surface?"),
    M("ray_sphere", "surface is outside", met(starts=lambda x, u, r: (length(x) < r) & (inner(u, u) >= 0)),
      "A ray that starts on the surface and goes out is said to miss. The surface belongs to the sphere.",
      "What does the description say of a start on the surface?"),
    M("ray_sphere", "grazing is a miss",
      met(lambda a, b, c: np.where(b * b - a * c > 0, root(a, b, c), np.inf)),
      "A ray that grazes the sphere is said to miss. It touches the surface at one point.",
      "What is the number below the root if the ray grazes the sphere?"),
    M("ray_sphere", "0/0 without a direction",
      met(counts=lambda t: np.where(np.isnan(t), t, np.where(t >= 0, t, np.inf)),
          when=lambda a, b, c: np.where(b * b - a * c < 0, np.inf, root(a, b, c))),
      "Without a direction the formula divides zero by zero.",
      "Where is the ray after a second if it has no direction?"),

    M("sweep_sphere_sphere", "beyond the step", swept(ends=lambda t, dt: t + 0 * np.where(dt < np.inf, dt, 0)),
      "A contact after the end of the step is reported as well. Velocities are constant in this step only, so that"
      " nobody knows what comes after it.",
      "Which argument makes no difference to your answer?"),
    M("sweep_sphere_sphere", "dt for infinity", swept(ends=np.minimum),
      "Two balls that do not touch in this step are said to touch at its end.",
      "How can anyone who calls your function tell a touch at the end of the step from none?"),
    M("sweep_sphere_sphere", "end of the step left out", swept(ends=lambda t, dt: np.where(t < dt, t, np.inf)),
      "A touch at the very end of the step is left out. The description has times from 0 to dt.",
      "If this step leaves the touch to the next one, what does the next one start with?"),
    M("sweep_sphere_sphere", "share of the step", swept(ends=lambda t, dt: late(t, dt) / dt),
      "The result is a share of the step, from 0 to 1. The description has seconds.",
      "In which unit is your result?"),
    M("sweep_sphere_sphere", "A's radius alone", swept(radius=lambda a, b: np.asarray(a)),
      "Only A's radius counts: the balls touch when A's surface reaches B's centre.",
      "How far apart are the centres of two balls that touch?"),
    M("sweep_sphere_sphere", "B's radius alone", swept(radius=lambda a, b: b + 0 * np.asarray(a)),
      "Only B's radius counts: the balls touch when A's centre reaches B's surface.",
      "If A shrinks to a point, what has to happen to B?"),
    M("sweep_sphere_sphere", "larger radius", swept(radius=np.maximum),
      "Only the larger of the two radii counts.",
      "How far apart are the centres of two balls that touch?"),
    M("sweep_sphere_sphere", "difference of the radii", swept(radius=lambda a, b: np.abs(np.asarray(a) - b)),
      "The centres are as far apart as the difference of the radii: one ball is then inside the other and touches it"
      " from within.",
      "Draw two balls that touch from outside. How far apart are their centres?"),
    M("sweep_sphere_sphere", "radii by Pythagoras", swept(radius=lambda a, b: np.hypot(a, b)),
      "The square of the distance is compared with r_A² + r_B². This is not the square of r_A + r_B.",
      "Two balls have a radius of 1 m each and touch. What is the square of the distance of their centres?"),
    M("sweep_sphere_sphere", "A's velocity alone", swept(velocity=lambda a, b: np.asarray(a)),
      "Only A moves: B's velocity is left out. Seen from B, A moves with the difference of the two velocities.",
      "Two cars drive one behind the other at the same speed. When do they collide?"),
    M("sweep_sphere_sphere", "B's velocity alone", swept(velocity=lambda a, b: -np.asarray(b) + 0 * np.asarray(a)),
      "Only B moves: A's velocity is left out.",
      "Let B rest. Do the balls never touch?"),
    M("sweep_sphere_sphere", "sum of the velocities", swept(velocity=lambda a, b: np.asarray(a) + b),
      "The velocities are added. Seen from B, what B does itself is taken off.",
      "Two cars drive one behind the other at the same speed. How fast does the first one come nearer?"),
    M("sweep_sphere_sphere", "seen from the other side", swept(velocity=lambda a, b: np.asarray(b) - a),
      "The position is that of one ball seen from the other, and the velocity is seen the other way round. So balls"
      " that approach seem to part.",
      "From which ball do you look in the first difference, and from which in the second?"),
    M("sweep_sphere_sphere", "B at the origin", swept(place=lambda a, b: np.asarray(a)),
      "B's position is left out: the ball seems to be at the origin.",
      "Move both balls by 10 m. Does the time change?"),
    M("sweep_sphere_sphere", "far root", swept(met(lambda a, b, c: root(a, b, c, 1))),
      "The time is that at which the balls part again after they have passed through each other.",
      "Their centres are r_A + r_B apart twice. Which of the two times comes first?"),
    M("sweep_sphere_sphere", "time of parting", swept(met(lambda a, b, c: root(a, b, c, 1), starts=never)),
      "The time is that at which the balls part again, also of balls that overlap now.",
      "Their centres are r_A + r_B apart twice. Which of the two times comes first? And what of balls that overlap?"),
    M("sweep_sphere_sphere", "overlap is no touch", swept(met(starts=never)),
      "Balls that overlap already are said not to touch: their contact began in the past.",
      "What does the description say of balls that overlap now?"),
    M("sweep_sphere_sphere", "end of the overlap", swept(met(first_ahead, starts=never)),
      "Balls that overlap already are given the time at which they part.",
      "What does the description say of balls that overlap now?"),
    M("sweep_sphere_sphere", "straight at each other", swept(straight),
      "The gap is divided by the relative speed, as if the balls flew straight at each other. Most balls pass each"
      " other at an offset, and many miss.",
      "A ball flies past another one. How large is their gap divided by their speed, and when do they touch?"),
    M("sweep_sphere_sphere", "approach of now", swept(towards),
      "The gap is divided by the speed at which it shrinks now. While the balls pass each other, the line of their"
      " centres turns and the gap shrinks more slowly.",
      "Let one ball pass another one at a great distance. What is the speed of approach now, and what at the nearest"
      " point?"),
    M("sweep_sphere_sphere", "looks at both ends", looks_at_the_ends,
      "It asks whether the balls overlap at the start and at the end of the step. Between the two they may have passed"
      " through each other.",
      "Let the step be so long that A flies from one side of B to the other. What do you see at its end?"),
)
# fmt: on
