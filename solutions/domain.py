"""What the arguments of a function may be: said once, at the parameter.

A function with `@domain` gets each argument as an array of the domain that
its annotation names, such as `Unit`: whatever NumPy makes one from is
welcome, a list or a number too. What is outside the domain is refused with a
ValueError that names the argument. So the body is the formula.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from types import NoneType
from typing import Annotated, Any, TypeVar, get_args, get_type_hints

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import (
    finite,
    in_unit_interval,
    matrix,
    not_negative,
    not_zero,
    positive,
    real,
    truth,
    unit,
    vector,
    whole,
    with_shape,
)

Result = TypeVar("Result")
Rule = Callable[[str, Any], Any]
"""It takes the name and the value of an argument, and returns its array."""

Number = Annotated[Array, real]
"""Any real number, infinity and NaN too."""
Finite = Annotated[Array, finite]
Positive = Annotated[Array, positive]
"""Infinity is one of them: the mass of an immovable body."""
NotNegative = Annotated[Array, not_negative]
"""Infinity is one of them."""
FinitePositive = Annotated[Array, positive, finite]
FiniteNotNegative = Annotated[Array, not_negative, finite]
Whole = Annotated[Array, whole, not_negative, finite]
"""0, 1, 2 …, as floats."""
Share = Annotated[Array, in_unit_interval]
"""0 to 1."""
Triple = Annotated[Array, vector]
"""(..., 3), any real numbers."""
Vector = Annotated[Array, vector, finite]
"""(..., 3), finite."""
Unit = Annotated[Array, vector, unit]
"""(..., 3), of length 1."""
Direction = Annotated[Array, vector, not_zero]
"""(..., 3), of any length but zero."""
Quaternion = Annotated[Array, with_shape(..., 4), unit]
"""(..., 4), w, x, y, z, of length 1: an orientation."""
Matrix = Annotated[Array, matrix]
"""(..., 3, 3), finite."""
Truth = Annotated[Booleans, truth]
"""True or False."""


def domain(function: Callable[..., Result]) -> Callable[..., Result]:
    """The function, of arguments in the domains of its annotations.

    Annotations without a rule are left alone, and so is None where it is
    allowed. An array that the function returns is an array for single numbers
    too.
    """
    names = tuple(inspect.signature(function).parameters)

    @functools.wraps(function)
    def checked(*args: Any, **kwargs: Any) -> Result:
        rules, defaults, returned = _domains(function)
        given, count = list(args), len(args)
        for at, name, rule in rules:
            if at < count:
                given[at] = rule(name, given[at])
            elif name in kwargs:
                kwargs[name] = rule(name, kwargs[name])
        for name in names[count:]:
            if name in defaults:
                kwargs.setdefault(name, defaults[name])
        result: Result = returned(function(*given, **kwargs))
        return result

    return checked


def require(holds: bool | Booleans, words: str) -> None:
    """Raise a ValueError with these words unless all of it holds."""
    if not np.all(holds):
        raise ValueError(words)


@functools.cache
def _domains(
    function: Callable[..., Any],
) -> tuple[list[tuple[int, str, Rule]], dict[str, Any], Callable[[Any], Any]]:
    """Place, name and rule of arguments, defaults, and what the result is.

    They are looked up at the first call, when all annotations have a meaning.
    """
    hints = get_type_hints(function, include_extras=True)
    rules, defaults = list[tuple[int, str, Rule]](), dict[str, Any]()
    parameters = inspect.signature(function).parameters.items()
    for at, (name, parameter) in enumerate(parameters):
        default = parameter.default
        for rule in _rules(hints.get(name)):
            rules.append((at, name, rule))
            if parameter.default is not parameter.empty:
                default = rule(name, default)
                defaults[name] = _kept(default)
    is_array = hints.get("return") in (Array, Booleans, Integers)
    return rules, defaults, np.asarray if is_array else _as_it_is


def _rules(hint: Any) -> tuple[Rule, ...]:
    """The rules of an annotation; with `| None` they are not for None."""
    if NoneType not in get_args(hint):
        return getattr(hint, "__metadata__", ())
    rules = [rule for kind in get_args(hint) for rule in _rules(kind)]

    def unless_none(name: str, value: Any) -> Any:
        for rule in rules if value is not None else ():
            value = rule(name, value)
        return value

    return (unless_none,)


def _kept(default: Any) -> Any:
    """A default that all calls share, so that none of them can change it."""
    if isinstance(default, np.ndarray):
        default.flags.writeable = False
    return default


def _as_it_is(result: Any) -> Any:
    return result
