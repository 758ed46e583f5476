"""Known mistakes of impacts in a row."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M


def unguarded_row(v, mass, e, most=10_000):
    """One pass over all pairs, whether or not they approach."""
    return row(v, mass, e, most=1, guard=False)


def row(
    v,
    mass,
    e,
    most=10_000,
    guard=True,
    backwards=False,
    both=None,
    weight=None,
    factor=lambda e: 1 + e,
    old=False,
    moved=lambda share: share,
):
    v = np.array(v, dtype=float)
    count = v.shape[-1]
    share = np.broadcast_to(1 / np.asarray(mass, dtype=float), count)
    share = share if weight is None else np.broadcast_to(weight(share), count)
    e = np.broadcast_to(np.asarray(e, dtype=float), max(count - 1, 0))
    for _ in range(min(most, 200)):
        before = v.copy()
        for i in reversed(range(count - 1)) if backwards else range(count - 1):
            seen = before if old else v
            closing = seen[..., i] - seen[..., i + 1]
            j = factor(e[i]) * (np.maximum(0, closing) if guard else closing) / (share[i] + share[i + 1])
            v[..., i] -= j * moved(share[i])
            v[..., i + 1] += (both or 1) * j * moved(share[i + 1])
        if np.array_equal(v, before):
            break
    return v


def swapped(v, mass, e, most=10_000):
    """The faster one of two gives its velocity to the next."""
    v = np.array(v, dtype=float)
    return np.sort(v, axis=-1)


# fmt: off
BANK = (
    M("propagate_impacts", "one pass", lambda v, m, e, most=1: row(v, m, e, most=1),
      "The pairs are gone through once; some of them approach again afterwards.",
      "Is there a pair left that approaches?"),
    M("propagate_impacts", "no guard", unguarded_row,
      "Every pair collides, also one that moves apart.",
      "What should happen to two balls that move apart?"),
    M("propagate_impacts", "perfect always", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: 2),
      "Every impact is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "e for 1 + e", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: e),
      "e stands in place of 1 + e: the balls go on into each other.",
      "How large must the impulse be to bring two balls to the same speed? And how much more to part them?"),
    M("propagate_impacts", "equal masses", lambda v, m, e, most=200: row(v, 1.0, e),
      "All balls are taken to have the same mass.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "mass for its inverse",
      lambda v, m, e, most=200: row(v, m, e, weight=lambda s: np.where(s > 0, 1 / np.where(s > 0, s, 1), 1e9)),
      "The velocities change by the impulse times the mass; a heavy ball should change less.",
      "A marble hits a cannon ball. Which one flies off?"),
    M("propagate_impacts", "+J to both", lambda v, m, e, most=200: row(v, m, e, both=-1, most=50),
      "The impulse acts the same way on both balls: momentum is not conserved.",
      "What does Newton's third law say of the two?"),
    M("propagate_impacts", "all at once", lambda v, m, e, most=200: row(v, m, e, old=True),
      "All pairs of a pass use the velocities from before it: a ball between two others gets both impulses at once.",
      "After the first pair has collided, which velocity has the second ball?"),
    M("propagate_impacts", "from the right", lambda v, m, e, most=200: row(v, m, e, backwards=True),
      "The pairs are gone through from the right; the description starts on the left, and the order matters.",
      "Which pair comes first?"),
    M("propagate_impacts", "sorted", swapped,
      "The velocities are sorted: right for equal, perfectly elastic balls only.",
      "Which arguments make no difference to your answer?"),
    M("propagate_impacts", "no rebound", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: 1),
      "The balls only come to the same speed: no impact has a rebound.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "1 − e", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: 1 - e),
      "1 − e stands in place of 1 + e: with e = 1 nothing happens at all.",
      "What should two equal balls do with e = 1?"),
)
# fmt: on
