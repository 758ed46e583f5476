"""A diagnosis in words, for a terminal and for feedback."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from labs.grading.marks import Answer, Right, outputs

if TYPE_CHECKING:
    from labs.grading.diagnosis import Diagnosis

WIDTH = 80
MOST = 12
"""Numbers of an array that are still shown one by one."""


def told(diagnosis: Diagnosis) -> str:
    """All of a diagnosis, some lines."""
    lines = _verdict(diagnosis)
    if diagnosis.counterexample:
        lines += ["For example", textwrap.indent(str(diagnosis.counterexample), "  ")]
    if diagnosis.changes_input:
        lines += _wrapped("It writes into its arguments: the caller's own arrays have other numbers afterwards.")
    if diagnosis.one_alone and not diagnosis.crash_in_many:
        lines += _wrapped("With several contacts in one call it is wrong in another way besides.")
    if diagnosis.crashes and diagnosis.verdict not in ("crashes", "unwritten"):
        where = "With several contacts in one call" if diagnosis.crash_in_many else "On some input"
        lines += _wrapped(f"{where} it ends in an error: {diagnosis.crashes[0]}")
    if diagnosis.accepted and diagnosis.verdict != "unwritten":
        lines += _wrapped(f"It should refuse, with a ValueError: {'; '.join(diagnosis.accepted)}.")
    return "\n".join(lines)


def _verdict(diagnosis: Diagnosis) -> list[str]:
    name, first = diagnosis.function, next(iter(diagnosis.mistakes), None)
    if first is None:
        return _wrapped(f"{name}: {_WITHOUT_NAME[diagnosis.verdict]}")
    if diagnosis.verdict == "named":
        return _wrapped(f"{name}: {first.rationale}") + _wrapped(f"Hint: {first.help}")
    if diagnosis.verdict == "likely":
        opening = f"{name}: most of its numbers are those of this mistake, and something else is wrong besides:"
        return [*_wrapped(opening), *_wrapped(f"- {first.rationale}"), *_wrapped(f"Hint: {first.help}")]
    opening = f"{name}: its numbers fit more than one mistake, and do not say which it is:"
    return [*_wrapped(opening), *(line for each in diagnosis.mistakes for line in _wrapped(f"- {each.rationale}"))]


_WITHOUT_NAME = {
    "right": "right on every probe.",
    "unwritten": "not written yet.",
    "crashes": "it ends in an error.",
    "shape": "what it returns has not the shape that its description promises.",
    "one at a time": "right for one contact, but not for several in one call.",
    "unknown": "its numbers are wrong, in a way that the lab does not know.",
}


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, break_on_hyphens=False)


def called(parameters: Sequence[str], arguments: Sequence[Any]) -> str:
    """Arguments by name: `velocity=(0, 0, -2), restitution=0.5`."""
    return ", ".join(f"{name}={shown(value)}" for name, value in zip(parameters, arguments, strict=False))


def compared(answer: Answer, right: Right) -> str:
    """What came and what should have: two lines."""
    expected = ", ".join(shown(array) for array in right.outputs)
    found = outputs(answer.value, len(right.outputs))
    if answer.error:
        came = answer.error
    elif found is None:
        came = f"something of type {type(answer.value).__name__}, where {_wanted(right)} should be"
    else:
        came = ", ".join(shown(array) for array in found)
        if [array.shape for array in found] != [array.shape for array in right.outputs]:
            came += f" of shape {_shapes(found)} instead of {_shapes(right.outputs)}"
    return f"gives   {came}\nphysics {expected}"


def _wanted(right: Right) -> str:
    return "numbers" if len(right.outputs) == 1 else f"{len(right.outputs)} arrays of numbers"


def _shapes(arrays: Sequence[Any]) -> str:
    return ", ".join(str(array.shape) for array in arrays)


def shown(value: Any) -> str:
    """A value in few digits; of a long array only its shape."""
    if isinstance(value, tuple):
        return "(" + ", ".join(shown(item) for item in value) + ")"
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        return repr(value)
    if array.size > MOST:
        return f"an array {array.shape}"
    return _nested(array.tolist())


def _nested(value: Any) -> str:
    if isinstance(value, list):
        return "(" + ", ".join(map(_nested, value)) + ")"
    return str(value) if isinstance(value, bool) else f"{float(value) + 0.0:.6g}"
