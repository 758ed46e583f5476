"""A diagnosis in words, for a terminal and for feedback."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from labs.grading.diagnosis.deviations import Answer, Right, outputs, rows_too_many
from labs.grading.diagnosis.findings import Counterexample, Diagnosis
from labs.grading.diagnosis.output_names import labelled, output_names
from labs.grading.phrases import gives_beside_physics, no_answer
from labs.grading.wrapping import WIDTH

ODD = "This mistake alone does not explain:"
"""It may be a second mistake, or the same one in a form that differs in a limiting case: the lab cannot tell which."""
MOST = 12
"""An array of up to so many numbers is shown number by number."""
DUST = 1e-13
"""In units of the scale of an answer: what some hundred roundings in double precision, 1e-16 each, may leave of zero,
and ten times more."""
SPACE = 3
"""So many coordinates has a point in space."""


def told(diagnosis: Diagnosis) -> str:
    """A whole diagnosis, in several lines."""
    first, *others = verdict(diagnosis)
    lines = [line for paragraph in (f"{diagnosis.function}: {first}", *others) for line in _wrapped(paragraph)]
    for opening, example in (("For example", diagnosis.counterexample), (ODD, diagnosis.odd)):
        lines += [opening, textwrap.indent(example_of(example), "  ")] if example else []
    repeated = diagnosis.error_is_in(diagnosis.counterexample, diagnosis.odd)
    rest = replace(diagnosis, crashes=()) if repeated else diagnosis
    return "\n".join([*lines, *(line for paragraph in besides(rest) for line in _wrapped(paragraph))])


def example_of(found: Counterexample) -> str:
    """What was tried, what the function gave, and what is right, in several lines."""
    tried = called(found.parameters, found.probe.arguments, found.function)
    case = f", {found.probe.note}" if found.probe.note else ""
    return f"{tried}{case}\n{compared(found.answer, found.right, output_names(found.function))}"


def verdict(diagnosis: Diagnosis) -> list[str]:
    """What is wrong, and the hint, a paragraph each. The first one follows the function's name."""
    first = next(iter(diagnosis.mistakes), None)
    if diagnosis.changes_input and diagnosis.verdict in _SAYS_LITTLE:
        return [f"{'its answers are right, but ' if diagnosis.verdict == 'right' else ''}{_WRITES}"]
    if diagnosis.verdict == "another order":
        wanted = output_names(diagnosis.function)
        given, asked = ", ".join(wanted[at] for at in diagnosis.order), ", ".join(wanted)
        return [f"right numbers in another order: it returns {given}, and should return {asked}."]
    if first is None:
        limits = diagnosis.verdict == "unknown" and diagnosis.limits_alone
        return [_AT_LIMITS if limits else _WITHOUT_NAME[diagnosis.verdict]]
    if diagnosis.verdict == "named":
        return [first.rationale, f"Hint: {first.help}"]
    if diagnosis.verdict == "likely":
        rest = ""
        if not diagnosis.odd and (diagnosis.spares_limits or diagnosis.spares_cases):
            rest = f"; {'limiting' if diagnosis.spares_limits else 'some'} cases are right that it would get wrong"
        return [f"most of its numbers fit this mistake{rest}:", f"- {first.rationale}", f"Hint: {first.help}"]
    opening = "its numbers fit more than one mistake, and do not say which it is:"
    return [opening, *(f"- {each.rationale}" for each in diagnosis.mistakes)]


def besides(diagnosis: Diagnosis) -> list[str]:
    """What else was seen, a paragraph each."""
    found = []
    if diagnosis.changes_input and diagnosis.verdict not in _SAYS_LITTLE:
        found.append(_WRITES[0].upper() + _WRITES[1:])
    if diagnosis.one_alone and not diagnosis.crash_in_many:
        found.append("With several cases in one call it is wrong in another way besides.")
    if diagnosis.crashes and diagnosis.verdict not in ("crashes", "unwritten"):
        where = "With several cases in one call" if diagnosis.crash_in_many else "On some input"
        found.append(f"{where} it ends in an error: {diagnosis.crashes[0]}")
    if diagnosis.accepted and diagnosis.verdict != "unwritten":
        found.append(f"It should refuse, with a ValueError: {'; '.join(diagnosis.accepted)}.")
    return found


_WRITES = "it writes into its arguments, as a += b and a[0] = b do: the caller's own arrays change."
_SAYS_LITTLE = ("right", "wrong")
"""Verdicts beside which nothing more has to be said than that a function writes into its arguments."""
_AT_LIMITS = "right in the usual cases, not yet in limiting ones."
_WITHOUT_NAME = {
    "right": "right on every probe.",
    "unwritten": "not written yet.",
    "crashes": "it ends in an error.",
    "shape": "what it returns has not the shape that its description promises.",
    "one at a time": "right for one case, not yet for several in one call.",
    "unknown": "its numbers are wrong, in a way that the lab does not know.",
    "wrong": "it fails a test, and which mistake it makes was not found.",
    "too slow": "it gave no answer in time, and was asked no more. Does every loop in it come to an end?",
    "not tried": "its mistake was not looked for: the time for the whole file was used up before.",
}


def renamed(message: str, function: str, title: str, help: str) -> str:
    """A message about a mistake that the lab does not know, with the title and the hint that a course gives it."""
    named = [*_wrapped(f"{function}: {title}"), *_wrapped(f"Hint: {help}")]
    for words in (_WITHOUT_NAME["unknown"], _AT_LIMITS):
        unknown = "\n".join(_wrapped(f"{function}: {words}"))
        if unknown in message:
            return message.replace(unknown, "\n".join(named), 1)
    return "\n".join([*named, message])


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, break_on_hyphens=False)


def listed(names: Sequence[str]) -> str:
    """Names in a sentence."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def called(parameters: Sequence[str], arguments: Sequence[Any], function: str = "") -> str:
    """Arguments with their names if known, `velocity=(0, 0, -2), restitution=0.5`; with a function, as its call."""
    names = [f"{name}=" for name in parameters] or [""] * len(arguments)
    given = ", ".join(f"{name}{shown(value)}" for name, value in zip(names, arguments, strict=False))
    return f"{function}({given})" if function else given


def compared(answer: Answer, right: Right, names: Sequence[str] = ()) -> str:
    """A function's answer and the right one, in two lines. names: of what it returns, if it is several things."""
    return gives_beside_physics(*answered(answer, right, names))


def answered(answer: Answer, right: Right, names: Sequence[str] = ()) -> tuple[str, str]:
    """A function's answer and the right one in words."""
    truths = _are_truths(answer.value, right)
    expected = labelled([_cleaned(*each, truths) for each in zip(right.outputs, right.scales, strict=True)], names)
    found = outputs(answer.value, len(right.outputs))
    if answer.error:
        came = answer.error
    elif found is None:
        came = no_answer(answer.value, len(right.outputs), answer.printed)
    else:
        came = labelled([_cleaned(*each, truths) for each in zip(found, right.scales, strict=True)], names)
        if more := rows_too_many(found, right):
            came += f", {_counted(more, right.thing)}"
        elif [array.shape for array in found] != [array.shape for array in right.outputs]:
            came += f" of shape {_shapes(found)} instead of {_shapes(right.outputs)}"
    return came, expected


def _counted(more: int, thing: str) -> str:
    """How many things are too many, or missing."""
    many = f"{abs(more)} {thing}s" if abs(more) > 1 else f"one {thing}"
    return f"{many} too many" if more > 0 else f"where {many} {'are' if more < -1 else 'is'} missing"


def _cleaned(array: Any, scale: float, truths: bool) -> str:
    """One of the things returned, with zero for what rounding leaves of zero, or as flags."""
    return shown(array.astype(bool) if truths else np.where(np.abs(array) < DUST * scale, 0.0, array))


def _are_truths(value: Any, right: Right) -> bool:
    """Whether the answer is True or False, or an array of these, as the right one is."""
    is_truth = isinstance(value, bool | np.bool_) or (isinstance(value, np.ndarray) and value.dtype == bool)
    return is_truth and all(np.isin(array, (0, 1)).all() for array in right.outputs)


def _shapes(arrays: Sequence[Any]) -> str:
    return ", ".join(shape_in_words(array.shape) for array in arrays)


def shape_in_words(shape: Sequence[int | None]) -> str:
    """A shape as Python writes it, with an n for a length that differs from case to case."""
    return str(tuple(shape)).replace("None", "n")


def shown(value: Any) -> str:
    """A value with few digits: a diagonal matrix as `diag(2, 2, 2)`, a long array by its shape, points by their box."""
    if isinstance(value, tuple):
        return "(" + ", ".join(shown(item) for item in value) + ")"
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        return repr(value)
    if array.size > MOST:
        return f"an array {array.shape}{_box(array)}"
    if _is_diagonal(array):
        return f"diag{_nested(np.diagonal(array).tolist())}"
    return _nested(array.tolist())


def _box(array: Any) -> str:
    """Of many points (n, 3) the corners of the box around them, of many flags which are true; nothing of others."""
    if array.ndim == 1 and array.dtype.kind == "b" and 0 < np.count_nonzero(array) <= MOST:
        return f", True at {_nested(np.flatnonzero(array).tolist())}"
    if array.ndim != 2 or array.shape[1] != SPACE or array.dtype.kind != "f" or not np.isfinite(array).all():
        return ""
    return f" between {_nested(array.min(axis=0).tolist())} and {_nested(array.max(axis=0).tolist())}"


def _is_diagonal(array: Any) -> bool:
    square = array.ndim == 2 and array.shape[0] == array.shape[1] > 1
    if not square or array.dtype.kind == "b" or not np.any(array):  # zeros may as well be vectors
        return False
    return not np.any(array[~np.eye(len(array), dtype=bool)])


def _nested(value: Any) -> str:
    if isinstance(value, list):
        only = "," if len(value) == 1 else ""  # as Python writes a tuple of one, so that it can be copied
        return "(" + ", ".join(map(_nested, value)) + only + ")"
    return str(value) if isinstance(value, bool) else f"{float(value) + 0.0:.6g}"
