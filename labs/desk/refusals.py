"""Turns what the lab refuses or cannot do into a line of text, without a traceback through the lab's own code."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import ParamSpec, TypeVar

from labs.desk.nbgrader import run_of_nbgrader
from reference.errors import CollisionsError

P = ParamSpec("P")
R = TypeVar("R")


def errors_in_words(method: Callable[P, R]) -> Callable[P, R | None]:
    """Let a method of the lab print its errors, and return None."""

    @functools.wraps(method)
    def call(*arguments: P.args, **named: P.kwargs) -> R | None:
        try:
            inspect.signature(method).bind(*arguments, **named)
        except TypeError as error:
            print(f"lab.{method.__name__}: {error}; help(lab.{method.__name__}) says what it takes")
            return None
        try:
            return method(*arguments, **named)
        except CollisionsError as error:
            if run_of_nbgrader() == "autograde":
                raise  # a cell that ends without an error would get all its points
            print(f"lab.{method.__name__}: {error}")
        except KeyboardInterrupt:
            print(f"lab.{method.__name__}: interrupted")
        return None

    return call
