"""Inputs that expose a wrong function: whether one does, and which of them a notebook holds."""

from __future__ import annotations

import ast
import contextlib
import importlib
import importlib.util
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from labs.grading.diagnosis.output_names import labelled, output_names
from labs.grading.submission.cells import read_cells
from labs.grading.submission.magics import without_magics
from labs.grading.worker.bodies import SpringMesh
from reference import lecture
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, UnknownName

NEAR = 1e-9
"""Two answers that differ by no more than this, relative to the larger one, are the same: rounding."""
LARGEST = 1e100
"""Numbers of an input are smaller than this: an overflow exposes nobody."""
MOST = 100
"""The most numbers in it."""


@dataclass(frozen=True)
class Suspect:
    """A wrong function. key: its name in the lab. function: which function it should be.

    shapes: of one result, of each of several that differ in shape, or those that a result may have.
    """

    key: str
    function: str
    wrong: Callable[..., Any]
    shapes: frozenset[tuple[int, ...]] = frozenset({()})


@dataclass(frozen=True)
class Exposure:
    """The result of an input. exposed: whether the two answers differ. said: both answers in words."""

    exposed: bool
    said: str


def suspects(topic: str) -> tuple[Suspect, ...]:
    """The wrong functions of a lab; none where the lab has no such question."""
    name = f"labs.assessment.suspects.{lecture.topic(topic).name}"
    if importlib.util.find_spec(name) is None:
        return ()
    table = importlib.import_module(name).SUSPECTS
    return tuple(Suspect(key, function, wrong, frozenset(shapes)) for key, (function, wrong, *shapes) in table.items())


def suspect(topic: str, key: str) -> Suspect:
    """A lab's wrong function by its key; raises `UnknownName` if the lab has none of that name."""
    found = {each.key: each for each in suspects(topic)}
    if key not in found:
        raise UnknownName("wrong function", key, found)
    return found[key]


def tried(wrong: Suspect, arguments: Sequence[Any], right: Callable[..., Any]) -> Exposure:
    """Whether an input exposes a wrong function. right: a function that is right.

    Raises
    ------
    InvalidInput
        If it is no single case, or one of the two functions refuses it: then it says nothing about the mistake.
    """
    _check_size(arguments)
    given_to_both = _with_floats([_as_checks_give(each) for each in arguments])
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        try:
            needed = right(*given_to_both)
            single = {np.shape(part) for part in (needed if isinstance(needed, tuple) else (needed,))}
            answer = _flat(needed)
        except NotImplementedError:
            raise InvalidInput(f"write {wrong.function} first: your colleague's is compared with it") from None
        except Exception as error:
            reason = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
            raise InvalidInput(f"{wrong.function} refuses this input ({reason}), so it exposes nothing") from None
        if not single <= wrong.shapes:
            raise InvalidInput("the input has to be one case: your colleague's function takes no more at once")
        try:
            theirs = wrong.wrong(*given_to_both)
            given = _flat(theirs)
        except Exception as error:
            raise InvalidInput(
                f"your colleague's function ends in {type(error).__name__}: take another input"
            ) from None
    if given.shape == answer.shape and np.allclose(given, answer, rtol=NEAR, atol=NEAR, equal_nan=True):
        return Exposure(False, f"Both give {_shown(needed, needed, wrong.function)}")
    yours, colleagues = _shown(needed, needed, wrong.function), _shown(theirs, needed, wrong.function)
    return Exposure(True, f"{wrong.function} gives {yours}, and your colleague's {colleagues}")


def found_in(path: Path, topic: str, source: str = "solutions") -> dict[str, bool]:
    """Of each of a lab's suspects, whether a notebook's last input for it exposes it.

    The notebook is read, never run; an input counts only if it is written in numbers. source: of the right functions.
    """
    right = Implementation(source)
    written = dict(_inputs(path))
    found = {}
    for each in suspects(topic):
        found[each.key] = False
        if each.key in written:
            with contextlib.suppress(InvalidInput):
                found[each.key] = tried(each, written[each.key], right.function(each.function)).exposed
    return found


def _inputs(path: Path) -> Iterator[tuple[str, list[Any]]]:
    """Key and arguments of every call of `lab.expose` in a notebook, in its order, where these are plain numbers."""
    for cell in (each for each in read_cells(path)[0] if each.code):
        if "expose" not in cell.source and cell.source.isascii():  # other letters may be read as these
            continue
        try:
            tree = ast.parse(without_magics(cell.source))
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "expose":
                try:
                    key, *arguments = [ast.literal_eval(each) for each in node.args]
                except (ValueError, TypeError, RecursionError, MemoryError):
                    continue
                if isinstance(key, str) and arguments and not node.keywords:
                    yield key, arguments


def _is_plain(arguments: Sequence[Any]) -> bool:
    """Whether an input is made of numbers, lists and tuples alone, as it has to be to be read from a notebook."""
    return all(
        _is_plain(each) if isinstance(each, list | tuple) else type(each) in (int, float) and abs(each) < LARGEST
        for each in arguments
    )


def _check_size(arguments: Sequence[Any]) -> None:
    if not _is_plain(arguments):
        raise InvalidInput("write the input in numbers, in lists or tuples where it has several: no names, no 1/240")
    if _count(arguments) > MOST:
        raise InvalidInput("the input is too long: one case is enough")


def _count(value: Any) -> int:
    return sum(map(_count, value)) if isinstance(value, list | tuple) else 1


def _as_checks_give(value: Any) -> Any:
    """An input as the checks of a lab give it: a list as an array, unless its parts differ in shape; a mesh by name."""
    if not isinstance(value, list | tuple):
        return value
    with contextlib.suppress(ValueError):  # as of a body, with its velocity and its mass
        return np.array(value)
    if len(value) == len(SpringMesh._fields):
        edges, *springs, mass, pinned = value
        rest, stiffness, damping = (np.array(each, dtype=float) for each in springs)
        ends, held = np.array(edges, dtype=int), np.array(pinned, dtype=bool)
        return SpringMesh(ends, rest, stiffness, damping, np.array(mass, dtype=float), held)
    return value


def _with_floats(arguments: list[Any]) -> list[Any]:
    """The arguments of a call; beside a mesh, which holds all whole numbers, arrays are of floats."""
    if not any(isinstance(each, SpringMesh) for each in arguments):
        return arguments
    return [each.astype(float) if isinstance(each, np.ndarray) else each for each in arguments]


def _flat(answer: Any) -> np.ndarray[Any, Any]:
    """An answer's numbers in a row; a tuple is read as its parts one after another."""
    return np.concatenate([np.ravel(np.asarray(part, dtype=float)) for part in _parts(answer)])


def _parts(answer: Any) -> tuple[Any, ...]:
    return answer if isinstance(answer, tuple) else (answer,)


def _shown(answer: Any, needed: Any, function: str) -> str:
    """An answer in words; of several things each has its name. needed: the right answer, which may be yes or no."""
    yes_or_no = all(np.asarray(part).dtype == bool for part in _parts(needed))
    return labelled([_in_words(_flat(part), yes_or_no) for part in _parts(answer)], output_names(function))


def _in_words(numbers: np.ndarray[Any, Any], yes_or_no: bool) -> str:
    if yes_or_no and np.isin(numbers, (0, 1)).all():
        return ", ".join(map(str, numbers.astype(bool).tolist()))
    words = [f"{value + 0.0:.4g}".replace("-", "−") for value in np.round(numbers, 12)]
    return words[0] if len(words) == 1 else f"({', '.join(words)})"
