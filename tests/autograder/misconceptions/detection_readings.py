"""Loose readings of the slides about detection: a sign of a tolerance, t for Δt, a midpoint, a test left out."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import formulas_of, over

guarded = formulas_of("detection").guarded


def share(s0, s1):
    return over(s0, np.asarray(s0) - s1, 0)


def crossing(time):
    """A time only where the point goes through the plane within the step."""
    return lambda s0, s1, t, dt: np.where((s0 >= 0) & (s1 < 0), time(share(s0, s1), t, dt), np.inf)


def without_test(s, u, a):
    """The root with the minus, whatever its sign, and whether or not there is one."""
    s = np.maximum(s, 0.0)
    root = np.sqrt(u * u - 2 * a * s)
    return np.where(a == 0, -s / u, -(u + root) / a)


# fmt: off
BANK = (
    M("side_of_plane", "moved plane forwards", lambda s, tol=0.0: np.sign(s + tol),
      "The tolerance has the wrong sign in front of the plane, or it is added to the separation: "
      "both move the plane, and it stays as thin as it was on slide 4.",
      "Take a point that is just in front of the plane, within the tolerance. On which side does your answer put it?"),
    M("time_of_impact_interpolated", "t for Δt", crossing(lambda part, t, dt: t + t * part + 0 * np.asarray(dt)),
      "The share of the step is multiplied by t, the time at the start. "
      "On slide 5 the factor is Δt, the length of the step.",
      "Let the same step begin an hour later. Should the impact come later within the step?"),
    M("time_of_impact_interpolated", "t for Δt, no guard", lambda s0, s1, t, dt: t + t * share(s0, s1) + 0 * dt,
      "The share of the step is multiplied by t, the time at the start, and not by the length Δt of slide 5. "
      "Besides, a point that does not reach the plane also gets a time.",
      "Let the same step begin an hour later. Should the impact come later within the step?"),
    M("time_of_impact_interpolated", "t for Δt, no guard, magnitudes",
      lambda s0, s1, t, dt: t + t * over(np.abs(s0), np.abs(s0) + np.abs(s1), 0) + 0 * dt,
      "The share of the step is multiplied by t, the time at the start, and not by the length Δt of slide 5. "
      "Besides, with absolute values a point that does not reach the plane also gets a time.",
      "Let the same step begin an hour later. Should the impact come later within the step?"),
    M("time_of_impact_interpolated", "Δt for t", crossing(lambda part, t, dt: dt + dt * part + 0 * np.asarray(t)),
      "The count begins at Δt. On slide 5 it begins at t, the time at which the step starts.",
      "At what time is a point on the plane that was already on it when the step began?"),
    M("time_of_impact_interpolated", "Δt as the end", crossing(lambda part, t, dt: t + (dt - np.asarray(t)) * part),
      "Δt is treated as the time at which the step ends. On slide 5 it is the length of the step.",
      "A step begins at t = 3 s and lasts 0.1 s. When does it end?"),
    M("time_of_impact_interpolated", "midpoint", guarded(lambda s0, s1: 0.5 + 0 * np.asarray(s0)),
      "The impact is put in the middle of every step. On slide 5 the two distances decide where it lies.",
      "A point starts close to the plane and ends far behind it. Does it meet the plane early or late in the step?"),
    M("time_of_impact_interpolated", "midpoint, no guard", lambda s0, s1, t, dt: t + dt / 2 + 0 * (np.asarray(s0) - s1),
      "The impact is put in the middle of every step, and also of a step in which the point does not reach the plane. "
      "On slide 5 the two distances decide where the impact lies.",
      "Which arguments does your answer not depend on? What should a point get that stays in front?"),
    M("time_of_impact_interpolated", "midpoint of t and Δt", crossing(lambda part, t, dt: (t + np.asarray(dt)) / 2),
      "The mean of t and Δt is taken for the middle of the step. Δt is a length of time, not the end of the step, "
      "and on slide 5 the two distances decide where the impact lies.",
      "A step begins at t = 3 s and lasts 0.1 s. When does it end? And is every impact in the middle?"),
    M("time_of_impact_exact", "no test", without_test,
      "The root is returned without a look at what it means. "
      "There may be no root, it may lie in the past, and with a = 0 the formula of the parabola does not hold.",
      "A body moves away from the plane and nothing pulls it back. What does your formula return for it?"),
)
# fmt: on
