"""Says in a student's words what Python cannot read in a source, and on which line the mistake is.

Python names the line at which it gave up. After a bracket or a text that is never closed, that line may lie far below
the mistake, in a function that is right. So those two are looked for here first; then Python's own message is put into
a sentence that says what to do. The messages are those of Python 3.11 to 3.14; one that is not known is passed on.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable
from typing import NamedTuple

from labs.grading.safe_text import one_line
from labs.grading.submission.magics import TOKEN
from labs.grading.submission.newer_python import newer_python
from labs.grading.submission.statements import HUGE

_CLOSING = {"(": ")", "[": "]", "{": "}"}
_STATEMENT = re.compile(
    r"[ \t]*(?:def|class|return|import|while|with|try|except|finally|raise|del|assert|pass|break|continue|elif|global"
    r"|nonlocal)\b(?![ \t]*[=,)\]}:.])"
)
"""The start of a line that no bracket can hold."""
_ASSIGNMENT = re.compile(r"[ \t]*[^\W\d][\w.]*[ \t]*(?:\[[^\]\n]*\][ \t]*)?=(?!=)")
_DEFINITION = re.compile(r"^(?:def \w+ ?\(|(?:import|from) \w+|class \w+)", re.MULTILINE)
"""The start of a line that is a program's, not a sentence's."""
_BLOCK_WITH_BRACE = re.compile(r"\s*(?:def|if|elif|else|for|while|class)\b[^{]*\{\s*$")
_BLOCK = re.compile(r"expected an indented block after (.+) on line (\d+)")
_CHARACTER = re.compile(r"invalid (?:character|non-printable character).*U\+([0-9A-F]+)")
_PLAIN = {
    '"': "“”„‟«»″", "'": "‘’‚‛`´′", "-": "−–—‐‑‒―", "*": "×·∙⋅•∗", "/": "÷∕⁄", "<=": "≤", ">=": "≥", "!=": "≠",
    "**2": "²", "**3": "³", "...": "…",
}  # fmt: skip
"""What a keyboard for programs types, and characters that look like it."""
_WORDS = ("def", "if", "else", "elif", "for", "while", "return", "import", "from", "class", "with")


_BELONGS = {"else": "if", "elif": "if", "except": "try", "finally": "try"}


class Explained(NamedTuple):
    """Where a mistake is, and what to do about it in a sentence."""

    line: int
    text: str


def explained(error: SyntaxError, source: str) -> Explained:
    """The line of a mistake that Python found in a source, and a sentence on it."""
    number = min(max(error.lineno or 1, 1), source.count("\n") + 1)
    if newer := newer_python(error, source):
        return Explained(number, newer)
    if "unterminated string" not in error.msg:  # which may hide a bracket that is closed
        for opened in (_endless_text(source), _open_bracket(source)):
            if opened and opened.line <= number:
                return opened
    if found := _BLOCK.search(error.msg):
        what = "this function has no lines" if "function" in found[1] else "nothing is indented below this line"
        return Explained(int(found[2]), f"{what}: indent what belongs to it by four spaces, or delete it")
    return Explained(number, _sentence(error, source.split("\n")[number - 1], source))


def _endless_text(source: str) -> Explained | None:
    """The first text in three quotes that has no end, or that ends only after lines of the program."""
    for token in TOKEN.finditer(source):
        quotes = token["long"]
        if quotes and (len(token[0]) < 6 or not token[0].endswith(quotes) or _DEFINITION.search(token[0])):
            line = source.count("\n", 0, token.start()) + 1
            return Explained(line, f"the text that begins here with {quotes} does not end: write {quotes} after it")
    return None


def _open_bracket(source: str) -> Explained | None:
    """The first bracket that is still open where a statement begins, or at the end."""
    opened: list[tuple[str, int]] = []  # each with its place
    for token in TOKEN.finditer(source):
        if token["open"]:
            opened.append((token["open"], token.start()))
        elif token["close"]:
            if not opened or _CLOSING[opened.pop()[0]] != token["close"]:
                return None  # Python's own message names it
        elif token["end"] and opened and _begins_statement(source, token.end(), opened[-1][0]):
            break
    if not opened:
        return None
    bracket, place = opened[-1]
    line = source.count("\n", 0, place) + 1
    if bracket == "{" and _BLOCK_WITH_BRACE.match(source.split("\n")[line - 1]):
        return Explained(line, "Python writes : instead of {, and indents the lines that belong to it")
    name = re.search(r"[\w.]*$", source[max(0, place - 80) : place])
    whole = f"{name[0] if name else ''}{bracket}"
    text = f"{whole} is opened here and never closed: add its {_CLOSING[bracket]}"
    return Explained(line, text)


def _begins_statement(source: str, at: int, bracket: str) -> bool:
    """Whether the line that starts there, within a bracket, can only be a statement of its own."""
    if _STATEMENT.match(source, at):
        return True
    before = source[max(0, at - 200) : at].rstrip()[-1:]  # after a comma, `name = 3` may be an argument
    return bool(_ASSIGNMENT.match(source, at)) and (bracket != "(" or before not in "(,")


def _sentence(error: SyntaxError, line: str, source: str) -> str:
    if found := _CHARACTER.search(error.msg):
        return _odd_character(chr(int(found[1], 16)), source)
    if isinstance(error, TabError):
        return "tabs and spaces are mixed: indent every line of the function by four spaces for each level"
    if error.msg.startswith("Exceeds the limit"):
        return HUGE
    for pattern, words in _MESSAGES:
        if found := re.search(pattern, error.msg):
            return words(line) if callable(words) else found.expand(words)
    return _not_understood(error, line) if error.msg == "invalid syntax" else one_line(error.msg)


def _odd_character(character: str, source: str) -> str:
    """What to type instead of a character that is none of Python's."""
    named = f"{one_line(character)} (U+{ord(character):04X})"
    plain = next((typed for typed, alike in _PLAIN.items() if character in alike), "")
    plain = plain or unicodedata.normalize("NFKC", character)
    if unicodedata.category(character) == "Zs":
        text = f"one of its spaces is no plain space (U+{ord(character):04X}): delete it and type a space"
    elif unicodedata.category(character) in ("Cf", "Cc", "Zl", "Zp"):
        text = f"an invisible character (U+{ord(character):04X}) is in it: delete the line and type it again"
    elif plain.isascii() and plain.isprintable():
        text = f"Python does not know the character {named}: type {plain} instead"
    else:
        text = f"Python does not know the character {named}: delete it"
    lines = sum(character in line for line in source.split("\n"))
    return text + (f" ({lines} lines have one)" if lines > 1 else "")


def _missing_colon(line: str) -> str:
    if re.match(r"\s*else\s+if\b", line):
        return "Python writes elif for else if"
    return "a colon is missing"


def _not_understood(error: SyntaxError, line: str) -> str:
    """A sentence on a mistake of which Python says no more than "invalid syntax"."""
    first = re.match(r"\s*(\w*)", line)
    word = first[1] if first else ""
    if line.lstrip().startswith((">>>", "...")):
        return "a prompt such as >>> is no part of a program: delete it"
    if word in _BELONGS:
        return f"this {word} belongs to no {_BELONGS[word]} above it: look at the indentation of both"
    if word != word.lower() and word.lower() in _WORDS:
        return f"Python writes {word.lower()}, in small letters"
    if re.match(r"\s*\d+[:.]?\s+[A-Za-z]", line):
        return "a line number was copied with it: delete the numbers"
    if re.search(r"\w(\+\+|--)\s*$", line):
        return f"Python has no {line.rstrip()[-2:]}: write {line.rstrip()[-1]}= 1"
    if re.fullmatch(r"\s*[A-Z][a-z']*(?: [\w',;:-]+){3,}[.?!]?\s*", line):
        return "it reads like a sentence: put a # before it, or make the cell one of text (Markdown)"
    if found := re.search(r"(?<![<>=!])=([<>])|&&|\|\|", line):
        return f"Python writes {({'&&': 'and', '||': 'or'}).get(found[0], f'{found[1]}=')} for {found[0]}"
    at = (error.offset or 1) - 1
    rest = re.match(r"\w+|\S", line[at:])
    if rest and rest[0] == "lambda":
        return "lambda is a word of Python's own: choose another name, such as lam"
    return f"Python does not understand it from {one_line(rest[0], 40)!r} on" if rest else "it is not complete"


_MESSAGES: tuple[tuple[str, str | Callable[[str], str]], ...] = (
    (r"expected ':'", _missing_colon),
    (r"cannot assign to (.+?)(?: here)?(?:\. Maybe.*)?$",
     r"left of = only a name can be written, no \1; to compare, write =="),
    (r"Maybe you meant '=='", "one = gives a value a name; to compare, write =="),
    (r"unterminated (f-)?string literal|EOL while scanning", "a text begins in it and has no closing quote"),
    (r"invalid (decimal|hexadecimal|octal|binary) literal|invalid imaginary",
     "a number runs into a name: is a * missing between them?"),
    (r"^unmatched '(.)'", r"the bracket \1 closes nothing: delete it, or add the one that it closes"),
    (r"closing parenthesis '(.)' does not match opening parenthesis '(.)'( on line \d+)?",
     r"the bracket \1 cannot close the bracket \2\3: which of the two is meant?"),
    (r"unexpected indent", "it is indented further than the line above for no reason: give it the same indentation"),
    (r"unindent does not match", "it is indented differently from every line above: give it the indentation of one"),
    (r"null byte", "a NUL character is in it, which no editor shows: delete the line and type it again"),
    (r"after line continuation", "nothing may follow a backslash in its line, not even a space: delete what follows"),
    (r"(non-default argument|parameter without a default) follows", "arguments with a default come last: move them"),
    (r"duplicate argument '(\w+)'", r"two of its arguments are named \1: give each a name of its own"),
    (r"f-string: expecting '}'", "a { in its text is never closed: add its }"),
    (r"expected '\('", "the name of a function is one word, as in signed_distance, and a bracket follows it"),
    (r"Missing parentheses in call to '(\w+)'",
     r"\1 is a function, so brackets belong around what follows it, as in \1(x)"),
    (r"forgot a comma", "a comma or an operator such as * is missing in it, or a bracket is not closed"),
)  # fmt: skip
"""Patterns that Python's message is searched for, each with a sentence."""
