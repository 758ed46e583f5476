"""Finds in the syntax tree what statements do to objects: share them, change them, or pass them on to a function.

`B = A` shares, `A[0] = 1` changes, and `fill(A)` passes on. A tree does not say what the objects are; `flow` decides
which calls are sure to change nothing.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from labs.grading.submission.sharing import (
    Binding,
    arguments,
    binding,
    bindings,
    called_as,
    names_in,
    root,
    shared,
)

CHANGING_METHODS = {
    "add", "append", "appendleft", "clear", "difference_update", "discard", "extend", "extendleft", "fill", "insert",
    "intersection_update", "partition", "pop", "popitem", "popleft", "put", "remove", "resize", "reverse", "rotate",
    "move_to_end", "subtract",
    "setdefault", "setfield", "setflags", "sort", "symmetric_difference_update", "update",
    "__delitem__", "__iadd__", "__imul__", "__ior__", "__setitem__",
}  # fmt: skip
"""What changes a list, a set, a table, a queue or an array in place."""
OPERATOR = ".__"
"""Stands for all methods that a class has for operators, brackets, loops and `with`."""
_MAKING = {"__init__", "__new__", "__init_subclass__", "__post_init__"}  # these a call of the class calls
_OPERATED = (
    ast.BinOp | ast.UnaryOp | ast.Compare | ast.Subscript | ast.withitem | ast.For | ast.comprehension | ast.AugAssign
)


@dataclass(frozen=True)
class Call:
    """A call, a decorator, or a method that is looked up. called: the function's name, with a dot before a method.

    path: the names from the root to the function, as `np.linalg.norm`; empty if it is not made of names alone. root:
    the name that the expression begins with. receiver: names that share the object of a method, or of a value that is
    called. given: names that share an argument. roots: those that arguments begin with, and the calls around it.
    keywords: the names of arguments. is_lookup: whether nothing is called, or only with what is defined there.
    """

    called: str
    path: tuple[str, ...]
    root: str
    receiver: frozenset[str]
    given: frozenset[str] = frozenset()
    roots: frozenset[str] = frozenset()
    keywords: frozenset[str] = frozenset()
    is_lookup: bool = False
    is_statement: bool = False


@dataclass(frozen=True)
class Effects:
    """What some statements may do to objects.

    bindings: of names to values. stores: of values in the objects of names. changes: names whose objects they change
    themselves. operated: names that operators, brackets, loops and `with` are applied to. local: names that they bind.
    """

    bindings: tuple[Binding, ...]
    stores: tuple[Binding, ...]
    changes: frozenset[str]
    operated: frozenset[str]
    calls: tuple[Call, ...]
    local: frozenset[str] = frozenset()


@dataclass(frozen=True, eq=False)
class Function:
    """A function or a method. called: its name, with a dot before that of a method. given: all of its parameters.

    result: names that share what it gives back. is_lazy: whether it is a generator.
    """

    called: str
    given: frozenset[str]
    result: frozenset[str]
    is_lazy: bool
    does: Effects


def functions_of(node: ast.AST) -> Iterator[Function]:
    """The functions that a node defines, methods of a class among them; a class is called by its `__init__`."""
    match node:
        case ast.FunctionDef(name=name, args=given, body=body):
            yield _function(name, given, body)
        case ast.Assign(targets=[ast.Name(id=name)], value=ast.Lambda(args=given, body=value)):
            yield _function(name, given, [ast.Return(value)])
        case ast.ClassDef(name=name, body=statements, bases=bases):
            methods = [method for method in statements if isinstance(method, ast.FunctionDef)]
            yield from (_function(_called(method, name), method.args, method.body, name) for method in methods)
            for base in filter(None, map(root, bases)):
                call = Call(base, (base,), base, frozenset(), frozenset({"self"}))
                does = Effects((), (), frozenset(), frozenset(), (call,))
                yield Function(name, frozenset({"self"}), frozenset({"self"}), False, does)


def _called(method: ast.FunctionDef, of: str) -> str:
    if method.name in _MAKING:
        return of
    return OPERATOR if method.name.startswith("__") else f".{method.name}"


def _function(called: str, given: ast.arguments, body: list[ast.stmt], of: str = "") -> Function:
    every = [*given.posonlyargs, *given.args, *given.kwonlyargs, *filter(None, (given.vararg, given.kwarg))]
    nodes = [node for statement in body for node in ast.walk(statement)]
    made = every[0].arg if called == of and every else ""
    results = [node.value for node in nodes if isinstance(node, ast.Return | ast.Yield | ast.YieldFrom) and node.value]
    result = frozenset({made} - {""}).union(*map(shared, results))
    is_lazy = any(isinstance(node, ast.Yield | ast.YieldFrom) for node in nodes)
    does = effects(nodes, (), made)
    return Function(called, frozenset(each.arg for each in every), result, is_lazy, does)


def effects(nodes: Iterable[ast.AST], statements: Iterable[ast.stmt], made: str = "") -> Effects:
    """What the nodes of some statements do. made: an object in the making, to which attributes may be given."""
    nodes = list(nodes)
    found, stores, changes, operated, calls = list[Binding](), list[Binding](), set[str](), set[str](), list[Call]()
    functions = {id(node.func) for node in nodes if isinstance(node, ast.Call)}
    within: dict[int, set[str]] = {}
    for node in nodes:
        if isinstance(node, ast.Call) and (start := root(node)):
            for inner in (inner for each in arguments(node) for inner in ast.walk(each)):
                if isinstance(inner, ast.Call | ast.Attribute):
                    within.setdefault(id(inner), set()).add(start)
    for node in nodes:
        found += bindings(node)
        stores += bindings(node, stored=True)
        changes.update(_changed(node, made))
        if isinstance(node, _OPERATED):
            operated |= names_at(node)
        if isinstance(node, ast.Call):
            calls.append(call := _call(node, within.get(id(node), ())))
            if isinstance(node.func, ast.Attribute) and node.func.attr in CHANGING_METHODS:
                stores += (binding(name, each) for name in call.receiver for each in arguments(node))
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Load) and id(node) not in functions:
            calls.append(
                Call(
                    f".{node.attr}",
                    (),
                    root(node),
                    shared(node.value),
                    roots=frozenset(within.get(id(node), ())),
                    is_lookup=True,
                )
            )
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            names = frozenset(names_in(node))
            found.append(Binding(node.name, frozenset(), False, names))
            calls += _applied(node)
    for each in statements:
        if isinstance(each, ast.Expr) and isinstance(each.value, ast.Call):
            calls.append(_call(each.value, is_statement=True))
    local = frozenset(name for node in nodes for name in _bound(node))
    return Effects(tuple(found), tuple(stores), frozenset(changes), frozenset(operated), tuple(calls), local)


def _bound(node: ast.AST) -> Iterator[str]:
    """The names that a node binds, parameters and what a pattern or a handler names among them."""
    match node:
        case ast.Name(id=name, ctx=ast.Store()) | ast.arg(arg=name) | ast.ExceptHandler(name=str() as name):
            yield name
        case ast.MatchAs(name=str() as name) | ast.MatchStar(name=str() as name) | ast.MatchMapping(rest=str() as name):
            yield name
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            yield name
        case ast.Lambda(args=given):
            yield from (each.arg for each in ast.walk(given) if isinstance(each, ast.arg))
        case ast.Import(names=several) | ast.ImportFrom(names=several):
            yield from (each.asname or each.name.partition(".")[0] for each in several)


def names_at(node: ast.AST) -> frozenset[str]:
    """Names that share what an operator, a bracket, a loop or a `with` is applied to."""
    match node:
        case ast.For(iter=value) | ast.comprehension(iter=value) | ast.withitem(context_expr=value):
            return shared(value)
    return frozenset().union(*(shared(each) for each in ast.iter_child_nodes(node) if isinstance(each, ast.expr)))


def _changed(node: ast.AST, made: str) -> Iterator[str]:
    """Names whose object a node changes: `table[i] = …`, `f.limit = …`, `del table[i]`, `table += …`."""
    match node:
        case ast.Attribute(value=ast.Name(id=name), ctx=ast.Store()) if name == made:
            return
        case ast.Subscript(value=value, ctx=ast.Store() | ast.Del()):
            yield from shared(value)
        case ast.Attribute(value=value, ctx=ast.Store() | ast.Del()):
            yield from shared(value)
        case ast.AugAssign(target=ast.Name(id=name)) | ast.Name(id=name, ctx=ast.Del()):
            yield name
        case ast.Global(names=names):
            yield from names
        case ast.ClassDef(bases=bases):
            yield from map(root, bases)  # they may note what is derived from them


def _applied(node: ast.FunctionDef | ast.ClassDef) -> Iterator[Call]:
    """The decorators of a function or a class, and the classes that make it or that it is derived from, as calls.

    `@f.register` changes f.
    """
    keywords = [each.value for each in getattr(node, "keywords", [])]
    for each in (*node.decorator_list, *getattr(node, "bases", []), *keywords):
        function = each.func if isinstance(each, ast.Call) else each
        call = ast.Call(function, [ast.Name(node.name, ast.Load())], [])
        yield replace(_call(call, is_statement=isinstance(function, ast.Attribute)), is_lookup=True)


def _call(node: ast.Call, within: Iterable[str] = (), is_statement: bool = False) -> Call:
    """A call. within: what the calls around it begin with. is_statement: whether it may change even a module."""
    every = arguments(node)
    receiver = shared(node.func.value if isinstance(node.func, ast.Attribute) else node.func)
    path: list[str] = []
    function: ast.AST = node.func
    while isinstance(function, ast.Attribute):
        path.append(function.attr)
        function = function.value
    path = [*path, function.id] if isinstance(function, ast.Name) else []
    return Call(
        called_as(node),
        tuple(reversed(path)),
        root(node.func),
        receiver,
        frozenset().union(*map(shared, every)),
        frozenset((*map(root, every), *within)) - {""},
        frozenset(each.arg for each in node.keywords if each.arg),
        is_statement=is_statement,
    )
