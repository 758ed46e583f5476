"""Makes text that came from a student fit for a terminal, a log and a page: names, printed output, messages.

Threat: control characters and ANSI escapes rewrite what a terminal shows. Marks that turn the writing direction rewrite
what a reader sees. A name with a line break forges a line of its own. Code that writes HTML or CSV has to escape for
these itself.

An address in memory is left out as well: it is another one in every run, and equal files should get equal grades.
"""

from __future__ import annotations

import re
import unicodedata

_ADDRESS = re.compile(r" at 0x(?:[0-9a-fA-F]{6,16}\b|[0-9a-fA-F]*\Z)")
"""As Python writes it, `<function f at 0x7f…>`, or the start of one at the end of a text that was cut."""
_LONGEST_ADDRESS = 22
_PICTURES = 0x2400  # from there on, Unicode has a picture for each control character
_HIDDEN = {"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"}


def plain(text: str, limit: int = 10_000) -> str:
    """The text without addresses and with every hidden character made visible, cut at the limit.

    Tabs and line breaks are left as they are.
    """
    shown = _ADDRESS.sub("", text[: limit + _LONGEST_ADDRESS])[:limit].replace("\r\n", "\n")
    shown = shown if shown.isascii() and shown.isprintable() else "".join(map(_visible, shown))
    return shown + (f" … ({len(text)} characters in all)" if len(text) > limit else "")


def one_line(text: str, limit: int = 300) -> str:
    """The text on one line, with every hidden character made visible."""
    return " ".join(plain(text, limit).split())


def cause_of(error: BaseException) -> str:
    """An exception that nobody expected, on one line: its type, and its message if it has one."""
    return one_line(f"{type(error).__name__}: {error}".rstrip(": "), 200)


def _visible(character: str) -> str:
    if character in "\n\t" or unicodedata.category(character) not in _HIDDEN:
        return character
    if ord(character) < 0x20:
        return chr(_PICTURES + ord(character))
    return "␡" if character == "\x7f" else f"\\u{ord(character):04x}"
