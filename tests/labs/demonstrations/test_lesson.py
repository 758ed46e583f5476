"""The lines of a lesson: the numbers that they name, and what is left out where a number is missing."""

from __future__ import annotations

import dataclasses
import re

import pytest
from made_results import EVERY, seen_of

from labs.demonstrations.catalogue import find
from labs.demonstrations.lesson import Error, IfKnown, Line, Listed, Measured, Predicted, Theory
from reference.catalogue.scenarios import catalogue
from reference.errors import UnknownName

A, B, GONE = Theory("a"), Theory("b"), Theory("gone")


def list_of(first, second):
    return Listed(IfKnown(first, " here"), IfKnown(second, " there"))


@EVERY
def test_every_number_that_a_lesson_names_is_available(demonstration):
    seen = seen_of(demonstration)
    family = catalogue()[demonstration.family]
    for line in demonstration.lesson:
        for number in line.numbers:
            assert seen.written(number), number
            if not isinstance(number, Predicted):
                assert family.quantity(number.quantity), number
    assert len(seen.lesson()) == len(demonstration.lesson)


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (Measured("bullet", "stock", "rest_time"), "unknown engine in the lesson of 'bounce' 'bullet'"),
        (Error("pybullet", "stack", "rest_time"), "unknown profile of pybullet in the lesson of 'bounce' 'stack'"),
        (Theory("rest_time", at="e = 0.8"), "unknown case or timestep in the lesson of 'bounce' 'e = 0.8'"),
        (Predicted("1 ms"), "unknown timestep in the lesson of 'bounce' '1 ms'"),
    ],
    ids=["engine", "profile", "case", "timestep"],
)
def test_a_lesson_that_names_a_number_of_no_run_is_refused(number, said):
    with pytest.raises(UnknownName, match=re.escape(said)):
        dataclasses.replace(find("bounce"), lesson=(Line("It is ", IfKnown(number), "."),))


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        (["plain"], "plain"),
        ([A, " and ", B], "1 and 2"),
        ([A, " and ", GONE], ""),
        (["so: ", list_of(A, B), "."], "so: 1 here, 2 there."),
        (["so: ", list_of(GONE, B), "."], "so: 2 there."),
        (["so: ", list_of(A, GONE), "."], "so: 1 here."),
        (["so: ", list_of(GONE, GONE), "."], ""),
        ([A, IfKnown("; ", GONE), "."], "1."),
        (["so", IfKnown(": ", GONE), IfKnown(", ", GONE), "."], ""),
        ([A, IfKnown("; so: ", list_of(GONE, GONE)), "."], "1."),
    ],
)
def test_parts_of_a_lesson_without_a_number_are_left_out(parts, said):
    assert Line(*parts).text(lambda number: {A: "1", B: "2"}.get(number, "")) == said
