"""Which functions of a submission are still as the student found them: a description, and an error."""

from __future__ import annotations

import ast

UNWRITTEN = "NotImplementedError"


def is_stub(statement: ast.stmt) -> bool:
    """Whether a statement is a function that only says whose turn it is."""
    if not isinstance(statement, ast.FunctionDef) or len(statement.body) > 2:
        return False
    return UNWRITTEN in ast.dump(statement.body[-1])
