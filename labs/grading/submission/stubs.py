"""Which functions of a submission are still as the student found them: a description, and an error."""

from __future__ import annotations

import ast

UNWRITTEN = "NotImplementedError"
VERSION, AGAIN = " version of ", "is yours to write again"
"""Parts of what the stubs say of a function that is written several times: first for simpler cases, then in full."""


def is_stub(statement: ast.stmt) -> bool:
    """Whether a statement is a function that only says whose turn it is."""
    if not isinstance(statement, ast.FunctionDef) or len(statement.body) > 2:
        return False
    return says(statement.body[-1], UNWRITTEN)


def is_open_version(statement: ast.stmt) -> bool:
    """Whether a statement is one version of a function that is written several times, and is not written yet.

    It may hold lines to begin with; it is written as soon as it returns something.
    """
    if not isinstance(statement, ast.FunctionDef) or not isinstance(statement.body[-1], ast.Raise):
        return False
    last = statement.body[-1]
    returns = any(isinstance(node, ast.Return) for node in ast.walk(statement))
    return says(last, UNWRITTEN) and (says(last, VERSION) or says(last, AGAIN)) and not returns


def says(statement: ast.stmt, words: str) -> bool:
    """Whether words are in a name or a text of a statement, however deep that is nested."""
    parts = (vars(node).get(kind) for node in ast.walk(statement) for kind in ("id", "attr", "value"))
    return any(isinstance(part, str) and words in part for part in parts)
