"""Functions that are right for one case alone: what they lose, and what a student reads about them."""

from __future__ import annotations

from submissions import joined, sheet_of

from labs.grading.errors import ArgumentsChanged
from labs.grading.feedback import report
from labs.grading.judging import pytest_run

ONE_CASE = """
import numpy as np
def edge_edge_normal(e, f, a, b):
    n = np.cross(e, f)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    return n if np.sum(n * (a - b), axis=-1) >= 0 else -n
def inverse_effective_mass(a, b, n):
    k = 0.0
    for _, _, r, share, turning in (a, b):
        k = k + share + n @ np.cross(turning @ np.cross(r, n), r)
    return k
def normal_velocity(a, b, n):
    return np.sum((a[0] + np.cross(a[1], a[2]) - b[0] - np.cross(b[1], b[2])) * n, axis=-1)
"""


def test_functions_of_one_case_lose_one_part_of_the_lab_together(tmp_path, grader):
    names = ("edge_edge_normal", "inverse_effective_mass", "normal_velocity")
    sheet = sheet_of(tmp_path, grader, ONE_CASE, *names)
    assert sheet.points - sheet.earned == 1
    assert sheet.lost == ["edge_edge_normal"]
    assert set(sheet.case_by_case.functions) == {"edge_edge_normal", "inverse_effective_mass"}
    text = joined("\n".join(report.report(sheet, ("impulse",))))
    assert "✗ edge_edge_normal 1 of 2 parts right Not yet: both in one call raised ValueError" in text
    assert "That costs one part of the impulse lab, this one, however many of its functions do it." in text
    assert "hands it several cases in one call gets no right numbers from it" in text
    assert text.count("np.where((s < 0)[..., None], b, c)") == 1
    assert "✓ inverse_effective_mass for one case at a time" in text
    assert "✓ normal_velocity" in text
    assert "✓ normal_velocity for" not in text


def test_the_lab_that_lost_a_part_is_named_where_a_file_has_two(tmp_path, grader):
    (tmp_path / "lab.py").write_text(
        f"{ONE_CASE}\ndef side_of_plane(d, t=0.0):\n    return 1 if d > t else -int(d < -t)\n"
    )
    topics = ("detection", "impulse")
    sheet = pytest_run.run(tmp_path / "lab.py", topics, grader=grader, functions=("side_of_plane", "edge_edge_normal"))
    text = joined("\n".join(report.report(sheet, topics)))
    assert text.index("one part of the detection lab") < text.index("one part of the impulse lab")


def test_a_function_that_calls_one_of_one_case_loses_nothing_for_it(tmp_path, grader):
    text = ONE_CASE + (
        "def impulse_magnitude(a, b, n, e):\n    k = inverse_effective_mass(a, b, n)\n"
        "    return np.where(k > 0, -(1 + e) * normal_velocity(a, b, n) / np.where(k > 0, k, 1), 0)\n"
    )
    sheet = sheet_of(tmp_path, grader, text, "edge_edge_normal", "inverse_effective_mass", "impulse_magnitude")
    assert sheet.points - sheet.earned == 1
    assert "impulse_magnitude" in sheet.case_by_case.functions


def test_the_forms_for_many_are_shown_at_one_function_of_a_lab(tmp_path, grader):
    (tmp_path / "lab.py").write_text(ONE_CASE.replace("in (a, b)", "in (a, (*b[:2], 0 * b[2], *b[3:]))"))
    name, paid = "inverse_effective_mass", {"impulse": "edge_edge_normal"}  # in a check before this one
    sheet = pytest_run.run(tmp_path / "lab.py", ("impulse",), grader=grader, functions=(name,), paid=paid)
    text = joined("\n".join(report.report(sheet, ("impulse",))))
    assert "The check of edge_edge_normal shows how to write for one or many." in text
    assert "np.where(s < 0, b, c)" not in text


def test_a_part_with_a_wrong_number_is_lost_whatever_is_asked_alone(tmp_path, grader):
    wrong = ONE_CASE.replace("else -n", "else n")
    sheet = sheet_of(tmp_path, grader, wrong, "edge_edge_normal", "inverse_effective_mass")
    assert [sum(not part.passed for part in outcome.parts) for outcome in sheet.outcomes] == [2, 1]
    assert sheet.case_by_case.paid == {"impulse": "inverse_effective_mass"}
    assert sheet.diagnoses["edge_edge_normal"].verdict == "named"


def test_arguments_that_one_case_writes_to_count_as_changed(tmp_path, grader):
    writes = ONE_CASE.replace("    n = np.cross(e, f)", "    assert e.ndim == 1\n    n = np.cross(e, f)\n    e *= 2")
    (tmp_path / "lab.py").write_text(writes)
    sheet = pytest_run.run(tmp_path / "lab.py", ("impulse",), grader=grader, functions=("edge_edge_normal",))
    hidden = next(outcome for outcome in sheet.outcomes if outcome.hidden)
    part = next(part for part in hidden.parts if "arrays left as they were" in part.reason)
    assert part.said == f"the function {ArgumentsChanged.gist}"
