"""Runs the text of a submission: what fails costs the names that it would have defined, and nothing else.

A table may be filled in a loop that also plots, and there is no library for plots here. So if a statement in a loop or
a branch fails, the next one is run. Nothing is different for code that does not fail: the bodies of `try` and `with`,
which may expect an exception, are left alone.

Before each statement of the top level that may take long, the grader is told its line. If the statement never ends, or
ends the process, the grader can do without it.
"""

from __future__ import annotations
import __future__

import ast
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from types import CodeType, ModuleType

from labs.grading.worker.raised import TITLE, described, place

Failure = tuple[list[str], str, str, int | None]
"""The names that a statement would have defined ("" for all), the exception's type and message, and its line."""
_FLAGS = __future__.annotations.compiler_flag  # a type hint that cannot be evaluated costs nothing
_BEGINS, _FAILED, _ERROR = "its line", "its failure", "an exception"  # no names that a submission can write
_SIMPLE = ast.Expr | ast.Assign | ast.AnnAssign | ast.AugAssign | ast.Delete | ast.Assert | ast.Import | ast.ImportFrom
_LONG = ast.Call | ast.For | ast.While | ast.comprehension | ast.Pow
MOST_TOLD = 200
"""Before so many statements the grader is told their lines."""
_MOST_FAILURES = 10_000
"""After so many failures within loops, a failure ends its loop, which might never end otherwise."""
_MOST_NOTED = 20


@dataclass
class _Inner:
    """The failures of statements in loops and branches. noted: of each line the first one. count: of all."""

    noted: dict[int, Failure] = field(default_factory=dict)
    count: int = 0

    def add(self, line: int, *names: str) -> None:
        """Note the exception that is being handled; raise it again if it ends the loop.

        names: those that the statement would have defined.
        """
        error = sys.exc_info()[1]
        assert error is not None
        self.count += 1
        if isinstance(error, StopIteration) or self.count > _MOST_FAILURES:
            raise error
        if line not in self.noted and len(self.noted) < _MOST_NOTED:
            kind, message, _ = described(error)
            self.noted[line] = [*names], kind, message, line


def compiled(text: str) -> CodeType | None:
    """The code of the text; None if Python cannot read all of it."""
    try:
        code: CodeType = compile(_prepared(ast.parse(text, TITLE)), TITLE, "exec", _FLAGS, dont_inherit=True)
    except Exception:
        return None
    return code


def load(
    text: str, module: ModuleType, code: CodeType | None, begins: Callable[[int | None], object]
) -> tuple[list[Failure], list[Failure]]:
    """Run the code of the text in the module; a statement that fails costs only the names that it defines.

    Without code, because Python cannot read all of the text, each statement is run alone. begins: is told the line of
    a statement before it is run, and None when there have been too many. Returns the failures of statements, and those
    within loops and branches.
    """
    inner, told = _Inner(), 0

    def tell(line: int) -> None:
        nonlocal told
        told += 1
        if told <= MOST_TOLD:
            begins(line if told < MOST_TOLD else None)

    sys.modules[module.__name__] = module  # as any import does; a dataclass looks itself up there
    names = vars(module)
    names.update({_BEGINS: tell, _FAILED: inner.add, _ERROR: Exception})
    try:
        failures = _run(text, module, code)
    finally:
        for name in (_BEGINS, _FAILED, _ERROR):
            names.pop(name, None)
    return failures, [*inner.noted.values()]


def _run(text: str, module: ModuleType, code: CodeType | None) -> list[Failure]:
    if code is None:
        return _run_rest(text, module)
    try:
        exec(code, module.__dict__)
    except BaseException as error:
        return _run_rest(text, module, error)
    return []


def _run_rest(text: str, module: ModuleType, failed: BaseException | None = None) -> list[Failure]:
    """Run all of the text, or what comes after the failed statement, statement by statement, which takes longer."""
    failures: list[Failure] = []
    try:
        statements = _prepared(ast.parse(text, TITLE)).body
    except Exception as error:
        return [([""], *described(error))]
    if failed is not None:
        where = place(failed)
        reached = [statement for statement in statements if where is None or _start(statement) <= where]
        kind, message, line = described(failed)
        failures.append((list(_names(reached[-1])), kind, message, line or reached[-1].lineno))
        statements = statements[len(reached) :]
    for statement in statements:
        try:
            code = compile(ast.Module([statement], []), TITLE, "exec", _FLAGS, dont_inherit=True)
            exec(code, module.__dict__)
        except BaseException as error:
            kind, message, line = described(error)
            failures.append((list(_names(statement)), kind, message, line or statement.lineno))
    return failures


def _prepared(tree: ast.Module) -> ast.Module:
    """The tree with a call before each statement that may take long, and a `try` round each in a loop or a branch."""
    body: list[ast.stmt] = []
    for statement in tree.body:
        if _may_take_long(statement):
            body.append(_call(_BEGINS, statement))
        _guard_within(statement)
        body.append(statement)
    tree.body = body
    return tree


def _may_take_long(statement: ast.stmt) -> bool:
    """Whether there is a call, a loop or a power in what is run now; of a function, its decorators and defaults."""
    if not isinstance(statement, ast.FunctionDef):
        return any(isinstance(node, _LONG) for node in ast.walk(statement))
    defaults = [each for each in (*statement.args.defaults, *statement.args.kw_defaults) if each]
    return bool(statement.decorator_list) or any(
        isinstance(node, _LONG) for each in defaults for node in ast.walk(each)
    )


def _guard_within(statement: ast.stmt) -> None:
    match statement:
        case ast.For() | ast.While() | ast.If():
            statement.body, statement.orelse = _guarded(statement.body), _guarded(statement.orelse)
        case ast.Match():
            for case in statement.cases:
                case.body = _guarded(case.body)


def _guarded(statements: list[ast.stmt]) -> list[ast.stmt]:
    for statement in statements:
        _guard_within(statement)
    return [_tried(statement) if isinstance(statement, _SIMPLE) else statement for statement in statements]


def _tried(statement: ast.stmt) -> ast.stmt:
    handler = ast.ExceptHandler(ast.Name(_ERROR, ast.Load()), None, [_call(_FAILED, statement, *_names(statement))])
    return ast.fix_missing_locations(ast.copy_location(ast.Try([statement], [handler], [], []), statement))


def _call(name: str, statement: ast.stmt, *more: str) -> ast.stmt:
    given: list[ast.expr] = [ast.Constant(statement.lineno), *map(ast.Constant, more)]
    call = ast.Call(ast.Name(name, ast.Load()), given, [])
    return ast.fix_missing_locations(ast.copy_location(ast.Expr(call), statement))


def _start(statement: ast.stmt) -> tuple[int, int]:
    first = min([statement, *getattr(statement, "decorator_list", [])], key=lambda node: node.lineno)
    return first.lineno, first.col_offset


def _names(statement: ast.stmt) -> Iterator[str]:
    """The names that a statement would have defined."""
    for node in ast.walk(statement):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.alias):
            yield node.asname or node.name.partition(".")[0]
