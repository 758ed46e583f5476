"""Finds the statements of a submission that its functions need, from the names in the syntax tree.

A function needs the statements that define the names which it looks up outside itself, and those that change what these
names stand for; these need others in turn. All other statements only plot, print, check or animate. They are left out,
so that they can neither fail nor cost time, while a line number still means the line that the student sees.
"""

from __future__ import annotations

import ast
import functools
import symtable
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

_MOST_SCOPES = 200
_SCOPES = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda


@dataclass(frozen=True)
class Group:
    """Statements that share lines, and so are kept or left out together. first, last: their lines, from 1.

    kinds: how each name that they bind is bound. touches: names whose objects they change. uses: names that they look
    up. calls: names that they call at once, decorators among them. changes: names that functions defined here change
    when they are called.
    """

    first: int
    last: int
    statements: tuple[ast.stmt, ...]
    kinds: Mapping[str, str]
    touches: frozenset[str]
    uses: frozenset[str]
    calls: frozenset[str]
    changes: frozenset[str]

    @functools.cached_property
    def concerns(self) -> frozenset[str]:
        """The names that they bind, or whose objects they change."""
        return self.defines | self.touches

    @property
    def has_function(self) -> bool:
        """Whether one of them is a function."""
        return any(isinstance(each, ast.FunctionDef) for each in self.statements)

    @functools.cached_property
    def defines(self) -> frozenset[str]:
        """The names that they bind."""
        return frozenset(self.kinds)


@functools.lru_cache(maxsize=64)  # a file is read for its topics, for its tests, and for what its functions use
def groups(source: str) -> tuple[Group, ...]:
    """The source's top-level statements; raises SyntaxError, ValueError, RecursionError or MemoryError."""
    tree = ast.parse(source)
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


def needed(every: Sequence[Group], wanted: Collection[str]) -> set[int]:
    """The numbers of the groups that the wanted names need.

    A function that a needed function calls changes what it changes whenever that happens. But one that none of them
    calls, such as a decorator that fills a table, counts through the statements that call it.
    """
    concerned, calling, changing, using = (_places(every, kind) for kind in ("concerns", "calls", "changes", "uses"))
    imported = {name for group in every for name, kind in group.kinds.items() if kind == "import"}
    kept = {at for at, group in enumerate(every) if _is_star(group)}
    seen, active = set(wanted), set[str]()
    names, functions = list(wanted), list[str]()
    while names or functions:
        if names:
            name = names.pop()
            new = concerned.get(name, [])
            if name not in imported:  # nobody changes NumPy by a call of it
                functions += (each for at in changing.get(name, []) for each in every[at].defines)
        elif (function := functions.pop()) in active or function in seen:
            continue
        else:
            active.add(function)
            new = calling.get(function, [])
            functions += (
                each for at in using.get(function, []) if every[at].has_function for each in every[at].defines
            )
        for at in new:
            if at not in kept:
                kept.add(at)
                names += every[at].uses - seen
                seen |= every[at].uses
    return kept


def _places(every: Sequence[Group], kind: str) -> dict[str, list[int]]:
    """The numbers of the groups that have to do with a name in some way."""
    found: dict[str, list[int]] = {}
    for at, group in enumerate(every):
        for name in getattr(group, kind):
            found.setdefault(name, []).append(at)
    return found


def used_by(every: Sequence[Group], name: str, among: Collection[str]) -> list[str]:
    """Which of some names a name needs, directly or through names that are not among them; in their order."""
    used: dict[str, list[frozenset[str]]] = {}
    for group in every:
        for each in group.defines:
            used.setdefault(each, []).append(group.uses)
    waiting, seen, ends = [name], {name}, set(among) - {name}
    while waiting:
        each = waiting.pop()
        for names in used.pop(each, []) if each not in ends else []:
            found = names - seen
            seen |= found
            waiting.extend(found)
    return [other for other in among if other in seen and other != name]


def defined_as(group: Group, name: str) -> str | None:
    """How a group binds a name: "def", "class", "import" or "value"; None if it does not."""
    return group.kinds.get(name)


def called_in(group: Group) -> set[str]:
    """The names that a group's statements call, also within their functions."""
    return {name for each in group.statements for node in ast.walk(each) for name in _called(node)}


def _group(statements: list[ast.stmt], scopes: Mapping[int, list[symtable.SymbolTable]]) -> Group:
    first, last = _first(statements[0]), statements[-1].end_lineno or statements[-1].lineno
    nodes = [list(_outside_scopes(statement)) for statement in statements]
    # The last statement counts, and within it the outermost binding, which comes first.
    kinds = dict(found for each in nodes for node in reversed(each) for found in _bindings(node))
    inner = {name for line in range(first, last + 1) for scope in scopes.get(line, []) for name in _looked_up(scope)}
    loaded = (node for each in nodes for node in each if isinstance(node, ast.Name))
    outer = {node.id for node in loaded if not isinstance(node.ctx, ast.Store)}
    touched = frozenset(name for statement in statements for name in _touched(statement))
    calls = frozenset(name for each in nodes for node in each for name in _called(node))
    changes = frozenset(name for each in statements if isinstance(each, ast.FunctionDef) for name in _changed(each))
    return Group(first, last, tuple(statements), kinds, touched, frozenset(inner | outer), calls, changes & inner)


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


def _touched(statement: ast.AST) -> Iterator[str]:
    """Names whose object a statement changes in place: `table[i] = …`, `table.append(…)`, `f.limit = …`.

    A decorator such as `@f.register` changes f, and a class may be noted in those that it is derived from.
    """
    targets: list[ast.expr] = []
    if isinstance(statement, ast.Assign):
        targets = statement.targets
    elif isinstance(statement, ast.AugAssign):
        targets = [statement.target]
    elif isinstance(statement, ast.Expr) and isinstance(call := statement.value, ast.Call):
        if isinstance(call.func, ast.Name) and call.func.id == "setattr" and call.args:
            yield from _root(call.args[0])
        targets = [call.func]
    elif isinstance(statement, ast.FunctionDef | ast.ClassDef):
        targets = [each.func if isinstance(each, ast.Call) else each for each in statement.decorator_list]
        for base in getattr(statement, "bases", []):
            yield from _root(base)
    for target in targets:
        if not isinstance(target, ast.Name):
            yield from _root(target)


def _root(expression: ast.expr) -> Iterator[str]:
    """The name that an expression begins with, as `table` in `table.rows[0]`, if it begins with one."""
    while isinstance(expression, ast.Attribute | ast.Subscript):
        expression = expression.value
    if isinstance(expression, ast.Name):
        yield expression.id


def _called(node: ast.AST) -> Iterator[str]:
    """The name that a node calls, or those that decorate it."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        yield node.func.id
    for decorator in getattr(node, "decorator_list", []):
        if isinstance(decorator, ast.Name):
            yield decorator.id


def _changed(function: ast.FunctionDef) -> Iterator[str]:
    """Names outside a function that a call of it may change: it declares them global, or changes their objects."""
    for node in ast.walk(function):
        if isinstance(node, ast.Global):
            yield from node.names
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            yield from _root(node.func)
        elif node is not function:
            yield from _touched(node)


def _is_star(group: Group) -> bool:
    return any(
        isinstance(statement, ast.ImportFrom) and statement.names[0].name == "*" for statement in group.statements
    )


def _bound(alias: ast.alias) -> str:
    return alias.asname or alias.name.partition(".")[0]
