"""Formulas and code in prose, both between backticks: typeset as MathML or code for a page, or plain for a terminal.

A formula is written as one would type it: `t₁ (1 + e)/(1 − e)`. A stroke divides all factors before it, up to the last
sum or relation, by the one factor behind it; brackets that only hold a fraction or a power together are not printed.
A name of three letters or more, such as `mesh_step`, is code and no formula.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from markupsafe import Markup, escape

_FORMULA = re.compile(r"`([^`]+)`")
_CODE = re.compile(r"(?!(sin|cos|tan)\b)[A-Za-z]{3,}[\w-]*( \w+)*(=\w+)?")
"""A name in code, a profile of two words, or an option with its value."""
_TOKEN = re.compile(
    r"(?P<raised>[⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹ⁿ]+)|(?P<lowered>[₀₁₂₃₄₅₆₇₈₉ₙ]+|_[^\W_]+)|\s*(?P<number>[0-9]+(\.[0-9]+)?)"
    r"|\s*(?P<name>asin|sin|cos|tan|dt|[^\W\d_])|\s*(?P<sign>[-+−=<>≤≥≈≠·×±√/(),^])"
)
_RAISED = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹ⁿ", "−+0123456789n")
_LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉ₙ", "0123456789n")
_BETWEEN = "+−-=<>≤≥≈≠±,"
"""What stands between two terms; a stroke does not reach across it."""


def plain(text: str) -> str:
    """The text for a terminal: without the backticks."""
    return text.replace("`", "")


def typeset(text: str) -> Markup:
    """The text for a page: formulas in MathML, names in code as code, everything else escaped."""
    parts = _FORMULA.split(text)  # prose and formulas in turn
    return Markup("").join(_marked(part) if place % 2 else escape(part) for place, part in enumerate(parts))


def _marked(part: str) -> Markup:
    return Markup("<code>{}</code>").format(part) if _CODE.fullmatch(part) else mathml(part)


def mathml(formula: str) -> Markup:
    """One formula as a MathML element.

    Raises
    ------
    ValueError
        If it has a sign that is not known here, or a bracket without its other half.
    """
    tokens = _tokens(formula)
    found = _terms(tokens)
    if tokens:
        raise ValueError(f"{formula}: {tokens[0][1]!r} has nothing to close")
    return Markup(f"<math>{found}</math>")


def _tokens(formula: str) -> list[tuple[str, str]]:
    """Kind and text of each part, in order; what is read is taken off its front."""
    found, place = [], 0
    while place < len(formula.rstrip()):
        match = _TOKEN.match(formula, place)
        if match is None:
            raise ValueError(f"{formula}: {formula[place:]!r} is no part of a formula")
        kind = str(match.lastgroup)
        found.append((kind, match[kind]))
        place = match.end()
    return found


def _terms(tokens: list[tuple[str, str]]) -> str:
    """Terms and what stands between them, up to the end or to a closing bracket."""
    whole, factors = "", list[str]()
    while tokens and tokens[0][1] != ")":
        kind, text = tokens.pop(0)
        if kind == "sign" and text in _BETWEEN:
            whole += "".join(factors) + f"<mo>{escape(text.replace('-', '−'))}</mo>"
            factors = []
        elif text == "/":
            below = _factor(tokens)
            factors = [f"<mfrac>{_row(factors)}{_unbracketed(below)}</mfrac>"]
        else:
            tokens.insert(0, (kind, text))
            factors.append(_factor(tokens))
    return whole + "".join(factors)


class _Bracketed(str):
    """A bracket with what it holds, for a stroke or a root, which make the bracket unnecessary."""

    inside: str


_OPEN, _CLOSE = '<mo stretchy="false">(</mo>', '<mo stretchy="false">)</mo>'
_FUNCTIONS = ("asin", "sin", "cos", "tan")


def _factor(tokens: list[tuple[str, str]]) -> str:
    """A number, a name, a root or a bracket, with what is raised or lowered at it."""
    if not tokens:
        raise ValueError("a formula ends in the middle")
    kind, text = tokens.pop(0)
    name = text
    if text == "√":
        found = f"<msqrt>{_unbracketed(_factor(tokens))}</msqrt>"
    elif text == "(":
        inside = _terms(tokens)
        if not tokens:
            raise ValueError("a bracket is not closed")
        tokens.pop(0)
        found = _Bracketed(f"<mrow>{_OPEN}{inside}{_CLOSE}</mrow>")
        found.inside = f"<mrow>{inside}</mrow>"
    elif kind == "number":
        found = f"<mn>{text}</mn>"
    elif text == "dt":
        found = "<mrow><mi>d</mi><mi>t</mi></mrow>"
    elif kind == "name":
        found = f"<mi>{escape(text)}</mi>"
    else:
        found = f"<mo>{escape(text)}</mo>"
    while tokens and (tokens[0][0] in ("raised", "lowered") or tokens[0][1] == "^"):
        kind, text = tokens.pop(0)
        if text == "^":
            found = f"<msup>{found}{_unbracketed(_factor(tokens))}</msup>"
            continue
        tag, small = ("msup", text.translate(_RAISED)) if kind == "raised" else ("msub", text.translate(_LOWERED))
        found = f"<{tag}>{found}<mtext>{escape(small.lstrip('_'))}</mtext></{tag}>"
    return _applied(found, tokens) if name in _FUNCTIONS else found


def _applied(function: str, tokens: list[tuple[str, str]]) -> str:
    """A function with what it is applied to, `2φ` in `sin 2φ`, as one factor: a stroke divides by all of it."""
    of = ""
    while tokens and tokens[0][0] in ("number", "name"):
        kind, _ = tokens[0]
        of += _factor(tokens)
        if kind == "name":
            break
    return f'<mrow>{function}<mspace width="0.17em"/>{of}</mrow>'


def _row(factors: Sequence[str]) -> str:
    return _unbracketed(factors[0]) if len(factors) == 1 else f"<mrow>{''.join(factors)}</mrow>"


def _unbracketed(factor: str) -> str:
    return factor.inside if isinstance(factor, _Bracketed) else factor
