"""Finds in the syntax tree which names may share an object after a statement: `B = A`, `for row in A`, `with A as B`.

A tree does not say what the objects are, so where it is not clear, two names count as names that share one.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

LOOKED_AT = 50
"""So many parts of an expression are looked at for names. A chain of thousands of calls would take hours."""


@dataclass(frozen=True)
class Binding:
    """A name that is bound to a value. root: the name that the expression begins with.

    is_constant: whether nothing can change the value, which is made of numbers and texts alone. shares: names whose
    object may be the value or a part of it. lent: the same for what calls in the expression are given, which their
    values may hold; each with the name that the call begins with.
    """

    name: str
    root: str
    is_constant: bool
    shares: frozenset[str]
    lent: tuple[tuple[str, frozenset[str]], ...]


def shared(expression: ast.AST, calls: list[ast.Call] | None = None) -> frozenset[str]:
    """Names whose object the value of an expression may be, be a part of, or hold.

    calls: takes the calls whose arguments are then left out.
    """
    waiting: list[ast.AST] = [expression]
    found: set[str] = set()
    for _ in range(LOOKED_AT):
        match waiting.pop() if waiting else None:
            case ast.Name(id=name):
                found.add(name)
            case ast.Attribute(value=value) | ast.Subscript(value=value) | ast.Starred(value=value):
                waiting.append(value)
            case ast.NamedExpr(value=value) | ast.Await(value=value):
                waiting.append(value)
            case ast.Tuple(elts=several) | ast.List(elts=several) | ast.Set(elts=several):
                waiting += (each for each in several if not isinstance(each, ast.Constant))
            case ast.Dict(values=several) | ast.BoolOp(values=several):
                waiting += (each for each in several if not isinstance(each, ast.Constant))
            case ast.IfExp(body=one, orelse=other):
                waiting += [one, other]
            case ast.Call(func=ast.Attribute(attr="copy")):
                pass
            case ast.Call() as call:
                waiting += [call.func] * isinstance(call.func, ast.Attribute)
                if calls is None:
                    waiting += arguments(call)
                else:
                    calls.append(call)
            case ast.ListComp(elt=value) | ast.SetComp(elt=value) | ast.GeneratorExp(elt=value):
                waiting.append(value)
            case None:
                break
    return frozenset(found)


def root(expression: ast.AST) -> str:
    """The name that an expression begins with, as `table` in `table.rows[0].pop()`; empty if it begins with none."""
    for _ in range(LOOKED_AT):
        match expression:
            case ast.Attribute(value=inner) | ast.Subscript(value=inner) | ast.Call(func=inner):
                expression = inner
            case _:
                break
    return expression.id if isinstance(expression, ast.Name) else ""


def _is_constant(expression: ast.AST) -> bool:
    allowed = (ast.Constant, ast.UnaryOp, ast.BinOp, ast.Tuple, ast.operator, ast.unaryop, ast.expr_context)
    return all(isinstance(node, allowed) for node in ast.walk(expression))


def arguments(call: ast.Call) -> list[ast.expr]:
    """What a call is given, by position and by keyword."""
    return [*call.args, *(each.value for each in call.keywords)]


def bindings(node: ast.AST) -> Iterator[Binding]:
    """The names that a node binds to the value of an expression."""
    pairs: list[tuple[ast.AST, ast.AST]] = []
    match node:
        case ast.Assign():
            pairs += ((target, node.value) for target in node.targets)
        case ast.AnnAssign(value=ast.expr() as value) | ast.NamedExpr(value=value):
            pairs.append((node.target, value))
        case ast.For() | ast.comprehension():
            pairs.append((node.target, node.iter))
        case ast.withitem(optional_vars=ast.expr() as target):
            pairs.append((target, node.context_expr))
    while pairs:
        match pairs.pop():
            case (ast.Tuple(elts=targets) | ast.List(elts=targets), ast.Tuple(elts=values) | ast.List(elts=values)) if (
                len(targets) == len(values)
            ):
                pairs += zip(targets, values, strict=True)
            case (ast.Tuple(elts=targets) | ast.List(elts=targets), whole):
                pairs += ((each, whole) for each in targets)
            case (ast.Starred(value=part), whole):
                pairs.append((part, whole))
            case (ast.Name(id=name), whole):
                yield _binding(name, whole)


def _binding(name: str, value: ast.AST) -> Binding:
    calls: list[ast.Call] = []
    shares = shared(value, calls)
    lent = ((root(call), frozenset[str]().union(*map(shared, arguments(call)))) for call in calls)
    return Binding(name, root(value), _is_constant(value), shares, tuple(each for each in lent if each[1]))
