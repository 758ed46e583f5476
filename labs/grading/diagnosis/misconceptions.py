"""The bank of known mistakes: each is a wrong version of a function, what its author seems to believe, and a hint.

The entries are written down in `tests/autograder/misconceptions/`, one file per topic or part of a topic, and loaded by
path. A student's tree lacks these formulas and has only the numbers that they give (`fingerprints`). A new mistake is
an entry in a table; a new topic is a file with such a table.
"""

from __future__ import annotations

import functools
import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.project_folders import AUTOGRADER
from reference import lecture
from reference.arrays import Array
from reference.errors import InvalidInput

FOLDER = AUTOGRADER / "misconceptions"


@dataclass(frozen=True)
class Misconception:
    """One mistake in one function.

    function: which one. name: the mistake in a word or two, unique within the function. formula: the wrong version; it
    takes arrays as the function itself does. rationale: what its author seems to believe, addressed to them. help: a
    hint that does not give away the answer.
    """

    function: str
    name: str
    formula: Callable[..., Any]
    rationale: str
    help: str

    @property
    def id(self) -> str:
        """Function and name, unique in the bank."""
        return f"{self.function}/{self.name}"


def read_bank(folder: Path | None = None) -> tuple[Misconception, ...]:
    """All entries of the tables `BANK` in a folder's files, in the order of files and tables.

    Raises
    ------
    InvalidInput
        If two entries share an id, or one is about a function that no student writes.
    """
    files = sorted((folder or FOLDER).glob("*.py"))
    bank = tuple(entry for path in files for entry in _loaded(path).BANK)
    for entry in bank:
        if lecture.function(entry.function).role != "written":
            raise InvalidInput(f"{entry.id}: {entry.function} is not written by a student")
    ids = [entry.id for entry in bank]
    for name in ids:
        if ids.count(name) > 1:
            raise InvalidInput(f"the bank has {ids.count(name)} entries {name!r}; give each a name of its own")
    return bank


def formulas_of(name: str) -> ModuleType:
    """One of the bank's files as a module, so that another file can build its entries from the same formulas."""
    return _loaded(FOLDER / f"{name}.py")


@functools.cache
def _loaded(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"misconceptions_{path.stem}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# The vocabulary of the formulas


def dot(a: ArrayLike, b: ArrayLike) -> Array:
    """a·b along the last axis, kept as an axis of one: ready to be multiplied with a vector."""
    return np.asarray(np.sum(np.asarray(a) * np.asarray(b), axis=-1, keepdims=True))


def size(a: ArrayLike) -> Array:
    """‖a‖ along the last axis, kept as an axis of one."""
    return np.asarray(np.linalg.norm(np.asarray(a), axis=-1, keepdims=True))


def col(value: ArrayLike) -> Array:
    """A number for each contact, as a column beside its vectors."""
    return np.asarray(value, dtype=float)[..., None]


def flat(value: ArrayLike) -> Array:
    """Without the axis of one that `dot` and `size` keep."""
    return np.asarray(value)[..., 0]


def direction(a: ArrayLike) -> Array:
    """a/‖a‖; zero of a zero vector."""
    length = size(a)
    return np.asarray(a) / np.where(length > 0, length, 1.0)


def along(a: ArrayLike, normal: ArrayLike) -> Array:
    """The part of a that is at right angles to a normal of unit length."""
    return np.asarray(np.asarray(a) - dot(a, normal) * np.asarray(normal))


def over(a: ArrayLike, b: ArrayLike, otherwise: float = np.inf) -> Array:
    """a/b; `otherwise` where b is zero."""
    b = np.asarray(b, dtype=float)
    return np.where(b != 0, np.asarray(a) / np.where(b != 0, b, 1.0), otherwise)
