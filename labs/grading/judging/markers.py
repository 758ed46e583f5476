"""The markers of a test: which function it is about, what it is worth, why it asks, and what to look at.

@asks("side_of_plane", 2, "A point behind the plane by more than the tolerance is behind.", "Slide 4.")
def test_a_point_behind_the_plane_is_behind(submission, part):
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import pytest

Test = TypeVar("Test", bound=Callable[..., None])
MEANINGS = {
    "points(n)": "what the test is worth, a whole number",
    "function(name)": "which function it is about; where a test of it fails, the feedback says what is wrong with it",
    "rationale(text)": "why a submission has to pass it",
    "help(text)": "what a student should look at",
}


def asks(function: str, points: int, rationale: str, help: str = "") -> Callable[[Test], Test]:
    """Mark a test: which function it is about, what it is worth, why it asks, and what to look at."""

    def marked(test: Test) -> Test:
        for each in (
            pytest.mark.function(function),
            pytest.mark.points(points),
            pytest.mark.rationale(rationale),
            pytest.mark.help(help),
        ):
            test = each(test)
        return test

    return marked


def marker(item: pytest.Item, name: str, otherwise: Any) -> Any:
    """The value of a test's marker."""
    found = item.get_closest_marker(name)
    return found.args[0] if found and found.args else otherwise


def is_hidden(item: pytest.Item) -> bool:
    """Whether a test is in a folder named hidden."""
    return "hidden" in item.path.parts
