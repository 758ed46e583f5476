"""Known mistakes of what presses and pushes a body, what friction answers, and how it slides."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, dot, flat, over, size


def friction(push, v, N, s, k, moving=None, rest=None, breaks=None, held=None):
    """Friction from what it is while moving, while held, and when it gives way."""
    limit, kinetic = col(s * np.asarray(N)), col(k * np.asarray(N))
    moving = -kinetic * direction(v) if moving is None else moving
    rest = -np.asarray(push) if rest is None else rest
    breaks = -kinetic * direction(push) if breaks is None else breaks
    held = size(push) <= limit if held is None else held
    return np.where(size(v) > 0, moving, np.where(held, rest, breaks))


def of(**parts):
    """A version of friction whose parts are functions of (push, v, N, s, k)."""

    def force(push, v, N, s, k):
        given = np.asarray(push), np.asarray(v), np.asarray(N), np.asarray(s), np.asarray(k)
        return friction(*given, **{name: part(*given) for name, part in parts.items()})

    return force


def always_kinetic(push, v, N, s, k):
    return -col(k * np.asarray(N)) * np.where(size(v) > 0, direction(v), direction(push)) + 0 * col(s)


def slide_static(push, v, N, s, k):
    """The slide: friction has the size of its limit."""
    way = np.where(size(v) > 0, direction(v), direction(push))
    return -np.where(size(v) > 0, col(k * np.asarray(N)), col(s * np.asarray(N))) * way


def helps_throughout(push, v, N, s, k):
    return -friction(push, v, N, s, k)


def static_wherever_it_would_hold(push, v, N, s, k):
    way = np.where(size(v) > 0, direction(v), direction(push))
    return np.where(size(push) <= col(s * np.asarray(N)), -np.asarray(push), -col(k * np.asarray(N)) * way)


def without_normal_force(push, v, N, s, k):
    sliding, starting = -col(k) * direction(v) + 0 * col(N), -col(k) * direction(push)
    return friction(push, v, N, s, k, moving=sliding, breaks=starting)


grows_with_speed = of(moving=lambda f, v, N, s, k: -col(k * N) * v)


def viscosity(push, v, N, s, k):
    return -col(k * np.asarray(N)) * v + 0 * np.asarray(push) + 0 * col(s)


def slide(p, v, f, N, s, k, m, dt, force=friction, stop=True, held=True, again=True, half=0.5):
    """Exact motion, with what may be wrong about it."""
    m, dt = col(m), np.asarray(dt)
    a = (f + force(f, v, N, s, k)) / m
    squared, closing = flat(dot(v, v)), -flat(dot(v, a))
    stops = (squared > 0) & (squared <= closing * dt) & stop
    time = np.where(stops, squared / np.where(stops, closing, 1), np.inf)
    first = col(np.minimum(time, dt))
    p, v = p + v * first + half * a * first**2, np.where(col(stops), 0, v + a * first)
    rest = col(dt) - first
    after = np.where(col(stops), (f + force(f, v, N, s, k)) / m if again else 0 * a, 0)
    return p + half * after * rest**2, v + after * rest, time


def euler(p, v, f, N, s, k, m, dt):
    a, dt = (f + friction(f, v, N, s, k)) / col(m), col(dt)
    time = slide(p, v, f, N, s, k, m, flat(dt))[2]
    return p + v * dt, v + a * dt, time


def never(p, v, f, N, s, k, m, dt):
    """Without looking for the stop: friction turns the body round."""
    return slide(p, v, f, N, s, k, m, dt, stop=False)


def without_end(p, v, f, N, s, k, m, dt):
    """The stopping time even where it lies after the step."""
    a = (f + friction(f, v, N, s, k)) / col(m)
    squared, closing = flat(dot(v, v)), -flat(dot(v, a))
    place, speed, _ = slide(p, v, f, N, s, k, m, dt)
    return place, speed, np.where((squared > 0) & (closing > 0), over(squared, np.maximum(closing, 0)), np.inf)


def end_for_no_stop(p, v, f, N, s, k, m, dt):
    place, speed, time = slide(p, v, f, N, s, k, m, dt)
    return place, speed, np.where(np.isinf(time), dt, time)


def without_mass(p, v, f, N, s, k, m, dt):
    return slide(p, v, f, N, s, k, 1.0 + 0 * np.asarray(m), dt)


def with_force(force):
    return lambda *given: slide(*given, force=force)


def ends_where_it_stops(p, v, f, N, s, k, m, dt):
    """Resting for ever once stopped, from the start as well."""
    place, speed, time = slide(p, v, f, N, s, k, m, dt, again=False)
    return place, speed, time


def no_motion_from_rest(p, v, f, N, s, k, m, dt):
    place, speed, time = slide(p, v, f, N, s, k, m, dt)
    return np.where(size(v) > 0, place, p), np.where(size(v) > 0, speed, v), time


# fmt: off
BANK = (
    M("friction_force", "the slide's static friction", slide_static,
      "At rest friction has the size μ_s N, as slide 24 prints it. "
      "That is only the largest value: it pushes back harder than one pushes, and sets the body in motion.",
      "Push a heavy box gently. How large is the friction?"),
    M("friction_force", "along the velocity", of(moving=lambda f, v, N, s, k: col(k * N) * direction(v)),
      "Friction acts along the velocity and makes the body faster.",
      "Which way does friction point on a body that slides to the right?"),
    M("friction_force", "along everything",
      helps_throughout,
      "The sign is wrong throughout: friction acts along the motion and along the push.",
      "Which way does friction point on a body that slides to the right?"),
    M("friction_force", "along the velocity's size", grows_with_speed,
      "The velocity itself is taken for its direction: the faster, the more friction. "
      "Dry friction does not depend on the speed.",
      "How long is the vector that you multiply with μ N?"),
    M("friction_force", "sign of each component", of(moving=lambda f, v, N, s, k: -col(k * N) * np.sign(v)),
      "Each component gets the full friction, by its sign: along the diagonal that is too much, and points askew.",
      "How large is the friction on a body that slides along the diagonal?"),
    M("friction_force", "static while sliding", of(moving=lambda f, v, N, s, k: -col(s * N) * direction(v)),
      "The static coefficient is used while the body slides.",
      "Which coefficient belongs to a body that slides?"),
    M("friction_force", "static when it gives way", of(breaks=lambda f, v, N, s, k: -col(s * N) * direction(f)),
      "A body that breaks away slides: from then on it is the kinetic coefficient that counts.",
      "Which coefficient belongs to a body that has broken away?"),
    M("friction_force", "kinetic limit", of(held=lambda f, v, N, s, k: size(f) <= col(k * N)),
      "Whether the body holds is decided by the kinetic coefficient.",
      "Which coefficient says how much a body at rest can take?"),
    M("friction_force", "coefficients swapped",
      lambda f, v, N, s, k: friction(f, v, N, k, s),
      "The two coefficients are swapped: the static one, the larger, is of a body at rest.",
      "Which of them is larger, and when is it felt?"),
    M("friction_force", "always kinetic", always_kinetic,
      "A body at rest gets kinetic friction, even where it pushes back harder than one pushes.",
      "Push a heavy box gently. How large is the friction?"),
    M("friction_force", "none at rest", of(rest=lambda f, v, N, s, k: 0 * f, breaks=lambda f, v, N, s, k: 0 * f),
      "A body at rest gets no friction: it would slide off the gentlest slope.",
      "What holds a box on a slope?"),
    M("friction_force", "no limit", of(breaks=lambda f, v, N, s, k: -f),
      "Whatever the push, a body at rest is held: there is no limit.",
      "Push a light box hard. What happens?"),
    M("friction_force", "static wherever it would hold",
      static_wherever_it_would_hold,
      "Static friction is applied to a body that slides, whenever the push is small: it would slide on for ever.",
      "Slide a book over a table and let go. Nothing pushes it. Is there friction?"),
    M("friction_force", "against the push while sliding", of(moving=lambda f, v, N, s, k: -col(k * N) * direction(f)),
      "While the body slides friction opposes the push; it should oppose the velocity.",
      "Slide a book to the right and push it to the left. Which way does friction point?"),
    M("friction_force", "normal force left out",
      without_normal_force,
      "The kinetic friction is μ_k without the normal force: a number without a unit is taken for a force.",
      "What unit has μ_k?"),
    M("friction_force", "nothing when it gives way", of(breaks=lambda f, v, N, s, k: 0 * f),
      "A body that breaks away gets no friction at all; it slides, and kinetic friction opposes it.",
      "What acts on a box that has just broken away?"),
    M("friction_force", "along the push when it gives way", of(breaks=lambda f, v, N, s, k: col(k * N) * direction(f)),
      "Once the push is too large friction helps it: it should oppose the motion that begins.",
      "Which way will the body start to slide?"),
    M("friction_force", "held not at the limit", of(held=lambda f, v, N, s, k: size(f) < col(s * N)),
      "At exactly the limit the body is let go; static friction can be as large as μ_s N.",
      "How large can static friction be?"),
    M("friction_force", "divides by no speed",
      lambda f, v, N, s, k: -col(k * np.asarray(N)) * np.asarray(v) / size(v) + 0 * np.asarray(f) + 0 * col(s),
      "The velocity is divided by its size even where there is none: 0/0. And a body at rest has no case of its own.",
      "What is v/‖v‖ of a body at rest? And which friction has it?"),
    M("friction_force", "viscosity",
      viscosity,
      "Friction is taken to be −μ N v, as if it were viscosity: it grows with the speed, and there is none at rest.",
      "What holds a box on a slope?"),
    M("sliding_motion", "friction turns it round", never,
      "The stop within the step is not looked for: friction goes on pushing and turns the body round.",
      "Can friction set a body in motion against the way it slid?"),
    M("sliding_motion", "explicit Euler", euler,
      "It is a step of explicit Euler: the place lacks a t²/2, and the body is turned round where it should stop.",
      "The acceleration is constant while it slides. What is the exact motion?"),
    M("sliding_motion", "mass left out", without_mass,
      "The force is taken for the acceleration: the mass is missing.",
      "Which argument makes no difference to your answer?"),
    M("sliding_motion", "stays where it stops", ends_where_it_stops,
      "Once it has stopped it stays, even where the push is more than static friction can hold.",
      "It has slid up a steep slope and stopped. What then?"),
    M("sliding_motion", "never starts", no_motion_from_rest,
      "A body at rest stays at rest, however hard it is pushed.",
      "Push a light box hard. What happens?"),
    M("sliding_motion", "a t² whole", lambda *given: slide(*given, half=1),
      "The way has a t² without the half.",
      "How far does a body get that is braked to a stop from v by a?"),
    M("sliding_motion", "way without braking", lambda *given: slide(*given, half=0),
      "The way is v t: the braking on the way is left out.",
      "How far does a body get that is braked to a stop from v by a?"),
    M("sliding_motion", "no friction", with_force(lambda f, v, N, s, k: 0 * f + 0 * v),
      "Friction makes no difference: the body slides as on ice.",
      "Which arguments make no difference to your answer?"),
    M("sliding_motion", "friction drives", with_force(lambda f, v, N, s, k: -friction(f, v, N, s, k)),
      "Friction has the wrong sign and drives the body.",
      "Which way does friction point on a body that slides to the right?"),
    M("sliding_motion", "static friction while sliding",
      with_force(of(moving=lambda f, v, N, s, k: -col(s * N) * direction(v))),
      "The static coefficient is used while the body slides.",
      "Which coefficient belongs to a body that slides?"),
    M("sliding_motion", "push left out", lambda p, v, f, N, s, k, m, dt: slide(p, v, 0 * np.asarray(f), N, s, k, m, dt),
      "The push makes no difference to the motion.",
      "Which argument makes no difference to your answer?"),
    M("sliding_motion", "stops after the step", without_end,
      "A stopping time is given even where the body has not stopped at the end of the step.",
      "What should come out of a body that still moves at the end of the step?"),
    M("sliding_motion", "step for no stop", end_for_no_stop,
      "Where the body does not stop, the step's length is returned, which looks like a stop at its end.",
      "How would the caller tell that it did not stop?"),
    M("sliding_motion", "velocity over the friction",
      with_force(grows_with_speed),
      "The velocity itself is taken for its direction: the faster, the more friction.",
      "How long is the vector that you multiply with μ N?"),
)
# fmt: on
