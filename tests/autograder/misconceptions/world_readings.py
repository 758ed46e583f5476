"""Loose readings of the slide about resting contact: masses that are forgotten."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import formulas_of

row = formulas_of("world").row


def row_without_mass(v, m, e, most=200):
    """The impulse itself is taken from one velocity and added to the other."""
    return row(v, m, e, most=most, moved=lambda share: 1 + 0 * share)


# fmt: off
BANK = (
    M("propagate_impacts", "no mass", row_without_mass,
      "The impulse itself is taken from one velocity and added to the other. Slide 13 has J = M Δv.",
      "A marble and a cannon ball get the same impulse. Do their velocities change by the same amount?"),
    M("resting_problem", "no mass", lambda g, w, f: (g @ np.swapaxes(g, -1, -2) + 0 * (g @ w @ np.swapaxes(g, -1, -2)),
                                                     np.matvec(g + 0 * (g @ w), f)),
      "The inverse masses are used nowhere: A is G Gᵀ, and b is G F.",
      "Which argument does your answer not depend on? And what unit does each of your results have?"),
)
# fmt: on
