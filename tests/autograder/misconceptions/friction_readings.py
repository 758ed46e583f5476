"""Loose readings of the slides about friction: the limit as a value, friction as a reaction, level floors alone."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, dot, flat, formulas_of, over, size

DRY, LIMITS, SUPPORT = map(formulas_of, ("friction", "friction_limits", "friction_support"))


def always_static(push, v, N, s, k):
    """−μ_s N along the velocity or, at rest, along the push."""
    way = np.where(size(v) > 0, direction(v), direction(push))
    return -col(s * np.asarray(N)) * way + 0 * col(k)


def whole_step_after_the_stop(p, v, f, N, s, k, m, dt):
    """From where it stops, a whole step more."""
    place, speed, time = DRY.slide(p, v, f, N, s, k, m, dt)
    after = (f + DRY.friction(f, 0 * np.asarray(v), N, s, k)) / col(m)
    dt = col(dt)
    stopped = col(time) <= dt
    rest = np.where(stopped, dt - col(np.where(np.isfinite(time), time, 0)), 0)
    extra = np.where(stopped, after * (dt**2 - rest**2) / 2, 0)
    return place + extra, speed + np.where(stopped, after * (dt - rest), 0), time


def weight_alone(m, g, f, a, n):
    g, f, a = (np.asarray(each, dtype=float) for each in (g, f, a))
    return np.maximum(0, -flat(dot(col(m) * (g - a) + 0 * f, n))), SUPPORT.support(m, g, f, a, n)[1]


def nothing_along(m, g, f, a, n):
    N, along = SUPPORT.support(m, g, f, a, n)
    return N, np.where(col(N) > 0, along, 0.0)


def slow_is_at_rest(push, v, N, s, k):
    return DRY.friction(push, np.where(size(v) > 1e-2, v, 0.0), N, s, k)


def hardly_moving_is_at_rest(push, v, N, s, k):
    return DRY.friction(push, np.where(size(v) > 1e-9, v, 0.0), N, s, k)


def no_more_than_the_push(f, v, N, s, k):
    return -np.minimum(col(k * N), size(f)) * direction(v)


def stops_without_the_push(p, v, f, N, s, k, m, dt):
    """The time to stop is that of friction alone."""
    a, speed = (f + DRY.friction(f, v, N, s, k)) / col(m), flat(size(v))
    time = np.where(speed > 0, over(speed, k * np.asarray(N) / m), np.inf)
    stops = time <= dt
    first = col(np.minimum(time, dt))
    rest = np.asarray(dt)[..., None] - first
    after = np.where(col(stops), (f + DRY.friction(f, 0 * np.asarray(v), N, s, k)) / col(m), 0)
    place, speed = p + v * first + a * first**2 / 2, np.where(col(stops), 0, v + a * first)
    return place + speed * rest + after * rest**2 / 2, speed + after * rest, np.where(stops, time, np.inf)


def braked_by(opposes):
    """Only a push that opposes the velocity lets the body stop."""
    return lambda p, v, f, *rest: DRY.slide(p, v, f, *rest, stop=opposes(flat(dot(np.asarray(f), v))))


def step_of_a_game(p, v, f, N, s, k, m, dt):
    """The new velocity moves the body, or it stops where the velocity would turn."""
    a, dt = (f + DRY.friction(f, v, N, s, k)) / col(m), np.asarray(dt, dtype=float)[..., None]
    new = v + a * dt
    turned = (size(v) > 0) & (dot(new, v) <= 0)
    new = np.where(turned, 0.0, new)
    return p + new * dt, new, flat(np.where(turned, over(size(v), size(a)), np.inf))


def root_over_nothing(found):
    """The root (−b + √(b² − a c))/a, with something else where a is 0 and b is positive."""

    def time(force, rate, n, mu):
        rise, f, g = -flat(dot(rate, n)), SUPPORT.along(np.asarray(force), n), SUPPORT.along(np.asarray(rate), n)
        N = -flat(dot(force, n))
        a, b = flat(dot(g, g)) - (mu * rise) ** 2, flat(dot(f, g)) - np.asarray(mu) ** 2 * N * rise
        right = LIMITS.leaving(force, rate, n, mu)
        lifts = np.where(rise < 0, N / np.where(rise < 0, -rise, 1), np.inf)
        return np.where((right > 0) & (np.abs(a) < 1e-12) & (b > 0), np.minimum(found, lifts), right)

    return time


def shortened(length):
    return lambda f, limit: f * np.minimum(1, over(col(limit), length(np.asarray(f)), np.inf))


def share_squared(f, limit):
    return np.where(size(f) > col(limit), f * over(col(limit), size(f), 1) ** 2, f)


def along_x_alone(v, w, R, mu, g, dt):
    """As in a drawing: x and the turning about y."""
    seen = np.asarray(v) * [1, 0, 0], np.asarray(w) * [0, 1, 0]
    after = SUPPORT.roll(*seen, R, mu, g, dt)
    return v + after[0] - seen[0], w + after[1] - seen[1]


def against_the_velocity_until_it_rolls(v, w, R, mu, g, dt):
    def push(J, wanted, u, limit):
        return -np.minimum(size(wanted), limit) * direction(v)

    return SUPPORT.roll(v, w, R, mu, g, dt, push=push)


def steady_push_holds(force, rate, n, mu):
    along = SUPPORT.along(np.asarray(rate), n)
    time = LIMITS.leaving(force, rate, n, mu)
    return np.where((flat(size(along)) == 0) & (time > 0), np.inf, time)


def pulled_off_as_pressed(N, rise):
    return np.abs(N), np.where(N < 0, -rise, rise)


# fmt: off
BANK = (
    M("support_force", "weight alone presses", weight_alone,
      "The support carries the weight and nothing else. A push into the surface presses the body on as well, and one"
      " out of it takes some of the load away.",
      "Somebody leans on a crate. Does it press on the floor as it did before?"),
    M("support_force", "nothing along where it lifts off", nothing_along,
      "Where the body is lifted off, the force along the surface is set to zero too. The support gives nothing then;"
      " the other forces along the surface are what they were.",
      "A crane lifts a crate while the wind blows. Which force along the ground is left?"),
    M("friction_force", "square limit", DRY.of(held=lambda f, v, N, s, k: np.max(
        np.abs(f), axis=-1, keepdims=True) <= col(s * N)),
      "Each component of the push is compared with the limit. What counts is how large the push is as a whole.",
      "How large is a push of 4 N along x and 4 N along y?"),
    M("friction_force", "slow is at rest", slow_is_at_rest,
      "A body that slides slowly is taken for one at rest. Dry friction does not depend on the speed: as long as the"
      " body moves at all, it slides.",
      "A glacier slides a metre a day. Which of the two coefficients does it feel?"),
    M("friction_force", "hardly moving is at rest", hardly_moving_is_at_rest,
      "A body below some tiny speed is taken for one at rest. Dry friction does not depend on the speed: as long as the"
      " body moves at all, it slides.",
      "A continent moves by 10⁻⁹ m/s. Which of the two coefficients does it feel?"),
    M("friction_force", "no more than the push", DRY.of(moving=no_more_than_the_push),
      "While the body slides, friction is never more than the push, as if it only answered the push. A book that slides"
      " by itself would then never stop.",
      "Slide a book over a table and let go. Nothing pushes it. What stops it?"),
    M("sliding_motion", "push left out of the stop", stops_without_the_push,
      "The time to stop is that of friction alone. The push brakes the body as well, or drives it on.",
      "Somebody pushes against a crate that slides. Does it stop sooner than by itself?"),
    M("sliding_motion", "no stop while pushed on", braked_by(lambda along: along <= 0),
      "A body that is pushed along its way is said never to stop. Friction may be larger than the push, and then it is"
      " braked all the same.",
      "Somebody helps a sliding crate on with one finger. Does it slide for ever?"),
    M("sliding_motion", "no stop unless pushed back", braked_by(lambda along: along < 0),
      "Only a push against the velocity lets the body stop. Friction brakes it as well, and alone if nobody pushes.",
      "A crate slides, and nobody pushes it. What stops it? Which sign has v·a then?"),
    M("sliding_motion", "step of a game", step_of_a_game,
      "The body moves with the velocity at the end of the step, and a velocity that would turn is set to zero. The"
      " exact motion includes the way of the braking, and what comes after the stop.",
      "A body is braked steadily from 2 m/s to rest within one step of 1 s. How far does it get?"),
    M("clamp_to_circle", "diamond", shortened(lambda f: np.sum(np.abs(f), axis=-1, keepdims=True)),
      "The sizes of the components are added up to the size of the force. What friction can give is then a diamond and"
      " no circle.",
      "How large is a force of 3 N along x and 4 N along y?"),
    M("clamp_to_circle", "level floors alone", shortened(lambda f: size(f * np.array([1, 1, 0]))),
      "The size of the force is that of its x and y components. Along a slope a force has a z component as well.",
      "How large is a force of 3 N along x and 4 N along z?"),
    M("clamp_to_circle", "share squared", share_squared,
      "The force is multiplied by the square of the share: a root is missing.",
      "How long is your answer to a force of twice the limit?"),
    M("roll_step", "against the velocity until it rolls", against_the_velocity_until_it_rolls,
      "Friction opposes the velocity of the centre until the ball rolls. It opposes the slip of the point that touches"
      " the floor, which may go another way.",
      "A ball spins on the spot. Does friction act on it, and which way?"),
    M("roll_step", "along x alone", along_x_alone,
      "The ball rolls along x alone, as in a drawing from the side: what moves along y, and what turns about x, is left"
      " as it is.",
      "Which components of v and ω does your answer leave as they are?"),
    M("break_away_time", "pulled off as if pressed on", lambda *given: LIMITS.leaving(
        *given, press=pulled_off_as_pressed),
      "A force that pulls the body off its support is taken for one that presses it on.",
      "A crate hangs on a rope. How much can friction hold?"),
    M("break_away_time", "a steady push holds", steady_push_holds,
      "A push along the surface that does not grow is said to hold for ever. The normal force may fall meanwhile, and"
      " with it what friction can hold.",
      "You push a crate steadily while somebody begins to lift it. What happens?"),
    M("break_away_time", "no time where both grow alike", root_over_nothing(np.inf),
      "Where the push grows as fast as the limit falls, a is zero, and the usual root divides by it. The equation is"
      " linear then, and its time is lost: the body is said to hold until it is lifted off.",
      "The push grows by 1 N/s, and μ_s N falls by 1 N/s. What are a and the root's denominator?"),
    M("break_away_time", "0/0 where both grow alike", root_over_nothing(np.nan),
      "Where the push grows as fast as the limit falls, a is zero, and the usual root is 0/0. The equation is linear"
      " then.",
      "The push grows by 1 N/s, and μ_s N falls by 1 N/s. What are a and the root's denominator?"),
    M("break_away_time", "a tiny number for a = 0", root_over_nothing(0.0),
      "Where the push grows as fast as the limit falls, a is zero, and the root is divided by a tiny number instead."
      " Its numerator is zero as well, and the body is said to break away at once.",
      "The push grows by 1 N/s, and μ_s N falls by 1 N/s. What are a and −b + √(b² − a c)?"),
    M("friction_force", "limit while held", DRY.of(rest=lambda f, v, N, s, k: -col(s * N) * direction(f)),
      "A body that is held gets μ_s N, as slide 24 prints it. That is only the largest value of static friction: "
      "with a gentle push, friction would win and set the body in motion against the push.",
      "Push a heavy box with one finger. How large is the friction, if the box stays where it is?"),
    M("friction_force", "static throughout", always_static,
      "Friction is μ_s N always, at rest and while the body slides. "
      "Slide 24 has two coefficients, and the static one only gives the largest value for a body at rest.",
      "Which argument does your answer not depend on? And how large is the friction on a box that nobody pushes hard?"),
    M("sliding_motion", "a whole step after the stop", whole_step_after_the_stop,
      "After the stop the body moves for a whole Δt. Only the rest of the step is left by then.",
      "How much time has passed when your function returns?"),
)
# fmt: on
