"""What a submission's exceptions say: their type, their message as Python would show it, and their line."""

from __future__ import annotations

import builtins
import difflib
import itertools
import traceback
from collections.abc import Collection

TITLE = "submission"
"""Name of the module that the text becomes, and of the file in its tracebacks."""
_MESSAGE_CHARACTERS = 2000
"""The longest message of an exception that is sent."""
_NAME_CHARACTERS, _MOST_NAMES = 100, 50
"""The longest name of a function that an exception passed through, and how many of these are sent."""
_LONG_ENOUGH = 3  # letters that a name needs before another one is suggested for it
_LIKE, _LIKE_A_BUILTIN = 0.66, 0.75
"""Similarity, at most 1, from which a name is suggested for a misspelt one; more for one of Python's many own names."""


def place(error: BaseException) -> tuple[int, int] | None:
    """Line and column that the outermost statement of the text was at when it failed; None if the error hides it."""
    trace = error.__traceback__
    while trace is not None and trace.tb_frame.f_code.co_filename != TITLE:
        trace = trace.tb_next
    if trace is None:
        return None
    line, _, column, _ = next(itertools.islice(trace.tb_frame.f_code.co_positions(), trace.tb_lasti // 2, None))
    return line or trace.tb_lineno, column or 0


def through(error: BaseException) -> list[str]:
    """The names of the functions of the submission that an exception passed through, each once."""
    frames = (frame.f_code for frame, _ in traceback.walk_tb(error.__traceback__))
    names = dict.fromkeys(code.co_name for code in frames if code.co_filename == TITLE)
    return [name[:_NAME_CHARACTERS] for name in names][:_MOST_NAMES]


def described(error: BaseException) -> tuple[str, str, int | None]:
    """The exception's type, its message, and the last line of the submission that it passed through."""
    line = None
    for frame, number in traceback.walk_tb(error.__traceback__):
        if frame.f_code.co_filename == TITLE:
            line = number
    unreadable = error if isinstance(error, SyntaxError) and error.filename == TITLE else None
    if unreadable is not None:
        line = unreadable.lineno
    try:  # Python adds the line to the message of a SyntaxError
        message = str(error if unreadable is None else unreadable.msg) + _meant(error)
    except BaseException:
        message = "(its message cannot be shown)"
    return type(error).__name__[:100], message[:_MESSAGE_CHARACTERS], line


def _meant(error: BaseException) -> str:
    """What Python's own traceback adds about a misspelt name: ". Did you mean: 'cross'?"."""
    near: list[str] = []
    if isinstance(error, NameError) and error.__traceback__:
        frame = list(traceback.walk_tb(error.__traceback__))[-1][0]
        own = _alike(error.name, {*frame.f_locals, *frame.f_globals})
        near = own or _alike(error.name, vars(builtins), _LIKE_A_BUILTIN)
    elif isinstance(error, AttributeError):
        near = _alike(error.name, dir(error.obj))
    return f". Did you mean: {near[0]!r}?" if near else ""


def _alike(name: str | None, names: Collection[str], least: float = _LIKE) -> list[str]:
    """Names that are like another one; first those with its first letter, which are usually meant."""
    if not name or len(name) < _LONG_ENOUGH:
        return []
    found = difflib.get_close_matches(name, [each for each in names if each[:1] != "_"], 5, least)
    return sorted(found, key=lambda each: each[:1] != name[:1])
