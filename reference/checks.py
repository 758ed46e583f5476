"""Checks of single values that enter the lab; each error names the value and says what it must be."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from types import UnionType
from typing import Any, get_args

from reference.errors import InvalidInput

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


def finite(name: str, value: float, place: int | None = None) -> float:
    """Return `value` as a float; refuse NaN, infinities and anything that is no number.

    place: which of several numbers of that name it is, for the message.
    """
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise InvalidInput(f"{_called(name, place)} is {value!r}; it must be a number") from None
    if not math.isfinite(number):
        raise InvalidInput(f"{_called(name, place)} is {value!r}; it must be a finite number")
    return number


def _called(name: str, place: int | None) -> str:
    return name if place is None else f"{name}[{place}]"


def positive(name: str, value: float) -> float:
    """Return `value` if it is finite and above zero."""
    number = finite(name, value)
    if number <= 0:
        raise InvalidInput(f"{name} is {value!r}; it must be above zero")
    return number


def not_negative(name: str, value: float) -> float:
    """Return `value` if it is finite and at least zero."""
    number = finite(name, value)
    if number < 0:
        raise InvalidInput(f"{name} is {value!r}; it must not be negative")
    return number


def fraction(name: str, value: float) -> float:
    """Return `value` if it lies in the closed interval from 0 to 1."""
    number = finite(name, value)
    if not 0 <= number <= 1:
        raise InvalidInput(f"{name} is {value!r}; it must lie between 0 and 1")
    return number


def vector(name: str, values: Sequence[float]) -> Vector:
    """Return three finite numbers as a tuple."""
    if isinstance(values, str) or not hasattr(values, "__len__") or len(values) != 3:
        raise InvalidInput(f"{name} is {values!r}; it must hold three numbers")
    x, y, z = values
    return finite(name, x, 0), finite(name, y, 1), finite(name, z, 2)


def unit_vector(name: str, values: Sequence[float]) -> Vector:
    """Return a direction scaled to unit length; refuse the zero vector, which has none."""
    x, y, z = vector(name, values)
    length = math.sqrt(x * x + y * y + z * z)
    if length == 0:
        raise InvalidInput(f"{name} is {values!r}; a direction must not be zero")
    return x / length, y / length, z / length


def unit_quaternion(name: str, values: Sequence[float]) -> Quaternion:
    """Return an orientation (w, x, y, z) scaled to unit length; refuse the zero quaternion."""
    if isinstance(values, str) or not hasattr(values, "__len__") or len(values) != 4:
        raise InvalidInput(f"{name} is {values!r}; it must hold four numbers, w x y z")
    w, x, y, z = (finite(name, value, place) for place, value in enumerate(values))
    length = math.sqrt(w * w + x * x + y * y + z * z)
    if length == 0:
        raise InvalidInput(f"{name} is {values!r}; an orientation must not be zero")
    return w / length, x / length, y / length, z / length


def all_of(name: str, values: Iterable[Any], kind: type | UnionType) -> tuple[Any, ...]:
    """Return the values as a tuple; refuse what holds none, and any that is not of this kind, or of one of these."""
    of = " or ".join(each.__name__ for each in (get_args(kind) or (kind,)))
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise InvalidInput(f"{name} is {values!r}; it must be a tuple, each of them a {of}")
    found = tuple(values)
    for place, value in enumerate(found):
        if not isinstance(value, kind):
            raise InvalidInput(f"{_called(name, place)} is {value!r}; it must be a {of}")
    return found
