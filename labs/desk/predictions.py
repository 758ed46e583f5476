"""What a student expects before a run, kept and compared with the result. Whether it is right never costs points."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from numbers import Real
from types import EllipsisType
from typing import Any

import numpy as np

from labs.guidance.hint_files import Answer
from reference.errors import InvalidInput

_NEAR = 0.05
"""A number is right within this share of the right one: it is worked out by hand, often for an ideal case."""
_NEAR_ZERO = 0.01
"""How near to zero a number has to be, in its unit, if zero is right."""


@dataclass(frozen=True)
class Prediction:
    """One question and its answer. answer: None as long as it is open. unit: of a number. right: what is right."""

    key: str
    question: str
    answer: float | str | None
    unit: str = ""
    choices: tuple[str, ...] = ()
    right: Answer = field(default_factory=Answer)

    @property
    def shown(self) -> str:
        """The answer as a table shows it."""
        return f"{self.answer:g}".replace("-", "−") if isinstance(self.answer, float) else f"“{self.answer}”"

    @property
    def with_unit(self) -> str:
        """The answer as one says it; empty as long as it is open."""
        unit = f" {self.unit}" if self.unit else ""
        return "" if self.answer is None else f"{self.shown}{unit}"

    def verdict(self, theory: float | None = None) -> str:
        """Whether it is right, and why; empty if nobody knows. theory: the right number if the lab names none."""
        if isinstance(self.answer, str):
            if not self.right.said:
                return ""
            is_right, right = self.answer == self.right.said, f"“{self.right.said}”"
        elif self.answer is not None:
            number = theory if self.right.number is None else self.right.number
            if number is None:
                return ""
            within = _NEAR * abs(number) or _NEAR_ZERO if self.right.within is None else self.right.within
            is_right, right = abs(self.answer - number) <= within, _said(number, self.unit)
        else:
            return ""
        if not is_right:
            found = f"but {right} is right"
        elif right == self.with_unit:
            found = "and that is right"
        else:
            found = f"which is near enough: {right} is right"
        return f"You predicted {self.with_unit}, {found}. {_sentence(self.right.reason)}".strip()

    def __str__(self) -> str:
        if self.answer is None:
            options = (
                f" ({' or '.join(map(repr, self.choices))})" if self.choices else f" ({self.unit})" * bool(self.unit)
            )
            return f"{self.question}{options}\nPut your guess in place of the dots and run the cell again."
        return f"{self.question}\nYou predict {self.with_unit}."


def _said(number: float, unit: str) -> str:
    return f"{number:.4g}".replace("-", "−") + f" {unit}" * bool(unit)


def _sentence(text: str) -> str:
    """A text that begins with a capital letter, unless with a formula, and ends with a full stop."""
    first = text[:1].upper() + text[1:] if re.match(r"[a-z]{2}|a [a-z]{2}", text) else text
    return f"{first.rstrip('.')}." if first else ""


def predicted(
    key: str,
    question: str,
    answer: float | str | np.ndarray[Any, Any] | EllipsisType | None,
    unit: str = "",
    choices: Sequence[str] = (),
    right: Answer | None = None,
) -> Prediction:
    """Make a prediction; it is open while the answer is still the dots of the cell. right: what is right, if known.

    Raises
    ------
    InvalidInput
        If the answer is not one of the choices, or without choices is not a number.
    """
    right = right or Answer()
    if answer is None or answer is ...:
        return Prediction(key, question, None, unit, tuple(choices), right)
    if choices:
        if not isinstance(answer, str) or answer not in choices:
            raise InvalidInput(f"{answer!r} is none of the choices: {', '.join(map(repr, choices))}")
        return Prediction(key, question, str(answer), unit, tuple(choices), right)
    if isinstance(answer, np.ndarray) and answer.size == 1:  # as functions of the labs answer
        answer = answer.item()
    if not isinstance(answer, Real) or isinstance(answer, bool) or math.isnan(answer):
        raise InvalidInput(f"{answer!r} is no number; write one such as 1.5, without quotes or unit")
    try:
        return Prediction(key, question, float(answer), unit, (), right)
    except OverflowError:
        raise InvalidInput("that number is too large for any prediction") from None
