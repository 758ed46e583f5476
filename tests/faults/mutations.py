"""What can be wrong in a line of Python: an operator, a comparison, a number, a condition, a call that is forgotten.

These are the small mistakes of a programmer, for any code. Mistakes of physics are in `tests/labs/mutants` and in
`reference/comparison/faults.py`.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SUMS_AND_PRODUCTS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
COMPARISONS = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
}  # fmt: skip
_LEFT_ALONE = (ast.JoinedStr, ast.Raise, ast.Assert, ast.Import, ast.ImportFrom)
"""Words, and checks whose words a person reads."""


@dataclass(frozen=True)
class Fault:
    """One wrong expression or statement. count: which of the same ones in its function, from 0."""

    path: str
    function: str
    before: str
    after: str
    count: int


def wrong(node: ast.AST) -> Iterator[ast.AST]:
    """What may stand in the place of a node by mistake."""
    match node:
        case ast.BinOp(a, op, b) if type(op) in SUMS_AND_PRODUCTS:
            yield ast.BinOp(a, SUMS_AND_PRODUCTS[type(op)](), b)
        case ast.Compare(a, [op], b) if type(op) in COMPARISONS:
            yield ast.Compare(a, [COMPARISONS[type(op)]()], b)
        case ast.BoolOp(op, values):
            yield ast.BoolOp(ast.And() if isinstance(op, ast.Or) else ast.Or(), values)
        case ast.UnaryOp(ast.Not() | ast.USub(), a) if not isinstance(a, ast.Constant):
            yield a
        case ast.IfExp(_, a, b):
            yield from (a, b)
        case ast.Constant(bool() as value):
            yield ast.Constant(not value)
        case ast.Constant(int() | float() as value):
            yield ast.Constant(value + 1)
            if value:
                yield ast.Constant(2 * value)
        case ast.Call(function, [a, b, *rest], named) if not any(isinstance(each, ast.Starred) for each in node.args):
            yield ast.Call(function, [b, a, *rest], named)
        case ast.Expr(ast.Call()):
            yield ast.Pass()
        case ast.Return(value) if value is not None and not isinstance(value, ast.Constant):
            yield ast.Return(ast.Constant(None))


def faults(root: Path, path: str) -> Iterator[tuple[int, Fault]]:
    """Every fault of a file, with the line where it is."""
    for function, node, before, count in _places((root / path).read_text(encoding="utf-8")):
        for after in map(ast.unparse, wrong(node)):
            if after != before:  # as of two equal arguments that change places
                yield node.lineno, Fault(path, function, before, after, count)  # type: ignore[attr-defined]


def with_fault(source: str, fault: Fault) -> str:
    """The source with the fault in its place; `LookupError` where there is no such place any more."""
    for function, node, before, count in _places(source):
        if (function, before, count) == (fault.function, fault.before, fault.count):
            lines = source.encode().splitlines(keepends=True)
            start = sum(map(len, lines[: node.lineno - 1])) + node.col_offset  # type: ignore[attr-defined]
            end = sum(map(len, lines[: node.end_lineno - 1])) + node.end_col_offset  # type: ignore[attr-defined]
            after = fault.after if isinstance(node, ast.stmt) else f"({fault.after})"
            whole = source.encode()
            return (whole[:start] + after.encode() + whole[end:]).decode()
    raise LookupError(f"{fault.path} has no {fault.before!r} in {fault.function} any more")


def _places(source: str) -> Iterator[tuple[str, ast.AST, str, int]]:
    """The nodes of all functions that may be wrong: function, node, its text, and how many such there were before."""
    seen: dict[tuple[str, str], int] = {}
    for function, node in _nodes(ast.parse(source), ""):
        if any(True for _ in wrong(node)):
            before = ast.unparse(copy.deepcopy(node))
            count = seen[function, before] = seen.get((function, before), -1) + 1
            yield function, node, before, count


def _nodes(node: ast.AST, function: str) -> Iterator[tuple[str, ast.AST]]:
    for field, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST) or isinstance(child, _LEFT_ALONE):
                continue
            if field in ("annotation", "returns", "decorator_list", "args") and not isinstance(node, ast.Call):
                continue
            name = f"{function}.{child.name}".lstrip(".") if _is_named(child) else function
            if function and not _is_named(child):
                yield function, child
            yield from _nodes(child, name)


def _is_named(node: ast.AST) -> bool:
    return isinstance(node, ast.FunctionDef | ast.ClassDef)
