"""What a student expects before a run. It is kept and shown beside the result, and never graded."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from types import EllipsisType
from typing import Any

import numpy as np

from reference.errors import InvalidInput


@dataclass(frozen=True)
class Prediction:
    """One question and its answer. answer: None as long as it is open. unit: of a number."""

    key: str
    question: str
    answer: float | str | None
    unit: str = ""
    choices: tuple[str, ...] = ()

    @property
    def shown(self) -> str:
        """The answer as a table shows it."""
        return f"{self.answer:g}".replace("-", "−") if isinstance(self.answer, float) else f"“{self.answer}”"

    @property
    def with_unit(self) -> str:
        """The answer as one says it; empty as long as it is open."""
        unit = f" {self.unit}" if self.unit else ""
        return "" if self.answer is None else f"{self.shown}{unit}"

    def __str__(self) -> str:
        if self.answer is None:
            options = (
                f" ({' or '.join(map(repr, self.choices))})" if self.choices else f" ({self.unit})" * bool(self.unit)
            )
            return f"{self.question}{options}\nPut your guess in place of the dots and run the cell again."
        return f"{self.question}\nYou predict {self.with_unit}."


def predicted(
    key: str,
    question: str,
    answer: float | str | np.ndarray[Any, Any] | EllipsisType | None,
    unit: str = "",
    choices: Sequence[str] = (),
) -> Prediction:
    """Make a prediction; it is open while the answer is still the dots of the cell.

    Raises
    ------
    InvalidInput
        If the answer is not one of the choices, or without choices is not a number.
    """
    if answer is None or answer is ...:
        return Prediction(key, question, None, unit, tuple(choices))
    if choices:
        if answer not in choices:
            raise InvalidInput(f"{answer!r} is none of the choices: {', '.join(map(repr, choices))}")
        return Prediction(key, question, str(answer), unit, tuple(choices))
    if isinstance(answer, np.ndarray) and answer.size == 1:  # as functions of the labs answer
        answer = answer.item()
    if not isinstance(answer, Real) or isinstance(answer, bool) or math.isnan(answer):
        raise InvalidInput(f"{answer!r} is no number; write one such as 0.25, without quotes or unit")
    return Prediction(key, question, float(answer), unit)
