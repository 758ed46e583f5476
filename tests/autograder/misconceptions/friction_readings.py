"""Loose readings of the slides about friction: the limit as a value, and time that has passed."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, formulas_of, size

DRY = formulas_of("friction")


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


# fmt: off
BANK = (
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
