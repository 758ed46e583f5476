"""Programs with a bug that a student mends: what is still wrong with one, in words."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Callable
from typing import Any

from reference import lecture
from reference.errors import InvalidInput, UnknownName

Program = Callable[..., Any]


def still_wrong(topic: str, key: str, program: Program) -> str:
    """What is still wrong with a lab's program; empty if it is mended.

    Raises
    ------
    UnknownName, InvalidInput
        If the lab has no such program, or it ends in an error or returns something else than it did.
    """
    name = f"labs.assessment.suspects.{lecture.topic(topic).name}"
    found: dict[str, Callable[[Program], str]] = {}
    if importlib.util.find_spec(name) is not None:
        found = getattr(importlib.import_module(name), "MENDED", {})
    if key not in found:
        raise UnknownName("program to mend", key, found)
    if not callable(program):
        raise InvalidInput("give the program itself, without brackets behind its name")
    try:
        return found[key](program)
    except Exception as error:
        reason = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        raise InvalidInput(f"your program cannot be tried ({reason}): let it take and return what it did") from None
