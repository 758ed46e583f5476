"""Inside a test's process: runs the submission's text, then answers calls by name until the grader hangs up.

Threat: the submission controls everything here, and may patch this module, its NumPy and the two pipes. So nothing is
kept here that would help it: no test, no expected value, no other function's answer. What it sends is read as plain
values and judged elsewhere, so that forging an answer is no better than giving one.
"""

from __future__ import annotations

import io
import itertools
import marshal
import os
import sys
import time
from collections.abc import Collection
from types import CodeType, ModuleType
from typing import Any

import numpy as np

from labs.grading.worker import bodies, loading, messages, preloading
from labs.grading.worker.raised import described, through
from labs.grading.worker.sandbox import Sealing

FAILED = 70
"""Exit code of a process in which our own code failed, and not the submission."""


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
    module = ModuleType("__main__")  # as in a notebook, and where Python is given a file to run
    compiled = marshal.loads(code.tobytes()) if isinstance(code, np.ndarray) else loading.compiled(source)
    if code is True:
        _send(answers, ("compiled", None if printed.anything else _for_others(compiled)))
    failures, inner = loading.load(source, module, compiled, lambda line: _send(answers, ("begins", line)))
    _send(answers, ("loaded", [name for name, value in vars(module).items() if callable(value)], failures, inner))
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


def _for_others(code: CodeType | None) -> Any:
    """Code as bytes for other processes, which then need not compile the text; None if there is none, or too much."""
    try:
        made = marshal.dumps(code) if code else b""
    except ValueError:  # it is nested too deep
        return None
    return np.frombuffer(made, np.uint8) if 0 < len(made) < messages.MESSAGE_LIMIT // 2 else None


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
        return ("raised", *described(error), through(error))


def _bits(argument: Any) -> Any:
    """The contents of an argument that can be written to, an array or a list; compared before and after a call."""
    if isinstance(argument, np.ndarray):
        return argument.shape, argument.tobytes()
    if isinstance(argument, list | tuple):
        return tuple([_bits(each) for each in argument])
    return None


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
