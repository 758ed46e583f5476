"""Wraps text into lines of at most 80 columns that break between the arguments of a call rather than within one."""

from __future__ import annotations

import textwrap

WIDTH = 80
INDENT = " " * 4
_KEPT = "\u00a0"  # a space that textwrap does not break at


def folded(text: str, depth: int) -> list[str]:
    """A paragraph at some depth; all lines after the first are indented by two more columns."""
    lead = INDENT * depth + " " * (len(text) - len(text.lstrip()))
    text, room = text.strip(), WIDTH - len(lead) - 2
    head, bracket, rest = text.partition("(")
    call = head.isidentifier() and f"{head}{bracket} {rest}"  # its arguments may begin on the next line
    choices = [_together(text, 1), _together(text, 2), *([_together(call, 2)] if call else []), _together(text, 3)]
    fitting = next((kept for kept in choices if max(map(len, kept.split(" ")), default=0) <= room), text)
    lines = textwrap.wrap(fitting, WIDTH, initial_indent=lead, subsequent_indent=f"{lead}  ", break_on_hyphens=False)
    return [line.replace(_KEPT, " ").replace(f"{head}( ", f"{head}(") for line in lines]


def _together(text: str, level: int) -> str:
    """The text with everything inside so many nested brackets kept on one line."""
    depth, found = 0, []
    for character in text:
        depth = max(0, depth + (character in "([{") - (character in ")]}"))
        found.append(_KEPT if character == " " and depth >= level else character)
    return "".join(found)
