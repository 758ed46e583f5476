"""Phrases that one part of the grader writes and another part recognises; both are done here.

A failure reaches the feedback as text: a pytest assertion, an error of the submission, or the note of a scenario's run.
The feedback needs to know of it whether there was an answer at all, and whether numbers stand beside each other.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from labs.grading.safe_text import one_line
from reference import lecture

_NO_ANSWER = re.compile(
    r"^gives +(nothing \(None\).*|.* instead of (a number or an array|real ones|\d+( arrays)?)|a \w+ that is not .*)$",
    re.MULTILINE,
)
_NEEDS = re.compile(r"\bneeds (\w+) \(")
_NO_NUMBER = re.compile(r"^gives .*\b(nan|inf)\b", re.MULTILINE)


# What came, and what is right


def gives(came: str) -> str:
    """The line with a function's answer."""
    return f"gives   {came}"


def gives_beside_physics(came: str, physics: str) -> str:
    """The two lines with a function's answer and the right one."""
    return f"{gives(came)}\nphysics {physics}"


def without_explanation(said: str) -> str:
    """The message of an assertion without the lines that pytest adds to it; of one without a message, these lines."""
    lines = said.splitlines()
    added = next((at for at, line in enumerate(lines) if at and line.startswith("assert ")), len(lines))
    return "\n".join(lines[:added])


def has_answer(said: str) -> bool:
    """Whether a call is followed by its answer."""
    return "\ngives " in said


def has_physics(said: str) -> bool:
    """Whether a call is followed by its answer and the right one."""
    return "\nphysics " in said


def has_no_number(said: str) -> bool:
    """Whether the answer holds nan or inf."""
    return bool(_NO_NUMBER.search(said))


# No answer


def no_answer(value: Any, count: int, printed: str = "") -> str:
    """What was returned instead of a number, or of so many arrays. printed: by the same call."""
    wanted = "a number or an array" if count == 1 else f"{count} arrays"
    if value is None:
        return "nothing (None): it prints, and has to return" if printed else "nothing (None): is a return missing?"
    if isinstance(value, str):
        return f"the text {one_line(repr(value), 40)} instead of {wanted}"
    if _is_complex(value):
        return "complex numbers instead of real ones"
    if isinstance(value, tuple | list) and count > 1 and len(value) != count:
        return f"{len(value)} thing{'s' * (len(value) != 1)} instead of {count}"
    if isinstance(value, tuple | list):
        return f"a {type(value).__name__} that is not {wanted} of numbers"
    return f"one {'array' if isinstance(value, np.ndarray) else type(value).__name__} instead of {wanted}"


def _is_complex(value: Any) -> bool:
    if isinstance(value, tuple | list):
        return any(map(_is_complex, value))
    return isinstance(value, np.ndarray | np.generic | complex) and np.iscomplexobj(value)


def no_answer_in(said: str) -> str:
    """The line of `no_answer` in a text; empty if there is none."""
    return found[0] if (found := _NO_ANSWER.search(said)) else ""


def was_raised(said: str) -> bool:
    """Whether an error of `calling.calls`, without the function's name before it, is an exception of the submission."""
    return said.startswith("raised ")


def ended_without_numbers(said: str) -> bool:
    """Whether a text is an error of `calling.calls`, without the function's name before it, and no comparison."""
    return said.startswith(("raised ", "needs ", "gave "))


# Functions that are missing


def needs(function: str) -> str:
    """That another function is missing, with where it is taught."""
    entry = lecture.FUNCTIONS.get(function)
    return f"needs {function} ({entry.topic}, step {entry.step})" if entry else f"needs {function}"


def needed_function(said: str) -> str | None:
    """The function of the lecture that a text says is missing, if it does."""
    return found[1] if (found := _NEEDS.search(said)) else None


def scenario_needs_a_function(said: str) -> bool:
    """Whether a run of a whole scenario, which is named first, lacks another function."""
    return bool(re.search(r": needs \w+ \(", said))
