"""Makes the mutants of a solution: its own source and that of the helpers it calls, with one expression wrong.

A function is taken with everything that is its own: private helpers, and functions of its topic that it calls and that
no student is given, as if it had been written in one piece. Checks of what enters are left out, because no student has
to write them: a mutant that is refused by a check would say nothing about the tests.
"""

from __future__ import annotations

import ast
import copy
import functools
import importlib
import inspect
import itertools
import textwrap
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import CodeType, FunctionType
from typing import Any

import numpy as np

from labs.grading.diagnosis.probes import probes
from labs.grading.worker.bodies import with_names
from mutants import arguments, operators
from reference import lecture
from solutions.domain import Rule, _domains

Function = Callable[..., Any]
SKIPPED_KEYWORDS = ("axis", "axis1", "axis2", "keepdims", "dtype", "initial", "divide", "invalid")
"""Named arguments that say how an array is stored, not what is computed."""


def _floats(*parts: Any) -> Any:
    return tuple(np.asarray(part, dtype=float) for part in parts)


def _named(_name: str, value: Any) -> Any:
    return np.asarray(value, dtype=float)


CHECKS = dict.fromkeys(
    (
        "finite",
        "not_negative",
        "positive",
        "whole",
        "in_unit_interval",
        "unit",
        "vector",
        "matrix",
        "in_space",
    ),
    _named,
) | {"checked": lambda body: _floats(*body), "_checked": _floats}
"""What stands for the checks of what enters: they turn lists into arrays."""
OF_A_WORLD = ("candidate_pairs", "collect_contacts", "resting_problem", "solve_by_sweeps", "respond",
              "rotate_by_momentum")  # fmt: skip
"""What a student writes of a world: each is mutated by itself, because a step calls them all."""
NOT_ASKED = (*OF_A_WORLD, "blocks", "boxes_that_meet", "_faces_above", "_stretch", "winding_of_mesh",
             "inside_by_parity")  # fmt: skip
"""Helpers that save time or memory, or are there for numbers and cases that no lab asks for: they stay as they are.

So does `inside_by_parity` where another function calls it: what it makes of rays along edges is for its own checks.
"""
KINDS = {"edges": int, "pinned": bool}
"""What the parts of a mesh hold that are no floats."""
HELPERS = {
    name: getattr(operators, name)
    for name in ("shaped", "always", "never", "without", "alone", "transposed", "diagonal", "rounds")
}
"""What wrong expressions call, and loops."""


OPERATORS = (operators.sums, operators.sizes, operators.products, operators.conditions, operators.calls,
             operators.results)  # fmt: skip


@dataclass(frozen=True)
class Mutant:
    """A function with one thing wrong.

    function: the one that is called. owner: in whose source the mistake is, itself or one that it calls. change: what
    was done, in words that name one mutant of the owner.
    """

    function: str
    owner: str
    change: str
    call: Function

    @property
    def name(self) -> str:
        """What was done, and where."""
        return f"in {self.owner}: " * (self.owner != self.function) + self.change


def mutants(name: str) -> Iterator[Mutant]:
    """All mutants of a function, in the same order every time."""
    seen: Counter[tuple[str, str]] = Counter()
    for owner, words, call in itertools.chain(_of_arguments(name), _of_source(name)):
        seen[owner, words] += 1
        count = seen[owner, words]
        yield Mutant(name, owner, words + f" ({count})" * (count > 1), call)


def solution(name: str) -> Function:
    """The right function, without checks of what enters."""
    return _run(name, _own(name))


def _of_arguments(name: str) -> Iterator[tuple[str, str, Function]]:
    right = solution(name)
    parameters = list(inspect.signature(right).parameters)
    sample = max((probe.arguments for probe in probes(name) if probe.group == "usual"), key=len)
    for words, wrong in arguments.wrong_arguments(parameters, sample):
        yield name, words, functools.partial(_given, right, wrong)


def _given(function: Function, wrong: Function, *given: Any) -> Any:
    return function(*wrong(given))


def _of_source(name: str) -> Iterator[tuple[str, str, Function]]:
    functions = _own(name)
    for own, (function, tree) in functions.items():
        known = frozenset(function.__code__.co_varnames) | {"COLLIDING", "SEPARATING"}
        wrong = (*OPERATORS, operators.mistaken(known))
        for parent, field, at in list(_expressions(tree)):
            node = _at(parent, field, at)
            here = (*wrong, operators.sizes_returned) if isinstance(parent, ast.Return) else wrong
            for words, other in [pair for operator in here for pair in operator(node)]:
                if _said(other) == _said(node):
                    continue
                _put(parent, field, at, other)
                try:
                    call = _run(name, functions, own)
                finally:
                    _put(parent, field, at, node)
                yield own, f"{words}: {_said(node)} → {_said(other)}", call


def _said(node: ast.expr) -> str:
    """The source of an expression, without the checks of what enters."""
    return operators.text(_Shorter().visit(copy.deepcopy(node)))


class _Shorter(ast.NodeTransformer):
    """Takes away the calls that only turn lists into arrays."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        return node.args[-1] if operators.text(node.func) in (*CHECKS, "np.asarray") else node


# Places of expressions in a syntax tree: a node, the name of its field, and the place in it where that is a list


def _expressions(node: ast.AST) -> Iterator[tuple[ast.AST, str, int | None]]:
    """The places of all expressions below a node that say what is computed."""
    for field, value in ast.iter_fields(node):
        for at, child in enumerate(value) if isinstance(value, list) else ((None, value),):
            if not isinstance(child, ast.AST) or _is_form(node, field, child):
                continue
            if _guarded(node, child):
                node, child, field, at = child, child.args[1], "args", 1
            if isinstance(child, ast.expr):
                yield node, field, at
            yield from _expressions(child)


def _is_form(node: ast.AST, field: str, child: ast.AST) -> bool:
    """Whether a part of a node says how arrays lie, or what something is called."""
    if isinstance(node, ast.FunctionDef) and field != "body":
        return True
    if isinstance(node, ast.Subscript) and field == "slice":
        return True
    if isinstance(node, ast.Call) and operators.text(node.func) in ("np.swapaxes", "np.cross") and field == "args":
        return isinstance(child, ast.Constant | ast.UnaryOp)
    return isinstance(child, ast.keyword) and child.arg in SKIPPED_KEYWORDS


def _guarded(node: ast.AST, child: ast.AST) -> bool:
    """Whether a part of a node is `np.where(c, x, 1.0)` below the line of a fraction: x is mutated, c and 1.0 are not.

    The 1.0 keeps a division by zero from a warning, and what comes of it is never used.
    """
    match node, child:
        case ast.BinOp(_, ast.Div(), below), ast.Call(ast.Attribute(attr="where"), [_, _, ast.Constant(1.0)]):
            return below is child
    return False


def _at(parent: ast.AST, field: str, at: int | None) -> Any:
    value = getattr(parent, field)
    return value if at is None else value[at]


def _put(parent: ast.AST, field: str, at: int | None, node: ast.expr) -> None:
    if at is None:
        setattr(parent, field, node)
    else:
        getattr(parent, field)[at] = node


# Sources


Sources = dict[str, tuple[FunctionType, ast.FunctionDef]]


@functools.cache
def _own(name: str) -> Sources:
    """A function and all that is its own, by name: the function and its syntax tree."""
    topic = lecture.function(name).topic
    found: Sources = {}
    waiting = [inspect.unwrap(getattr(importlib.import_module(f"solutions.{topic}"), name))]
    while waiting:
        function = waiting.pop(0)
        if function.__name__ not in found:
            tree = _bare(function)
            found[function.__name__] = function, tree
            names = {each.id for each in ast.walk(tree) if isinstance(each, ast.Name)}
            used = [function.__globals__.get(each) for each in sorted(names - {*function.__code__.co_varnames})]
            waiting += [inspect.unwrap(it) for it in used if isinstance(it, FunctionType) and _belongs(it, topic)]
    return found


def _belongs(function: FunctionType, topic: str) -> bool:
    entry = lecture.FUNCTIONS.get(function.__name__)
    ours = function.__module__.startswith(f"solutions.{topic}.") and function.__name__ not in CHECKS
    return ours and function.__name__ not in NOT_ASKED and (entry is None or entry.role != "given")


def _bare(function: FunctionType) -> ast.FunctionDef:
    """The syntax tree of a function, without description, types, and checks that only raise an error."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(function))).body[0]
    assert isinstance(tree, ast.FunctionDef)
    for each in [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]:
        each.returns, each.decorator_list = None, []
        for argument in each.args.args:
            argument.annotation = None
        each.body = [line for line in each.body if not _only_checks(line)]
    tree = _Longer().visit(tree)
    before = 0
    while len(tree.body) != before:
        before = len(tree.body)
        loaded = {each.id for each in ast.walk(tree) if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load)}
        tree.body = [line for line in tree.body if not _is_unread(line, loaded)]
    return tree


class _Longer(ast.NodeTransformer):
    """Writes `a -= b` as `a = a - b`, so that it is mutated as any difference is, and gives every loop an end."""

    def visit_While(self, node: ast.While) -> ast.AST:
        self.generic_visit(node)
        leaves = ast.If(ast.UnaryOp(ast.Not(), node.test), [ast.Break()], [])
        return ast.For(ast.Name("_", ast.Store()), operators.made("rounds()"), [leaves, *node.body], [])

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.AST:
        value = ast.parse(operators.text(node.target), mode="eval").body
        return ast.Assign([node.target], ast.BinOp(value, node.op, node.value), lineno=node.lineno)


def _only_checks(line: ast.stmt) -> bool:
    return isinstance(line, ast.Expr) or (isinstance(line, ast.If) and isinstance(line.body[-1], ast.Raise))


def _is_unread(line: ast.stmt, loaded: set[str]) -> bool:
    targets = line.targets if isinstance(line, ast.Assign) else []
    return bool(targets) and all(isinstance(each, ast.Name) and each.id not in loaded for each in targets)


# Functions from syntax trees


def _run(name: str, functions: Sources, changed: str = "") -> Function:
    """The function of that name. changed: which of the trees has been changed; all others are compiled already."""
    space = dict(_names(name))
    for own, (function, tree) in functions.items():
        exec(_compiled(tree) if own == changed else _code(name, own), space)
        space[own] = _of_arrays(function, space[own])
    found: Function = space[name]
    return found


def _of_arrays(right: FunctionType, mutant: Function) -> Function:
    """A mutant that gets its arguments as the right function does: as arrays, but whatever they hold."""
    rules, defaults, _ = _domains(right)
    names = list(inspect.signature(right).parameters)

    @functools.wraps(mutant)
    def call(*args: Any, **kwargs: Any) -> Any:
        given = defaults | dict(zip(names, args, strict=False)) | kwargs
        for _, name, rule in rules:
            given[name] = _unchecked(name, given[name], rule)
        return mutant(**given)

    return call if rules else mutant


def _unchecked(name: str, value: Any, rule: Rule) -> Any:
    try:
        return rule(name, value)
    except ValueError:
        value = with_names(value)
        if not hasattr(value, "_fields"):
            return np.asarray(value, dtype=float)
        parts = zip(value._fields, value, strict=True)
        return type(value)(*(np.asarray(part, dtype=KINDS.get(field, float)) for field, part in parts))


@functools.cache
def _names(name: str) -> dict[str, Any]:
    """What a function's own sources refer to."""
    space: dict[str, Any] = {}
    for function, _ in _own(name).values():
        space |= function.__globals__
    return space | CHECKS | HELPERS


@functools.cache
def _code(name: str, own: str) -> CodeType:
    return _compiled(_own(name)[own][1])


def _compiled(tree: ast.FunctionDef) -> CodeType:
    return compile(ast.fix_missing_locations(ast.Module(body=[tree], type_ignores=[])), f"<{tree.name}>", "exec")
