"""Finds what a later Python can read and the one that grades cannot, so that a student is not told it is a mistake.

Nothing here reads a later Python's grammar. What is known to be new is taken out of the source; if Python then gets
beyond that line, it was the new thing that stopped it.
"""

from __future__ import annotations

import ast
import re
import sys

_PARAMETERS = re.compile(r"^([ \t]*(?:async[ \t]+def|def|class)[ \t]+\w+)[ \t]*\[[^\]\n]*\]", re.MULTILINE)
"""`def first[T](x: T)` and `class Box[T]:`, since Python 3.12."""
_TYPE = re.compile(r"^([ \t]*)type[ \t]+(\w+)(?:[ \t]*\[[^\]\n]*\])?[ \t]*=(?!=)", re.MULTILINE)
"""`type Vector = tuple[float, ...]`, since Python 3.12."""
_TEXT = re.compile(r"(?i:\b(f|rf|fr)|\b(?:[bur]|br|rb))?(\"(?!\"\")|'(?!''))")
"""The quote with which a text begins in a line, with the letters before it; the first group if values are put in."""


def newer_python(error: SyntaxError, source: str) -> str:
    """What to tell a student whose source only a later Python can read; nothing if none can."""
    number = error.lineno or 1
    lines = source.split("\n")
    if sys.version_info >= (3, 12) or number > len(lines):
        return ""
    line = lines[number - 1]
    for what, older in (
        ("write other quotes inside the braces, and no backslash", _without_values(line)),
        ("leave out [ ] after the name, and what it holds", _PARAMETERS.sub(r"\1", line)),
        ("leave out the word type", _TYPE.sub(r"\1\2 =", line)),
    ):
        if older != line and _gets_beyond(number, [*lines[: number - 1], older, *lines[number:]]):
            version = f"{sys.version_info.major}.{sys.version_info.minor}"
            return f"Python {version}, which grades here, cannot read this; Python 3.12 can: {what}"
    return ""


def _gets_beyond(number: int, lines: list[str]) -> bool:
    """Whether Python finds no mistake in these lines, or only one that is further down."""
    try:
        ast.parse("\n".join(lines))
    except SyntaxError as error:
        return (error.lineno or 1) > number
    except (ValueError, RecursionError, MemoryError):  # for text that no person writes
        return False
    return True


def _without_values(line: str) -> str:
    """A line in which texts such as `f"{c["x"]}"`, whose values hold their own quotes or a backslash, are emptied.

    It is left as it is if a text does not end in it.
    """
    kept, at = list[str](), 0
    while found := _TEXT.search(line, at):
        end, new = _end(line, found.end(), found[2], bool(found[1]))
        if end is None:
            return line
        kept += line[at : found.start()], '""' if new else line[found.start() : end]
        at = end
    return "".join(kept) + line[at:]


def _end(line: str, at: int, quote: str, holds_values: bool) -> tuple[int | None, bool]:
    """Where a text that began before this place ends for Python 3.12, and whether its values are new in that version.

    None if it does not end, or a bracket of a value is left open.
    """
    new = False
    texts = [(quote, holds_values)]  # those that are open, the innermost last
    brackets = [""]  # that are open in the values of each of them
    while at < len(line):
        quote, holds_values = texts[-1]
        character, at = line[at], at + 1
        if brackets[-1]:  # within a value
            if character in "([{":
                brackets[-1] += character
            elif character in ")]}":
                if f"{brackets[-1][-1]}{character}" not in ("()", "[]", "{}"):
                    return None, new
                brackets[-1] = brackets[-1][:-1]
            elif character == "\\":
                new = True
            elif found := _TEXT.match(line, at - 1):
                new = new or found[2] == quote
                texts.append((found[2], bool(found[1])))
                brackets.append("")
                at = found.end()
        elif character == "\\":
            new = new or len(texts) > 1
            at += 1
        elif character == quote:
            texts.pop()
            brackets.pop()
            if not texts:
                return at, new
        elif character == "{" and holds_values:
            if line[at : at + 1] == "{":
                at += 1
            else:
                brackets[-1] = "{"
    return None, new
