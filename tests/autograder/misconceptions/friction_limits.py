"""Known mistakes of how much a surface can hold, and until when."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import along, col, direction, dot, flat, over, size


def leaving(force, rate, n, mu, press=None, now=True, coefficient=lambda mu: mu, earlier=False):
    """When F_t + F_t' t is as long as μ (N + N' t): its first root, or what is mistaken for it."""
    mu = coefficient(np.asarray(mu))
    N, rise = -flat(dot(force, n)), -flat(dot(rate, n))
    if press is not None:
        N, rise = press(N, rise)
    f, g = along(force, n), along(rate, n)
    held = (flat(size(f)) <= mu * np.maximum(N, 0)) & (N >= 0)
    a, b = flat(dot(g, g)) - (mu * rise) ** 2, flat(dot(f, g)) - mu**2 * N * rise
    c = np.minimum(0, flat(dot(f, f)) - (mu * N) ** 2)
    root = np.sqrt(np.maximum(0, b * b - a * c))
    with np.errstate(all="ignore"):
        sign = -1 if earlier else 1
        late = np.where(a > 0, (sign * root - b) / np.where(a != 0, a, 1), np.inf)
        leaves = late if earlier else np.where(b > 0, -c / (b + root), late)
        lifts = np.where(rise < 0, -N / np.where(rise < 0, rise, 1), np.inf)
    found = np.minimum(leaves, lifts)
    return np.where(held, found, 0.0) if now else found


def scalar_push(force, rate, n, mu):
    """As if the push only grew in length, along itself."""
    N, rise = -flat(dot(force, n)), -flat(dot(rate, n))
    f, g = flat(size(along(force, n))), flat(size(along(rate, n)))
    mu = np.asarray(mu)
    held = (f <= mu * np.maximum(N, 0)) & (N >= 0)
    gain = g - mu * rise
    time = np.where(gain > 0, np.maximum(mu * N - f, 0) / np.where(gain > 0, gain, 1), np.inf)
    lifts = np.where(rise < 0, -N / np.where(rise < 0, rise, 1), np.inf)
    return np.where(held, np.minimum(time, lifts), 0.0)


def from_no_push(force, rate, n, mu):
    """μ N over the rate, as if nothing pushed at the start."""
    return leaving(np.asarray(force) - along(force, n), rate, n, mu)


def infinity_where_not_held(force, rate, n, mu):
    time = leaving(force, rate, n, mu)
    return np.where(time == 0, np.inf, time)


# fmt: off
BANK = (
    M("clamp_to_circle", "each component alone", lambda f, limit: np.clip(f, -col(limit), col(limit)),
      "Each component is clamped on its own: that is a square, and it turns the force.",
      "Does your answer point the same way as the force?"),
    M("clamp_to_circle", "always the limit", lambda f, limit: col(limit) * direction(f),
      "The force is scaled to the limit even where it is smaller: friction would push back harder than one pushes.",
      "What should come out of a force below the limit?"),
    M("clamp_to_circle", "not clamped", lambda f, limit: 1.0 * np.asarray(f) + 0 * col(limit),
      "The force comes back unchanged, however large.",
      "Which argument makes no difference to your answer?"),
    M("clamp_to_circle", "nothing beyond the limit", lambda f, limit: np.where(size(f) <= col(limit), f, 0.0),
      "Beyond the limit nothing is left; friction still gives as much as it can.",
      "How large should the answer be to a force far beyond the limit?"),
    M("clamp_to_circle", "not scaled by the length", lambda f, limit: np.where(size(f) > col(limit), f * col(limit), f),
      "Beyond the limit the force is multiplied with it: it has to be divided by its own length first.",
      "How long is your answer?"),
    M("clamp_to_circle", "ratio upside down", lambda f, limit: f * np.maximum(1, over(size(f), col(limit), 1)),
      "The ratio is upside down: the force grows where it should be cut.",
      "Should the factor be more or less than 1?"),
    M("clamp_to_circle", "short ones stretched", lambda f, limit: f * np.maximum(1, over(col(limit), size(f), 1)),
      "The larger of the two factors is taken: short forces are stretched, long ones are left.",
      "Should the factor be more or less than 1?"),
    M("clamp_to_circle", "largest component",
      lambda f, limit: f * np.minimum(1, over(col(limit), np.max(np.abs(f), axis=-1, keepdims=True), 1)),
      "The largest component is taken for the length: along the diagonal too much is left.",
      "How long is a force of 4 N along x and 4 N along y?"),
    M("clamp_to_circle", "from above alone", lambda f, limit: np.minimum(f, col(limit)),
      "Components are cut from above only, each on its own: a force backwards is not cut at all.",
      "What becomes of (−9, 0, 0)?"),
    M("clamp_to_circle", "turned round", lambda f, limit: -f * np.minimum(1, over(col(limit), size(f), 1)),
      "The sign is turned round; the direction should stay.",
      "What should come out of a force below the limit?"),
    M("clamp_to_circle", "one for all", lambda f, limit: f * np.minimum(1, over(col(limit), np.linalg.norm(f), 1)),
      "With several forces in one call, one length is taken of all of them together.",
      "Along which axis do the components of a single force lie?"),
    M("clamp_to_circle", "squared length",
      lambda f, limit: np.where(size(f) > col(limit), f * over(col(limit), size(f) ** 2, 1), f),
      "It is divided by the square of the length.",
      "How long is your answer?"),
    M("clamp_to_circle", "0/0", lambda f, limit: f * np.minimum(1, col(limit) / size(f)),
      "Without force and without friction it divides 0 by 0.",
      "What is limit/‖F‖ when both are zero?"),
    M("break_away_time", "normal force constant", lambda *given: leaving(*given, press=lambda N, rise: (N, 0 * rise)),
      "The normal force is taken to stay as it is; it changes with the force.",
      "What does a lifting force do to the limit while it grows?"),
    M("break_away_time", "from no push", from_no_push,
      "The push that is there at the start makes no difference.",
      "A push near the limit and one far from it: which lets go sooner?"),
    M("break_away_time", "lengths for vectors", scalar_push,
      "The push is taken to grow along itself: lengths are added where vectors have to be. "
      "A push that first has to turn round comes out wrong.",
      "The push is 3 N to the right and changes by 2 N/s to the left. How large is it after a second?"),
    M("break_away_time", "earlier root", lambda *given: leaving(*given, earlier=True),
      "Of the two roots the earlier one is taken, which lies in the past.",
      "It holds now. Can it have broken away before?"),
    M("break_away_time", "μ not squared", lambda *given: leaving(*given, coefficient=np.sqrt),
      "When both sides are squared, μ is squared as well.",
      "What is the square of μ N?"),
    M("break_away_time", "not held now", lambda *given: leaving(*given, now=False),
      "A body that is not held even now gets another time than 0.",
      "What should come out where the push is too large already?"),
    M("break_away_time", "infinity where it is not held", infinity_where_not_held,
      "Where it is not held even now, infinity comes out, which says that it is always held.",
      "What should come out where the push is too large already?"),
    M("break_away_time", "frictionless", lambda *given: leaving(*given, coefficient=lambda mu: 0 * mu),
      "Friction makes no difference: any push breaks it away.",
      "Which argument makes no difference to your answer?"),
    M("break_away_time", "normal force falls and rises",
      lambda *given: leaving(*given, press=lambda N, rise: (N, -rise)),
      "The change of the normal force has the wrong sign.",
      "The force grows into the support. Does N grow or fall?"),
    M("break_away_time", "no friction left over", lambda *given: leaving(*given, coefficient=lambda mu: 1 + 0 * mu),
      "The push is compared with the normal force itself: μ makes no difference.",
      "Which argument makes no difference to your answer?"),
)
# fmt: on
