"""What an implementation answers to a published case: numbers with what its own method allows, not yet judged."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reference.published.case import Figure, Published


@dataclass(frozen=True)
class Answer:
    """What one implementation gives for one published figure.

    value: None where the implementation has none, and `reason` says why. tolerance: absolute, with its reason, where
    the method at hand allows less than the printed digits do; None for the case's own. shift: how much this
    implementation's method changes the figure, with its reason and its own tolerance.
    """

    value: Figure | None
    tolerance: Figure | None = None
    reason: str = ""
    shift: Figure = 0.0
    shift_reason: str = ""
    shift_tolerance: Figure = 0.0


Answers = Mapping[str, Answer]
"""By the names of the expected figures."""


def as_answers(**figures: Figure) -> Answers:
    """Answers that need no more than the number itself."""
    return {name: Answer(value) for name, value in figures.items()}


def answer_within(case: Published, figure: str, value: Figure, error: Figure, reason: str) -> Answer:
    """An answer that may be off by the case's own tolerance, or by the method's `error` where that is larger."""
    own = np.broadcast_to(case.tolerance[figure], np.shape(value))
    if np.all(np.asarray(error) <= own):
        return Answer(value)
    wider = np.maximum(own, error)
    return Answer(value, tuple(wider.tolist()) if isinstance(value, tuple) else float(wider), reason)
