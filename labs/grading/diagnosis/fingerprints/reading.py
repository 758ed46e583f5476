"""Reads the files of fingerprints."""

from __future__ import annotations

import functools
import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from labs.grading.diagnosis.deviations import Deviation, Right
from labs.grading.diagnosis.output_names import rows_of
from reference import lecture
from reference.errors import InvalidInput, UnknownName

SCHEMA, VERSION = "collisions-lab/fingerprints", 2
FOLDER = Path(__file__).parent
BETWEEN = " | "
"""Separates the ids of mistakes that give another function the same inherited deviations."""


@dataclass(frozen=True)
class Known:
    """One known mistake without its formula: its deviations, one per probe, and its texts.

    origins: the ids of the mistakes that it may come from, if it lies in another function that this one uses.
    """

    id: str
    rationale: str
    help: str
    deviations: tuple[Deviation, ...]
    origins: tuple[str, ...] = ()


@dataclass(frozen=True)
class Knowledge:
    """What is known of one function: the names of its parameters, the right answers, and the mistakes.

    right: one entry per probe; None if the input is bad and has to be refused.
    """

    function: str
    parameters: tuple[str, ...]
    right: tuple[Right | None, ...]
    mistakes: tuple[Known, ...]


@functools.cache
def known(function: str) -> Knowledge:
    """What is known of a function.

    Raises
    ------
    UnknownName
        If the lecture has no such function or there are no fingerprints of it.
    InvalidInput
        If the file does not hold fingerprints, or is of another version.
    """
    return _knowledge(function, _entry(function))


def right_answers(function: str) -> tuple[Right | None, ...]:
    """The right answers alone, without the many mistakes; raises as `known` does."""
    rows = rows_of(function)
    return tuple(None if answer is None else _right(answer, rows) for answer in _entry(function)["right"])


def _entry(function: str) -> Mapping[str, Any]:
    path = FOLDER / f"{lecture.function(function).topic}.json"
    functions: Mapping[str, Any] = read(path)["functions"] if path.exists() else {}
    if function not in functions:
        raise UnknownName("function with fingerprints", function, functions)
    entry: Mapping[str, Any] = functions[function]
    return entry


@functools.cache
def read(path: Path) -> Mapping[str, Any]:
    """The content of a file; refuses files that are not ours."""
    content: Mapping[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    found = content.get("schema"), content.get("version")
    if found != (SCHEMA, VERSION):
        raise InvalidInput(f"{path.name} is {found[0]} {found[1]}, not {SCHEMA} {VERSION}; make the fingerprints again")
    return content


def _knowledge(function: str, entry: Mapping[str, Any]) -> Knowledge:
    own = tuple(
        Known(f"{function}/{name}", text["rationale"], text["help"], tuple(map(_deviation, text["deviations"])))
        for name, text in entry["mistakes"].items()
    )
    others = tuple(
        _inherited(function, ids.split(BETWEEN), tuple(map(_deviation, deviations)))
        for ids, deviations in entry["inherited"].items()
    )
    return Knowledge(function, tuple(entry["parameters"]), right_answers(function), own + others)


def of_functions(knowledge: Knowledge, called: Collection[str]) -> tuple[Known, ...]:
    """The mistakes that a function can make which calls only these others: its own, and those inherited from them."""
    found = []
    for entry in knowledge.mistakes:
        origins = [origin for origin in entry.origins if _function_of(origin) in called]
        if len(origins) == len(entry.origins):
            found.append(entry)
        elif origins:
            found.append(_inherited(knowledge.function, origins, entry.deviations))
    return tuple(found)


def _function_of(origin: str) -> str:
    return origin.partition("/")[0]


def _inherited(function: str, origins: Sequence[str], deviations: tuple[Deviation, ...]) -> Known:
    """A mistake of a function that is right itself; its texts are those of the mistakes that it may come from."""
    texts = [_own(*origin.split("/", 1)) for origin in origins]
    names = " or ".join(dict.fromkeys(map(_function_of, origins)))
    rationale = f"It answers as if it were right itself and used a wrong {names}: " + " Or: ".join(
        text["rationale"] for text in texts
    )
    return Known(f"{function} < {BETWEEN.join(origins)}", rationale, texts[0]["help"], deviations, tuple(origins))


def _own(function: str, name: str) -> Mapping[str, str]:
    content = read(FOLDER / f"{lecture.function(function).topic}.json")
    texts: Mapping[str, str] = content["functions"][function]["mistakes"][name]
    return texts


def _right(answer: list[list[Any]], rows: tuple[tuple[int, ...], str]) -> Right:
    arrays = tuple(np.asarray(numbers, dtype=float).reshape(shape) for shape, numbers, _ in answer)
    return Right(arrays, tuple(scale for *_, scale in answer), *rows)


def _deviation(number: Any) -> Deviation:
    if isinstance(number, str):
        return Deviation(failure=number)  # type: ignore[arg-type]
    return Deviation(number, abs(number))  # the files keep no spread, which is at least this
