"""Grades of made-up students, as far as mistakes without a name need them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from labs.grading.diagnosis.unnamed import probe_keys

FUNCTION, LAB = "kinematic_response", "response"
COUNT = len(probe_keys(FUNCTION))
SCALED = [round(0.1 + 0.01 * at, 7) for at in range(COUNT)]
"""Deviations of a mistake that every case shows."""


def grade_of(numbers: Sequence[float | str], name: str = FUNCTION) -> dict[str, Any]:
    """A grade in which one function has an unknown mistake that gives these deviations."""
    place = next(at for at, value in enumerate(numbers) if value and not isinstance(value, str))
    function = {
        "name": name, "topic": LAB, "got": 1, "possible": 6, "verdict": "unknown", "suspect": False, "mend_first": [],
        "mistakes": [], "message": f"{name}: its numbers are wrong, in a way that the lab does not know.\nFor example",
        "unnamed": {"numbers": list(numbers), "place": place, "gives": "(0, 0, <3>)"},
    }  # fmt: skip
    return {"functions": [function], "got": 1, "points": 10.0, "tests": [], "marks": {}}
