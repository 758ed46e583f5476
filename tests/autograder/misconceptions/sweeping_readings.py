"""Loose readings of the slide about swept volumes: volumes for motions, and only the ends of a step."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import formulas_of
from solutions.sweeping import separation_of_hulls

SWEEPING, BOXES, TURNING = map(formulas_of, ("sweeping", "sweeping_boxes", "sweeping_turning"))


def against_the_volume(xa, va, ra, xb, vb, rb, dt):
    """A against all that B sweeps in the whole step."""
    far = np.where(np.isfinite(dt), dt, 1e6)
    end = np.asarray(xb) + np.asarray(vb) * far[..., None]
    time = BOXES.capsule()(np.asarray(xa, dtype=float), va + 0 * np.asarray(vb), xb, end, np.asarray(ra) + rb)
    return SWEEPING.late(time, np.asarray(dt, dtype=float))


def grown_at_the_ends(points, position, v, w, target, dt, tolerance, looks):
    """The start and the end of the step, and nothing between."""
    points, position, v, w = (np.asarray(each, dtype=float) for each in (points, position, v, w))
    for used, t in enumerate((0.0, dt)[:looks], start=1):
        if separation_of_hulls(TURNING.placed(points, position, v, w, t), np.asarray(target))[0] <= tolerance:
            return t, used
    return np.inf, min(2, looks)


# fmt: off
BANK = (
    M("sweep_sphere_sphere", "against B's swept volume", against_the_volume,
      "A is tested against all that B sweeps in the whole step, as if B were everywhere on its way at once. Slide 10"
      " says to compute the motion of one object relative to the other first.",
      "B crosses a street a second before A comes along it. Do they collide?"),
    M("missed_share", "the slab of slide 9", TURNING.share(TURNING.head_on),
      "Every collision is taken for one through the middle, as if B were a slab that is 2R thick. Most balls cross the"
      " other one along a chord that is shorter.",
      "How long is the chord of two balls that hardly graze each other?"),
    M("advance", "only the ends of the step", grown_at_the_ends,
      "It looks at the start and at the end of the step. A rod may be clear of B at both times and hit it in between.",
      "A rod turns half round in a step. What do you see at its end?"),
)
# fmt: on
