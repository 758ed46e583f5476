"""Known mistakes of the side of a plane that a point is on, and of when it comes through."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, flat, over, size


def plane(p, n, d):
    return flat(dot(n, p)) + d


def magnitudes(s0, s1, t, dt):
    """The slide's T of signed distances."""
    return t + dt * over(s0, s0 + s1)


def guarded(fraction):
    return lambda s0, s1, t, dt: np.where((s0 >= 0) & (s1 < 0), t + dt * fraction(s0, s1), np.inf)


def fall(s, u, a, clamp=True):
    s = np.maximum(s, 0.0) if clamp else np.asarray(s)
    return s, np.asarray(u), np.asarray(a), np.asarray(u**2 - 2 * a * s)


def roots(s, u, a):
    """Both roots of s + u t + a t²/2, NaN where there is none; a = 0 as a straight line."""
    s, u, a, disc = fall(s, u, a)
    root = np.sqrt(disc)
    straight = np.where(u < 0, -s / u, np.inf)
    return np.where(a == 0, straight, (-u - root) / a), np.where(a == 0, straight, (-u + root) / a)


def first_root(s, u, a):
    low, high = roots(s, u, a)
    return np.where(np.isnan(low), np.inf, np.minimum(low, high))


def other_root(s, u, a):
    high = roots(s, u, a)[1]
    return np.where(np.isnan(high), np.inf, high)


def straight_line(s, u, a):
    return np.where(u < 0, np.maximum(s, 0.0) / -np.where(u < 0, u, 1), np.inf)


def from_rest(s, u, a):
    return np.where(a < 0, np.sqrt(2 * np.maximum(s, 0) / np.where(a < 0, -a, 1)), np.inf)


def root_with(disc_of):
    def time(s, u, a):
        s, u, a, _ = fall(s, u, a)
        disc = disc_of(s, u, a)
        root = np.sqrt(np.maximum(disc, 0))
        return np.where((disc >= 0) & (a < 0), (u + root) / np.where(a < 0, -a, 1), straight_line(s, u, a))

    return time


def clipped(s, u, a, positive=lambda disc: np.maximum(disc, 0.0)):
    s, u, a, disc = fall(s, u, a)
    root = np.sqrt(positive(disc))
    rising = u >= 0
    below = np.where(rising, -a, root - u)
    return np.where(below > 0, np.where(rising, u + root, 2 * s) / np.where(below > 0, below, 1), np.inf)


def right_fall(s, u, a):
    return np.where(fall(s, u, a)[3] >= 0, clipped(s, u, a), np.inf)


def in_the_past(s, u, a):
    time = right_fall(s, u, a)
    return np.where(np.isfinite(time), -time, np.inf)


def not_clamped(s, u, a):
    s, u, a, disc = fall(s, u, a, clamp=False)
    root = np.sqrt(disc)
    rising = u >= 0
    below = np.where(rising, -a, root - u)
    return np.where((disc >= 0) & (below > 0), np.where(rising, u + root, 2 * s) / below, np.inf)


def now_where_on_plane(s, u, a):
    return np.where(np.asarray(s) <= 0, 0.0, right_fall(s, u, a))


def refuses_rising(s, u, a):
    return np.where(u > 0, np.inf, right_fall(s, u, a))


# fmt: off
BANK = (
    M("signed_distance", "not over the length", plane,
      "The slide's a x + b y + c z + d is taken for the distance. It is one only where the normal has length 1.",
      "Double all four coefficients: is it another plane? Is your distance another?"),
    M("signed_distance", "offset not over the length", lambda p, n, d: flat(dot(n, p) / size(n)) + d,
      "The normal is made a unit vector, but the offset d belongs to the normal as it was given, and stays as it is.",
      "Which number changes too when you divide the plane's whole equation by something?"),
    M("signed_distance", "offset alone over the length", lambda p, n, d: flat(dot(n, p) + col(d) / size(n)),
      "Only the offset is divided by ‖n‖: n·p has to be as well; brackets are missing.",
      "In which units is each of the two terms, with a normal of length 2?"),
    M("signed_distance", "offset subtracted", lambda p, n, d: (flat(dot(n, p)) - d) / flat(size(n)),
      "The offset has the wrong sign: the plane is n·p + d = 0, not n·p = d.",
      "Put the point of the plane that is nearest to the origin into your formula. What must come out?"),
    M("signed_distance", "sign lost", lambda p, n, d: np.abs(plane(p, n, d)) / flat(size(n)),
      "The absolute value is returned, so that nobody can tell any more on which side the point is.",
      "What tells a point behind the plane from one in front of it?"),
    M("signed_distance", "sides swapped", lambda p, n, d: -plane(p, n, d) / flat(size(n)),
      "The sign is turned round: a distance in front of the plane, where the normal points to, is positive.",
      "Where does the normal point to, and what is the distance of a point there?"),
    M("signed_distance", "length squared", lambda p, n, d: plane(p, n, d) / flat(dot(n, n)),
      "It is divided by n·n, which is the length squared: that gives the foot of the perpendicular in units of n.",
      "What unit has your result if the normal is given in metres?"),
    M("signed_distance", "times the length", lambda p, n, d: plane(p, n, d) * flat(size(n)),
      "It is multiplied with the normal's length instead of divided by it.",
      "Make the normal ten times as long. What should happen to n·p + d, and what to the distance?"),
    M("signed_distance", "offset left out", lambda p, n, d: flat(dot(n, p) / size(n)) + 0 * np.asarray(d),
      "The offset d is not used, so that every plane goes through the origin.",
      "Which of the four coefficients of the plane does not appear in your formula?"),
    M("signed_distance", "offset over the length twice", lambda p, n, d: plane(p, n, d) / flat(dot(n, n)) ** 1.5,
      "The normal is normalised first, and then everything is divided by its old length once more.",
      "How often does the length have to be taken out?"),
    M("signed_distance", "largest component", lambda p, n, d: plane(p, n, d) / np.max(np.abs(n), axis=-1),
      "The normal is divided by its largest component, not by its length.",
      "What is the length of (1, 1, 1)?"),
    M("signed_distance", "sum of components", lambda p, n, d: plane(p, n, d) / np.sum(np.abs(n), axis=-1),
      "The normal's length is taken as |a| + |b| + |c|, along the axes instead of straight.",
      "How long is the way straight from corner to corner?"),
    M("signed_distance", "one length for all", lambda p, n, d: plane(p, n, d) / np.linalg.norm(n),
      "With several planes at once, one length is taken of all their normals together.",
      "Along which axis do the components of a single normal lie?"),
    M("side_of_plane", "sides swapped", lambda s, tol=0.0: 1 * (s < -tol) - 1 * (s > tol),
      "Front and back are swapped: in front of the plane is +1.",
      "On which side is a point whose separation is positive?"),
    M("side_of_plane", "two sides", lambda s, tol=0.0: np.where(np.asarray(s) < -tol, -1, 1),
      "There are only two sides, as on the slide: a point on the plane is said to be in front.",
      "What should come out of a point that touches?"),
    M("side_of_plane", "two sides, touching behind", lambda s, tol=0.0: np.where(np.asarray(s) > tol, 1, -1),
      "There are only two sides: a point on the plane is said to be behind.",
      "What should come out of a point that touches?"),
    M("side_of_plane", "tolerance left out", lambda s, tol=0.0: np.sign(s) + 0 * np.asarray(tol),
      "The tolerance is not used: rounding puts nearly every point that touches on one side or the other.",
      "Which argument makes no difference to your answer?"),
    M("side_of_plane", "open tolerance", lambda s, tol=0.0: 1 * (s >= tol) - 1 * (s <= -tol),
      "At exactly the tolerance the point is no longer on the plane; up to and with this distance it should be. "
      "With no tolerance a touching point is on both sides at once, and only by luck comes out as 0.",
      "Read again what is promised of a point exactly at the tolerance."),
    M("side_of_plane", "tolerance in front alone", lambda s, tol=0.0: 1 * (s > tol) - 1 * (s < 0),
      "The tolerance is applied in front of the plane only.",
      "How far behind the plane is a point still on it?"),
    M("side_of_plane", "tolerance behind alone", lambda s, tol=0.0: 1 * (s > 0) - 1 * (s < -tol),
      "The tolerance is applied behind the plane only.",
      "How far in front of the plane is a point still on it?"),
    M("side_of_plane", "moved plane", lambda s, tol=0.0: np.sign(s - tol),
      "The tolerance lacks its minus behind the plane, or it is subtracted from the separation: "
      "both move the plane, and it stays as thin as it was on slide 4.",
      "On how many sides of the plane does the tolerance matter?"),
    M("side_of_plane", "true or false", lambda s, tol=0.0: 1 * (np.asarray(s) < -tol),
      "It says whether there is a collision, 1 or 0, not on which side the point is.",
      "How many answers are there?"),
    M("side_of_plane", "sign lost", lambda s, tol=0.0: 1 * (np.abs(s) > tol),
      "The sign of the separation is lost: a point far behind the plane is taken for one far in front.",
      "What does the absolute value do to the two sides of the plane?"),
    M("side_of_plane", "behind or not", lambda s, tol=0.0: -1 * (np.asarray(s) < -tol),
      "It says only whether the point is behind the plane. In front of it and on it the answer is the same.",
      "How many answers are there, and which of them do you never give?"),
    M("side_of_plane", "edge behind left out", lambda s, tol=0.0: 1 * (s > tol) - 1 * (s <= -tol),
      "A point behind the plane by exactly the tolerance counts as behind; up to and with this distance it is on it. "
      "Without a tolerance a point that touches collides, where the slide has <.",
      "What does the slide's < say of a point exactly on the plane?"),
    M("side_of_plane", "edge in front left out", lambda s, tol=0.0: 1 * (s >= tol) - 1 * (s < -tol),
      "A point in front of the plane by exactly the tolerance counts as in front; up to and with this distance it is "
      "on it.",
      "Read again what is promised of a point exactly at the tolerance."),
    M("side_of_plane", "two sides, tolerance left out",
      lambda s, tol=0.0: np.where(np.broadcast_arrays(s, tol)[0] < 0, -1, 1),
      "There are only two sides, as on the slide, and the tolerance is not used.",
      "What should come out of a point that touches, except for rounding?"),
    M("side_of_plane", "two sides, touching behind, tolerance left out",
      lambda s, tol=0.0: np.where(np.broadcast_arrays(s, tol)[0] > 0, 1, -1),
      "There are only two sides, a point on the plane is said to be behind, and the tolerance is not used.",
      "What does the slide's < say of a point exactly on the plane? And what should come out of one that touches?"),
    M("time_of_impact_interpolated", "the slide's magnitudes", magnitudes,
      "The slide's d1/(d1 + d2) is used with signed distances. "
      "Its d are magnitudes: behind the plane the distance is negative, and the sum is no longer the whole way.",
      "Draw the two distances on a line. How long is the way from the one end to the other?"),
    M("time_of_impact_interpolated", "the slide's magnitudes, guarded", guarded(lambda a, b: over(a, a + b)),
      "The slide's d1/(d1 + d2) is used with signed distances. "
      "Its d are magnitudes: behind the plane the distance is negative, and the sum is no longer the whole way.",
      "Draw the two distances on a line. How long is the way from the one end to the other?"),
    M("time_of_impact_interpolated", "no guard", lambda s0, s1, t, dt: t + dt * over(s0, s0 - s1),
      "A time is given whether or not the point goes through the plane in this step.",
      "What should come out of a point that stays in front?"),
    M("time_of_impact_interpolated", "no guard, magnitudes",
      lambda s0, s1, t, dt: t + dt * over(np.abs(s0), np.abs(s0) + np.abs(s1)),
      "With absolute values a time is given whether or not the point goes through the plane in this step.",
      "What should come out of a point that stays in front? Do the absolute values know of it?"),
    M("time_of_impact_interpolated", "from the end", guarded(lambda a, b: over(-np.asarray(b), a - b)),
      "The wrong distance is on top: this is the share of the step that is left after the impact.",
      "A point that starts close to the plane: does it arrive early or late?"),
    M("time_of_impact_interpolated", "start left out",
      lambda s0, s1, t, dt: np.where((s0 >= 0) & (s1 < 0), dt * over(s0, s0 - s1) + 0 * np.asarray(t), np.inf),
      "It is the time since the start of the step; the start t itself is not added.",
      "Which argument makes no difference to your answer?"),
    M("time_of_impact_interpolated", "step left out",
      lambda s0, s1, t, dt: np.where((s0 >= 0) & (s1 < 0), t + over(s0, s0 - s1) + 0 * np.asarray(dt), np.inf),
      "It is the share of the step, a number from 0 to 1, and not yet a time: the step's length is missing.",
      "What unit has s0/(s0 − s1)?"),
    M("time_of_impact_interpolated", "step over the share", guarded(lambda a, b: over(a - b, a)),
      "The fraction is upside down: the impact comes out after the end of the step.",
      "Can T be later than t + Δt?"),
    M("time_of_impact_interpolated", "touching start left out",
      lambda s0, s1, t, dt: np.where((s0 > 0) & (s1 < 0), t + dt * over(s0, s0 - s1), np.inf),
      "A point that starts exactly on the plane and goes through is not seen: it tunnels.",
      "What happens in the next step to a body that was left exactly on the plane?"),
    M("time_of_impact_interpolated", "touching end counts",
      lambda s0, s1, t, dt: np.where((s0 >= 0) & (s1 <= 0), t + dt * over(s0, s0 - s1, 0), np.inf),
      "A point that ends exactly on the plane, or lies on it, counts as having gone through.",
      "Is it behind the plane at the end of the step?"),
    M("time_of_impact_interpolated", "sign change in both ways",
      lambda s0, s1, t, dt: np.where(s0 * s1 < 0, t + dt * over(s0, s0 - s1), np.inf),
      "Any change of sign counts: also a point that comes out from behind the plane.",
      "Which way has to be gone for an impact? And what of a product of exactly zero?"),
    M("time_of_impact_interpolated", "the step's end for no impact",
      lambda s0, s1, t, dt: np.where((s0 >= 0) & (s1 < 0), t + dt * over(s0, s0 - s1), t + dt),
      "Where nothing is hit the end of the step is returned, which looks like an impact at that instant.",
      "How would the caller tell that nothing was hit?"),
    M("time_of_impact_interpolated", "start taken away", guarded(lambda a, b: -over(a, a - b)),
      "The share of the step has the wrong sign: the impact lies before the step.",
      "Can T be earlier than t?"),
    M("time_of_impact_interpolated", "guard of the end alone",
      lambda s0, s1, t, dt: np.where(np.asarray(s1) < 0, t + dt * over(s0, s0 - s1), np.inf),
      "It asks only whether the step ends behind the plane. One that starts behind it met it in an earlier step.",
      "What should come out of a point that is behind the plane all the time?"),
    M("time_of_impact_interpolated", "guard of the start alone",
      lambda s0, s1, t, dt: np.where(np.asarray(s0) >= 0, t + dt * over(s0, s0 - s1), np.inf),
      "It asks only whether the step starts in front of the plane, not whether it ends behind it.",
      "What should come out of a point that stays in front?"),
    M("time_of_impact_exact", "gravity left out", straight_line,
      "Time is way over speed, as if the velocity did not change on the way down.",
      "Let a ball fall from rest: what does your formula say?"),
    M("time_of_impact_exact", "start velocity left out", from_rest,
      "It is the time of a fall from rest: the velocity at the start makes no difference.",
      "Throw the ball down. Should it arrive sooner?"),
    M("time_of_impact_exact", "earlier root", first_root,
      "Of the two roots the smaller one is taken. Where the parabola opens downwards that one lies in the past.",
      "Put in a fall from rest and look at the sign of the time."),
    M("time_of_impact_exact", "half forgotten", root_with(lambda s, u, a: u * u - 4 * a * s),
      "The quadratic formula is used with a in place of a/2: the motion is s + u t + a t²/2.",
      "What is the coefficient of t²?"),
    M("time_of_impact_exact", "without the two", root_with(lambda s, u, a: u * u - a * s),
      "Under the root the factor 2 is missing: v² = u² − 2 a s.",
      "With what speed does a ball arrive that falls from a height h?"),
    M("time_of_impact_exact", "sign under the root", root_with(lambda s, u, a: u * u + 2 * a * s),
      "Under the root the sign is wrong: the acceleration towards the plane is negative and makes the body faster.",
      "Is the body slower or faster when it arrives?"),
    M("time_of_impact_exact", "root of a negative number", clipped,
      "A negative number under the root is set to zero and gives a time. "
      "It says that the body turns round before it arrives.",
      "What does it mean for the motion when the root does not exist?"),
    M("time_of_impact_exact", "root of the size", lambda s, u, a: clipped(s, u, a, np.abs),
      "The root is taken of the size of a negative number: there a body turns round before it reaches the plane.",
      "What does a negative number under the root say of the path?"),
    M("time_of_impact_exact", "in the past", in_the_past,
      "The sign is turned round: the time lies in the past.",
      "Which sign has a where it pulls towards the plane? So which sign has what stands below the line?"),
    M("time_of_impact_exact", "never when rising", refuses_rising,
      "A body that moves away is said never to arrive. Thrown up, it comes down again.",
      "Throw a ball up. What then?"),
    M("time_of_impact_exact", "at once on the plane", now_where_on_plane,
      "Whatever is on the plane is said to hit it now. One that moves away comes back later.",
      "A ball has just bounced and is on its way up. When does it hit next?"),
    M("time_of_impact_exact", "behind not on the plane", not_clamped,
      "A body that rounding has put just behind the plane is not treated as one on it.",
      "What should become of a separation below zero?"),
    M("time_of_impact_exact", "later root always", other_root,
      "The root with the plus is always taken. Which of the two comes first depends on the sign of a.",
      "A positive acceleration: the parabola opens upwards. Which root is reached first?"),
    M("time_of_impact_exact", "velocity's sign", lambda s, u, a: right_fall(s, -np.asarray(u), a),
      "The velocity has the wrong sign: it is positive when moving away from the plane.",
      "Throw the ball up. Should it arrive later or sooner?"),
    M("time_of_impact_exact", "acceleration's sign", lambda s, u, a: right_fall(s, u, -np.asarray(a)),
      "The acceleration has the wrong sign: towards the plane it is negative already.",
      "What is a for a ball that falls?"),
)
# fmt: on
