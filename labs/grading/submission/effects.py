"""Finds in the syntax tree what statements may do to objects: share them, change them, or pass them on to a function.

`B = A` shares, `A[0] = 1`, `A.append(1)` and `np.add(A, 1, out=A)` change, and `fill(A)` passes on. A tree does not say
what the objects are, so where it is not clear, a statement counts as one that may change them.
"""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from labs.grading.submission.sharing import Binding, arguments, bindings, root, shared

CHANGING_METHODS = {
    "add", "append", "appendleft", "clear", "difference_update", "discard", "extend", "extendleft", "fill", "insert",
    "intersection_update", "partition", "pop", "popitem", "popleft", "put", "remove", "resize", "reverse", "rotate",
    "setdefault", "setfield", "setflags", "sort", "symmetric_difference_update", "update",
    "__delitem__", "__iadd__", "__imul__", "__ior__", "__setitem__",
}  # fmt: skip
"""What changes a list, a set, a table, a queue or an array in place, and also gives a value that may be used."""
_CHANGING_BUILTINS = {"setattr", "delattr", "next"}  # of the first argument
_SHOWING = "print"
ANY = "*"
"""Stands for whichever parameter an argument is bound to."""


@dataclass(frozen=True)
class Call:
    """A call. name: of the function or method. root: the name that the expression begins with, empty if none.

    receiver: names that share the object of a method; None for a function. given: names that share each argument, by
    position or keyword, None for one with a star. for_effect: whether nothing is done with the value.
    """

    name: str
    root: str
    receiver: frozenset[str] | None
    given: tuple[tuple[int | str | None, frozenset[str]], ...]
    for_effect: bool


@dataclass(frozen=True)
class Effects:
    """What some statements may do to objects.

    changes: names whose objects they change, be these modules or functions. mutates: those that they change unless it
    is a module or a function.
    """

    bindings: tuple[Binding, ...]
    changes: frozenset[str]
    mutates: frozenset[str]
    calls: tuple[Call, ...]


@dataclass(frozen=True, eq=False)
class Function:
    """A function or a method. called: its name, with a dot before that of a method.

    itself: the parameter of a method that is the object that it is called on. places: its other parameters in order.
    named: those that take a keyword. rest: the names of `*rest` and `**rest`. does: what its statements may do.
    """

    called: str
    itself: str
    places: tuple[str, ...]
    named: frozenset[str]
    rest: tuple[str, ...]
    does: Effects

    def bound_to(self, place: int | str | None) -> tuple[str, ...]:
        """The parameters that an argument in some place may be bound to; None is one with a star."""
        if isinstance(place, int) and place < len(self.places):
            return (self.places[place],)
        if isinstance(place, str) and place in self.named:
            return (place,)
        return self.rest if place is not None else (ANY,)

    @property
    def parameters(self) -> Iterator[str]:
        """All of its parameters, without the object that a method is called on."""
        yield from (*self.places, *self.named, *self.rest)


def functions_of(node: ast.AST) -> Iterator[Function]:
    """The functions that a node defines, methods of a class among them; a class is called by its `__init__`."""
    match node:
        case ast.FunctionDef(name=name, args=given, body=body):
            yield _function(name, given, body)
        case ast.Assign(targets=[ast.Name(id=name)], value=ast.Lambda(args=given, body=value)):
            yield _function(name, given, [ast.Expr(value)])
        case ast.ClassDef(name=name, body=statements):
            for method in statements:
                if isinstance(method, ast.FunctionDef):
                    called = name if method.name == "__init__" else f".{method.name}"
                    yield _function(called, method.args, method.body, 1)


def _function(called: str, given: ast.arguments, body: list[ast.stmt], skipped: int = 0) -> Function:
    places = [each.arg for each in (*given.posonlyargs, *given.args)]
    rest = tuple(each.arg for each in (given.vararg, given.kwarg) if each)
    named = frozenset(each.arg for each in (*given.args, *given.kwonlyargs))
    does = effects((node for statement in body for node in ast.walk(statement)), ())
    return Function(called, "".join(places[:skipped]), tuple(places[skipped:]), named, rest, does)


def effects(nodes: Iterable[ast.AST], statements: Iterable[ast.stmt]) -> Effects:
    """What the nodes of some statements may do. A module is changed only by one of the statements themselves."""
    nodes = list(nodes)
    unused = {id(call) for node in nodes for call in _calls_for_effect(node)}
    found, changes, mutates, calls = list[Binding](), set[str](), set[str](), list[Call]()
    for node in nodes:
        found += bindings(node)
        changes.update(_changed(node))
        if isinstance(node, ast.Attribute) and node.attr in CHANGING_METHODS:
            mutates |= shared(node.value)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Del):
            mutates.add(node.id)
        elif isinstance(node, ast.Call):
            calls.append(call := _call(node, id(node) in unused))
            mutates |= (call.for_effect and call.receiver) or set()
            mutates.update(name for each in node.keywords if each.arg == "out" for name in shared(each.value))
            if _changes_first(call) and node.args:
                changes |= shared(node.args[0])
            if isinstance(node.func, ast.Lambda):
                mutates.update(name for _, names in call.given for name in names)
    for each in statements:
        if (
            isinstance(each, ast.Expr)
            and isinstance(each.value, ast.Call)
            and not isinstance(each.value.func, ast.Name)
        ):
            changes.add(root(each.value.func))
    return Effects(tuple(found), frozenset(changes), frozenset(mutates), tuple(calls))


def _changed(node: ast.AST) -> Iterator[str]:
    """Names whose object a node changes: `table[i] = …`, `f.limit = …`, `del table[i]`, `table += …`.

    A decorator such as `@f.register` changes f, and a class may be noted in those that it is derived from.
    """
    match node:
        case ast.Subscript(value=value, ctx=ast.Store() | ast.Del()):
            yield from shared(value)
        case ast.Attribute(value=value, ctx=ast.Store() | ast.Del()):
            yield from shared(value)
        case ast.AugAssign(target=ast.Name(id=name)):
            yield name
        case ast.Global(names=names):
            yield from names
        case ast.FunctionDef(decorator_list=decorators) | ast.ClassDef(decorator_list=decorators):
            yield from (root(each) for each in decorators if isinstance(_undecorated(each), ast.Attribute))
            yield from (root(base) for base in getattr(node, "bases", []))


def _undecorated(decorator: ast.expr) -> ast.expr:
    return decorator.func if isinstance(decorator, ast.Call) else decorator


def _call(node: ast.Call, for_effect: bool) -> Call:
    receiver = shared(node.func.value) if isinstance(node.func, ast.Attribute) else None
    name = getattr(node.func, "attr", getattr(node.func, "id", ""))
    given: list[tuple[int | str | None, frozenset[str]]] = []
    for place, each in enumerate(node.args):
        given.append((None if isinstance(each, ast.Starred) else place, shared(each)))
    given += ((each.arg, shared(each.value)) for each in node.keywords)
    return Call(name, root(node.func), receiver, tuple(each for each in given if each[1]), for_effect)


def _changes_first(call: Call) -> bool:
    """Whether a call changes what it is given first, as `setattr(f, …)` and `dict.update(table, …)` do."""
    if call.receiver is None:
        return call.name in _CHANGING_BUILTINS
    return call.name in CHANGING_METHODS and hasattr(builtins, call.root)


def _calls_for_effect(node: ast.AST) -> Iterator[ast.Call]:
    """The calls of a statement that does nothing with their values, also one for each item: `[fill(row) for row in A]`.

    What is given to a function of Python's own, other than print, counts as well: `list(map(A.append, B))`.
    """
    match node:
        case ast.Expr(value=value) | ast.Assign(targets=[ast.Name(id="_")], value=value):
            waiting: list[ast.AST] = [value]
        case _:
            return
    while waiting:
        match waiting.pop():
            case ast.Call(func=function) as call:
                yield call
                name = function.id if isinstance(function, ast.Name) else ""
                if name != _SHOWING:
                    every = arguments(call)
                    waiting += (each for each in every if hasattr(builtins, name) or isinstance(each, ast.GeneratorExp))
            case ast.ListComp(elt=value) | ast.SetComp(elt=value) | ast.GeneratorExp(elt=value):
                waiting.append(value)
            case ast.DictComp(value=value) | ast.NamedExpr(value=value) | ast.Starred(value=value):
                waiting.append(value)
            case ast.IfExp(body=one, orelse=other):
                waiting += [one, other]
            case ast.BoolOp(values=several) | ast.Tuple(elts=several) | ast.List(elts=several):
                waiting += several
            case ast.Lambda(body=value):
                waiting.append(value)
