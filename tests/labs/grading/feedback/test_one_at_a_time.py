"""Functions that are right for one case alone: what they lose, and what a student reads about them."""

from __future__ import annotations

from submissions import joined, sheet_of

from labs.grading.errors import ArgumentsChanged
from labs.grading.feedback import report
from labs.grading.judging import pytest_run

ONE_CASE = """
import numpy as np
def rebound_velocity(u, e):
    return -e * u if u < 0 else u
def classify_contact(u, threshold=0.0):
    return -1 if u < -threshold else int(u > threshold)
def point_velocity(v, w, r):
    return v + np.cross(w, r)
"""


def test_functions_of_one_case_lose_one_part_of_the_lab_together(tmp_path, grader):
    names = ("rebound_velocity", "classify_contact", "point_velocity")
    sheet = sheet_of(tmp_path, grader, ONE_CASE, *names)
    assert sheet.points - sheet.earned == 1
    assert sheet.lost == ["rebound_velocity"]
    assert set(sheet.case_by_case.functions) == {"rebound_velocity", "classify_contact"}
    text = joined("\n".join(report.report(sheet, ("impulse",))))
    assert "✗ rebound_velocity 1 of 2 parts right Not yet: several in one call raised ValueError" in text
    assert "That costs one part of the impulse lab, this one, however many of its functions do it." in text
    assert text.count("np.where((s < 0)[..., None], b, c)") == 1
    assert "✓ classify_contact for one case at a time" in text
    assert "✓ point_velocity" in text
    assert "✓ point_velocity for" not in text


def test_the_lab_that_lost_a_part_is_named_where_a_file_has_two(tmp_path, grader):
    (tmp_path / "lab.py").write_text(
        "def side_of_plane(d, t=0.0):\n    return 1 if d > t else -int(d < -t)\n"
        "def rebound_velocity(u, e):\n    return -e * u if u < 0 else u\n"
    )
    topics = ("detection", "impulse")
    sheet = pytest_run.run(tmp_path / "lab.py", topics, grader=grader, functions=("side_of_plane", "rebound_velocity"))
    text = joined("\n".join(report.report(sheet, topics)))
    assert text.index("one part of the detection lab") < text.index("one part of the impulse lab")


def test_a_function_that_calls_one_of_one_case_loses_nothing_for_it(tmp_path, grader):
    text = ONE_CASE + (
        "def relative_velocity(a, b):\n    x, y, z = a - b\n    return np.array([x, y, z])\n"
        "def normal_velocity(a, b, n):\n    return np.sum(relative_velocity(a, b) * n, axis=-1)\n"
    )
    sheet = sheet_of(tmp_path, grader, text, "rebound_velocity", "relative_velocity", "normal_velocity")
    assert sheet.points - sheet.earned == 1
    assert "normal_velocity" in sheet.case_by_case.functions


def test_a_part_with_a_wrong_number_is_lost_whatever_is_asked_alone(tmp_path, grader):
    wrong = ONE_CASE.replace("-e * u if", "e * u if")
    sheet = sheet_of(tmp_path, grader, wrong, "rebound_velocity", "classify_contact")
    assert [sum(not part.passed for part in outcome.parts) for outcome in sheet.outcomes] == [2, 1]
    assert sheet.case_by_case.paid == {"impulse": "classify_contact"}
    assert sheet.diagnoses["rebound_velocity"].verdict == "named"


def test_arguments_that_one_case_writes_to_count_as_changed(tmp_path, grader):
    writes = "def relative_velocity(a, b):\n    assert a.ndim == 1\n    a -= b\n    return a\n"
    (tmp_path / "lab.py").write_text(writes)
    sheet = pytest_run.run(tmp_path / "lab.py", ("impulse",), grader=grader, functions=("relative_velocity",))
    hidden = next(outcome for outcome in sheet.outcomes if outcome.hidden)
    part = next(part for part in hidden.parts if "arrays left as they were" in part.reason)
    assert part.said == f"the function {ArgumentsChanged.gist}"
