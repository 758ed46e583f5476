"""Inside a test's process: runs the submission's text, then answers calls by name until the grader hangs up.

Threat: the submission controls everything here, and may patch this module, its NumPy and the two pipes. So nothing is
kept here that would help it: no test, no expected value, no other function's answer. What it sends is read as plain
values and judged elsewhere, so that forging an answer is no better than giving one.
"""

from __future__ import annotations
import __future__

import ast
import builtins
import difflib
import io
import itertools
import marshal
import os
import sys
import time
import traceback
from collections.abc import Collection, Iterator
from types import CodeType, ModuleType
from typing import Any

import numpy as np

from labs.grading.worker import bodies, messages, preloading
from labs.grading.worker.sandbox import Sealing

TITLE = "submission"
"""Name of the module that the text becomes, and of the file in its tracebacks."""
FAILED = 70
"""Exit code of a process in which our own code failed, and not the submission."""
_MESSAGE_CHARACTERS = 2000
"""The longest message of an exception that is sent."""
_NAME_CHARACTERS, _MOST_NAMES = 100, 50
"""The longest name of a function that an exception passed through, and how many of these are sent."""
_LONG_ENOUGH = 3  # letters that a name needs before another one is suggested for it
_LIKE, _LIKE_A_BUILTIN = 0.66, 0.75
"""Similarity, at most 1, from which a name is suggested for a misspelt one; more for one of Python's many own names."""
Failure = tuple[list[str], str, str, int | None]
_FLAGS = __future__.annotations.compiler_flag  # a type hint that cannot be evaluated costs nothing


class Printed(io.TextIOBase):
    """Stands in for stdout and stderr: keeps the first characters and drops the rest."""

    def __init__(self, limit: int) -> None:
        super().__init__()
        self._limit = limit
        self._parts: list[str] = []
        self._kept = 0

    def writable(self) -> bool:
        """Yes: printing needs it."""
        return True

    def write(self, text: str) -> int:
        """Keep what there is room for."""
        part = str(text)[: self._limit - self._kept]
        if part:
            self._parts.append(part)
            self._kept += len(part)
        return len(text)

    @property
    def anything(self) -> bool:
        """Whether anything was written since the last time, such as Python's warning about a text that it compiles."""
        return bool(self._parts)

    def taken(self) -> str:
        """The text since the last time, as far as it was kept."""
        text = "".join(self._parts)
        self._parts, self._kept = [], 0
        return text


def serve(requests: int, answers: int, sealing: Sealing) -> None:
    """Report how far the process is shut in, load the text that comes first, then answer every call.

    The report also has the process's number and the s that it computed so far, for the grader that measures it. With
    the text comes its code; or True, and then this process sends the code before it runs any of it; or None.
    """
    text, limit, code = _receive(requests)
    source = text.tobytes().decode()
    lacking = preloading.lacking(source)
    _send(answers, ("sealed", int(sealing.tier), list(sealing.missing), lacking, os.getpid(), time.process_time()))
    printed = Printed(limit)
    sys.stdout = sys.stderr = printed
    module = ModuleType(TITLE)
    compiled = marshal.loads(code.tobytes()) if isinstance(code, np.ndarray) else _compiled(source)
    if code is True:
        _send(answers, ("compiled", None if printed.anything else _for_others(compiled)))
    failures = load(source, module, compiled)
    _send(answers, ("loaded", [name for name, value in vars(module).items() if callable(value)], failures))
    while True:
        try:
            _, number, name, arguments, named = _receive(requests)
        except EOFError:
            return
        answer = _answer(module, name, arguments, dict(named))
        said = printed.taken()
        try:
            message = messages.pack(("answer", number, *answer, said))
        except BaseException as error:  # a value that no message carries, too little memory, or patched code
            why = str(error) if isinstance(error, messages.Refused) else f"what cannot be sent ({type(error).__name__})"
            message = messages.pack(("answer", number, "refused", why, said))
        _write(answers, message)


def _compiled(text: str) -> CodeType | None:
    """The code of the text; None if Python cannot read all of it."""
    try:
        code: CodeType = compile(text, TITLE, "exec", _FLAGS, dont_inherit=True)
    except Exception:
        return None
    return code


def _for_others(code: CodeType | None) -> Any:
    """Code as bytes for other processes, which then need not compile the text; None if there is none, or too much."""
    try:
        made = marshal.dumps(code) if code else b""
    except ValueError:  # it is nested too deep
        return None
    return np.frombuffer(made, np.uint8) if 0 < len(made) < messages.MESSAGE_LIMIT // 2 else None


def load(text: str, module: ModuleType, code: CodeType | None) -> list[Failure]:
    """Run the code of the text in the module; a statement that fails costs only the names that it defines.

    Without code, because Python cannot read all of the text, each statement is run alone. Returns the names, the
    exception's type and message, and the line of each failure.
    """
    sys.modules[module.__name__] = module  # as any import does; a dataclass looks itself up there
    if code is None:
        return _load_rest(text, module)
    try:
        exec(code, module.__dict__)
    except BaseException as error:
        return _load_rest(text, module, error)
    return []


def _load_rest(text: str, module: ModuleType, failed: BaseException | None = None) -> list[Failure]:
    """Run all of the text, or what comes after the failed statement, statement by statement, which takes longer."""
    failures: list[Failure] = []
    try:
        statements = ast.parse(text, TITLE).body
    except Exception as error:
        return [([], *_described(error))]
    if failed is not None:
        place = _place(failed)
        reached = [statement for statement in statements if place is None or _start(statement) <= place]
        kind, message, line = _described(failed)
        failures.append((list(_names(reached[-1])), kind, message, line or reached[-1].lineno))
        statements = statements[len(reached) :]
    for statement in statements:
        try:
            code = compile(ast.Module([statement], []), TITLE, "exec", _FLAGS, dont_inherit=True)
            exec(code, module.__dict__)
        except BaseException as error:
            kind, message, line = _described(error)
            failures.append((list(_names(statement)), kind, message, line or statement.lineno))
    return failures


def _place(error: BaseException) -> tuple[int, int] | None:
    """Line and column that the outermost statement of the text was at when it failed; None if the error hides it."""
    trace = error.__traceback__
    while trace is not None and trace.tb_frame.f_code.co_filename != TITLE:
        trace = trace.tb_next
    if trace is None:
        return None
    line, _, column, _ = next(itertools.islice(trace.tb_frame.f_code.co_positions(), trace.tb_lasti // 2, None))
    return line or trace.tb_lineno, column or 0


def _start(statement: ast.stmt) -> tuple[int, int]:
    first = min([statement, *getattr(statement, "decorator_list", [])], key=lambda node: node.lineno)
    return first.lineno, first.col_offset


def _answer(module: ModuleType, name: str, arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
    """One call: ("value", seconds, which arguments it changed, value), or ("raised", type, message, line, through).

    through: the functions of the submission that the exception passed through.
    """
    function = vars(module).get(name)
    if not callable(function):
        return ("missing",)
    every = (*arguments, *named.values())
    before = [_bits(each) for each in every]
    start = time.perf_counter()
    try:
        value = function(*map(bodies.with_names, arguments), **named)
        seconds = time.perf_counter() - start
        changed = [place for place, each in enumerate(every) if _bits(each) != before[place]]
        return ("value", seconds, changed, value)
    except BaseException as error:
        return ("raised", *_described(error), _through(error))


def _through(error: BaseException) -> list[str]:
    """The names of the functions of the submission that an exception passed through, each once."""
    frames = (frame.f_code for frame, _ in traceback.walk_tb(error.__traceback__))
    names = dict.fromkeys(code.co_name for code in frames if code.co_filename == TITLE)
    return [name[:_NAME_CHARACTERS] for name in names][:_MOST_NAMES]


def _bits(argument: Any) -> Any:
    """The contents of an argument that can be written to, an array or a list; compared before and after a call."""
    if isinstance(argument, np.ndarray):
        return argument.shape, argument.tobytes()
    if isinstance(argument, list | tuple):
        return tuple([_bits(each) for each in argument])
    return None


def _described(error: BaseException) -> tuple[str, str, int | None]:
    """The exception's type, its message, and the last line of the submission that it passed through."""
    line = None
    for frame, number in traceback.walk_tb(error.__traceback__):
        if frame.f_code.co_filename == TITLE:
            line = number
    unreadable = error if isinstance(error, SyntaxError) and error.filename == TITLE else None
    if unreadable is not None:
        line = unreadable.lineno
    try:  # Python adds the line to the message of a SyntaxError
        message = str(error if unreadable is None else unreadable.msg) + _meant(error)
    except BaseException:
        message = "(its message cannot be shown)"
    return type(error).__name__[:100], message[:_MESSAGE_CHARACTERS], line


def _meant(error: BaseException) -> str:
    """What Python's own traceback adds about a misspelt name: ". Did you mean: 'cross'?"."""
    near: list[str] = []
    if isinstance(error, NameError) and error.__traceback__:
        frame = list(traceback.walk_tb(error.__traceback__))[-1][0]
        own = _alike(error.name, {*frame.f_locals, *frame.f_globals})
        near = own or _alike(error.name, vars(builtins), _LIKE_A_BUILTIN)
    elif isinstance(error, AttributeError):
        near = _alike(error.name, dir(error.obj))
    return f". Did you mean: {near[0]!r}?" if near else ""


def _alike(name: str | None, names: Collection[str], least: float = _LIKE) -> list[str]:
    """Names that are like another one; first those with its first letter, which are usually meant."""
    if not name or len(name) < _LONG_ENOUGH:
        return []
    found = difflib.get_close_matches(name, [each for each in names if each[:1] != "_"], 5, least)
    return sorted(found, key=lambda each: each[:1] != name[:1])


def _names(statement: ast.stmt) -> Iterator[str]:
    """The names that a statement would have defined."""
    for node in ast.walk(statement):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.alias):
            yield node.asname or node.name.partition(".")[0]


def _send(descriptor: int, value: Any) -> None:
    _write(descriptor, messages.pack(value))


def _write(descriptor: int, message: bytes) -> None:
    rest = memoryview(message)
    while rest:
        rest = rest[os.write(descriptor, rest) :]


def _receive(descriptor: int) -> Any:
    return messages.unpack(_read(descriptor, messages.length(_read(descriptor, messages.HEADER))))


def _read(descriptor: int, count: int) -> bytes:
    parts = []
    while count:
        part = os.read(descriptor, count)
        if not part:
            raise EOFError
        parts.append(part)
        count -= len(part)
    return b"".join(parts)


def hush(keep: Collection[int]) -> None:
    """Close every descriptor but those to keep; the standard three lead nowhere from now on."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1, 2):
        os.dup2(nowhere, standard)
    kept = sorted({*keep, 0, 1, 2})
    for after, before in itertools.pairwise([*kept, os.sysconf("SC_OPEN_MAX")]):
        os.closerange(after + 1, before)
