"""Finds the statements of a submission that its functions need, from the names in the syntax tree.

A function needs the statements that define the names which it looks up outside itself, and these need others in turn.
All other statements only plot, print, check or animate. They are left out, so that they can neither fail nor cost time,
while a line number still means the line that the student sees.
"""

from __future__ import annotations

import ast
import symtable
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

_SCOPES = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda


@dataclass(frozen=True)
class Group:
    """Statements that share lines, and so are kept or left out together. first, last: their lines, from 1.

    defines: names that they bind. touches: names whose objects they change. uses: names that they look up.
    """

    first: int
    last: int
    statements: tuple[ast.stmt, ...]
    defines: frozenset[str]
    touches: frozenset[str]
    uses: frozenset[str]


def groups(source: str) -> list[Group]:
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
    return [_group(statements, scopes) for statements in found]


def needed(every: list[Group], wanted: Collection[str]) -> set[int]:
    """The numbers of the groups that the wanted names need."""
    concerned: dict[str, list[int]] = {}
    for at, group in enumerate(every):
        for name in group.defines | group.touches:
            concerned.setdefault(name, []).append(at)
    kept = {at for at, group in enumerate(every) if _is_star(group)}
    waiting, seen = list(wanted), set(wanted)
    while waiting:
        for at in concerned.get(waiting.pop(), []):
            if at not in kept:
                kept.add(at)
                waiting.extend(every[at].uses - seen)
                seen |= every[at].uses
    return kept


def used_by(every: list[Group], name: str, among: Collection[str]) -> list[str]:
    """Which of some names a name needs, directly or through names that are not among them; in their order."""
    waiting, seen = [name], {name}
    while waiting:
        each = waiting.pop()
        if each != name and each in among:
            continue
        found = {used for group in every if each in group.defines for used in group.uses} - seen
        seen |= found
        waiting.extend(found)
    return [other for other in among if other in seen and other != name]


def defined_as(group: Group, name: str) -> str | None:
    """How a group binds a name: "def", "class", "import" or "value"; None if it does not."""
    for statement in reversed(group.statements) if name in group.defines else ():
        for node in _outside_scopes(statement):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name == name:
                return "def"
            if isinstance(node, ast.ClassDef) and node.name == name:
                return "class"
            if isinstance(node, ast.alias) and _bound(node) == name:
                return "import"
            if isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, ast.Store):
                return "value"
    return None


def _group(statements: list[ast.stmt], scopes: Mapping[int, list[symtable.SymbolTable]]) -> Group:
    first, last = _first(statements[0]), statements[-1].end_lineno or statements[-1].lineno
    nodes = [node for statement in statements for node in _outside_scopes(statement)]
    inner = {name for line in range(first, last + 1) for scope in scopes.get(line, []) for name in _looked_up(scope)}
    outer = {node.id for node in nodes if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Store)}
    return Group(
        first,
        last,
        tuple(statements),
        frozenset(_defined(nodes)),
        frozenset(name for statement in statements for name in _touched(statement)),
        frozenset(inner | outer),
    )


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
    """The global names that a scope and those within it look up."""
    for symbol in scope.get_symbols():
        if symbol.is_global():
            yield symbol.get_name()
    for child in scope.get_children():
        yield from _looked_up(child)


def _defined(nodes: Iterable[ast.AST]) -> Iterator[str]:
    for node in nodes:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.alias):
            yield _bound(node)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def _touched(statement: ast.stmt) -> Iterator[str]:
    """Names whose object a statement changes in place: `table[i] = …`, `table.append(…)`, `f.limit = …`."""
    targets: list[ast.expr] = []
    if isinstance(statement, ast.Assign):
        targets = statement.targets
    elif isinstance(statement, ast.AugAssign):
        targets = [statement.target]
    elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
        targets = [statement.value.func]
    for target in targets:
        root: ast.expr = target
        while isinstance(root, ast.Attribute | ast.Subscript):
            root = root.value
        if isinstance(root, ast.Name) and root is not target:
            yield root.id


def _is_star(group: Group) -> bool:
    return any(
        isinstance(statement, ast.ImportFrom) and statement.names[0].name == "*" for statement in group.statements
    )


def _bound(alias: ast.alias) -> str:
    return alias.asname or alias.name.partition(".")[0]
