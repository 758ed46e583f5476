"""Makes text that came from a student fit for a terminal, a log and a page: names, printed output, messages.

Threat: control characters and ANSI escapes rewrite what a terminal shows. Marks that turn the writing direction rewrite
what a reader sees. A name with a line break forges a line of its own. Code that writes HTML or CSV has to escape for
these itself.
"""

from __future__ import annotations

import unicodedata

_PICTURES = 0x2400  # from there on, Unicode has a picture for each control character
_HIDDEN = {"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"}


def plain(text: str, limit: int = 10_000) -> str:
    """The text with every hidden character made visible, tabs and line breaks left as they are; cut at the limit."""
    shown = text[:limit].replace("\r\n", "\n")
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
