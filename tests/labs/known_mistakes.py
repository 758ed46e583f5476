"""The known mistakes of each function, and wrong formulas as code that several tests diagnose."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

from labs.grading.diagnosis.misconceptions import Misconception, read_bank
from labs.grading.diagnosis.probes.one_case import one_case


def by_function() -> dict[str, list[Misconception]]:
    """All entries of the bank, in its order."""
    found: dict[str, list[Misconception]] = {}
    for entry in read_bank():
        found.setdefault(entry.function, []).append(entry)
    return found


def remembered(formula: Callable[..., Any]) -> Callable[..., Any]:
    """A formula that computes each answer, or error, once; for formulas that leave their arguments as they are."""
    kept: dict[bytes, tuple[Any, Exception | None]] = {}

    def called(*arguments: Any) -> Any:
        asked = pickle.dumps(arguments)
        if asked not in kept:
            try:
                kept[asked] = formula(*arguments), None
            except Exception as error:  # whatever a wrong formula raises
                kept[asked] = None, error
        answer, error = kept[asked]
        if error is not None:
            raise error
        return answer

    return called


def refuses_many(name: str, formula: Callable[..., Any]) -> Callable[..., Any]:
    """A formula as code for one case: several end in an error, as an `if` on an array does."""

    def called(_: str, *arguments: Any) -> Any:
        if one_case(name).leading(arguments):
            raise ValueError("The truth value of an array with more than one element is ambiguous.")
        return formula(*arguments)

    return called
