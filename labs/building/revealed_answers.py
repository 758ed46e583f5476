"""Finds lines that a student is to derive in texts that a student reads: stubs and lessons.

Lines are compared as *compact* texts: a formula as Python has it, as LaTeX and as plain text becomes the same letters,
digits and signs. Hints have each line twice, as an expression and, in their third level, typeset, so that a quantity
which a lesson writes with an index is found as well.
"""

from __future__ import annotations

import re

from labs.guidance.hint_files import LEVELS, hints

_SHORTEST = 6
"""A right side with fewer signs than this may be part of any text."""
_FORMULA = re.compile(r"\$\$?(.+?)\$\$?", re.DOTALL)
_FRACTION = re.compile(r"\\[dt]?frac\s*(?:\{([^{}]*)\}|(\w))\s*(?:\{([^{}]*)\}|(\w))")
_WORDS = {
    "−": "-", "·": "", "×": "", "*": "", "²": "^2", "³": "^3", "Δ": "d", "√": "sqrt",
    r"\Delta": "d", r"\cdot": "", r"\times": "", r"\left": "", r"\right": "", r"\lVert": "", r"\rVert": "",
}  # fmt: skip
"""What is written in several ways."""
_MARKS = re.compile(r"\^\{?[-+]\}?|[⁻⁺](?!¹)|_\{?n\}?(?![a-z])")
"""Before, after and *normal*, which an expression in a few quantities need not say."""
_LOST = re.compile(r"\\[,;:! ]|[\s(){}\[\]_&`]|\\quad|\\text|\\mathbf")
"""What says nothing about a formula without its brackets."""


def compact(text: str) -> str:
    """A text with its formulas as letters, digits and signs alone."""
    text = text.replace("**", "^")
    before = ""
    while text != before:  # from the innermost fraction to the outermost
        before, text = text, _FRACTION.sub(lambda found: f"{found[1] or found[2]}/{found[3] or found[4]}", text)
    for word, sign in sorted(_WORDS.items(), key=lambda pair: -len(pair[0])):
        text = text.replace(word, sign)
    return _LOST.sub("", _MARKS.sub("", text)).replace("\\", "")


def answers_of(topic: str, function: str) -> list[str]:
    """The right sides that a student is to find for a function, compact, as expressions and as they are typeset."""
    guide = hints(topic).of(function)
    found = [compact(each.right.text) for each in guide.derivations]
    if found and len(guide.levels) == len(LEVELS):
        formulas = [formula for formula in _FORMULA.findall(guide.levels[-1]) if "=" in formula]
        found += [compact(formula.rpartition("=")[2]) for formula in formulas]
    return [answer for answer in dict.fromkeys(found) if len(answer) >= _SHORTEST]
