"""The inputs of `lab.expose` that the text of a notebook holds, written in plain numbers. No cell is ever run.

The notebook asks here as well before it says ✓: a mark counts what is written, not what a cell happened to compute.
"""

from __future__ import annotations

import ast
import itertools
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from labs.grading.submission.calls_in_cells import calls_in
from reference.errors import InvalidInput

LARGEST = 1e50
"""Numbers of an input are smaller than this: an overflow exposes nobody."""
MOST = 100
"""The most numbers and lists in an input."""
DEEPEST = 5
"""Lists in lists in lists: a body in an input needs three."""
TRIES = 20
"""So many different inputs for one suspect are tried, the last ones of a notebook."""
IN_NUMBERS = "write the input in numbers, in lists or tuples where it has several: no names, no 1/240"
"""What an input has to be that a mark can count."""
NOT_WRITTEN = f"a mark counts what the text of the cell says, and this input is not found there: {IN_NUMBERS}"
"""What a student reads whose cell computes the input, or calls in a way that no reader of the text can follow."""
MANY = (
    f"You have tried at least {TRIES} inputs. A mark tries the last {TRIES} different ones in the notebook: delete"
    " those that expose nothing."
)
"""What a student reads who has tried so many that an early one may not count."""
_NODES = 10 * MOST
"""The most parts in the syntax of a call: a negative number in a list of its own has five."""


def inputs_in(sources: Iterable[str]) -> dict[str, list[list[Any]]]:
    """Key → the arguments of the calls of `lab.expose` in some cells that are plain numbers, in the order of the text.

    Of equal ones the first is left out, and of many the last ones are kept.
    """
    found: dict[str, list[list[Any]]] = {}
    for key, arguments in itertools.chain.from_iterable(map(_inputs, sources)):
        kept = [each for each in found.get(key, []) if each != arguments]
        found[key] = [*kept, arguments][-TRIES:]
    return found


def refuse_other_than_numbers(arguments: Sequence[Any]) -> None:
    """Refuse an input that is no numbers in lists or tuples, or too long."""
    if not all(_is_plain(each) for each in arguments):
        raise InvalidInput(IN_NUMBERS)
    if sum(map(_count, arguments)) > MOST:
        raise InvalidInput("the input is too long: one case is enough")


def _inputs(source: str) -> Iterator[tuple[str, list[Any]]]:
    for call in calls_in(source, "expose"):
        if call.keywords or _is_long(call):
            continue
        try:
            key, *arguments = [ast.literal_eval(each) for each in call.args]
            refuse_other_than_numbers(arguments)
        except (ValueError, TypeError, RecursionError, MemoryError):  # `InvalidInput` is a ValueError
            continue
        if isinstance(key, str) and arguments:
            yield key, arguments


def _is_long(call: ast.Call) -> bool:
    return next(itertools.islice(ast.walk(call), _NODES, None), None) is not None


def _is_plain(value: Any, depth: int = 0) -> bool:
    if isinstance(value, list | tuple):
        return depth < DEEPEST and all(_is_plain(each, depth + 1) for each in value)
    return type(value) in (int, float) and abs(value) < LARGEST


def _count(value: Any) -> int:
    return 1 + sum(map(_count, value)) if isinstance(value, list | tuple) else 1
