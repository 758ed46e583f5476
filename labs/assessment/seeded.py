"""Numbers of a question that differ from student to student, and are always the same for one of them."""

from __future__ import annotations

import hashlib
import unicodedata
from collections.abc import Mapping, Sequence
from types import SimpleNamespace

from reference.errors import InvalidInput


def drawn(student: str, topic: str, key: str, choices: Mapping[str, Sequence[float]]) -> SimpleNamespace:
    """One of the values of each name, by the student's name or number; the first ones if the student is not known.

    Raises
    ------
    InvalidInput
        If a name has no values to choose from.
    """
    who = " ".join(unicodedata.normalize("NFKC", student).casefold().split())
    found = {}
    for name, values in choices.items():
        if (
            not isinstance(values, list | tuple)
            or not values
            or not all(isinstance(each, int | float) for each in values)
        ):
            raise InvalidInput(f"{name} needs several values to choose from, such as {name}=(0.3, 0.5, 0.7)")
        found[name] = values[_number(f"{who}|{topic}|{key}|{name}") % len(values) if who else 0]
    return SimpleNamespace(**found)


def in_words(numbers: SimpleNamespace) -> str:
    """`e = 0.4, mass = 2`."""
    return ", ".join(f"{name} = {value:g}" for name, value in vars(numbers).items())


def _number(text: str) -> int:
    return int.from_bytes(hashlib.sha256(text.encode("utf-8")).digest()[:8], "big")
