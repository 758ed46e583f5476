"""Takes a source apart into the statements of its top level, and says which names each has to do with, and how."""

from __future__ import annotations

import ast
import functools
import re
import symtable
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from labs.grading.submission.effects import Effects, Function, effects, functions_of

STATEMENT_LIMIT = 20_000
"""The most statements at the top level of a source."""
HUGE = "this number has more than 4300 digits, and Python cannot write it: give it as a power or a float"
_LARGEST, _LONG_NUMBER = 10**4300, 3000  # an int, and the letters of a shorter one in base 16
_WORD = re.compile(r"\w+")
_MOST_SCOPES = 200
_DYNAMIC = {"exec", "eval", "globals"}  # they may bind any name
_SCOPE = {"vars", "locals"}  # so do these without an argument
_COMPOUND = ast.For | ast.AsyncFor | ast.While | ast.If | ast.With | ast.AsyncWith | ast.Try | ast.TryStar | ast.Match
_SCOPES = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda


@dataclass(frozen=True)
class Group:
    """Statements that share lines, and so are kept or left out together. first, last: their lines, from 1.

    kinds: how each name that they bind is bound. modules: where each name that they import comes from. uses: names that
    they look up. inner: those that only their functions and classes look up. functions: that they define. does: what
    they may do to objects. is_compound: whether they hold other statements,
    as a loop does. is_dynamic: whether they may bind any name.
    """

    first: int
    last: int
    statements: tuple[ast.stmt, ...]
    kinds: Mapping[str, str]
    modules: Mapping[str, str]
    uses: frozenset[str]
    inner: frozenset[str]
    functions: tuple[Function, ...]
    does: Effects
    is_compound: bool
    is_dynamic: bool

    @functools.cached_property
    def constants(self) -> frozenset[str]:
        """The names that they bind to what nothing can change."""
        bindings = self.does.bindings
        other = {each.name for each in bindings if not each.is_constant} | self.does.changes
        return frozenset(each.name for each in bindings if each.is_constant) - other

    @functools.cached_property
    def defines(self) -> frozenset[str]:
        """The names that they bind."""
        return frozenset(self.kinds)


@functools.lru_cache(maxsize=64)  # a file is read for its topics, for its tests, and for what its functions use
def groups(source: str) -> tuple[Group, ...]:
    """The source's top-level statements; raises SyntaxError, ValueError, RecursionError or MemoryError."""
    tree = ast.parse(source)
    _refuse_what_no_person_writes(tree, source)
    scopes: dict[int, list[symtable.SymbolTable]] = {}
    for scope in symtable.symtable(source, "submission", "exec").get_children():
        scopes.setdefault(scope.get_lineno(), []).append(scope)
    found: list[list[ast.stmt]] = []
    for statement in tree.body:
        if found and _first(statement) <= (found[-1][-1].end_lineno or 0):
            found[-1].append(statement)
        else:
            found.append([statement])
    return tuple(_group(statements, scopes) for statements in found)


def _refuse_what_no_person_writes(tree: ast.Module, source: str) -> None:
    """Raise a SyntaxError for too many statements, and for a number that Python reads and cannot write."""
    if len(tree.body) > STATEMENT_LIMIT:
        raise SyntaxError(
            f"{STATEMENT_LIMIT} statements outside of functions end here, and no more are read",
            ("submission", tree.body[STATEMENT_LIMIT].lineno, 0, ""),
        )
    if max(map(len, _WORD.findall(source)), default=0) > _LONG_NUMBER:
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, int) and node.value > _LARGEST:
                raise SyntaxError(HUGE, ("submission", node.lineno, 0, ""))


def defined_as(group: Group, name: str) -> str | None:
    """How a group binds a name: "def", "class", "import" or "value"; None if it does not."""
    return group.kinds.get(name)


def called_in(group: Group) -> set[str]:
    """The names that a group's statements call, also within their functions."""
    return {name for each in group.statements for node in ast.walk(each) for name in _called(node)}


def _group(statements: list[ast.stmt], scopes: Mapping[int, list[symtable.SymbolTable]]) -> Group:
    first, last = _first(statements[0]), statements[-1].end_lineno or statements[-1].lineno
    nodes = [list(_outside_scopes(statement)) for statement in statements]
    every = [node for each in nodes for node in each]
    # The last statement counts, and within it the outermost binding, which comes first.
    kinds = dict(found for each in nodes for node in reversed(each) for found in _bindings(node))
    inner = {name for line in range(first, last + 1) for scope in scopes.get(line, []) for name in _looked_up(scope)}
    outer = {node.id for node in every if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Store)}
    outer |= {node.target.id for node in every if isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name)}
    outer |= {name for node in every for name in _read_by_decorators(node)}
    is_dynamic = any(map(_binds_anything, every))
    texts = (node.value for node in every if is_dynamic and isinstance(node, ast.Constant))
    written = {name for text in texts if isinstance(text, str) for name in _WORD.findall(text)}
    run = [*every, *_within_lambdas(every), *_within_classes(every)]
    return Group(
        first,
        last,
        tuple(statements),
        kinds,
        modules=dict(found for node in every for found in _imports(node)),
        uses=frozenset(inner | outer | written),
        inner=frozenset(inner),
        functions=tuple(function for node in every for function in functions_of(node)),
        does=effects(run, statements),
        is_compound=any(isinstance(each, _COMPOUND) for each in statements),
        is_dynamic=is_dynamic,
    )


def _read_by_decorators(node: ast.AST) -> Iterator[str]:
    """The names in the type hints of a decorated function: its decorator may look them up, as `domain` does.

    So it is for the methods of a class.
    """
    if isinstance(node, ast.ClassDef):
        for method in node.body:
            yield from _read_by_decorators(method)
    if isinstance(node, ast.FunctionDef) and node.decorator_list:
        given = node.args
        arguments = [*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg]
        for hint in (node.returns, *(each.annotation for each in arguments if each)):
            yield from (each.id for each in (ast.walk(hint) if hint else ()) if isinstance(each, ast.Name))


def _first(statement: ast.stmt) -> int:
    decorators: list[ast.expr] = getattr(statement, "decorator_list", [])
    return min([statement.lineno, *(each.lineno for each in decorators)])


def _outside_scopes(statement: ast.stmt) -> Iterator[ast.AST]:
    """The statement's nodes, those within functions, classes and comprehensions left out; decorators stay."""
    waiting: list[ast.AST] = [statement]
    while waiting:
        node = waiting.pop()
        yield node
        if isinstance(node, _SCOPES):
            waiting.extend(_evaluated_outside(node))
        else:
            waiting.extend(ast.iter_child_nodes(node))


def _within_lambdas(nodes: Iterable[ast.AST]) -> Iterator[ast.AST]:
    return (inner for node in nodes if isinstance(node, ast.Lambda) for inner in ast.walk(node.body))


def _within_classes(nodes: Iterable[ast.AST]) -> Iterator[ast.AST]:
    """What is run at the definition of a class, which is its body without those of its methods."""
    classes = (node for node in nodes if isinstance(node, ast.ClassDef))
    return (inner for each in classes for statement in each.body for inner in _outside_scopes(statement))


def _evaluated_outside(scope: ast.AST) -> Iterator[ast.AST]:
    """The parts of a function or class that are evaluated at its definition: decorators, defaults, bases."""
    yield from getattr(scope, "decorator_list", [])
    yield from getattr(scope, "bases", [])
    if isinstance(arguments := getattr(scope, "args", None), ast.arguments):
        yield from (each for each in (*arguments.defaults, *arguments.kw_defaults) if each is not None)


def _looked_up(scope: symtable.SymbolTable) -> Iterator[str]:
    """The global names that a scope and those within it look up.

    `get_symbols` takes as many steps as a scope has names, times the scopes within it. So a function is asked for its
    global names at once, and all names of a class that has more scopes in it than anybody writes count as looked up.
    """
    if isinstance(scope, symtable.Function):
        yield from scope.get_globals()
    elif len(scope.get_children()) > _MOST_SCOPES:
        yield from scope.get_identifiers()
    else:
        yield from (symbol.get_name() for symbol in scope.get_symbols() if symbol.is_global())
    for child in scope.get_children():
        yield from _looked_up(child)


def _bindings(node: ast.AST) -> Iterator[tuple[str, str]]:
    """The name that a node binds, if it binds one, and how."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
        yield node.name, "def"
    elif isinstance(node, ast.ClassDef):
        yield node.name, "class"
    elif isinstance(node, ast.alias):
        yield _bound(node), "import"
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
        yield node.id, "value"


def _imports(node: ast.AST) -> Iterator[tuple[str, str]]:
    """The names that an import binds, each with where it comes from, as numpy.linalg."""
    if isinstance(node, ast.Import):
        yield from ((_bound(alias), alias.name if alias.asname else _bound(alias)) for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        yield from ((_bound(alias), f"{node.module or ''}.{alias.name}") for alias in node.names)


def _called(node: ast.AST) -> Iterator[str]:
    """The name that a node calls, or those that decorate it."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        yield node.func.id
    yield from (each.id for each in getattr(node, "decorator_list", []) if isinstance(each, ast.Name))


def _binds_anything(node: ast.AST) -> bool:
    """Whether a node may bind any name: `from math import *`, `exec(…)`, `globals()[name] = …`."""
    if isinstance(node, ast.ImportFrom):
        return node.names[0].name == "*"
    if isinstance(node, ast.Subscript):  # sys.modules[__name__]
        return isinstance(node.slice, ast.Name) and node.slice.id == "__name__"
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
        return False
    return node.func.id in _DYNAMIC or (node.func.id in _SCOPE and not node.args)


def _bound(alias: ast.alias) -> str:
    return alias.asname or alias.name.partition(".")[0]
