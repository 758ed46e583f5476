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
    return UNWRITTEN in ast.dump(statement.body[-1])


def is_open_version(statement: ast.stmt) -> bool:
    """Whether a statement is one version of a function that is written several times, and is not written yet.

    It may hold lines to begin with; it is written as soon as it returns something.
    """
    if not isinstance(statement, ast.FunctionDef) or not isinstance(statement.body[-1], ast.Raise):
        return False
    said = ast.dump(statement.body[-1])
    returns = any(isinstance(node, ast.Return) for node in ast.walk(statement))
    return UNWRITTEN in said and (VERSION in said or AGAIN in said) and not returns
