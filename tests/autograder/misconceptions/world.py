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
    rounds=None,
    later=None,
    quiet=np.array_equal,
    back=1,
    pairs=lambda count: range(count - 1),
    closing_of=lambda closing: np.maximum(0, closing),
):
    v = np.array(v, dtype=float)
    count = v.shape[-1]
    share = np.broadcast_to(1 / np.asarray(mass, dtype=float), count)
    share = share if weight is None else np.broadcast_to(weight(share), count)
    e = np.broadcast_to(np.asarray(e, dtype=float), max(count - 1, 0))
    for k in range(min(most if rounds is None else rounds(count, most), 200)):
        before = v.copy()
        for i in reversed(range(count - 1)) if backwards else pairs(count):
            seen = before if old else v
            closing = seen[..., i] - seen[..., i + 1]
            bounce = e[i] if k == 0 or later is None else later
            j = factor(bounce) * (closing_of(closing) if guard else closing) / (share[i] + share[i + 1])
            v[..., i] -= back * j * moved(share[i])
            v[..., i + 1] += (both or 1) * j * moved(share[i + 1])
        if quiet(v, before):
            break
    return v


def with_(**parts):
    return lambda v, m, e, most=10_000: row(v, m, e, most, **parts)


def by_products(v, m, e, most=10_000):
    """Impulses by m M/(m + M), which is no number if one mass is infinite."""
    m = np.broadcast_to(np.asarray(m, dtype=float), np.shape(v)[-1:])
    v = np.array(v, dtype=float)
    for _ in range(min(most, 200)):
        before = v.copy()
        for i in range(len(m) - 1):
            with np.errstate(all="ignore"):
                both = m[i] * m[i + 1] / (m[i] + m[i + 1])
            j = (1 + np.broadcast_to(e, len(m) - 1)[i]) * both * np.maximum(0, v[..., i] - v[..., i + 1])
            v[..., i] -= j / m[i]
            v[..., i + 1] += j / m[i + 1]
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
    M("propagate_impacts", "perfect always", lambda v, m, e, most=200: row(v, m, e, most, factor=lambda e: 2),
      "Every impact is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "e for 1 + e", lambda v, m, e, most=200: row(v, m, e, most, factor=lambda e: e),
      "e stands in place of 1 + e: the balls go on into each other.",
      "How large must the impulse be to bring two balls to the same speed? And how much more to part them?"),
    M("propagate_impacts", "equal masses", lambda v, m, e, most=200: row(v, 1.0, e, most),
      "All balls are taken to have the same mass.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "mass for its inverse",
      lambda v, m, e, most=200: row(v, m, e, most, weight=lambda s: np.where(s > 0, 1 / np.where(s > 0, s, 1), 1e9)),
      "The velocities change by the impulse times the mass; a heavy ball should change less.",
      "A marble hits a cannon ball. Which one flies off?"),
    M("propagate_impacts", "+J to both", lambda v, m, e, most=200: row(v, m, e, min(most, 50), both=-1),
      "The impulse acts the same way on both balls: momentum is not conserved.",
      "What does Newton's third law say of the two?"),
    M("propagate_impacts", "all at once", lambda v, m, e, most=200: row(v, m, e, most, old=True),
      "All pairs of a pass use the velocities from before it: a ball between two others gets both impulses at once.",
      "After the first pair has collided, which velocity has the second ball?"),
    M("propagate_impacts", "from the right", lambda v, m, e, most=200: row(v, m, e, most, backwards=True),
      "The pairs are gone through from the right; the description starts on the left, and the order matters.",
      "Which pair comes first?"),
    M("propagate_impacts", "no guard, until none approaches",
      with_(guard=False, quiet=lambda v, before: not np.any(v[..., :-1] > v[..., 1:])),
      "Every pair collides in its turn, also one that moves apart.",
      "What should happen to two balls that move apart?"),
    M("propagate_impacts", "product of the masses", by_products,
      "m M/(m + M) is no number if one of the masses is infinite: divide by 1/m + 1/M.",
      "How large is 1/m for a wall? And what is infinity over infinity?"),
    M("propagate_impacts", "the first pair's restitution", lambda v, m, e, most=10_000: row(v, m, np.ravel(e)[0], most),
      "All pairs have the restitution of the first one.",
      "`e` may have a number for each pair. Which of them makes no difference to your answer?"),
    M("propagate_impacts", "a round for each ball", with_(rounds=lambda count, most: count),
      "There are as many rounds as balls. A light ball between two heavy ones needs more.",
      "How do you know that no two balls approach any more?"),
    M("propagate_impacts", "most counts pairs",
      with_(rounds=lambda count, most: max(1, most // max(count - 1, 1))),
      "`most` counts pairs: with three balls there are half as many rounds.",
      "In a row of three, how many pairs have their turn in one round?"),
    M("propagate_impacts", "half of the impulse", with_(factor=lambda e: (1 + e) / 2),
      "Each impulse is half as large as it should be.",
      "Two equal balls meet, and e = 1. What does one impact make of their velocities?"),
    M("propagate_impacts", "until the first two part", with_(quiet=lambda v, before: np.all(v[..., :1] <= v[..., 1:2])),
      "The rounds end as soon as the first two balls do not approach, whatever the others do.",
      "The first two part. May others still approach?"),
    M("propagate_impacts", "most left out", with_(rounds=lambda count, most: 200),
      "There is no end after `most` rounds.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "size of the approach", with_(closing_of=np.abs, rounds=lambda count, most: min(most, 50)),
      "The size of the speed is taken, also for balls that move apart.",
      "What should happen to two balls that move apart?"),
    M("propagate_impacts", "the right ball alone", with_(back=0),
      "Only the right ball of a pair gets the impulse.",
      "What does Newton's third law say of the two?"),
    M("propagate_impacts", "the last pair left out", with_(pairs=lambda count: range(count - 2)),
      "The last pair never has a turn.",
      "How many pairs have two balls?"),
    M("propagate_impacts", "perfect from the second round", with_(later=1.0),
      "From the second round on every impact is perfect.",
      "Which restitution has a pair that collides for the second time?"),
    M("propagate_impacts", "sorted", swapped,
      "The velocities are sorted: right for equal, perfectly elastic balls only.",
      "Which arguments make no difference to your answer?"),
    M("propagate_impacts", "no rebound", lambda v, m, e, most=200: row(v, m, e, most, factor=lambda e: 1),
      "The balls only come to the same speed: no impact has a rebound.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "1 − e", lambda v, m, e, most=200: row(v, m, e, most, factor=lambda e: 1 - e),
      "1 − e stands in place of 1 + e: with e = 1 nothing happens at all.",
      "What should two equal balls do with e = 1?"),
)
# fmt: on
