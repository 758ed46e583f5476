"""Advice on answers that are no numbers: infinity is right of some functions, and of others a division by zero."""

from __future__ import annotations

import importlib
import inspect
import re

import pytest

from labs.grading.feedback.error_advice import MAY_BE_INFINITE, MAY_BE_NO_NUMBER, advice
from reference import lecture


def test_infinity_gets_no_advice_where_it_is_right():
    assert "division by zero" in advice("f(1)\ngives   (1, inf)\nphysics (1, 2)")
    assert advice("f(1)\ngives   inf\nphysics 2, inf") == ""
    assert advice("f(1)\ngives   2\nphysics 3") == ""


def test_infinity_is_blamed_on_no_division_where_a_function_may_return_it():
    assert advice("time_of_impact_exact(1)\ngives   inf\nphysics 2") == ""
    assert advice("time_of_impact_exact(1)\ngives   (inf, nan)\nphysics (1, 2)").startswith("nan comes from 0/0")


def test_a_row_of_numbers_times_a_column_is_told_from_numbers_beside_vectors():
    for shapes, said in {
        "(4,) (4,3)": "A number for each case stands beside",
        "(4,4) (4,3)": "A row of numbers times a column",
        "(2,2) (3,)": "A row of numbers times a column",
        "(2,3) (2,2)": "A row of numbers times a column",
        "(4,5) (4,3)": "",
    }.items():
        found = advice(f"ValueError: operands could not be broadcast together with shapes {shapes}")
        assert found.startswith(said), shapes
        assert bool(found) == bool(said), shapes


def test_a_segment_that_is_said_to_meet_nothing_is_blamed_on_no_division():
    nothing = "segment_triangle(1)\ngives   fraction=inf, barycentric=(nan, nan, nan)\nphysics fraction=0.25"
    assert advice(nothing) == ""
    assert advice(nothing.replace("=inf", "=0.5")).startswith("nan comes from 0/0")


def test_the_nan_of_an_advance_whose_looks_are_used_up_is_blamed_on_no_division():
    assert advice("advance(1)\ngives   time=nan, used=12\nphysics time=1.5, used=2") == ""


def test_a_function_whose_cell_was_not_run_is_named_as_one_of_a_lab():
    assert advice("NameError: name 'ray_sphere' is not defined").startswith("ray_sphere is a function of a lab")
    assert advice("NameError: name 'ray_spere' is not defined") == ""


@pytest.mark.parametrize(("word", "functions"), [("infinity", MAY_BE_INFINITE), ("NaN", MAY_BE_NO_NUMBER)])
def test_functions_that_may_return_no_finite_number_are_those_that_promise_it(word, functions):
    promised = set()
    for entry in lecture.FUNCTIONS.values():
        text = inspect.getdoc(getattr(importlib.import_module(f"solutions.{entry.topic}"), entry.name)) or ""
        returns = text.partition("Returns\n")[2].partition("Raises\n")[0].partition("Notes\n")[0]
        if entry.role == "written" and re.search(rf"\b{word}\b", returns, re.IGNORECASE):
            promised.add(entry.name)
    assert set(functions) == promised
