"""Says what is wrong with plain data that has to have a certain shape: formats of platforms, written down as checks."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Any

Check = Callable[[Any, str], Iterator[str]]
"""Takes a value and where it is, and yields a line for each thing that is wrong."""


def text(value: Any, where: str) -> Iterator[str]:
    """Text, which may be empty. JSON cannot hold half a character."""
    if not isinstance(value, str):
        yield f"{where} is {value!r}, and has to be text"
    elif not value.isascii() and any(0xD800 <= ord(each) < 0xE000 for each in value):
        yield f"{where} holds half a character"


def name(value: Any, where: str) -> Iterator[str]:
    """Text on one line that is not empty."""
    yield from text(value, where)
    if isinstance(value, str) and (not value.strip() or not value.isprintable()):
        yield f"{where} is {value!r}, and has to be one line that can be printed"


def like(pattern: str) -> Check:
    """Text that is as a regular expression says."""

    def check(value: Any, where: str) -> Iterator[str]:
        if not isinstance(value, str) or not re.fullmatch(pattern, value):
            yield f"{where} is {value!r}, and has to be like {pattern}"

    return check


def flag(value: Any, where: str) -> Iterator[str]:
    """True or False."""
    if not isinstance(value, bool):
        yield f"{where} is {value!r}, and has to be true or false"


def whole(value: Any, where: str) -> Iterator[str]:
    """A whole number that is not negative."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        yield f"{where} is {value!r}, and has to be a whole number, 0 or more"


def number(most: float = math.inf) -> Check:
    """A number from 0 on, at most so large."""

    def check(value: Any, where: str) -> Iterator[str]:
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            yield f"{where} is {value!r}, and has to be a number"
        elif not 0 <= value <= most:
            yield f"{where} is {value!r}, and has to be from 0 to {most:g}"

    return check


def one_of(*choices: str) -> Check:
    """One of some words."""

    def check(value: Any, where: str) -> Iterator[str]:
        if value not in choices:
            yield f"{where} is {value!r}, and has to be one of {', '.join(choices)}"

    return check


def anything(value: Any, where: str) -> Iterator[str]:
    """A table, whatever it holds."""
    if not isinstance(value, dict):
        yield f"{where} is no table"


def listed(check: Check) -> Check:
    """A list, each entry of which has a shape."""

    def checked(value: Any, where: str) -> Iterator[str]:
        if not isinstance(value, list):
            yield f"{where} is no list"
            return
        for place, each in enumerate(value):
            yield from check(each, f"{where}[{place}]")

    return checked


def keyed(check: Check) -> Check:
    """A table whose keys are names of any kind, and whose values have a shape."""

    def checked(value: Any, where: str) -> Iterator[str]:
        yield from anything(value, where)
        for key, each in value.items() if isinstance(value, dict) else ():
            yield from check(each, f"{where}[{key!r}]")

    return checked


def table(fields: Mapping[str, Check], needed: Collection[str] = ()) -> Check:
    """A table with some fields and no others, of which some are needed."""

    def checked(value: Any, where: str) -> Iterator[str]:
        if not isinstance(value, dict):
            yield f"{where} is no table"
            return
        for key in needed:
            if key not in value:
                yield f"{where} lacks {key}"
        for key, each in value.items():
            if key not in fields:
                yield f"{where} has {key!r}, which the platform does not know"
            else:
                yield from fields[key](each, f"{where}.{key}" if where else key)

    return checked


def at_most(fields: Mapping[str, str], check: Check) -> Check:
    """A shape of which some fields are at most as large as others."""

    def checked(value: Any, where: str) -> Iterator[str]:
        found = list(check(value, where))
        yield from found
        for small, large in fields.items():
            if not found and small in value and large in value and value[small] > value[large]:
                yield f"{where}.{small} is {value[small]}, more than {large}, {value[large]}"

    return checked


def either(first: Callable[[dict[str, Any]], bool], one: Check, other: Check) -> Check:
    """One of two shapes of a table: the first if what it holds says so."""

    def checked(value: Any, where: str) -> Iterator[str]:
        yield from (one if isinstance(value, dict) and first(value) else other)(value, where)

    return checked
