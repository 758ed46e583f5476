"""A function's header and description in lines that a notebook shows whole, with the same words."""

from __future__ import annotations

import ast
import re
import textwrap
from collections.abc import Iterator, Sequence

WIDTH = 88
"""Characters of a line, as in most notebooks' own style."""
_ITEM = re.compile(r"\s*[\w*][\w*, ]* : ")
"""How the description of an argument begins: `point : (..., 3), m`."""


def narrow(text: str) -> str:
    """A function that ends with its description, header and description in lines of at most `WIDTH`."""
    function = next(node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef))
    first = function.body[0].lineno
    before, description = text.split("\n")[: function.lineno - 1], text.split("\n")[first - 1 :]
    return "\n".join([*before, *_header(function, text), *_description(description)])


def _header(function: ast.FunctionDef, text: str) -> list[str]:
    lines = text.split("\n")[function.lineno - 1 : function.body[0].lineno - 1]
    if all(len(line) <= WIDTH for line in lines):
        return lines
    within = " ".join(line.strip() for line in lines)
    start, arguments, end = _parts(within)
    joined = "    " + ", ".join(arguments)
    rows = [joined] if len(joined) <= WIDTH else [f"    {argument}," for argument in arguments]
    return [start, *rows, end]


def _parts(header: str) -> tuple[str, list[str], str]:
    """`def f(`, its arguments, and `) -> Array:`."""
    opened, closed = header.index("("), header.rindex(")" if " -> " not in header else ") -> ")
    found, depth = [""], 0
    for sign in header[opened + 1 : closed]:
        depth += (sign in "([{") - (sign in ")]}")
        if sign == "," and depth == 0:
            found.append("")
        else:
            found[-1] += sign
    return header[: opened + 1], [each.strip() for each in found if each.strip()], header[closed:]


def _description(lines: Sequence[str]) -> Iterator[str]:
    """Its paragraphs, those that are too wide filled anew."""
    paragraph: list[str] = []
    for line in [*lines, ""]:
        if paragraph and not _continues(paragraph[0], line):
            yield from _filled(paragraph)
            paragraph = []
        if line.strip():
            paragraph.append(line)
        else:
            yield ""


def _continues(first: str, line: str) -> bool:
    """Whether a line belongs to the paragraph of a first one; what an argument is may go on farther in."""
    deeper = 4 * bool(_ITEM.match(first))
    return bool(line.strip()) and not _ITEM.match(line) and _indent(line) - _indent(first) in (0, deeper)


def _filled(paragraph: Sequence[str]) -> Iterator[str]:
    if all(len(line) <= WIDTH for line in paragraph):
        yield from paragraph
        return
    indent = " " * _indent(paragraph[0])
    hanging = indent + "    " * bool(_ITEM.match(paragraph[0]))
    text = " ".join(line.strip() for line in paragraph)
    yield from textwrap.wrap(
        text, WIDTH, initial_indent=indent, subsequent_indent=hanging, break_long_words=False, break_on_hyphens=False
    )


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())
