"""A paragraph as wide as a terminal: it breaks between words, or between the arguments of a call."""

from __future__ import annotations

import pytest

from labs.grading.wrapping import folded


@pytest.mark.parametrize(
    "text",
    [
        "point_velocity(velocity=(0, 0, 0), angular_velocity=(0, 0, 2), arm=(1, 0, 0))",
        "inverse_effective_mass(body_a=((0, 0, -2), (0, 0, 0), (0, 0, 0), 1, diag(2, 2, 2)), normal=(0, 0, 1))",
        "long(first=(" + ", ".join(["(0, 0.12345, 0)"] * 12) + "), second=1)",
        "words " * 40 + "(in a bracket that never closes",
    ],
)
def test_a_long_line_breaks_between_arguments_and_loses_nothing(text):
    lines = folded(text, 2)
    assert all(len(line) <= 80 for line in lines)
    assert "".join("".join(lines).split()) == "".join(text.split())
    if text.startswith(("point", "inverse")):
        assert all(line.count("(") - line.count(")") == (0, 1)[at == 0] for at, line in enumerate(lines[:-1]))
