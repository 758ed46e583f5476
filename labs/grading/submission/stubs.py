"""Which functions of a submission are still as the student found them: a description, and an error."""

from __future__ import annotations

import ast

UNWRITTEN = "NotImplementedError"
AGAIN = "is yours to write again"
"""Ends the error of a stub of which a first version was written before; that version counts as long as it is a stub."""


def is_stub(statement: ast.stmt) -> bool:
    """Whether a statement is a function that only says whose turn it is."""
    if not isinstance(statement, ast.FunctionDef) or len(statement.body) > 2:
        return False
    return UNWRITTEN in ast.dump(statement.body[-1])


def is_stub_of_a_second_version(statement: ast.stmt) -> bool:
    """Whether a statement is a stub of a function that was written before, for simpler cases."""
    return is_stub(statement) and AGAIN in ast.dump(statement)
