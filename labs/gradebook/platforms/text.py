"""Words as Markdown and as plain text.

Threat: a student's own text could hold links, scripts, formulas that MathJax runs, or marks that turn the writing
direction. In Markdown it stands in an indented block and nowhere else: no dialect reads anything in such a block as
markup, no content can end it, and MathJax leaves it alone. Hidden characters are made visible.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from labs.gradebook.platforms.lines import Paragraph
from labs.grading.safe_text import one_line, plain
from labs.grading.wrapping import folded

MOST = 4000
"""Characters of one paragraph."""
_MARKUP = re.compile(r"([\\`*_{}\[\]()#+!|~$>-])")
_NUMBER = re.compile(r"^(\d+)([.)])")
"""What would begin a list."""
_INDENT = " " * 4


def markdown(words: Iterable[Paragraph]) -> str:
    """Paragraphs as Markdown."""
    return "\n\n".join(_block(each.text) if each.verbatim else _sentence(each.text) for each in words)


def unmarked(words: Iterable[Paragraph]) -> str:
    """Paragraphs as plain text."""
    return "\n\n".join("\n".join(_kept(each.text if each.verbatim else one_line(each.text, MOST))) for each in words)


def _block(text: str) -> str:
    """Lines that Markdown shows as they are."""
    return "\n".join(_INDENT + line for line in _kept(text))


def _sentence(text: str) -> str:
    """Our own words, in which a star is a star."""
    entities = one_line(text, MOST).replace("&", "&amp;").replace("<", "&lt;")
    return _NUMBER.sub(r"\1\\\2", _MARKUP.sub(r"\\\1", entities))


def _kept(text: str) -> list[str]:
    lines = plain(text, MOST).replace("\t", _INDENT).split("\n")
    return [part for line in lines for part in folded(line, 0) or [""]]
