"""Finds in the syntax tree which names may share an object after a statement: `B = A`, `for row in A`, `with A as B`.

A tree does not say what the objects are, so where it is not clear, two names count as names that share one.
"""

from __future__ import annotations

import ast
from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass

COPIES = {"copy", "deepcopy"}
LOOKED_AT = 50
"""So many parts of an expression are looked at for names. A chain of thousands of calls would take hours."""


class Objects:
    """Sets of things that may share an object; two sets become one when a thing of each may share it."""

    def __init__(self) -> None:
        self._above: dict[Hashable, Hashable] = {}

    @property
    def joined(self) -> Iterable[Hashable]:
        """The things for which others stand."""
        return self._above.keys()

    def of(self, thing: Hashable) -> Hashable:
        """The thing that stands for the set of another one."""
        while (above := self._above.get(thing, thing)) != thing:
            self._above[thing] = self._above.get(above, above)
            thing = above
        return thing

    def join(self, one: Hashable, other: Hashable) -> None:
        """Make one set of the sets of two things."""
        if (first := self.of(one)) != (second := self.of(other)):
            self._above[first] = second


@dataclass(frozen=True)
class Lent:
    """What a call in an expression is given, which its value may hold.

    call: the function's name, dotted for a method. names: those that share what it is given.
    """

    call: str
    names: frozenset[str]


@dataclass(frozen=True)
class Binding:
    """A name that is bound to a value, or in whose object a value is stored.

    roots: the names that the expression begins with, and those that its call's arguments begin with. is_constant:
    whether nothing can change the value, which is made of numbers and texts alone. shares: names whose object may be
    the value or a part of it. lent: the same for what calls in the expression are given.
    """

    name: str
    roots: frozenset[str]
    is_constant: bool
    shares: frozenset[str]
    lent: tuple[Lent, ...] = ()


def shared(expression: ast.AST, calls: list[ast.Call] | None = None) -> frozenset[str]:
    """Names whose object the value of an expression may be, be a part of, or hold; functions that it calls as well.

    calls: takes the calls, whose arguments are then left out.
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
            case ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name)) if name in COPIES:
                pass
            case ast.Call() as call:
                waiting.append(call.func)
                if calls is None:
                    waiting += arguments(call)
                else:
                    calls.append(call)
            case ast.ListComp(elt=value) | ast.SetComp(elt=value) | ast.GeneratorExp(elt=value) as comprehension:
                waiting += [value, *(each.iter for each in comprehension.generators)]
            case ast.DictComp(value=value) as comprehension:
                waiting += [value, *(each.iter for each in comprehension.generators)]
            case ast.Lambda(body=value):
                found.update(sorted(names_in(value))[:LOOKED_AT])
            case None:
                break
    return frozenset(found)


def names_in(node: ast.AST) -> set[str]:
    """All names that stand in a node."""
    return {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}


def called_as(call: ast.Call) -> str:
    """The name of the function that a call calls, with a dot before that of a method; empty if it has none."""
    if isinstance(call.func, ast.Attribute):
        return f".{call.func.attr}"
    return call.func.id if isinstance(call.func, ast.Name) else ""


def root(expression: ast.AST) -> str:
    """The name that an expression begins with, as `table` in `table.rows[0].pop()`; empty if it begins with none."""
    for _ in range(LOOKED_AT):
        match expression:
            case (
                ast.Attribute(value=inner)
                | ast.Subscript(value=inner)
                | ast.Call(func=inner)
                | ast.Starred(value=inner)
            ):
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


def bindings(node: ast.AST, stored: bool = False) -> Iterator[Binding]:
    """The names that a node binds to the value of an expression; or those in whose objects it stores the value."""
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
                names = [each.id for each in targets if isinstance(each, ast.Name)]
                beside = frozenset(names[:1])  # one of them for all, as each shares with it
                pairs += ((each, whole) for each in targets if not isinstance(each, ast.Name))
                yield from (binding(name, whole, beside) for name in names if not stored)
            case (ast.Starred(value=part), whole):
                pairs.append((part, whole))
            case (ast.Subscript() | ast.Attribute() as place, whole) if stored:
                yield from (binding(name, whole) for name in shared(place))
            case (ast.Name(id=name), whole) if not stored:
                yield binding(name, whole)


def binding(name: str, value: ast.AST, beside: frozenset[str] = frozenset()) -> Binding:
    """A name that is bound to the value of an expression. beside: names that are bound to other parts of it."""
    calls: list[ast.Call] = []
    shares = shared(value, calls)
    roots = frozenset((root(value), *(root(each) for call in calls for each in arguments(call))))
    lent = [Lent(called_as(call), frozenset().union(*map(shared, arguments(call)))) for call in calls]
    if isinstance(value, ast.GeneratorExp):
        lent.append(Lent("iter", frozenset(names_in(value))))
    return Binding(name, roots, _is_constant(value), shares | beside, tuple(each for each in lent if each.names))
