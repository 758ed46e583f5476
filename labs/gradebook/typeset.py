"""Typesets what the lab itself wrote: Markdown with LaTeX formulas becomes HTML with MathML, without any network.

Threat: what students write never comes here. It is shown as plain text, every character escaped.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Sequence
from functools import cache
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.rules_inline import StateInline
from markdown_it.token import Token
from markupsafe import Markup

_FORMULA = re.compile(r"\$\$(?P<alone>.+?)\$\$|\$(?P<within>[^$\s](?:[^$]*[^$\s])?)\$", re.DOTALL)
_PIECE = re.compile(rf"```.*?```|`[^`]*`|{_FORMULA.pattern}", re.DOTALL)
"""Code, in which a dollar is a dollar, or a formula."""
_CAPITAL = re.compile(r"<mi>(&#x003(?:9[1-9A-F]|A[0-9]);)")
"""A Greek capital, such as Δ, which is printed upright."""
_SIGN = re.compile(r"(<mo>&#x0003D;</mo>)<mo>(?=&#x02212;)")
"""A minus right after =, which is a sign and stands close to its number."""


def typeset(text: str) -> Markup:
    """Our own text as HTML. A formula that cannot be typeset stays as it was written."""
    return Markup(_markdown().render(_PIECE.sub(_on_one_line, text)))


def _on_one_line(piece: re.Match[str]) -> str:
    """A formula without line breaks: a line of it that begins with a minus is no item of a list."""
    return piece[0] if piece[0].startswith("`") else " ".join(piece[0].split())


@cache
def _markdown() -> MarkdownIt:
    found = MarkdownIt("commonmark", {"html": False}).enable("table")
    found.inline.ruler.before("escape", "formula", _read_formula)
    found.add_render_rule("formula", lambda _, tokens, place, *__: _written(tokens, place))
    return found


def _read_formula(state: StateInline, silent: bool) -> bool:
    match = _FORMULA.match(state.src, state.pos)
    if match is None:
        return False
    if not silent:
        token = state.push("formula", "math", 0)
        token.content, token.block = match["alone"] or match["within"], match["alone"] is not None
    state.pos = match.end()
    return True


def _written(tokens: Sequence[Token], place: int) -> str:
    token = tokens[place]
    return mathml(token.content, token.block)


def mathml(formula: str, alone: bool = False) -> Markup:
    """A formula in LaTeX as MathML, or as it is written. alone: on a line of its own."""
    try:
        converter: Any = importlib.import_module("latex2mathml.converter")  # only this page needs it
        found = converter.convert(formula, display="block" if alone else "inline")
    except Exception:  # the package is missing, or raises one of its many errors
        return Markup("<code>{}</code>").format(formula)
    return Markup(_SIGN.sub(r'\1<mo form="prefix">', _CAPITAL.sub(r'<mi mathvariant="normal">\1', found)))
