"""Whole files, graded by the real tests in the real worker: right, untouched, wrong, and never ending."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from submissions import solved, stubs
from tests_in_process import TOPICS

from labs.grading.budget import Budget
from labs.grading.calling.processes import Limits
from labs.grading.errors import MachineBusy
from labs.grading.feedback import report
from labs.grading.judging import outcomes
from labs.grading.judging.grade import Grade, grade
from labs.grading.judging.pytest_run import run
from labs.grading.judging.score_sheet import Sheet
from reference import lecture

THREE_MISTAKES = """
import numpy as np

def normal_velocity(body_a, body_b, normal):
    p, q = (body[0] + np.cross(body[2], body[1]) for body in (body_a, body_b))
    return np.sum((p - q) * normal, axis=-1)

def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    across = np.cross(edge_a, edge_b)
    across = across / np.linalg.norm(across, axis=-1, keepdims=True)
    return np.where(np.sum(across * (centre_a - centre_b), axis=-1)[..., None] < 0, -across, across)

def inverse_effective_mass(body_a, body_b, normal):
    return np.asarray(body_a[3]) + body_b[3] + 0 * np.sum(normal, axis=-1)

def apply_impulse(body_a, body_b, impulse):
    (va, wa, ra, ma, ia), (vb, wb, rb, mb, ib) = body_a, body_b
    return va + ma * impulse, wa + ia @ np.cross(ra, impulse), vb + mb * impulse, wb + ib @ np.cross(rb, impulse)
"""

ENDLESS = """
def count_impacts(position, velocity, length, dt, duration):
    while True:
        pass

def side_of_plane(separation, tolerance=0.0):
    return (separation > tolerance) * 1 - (separation < -tolerance) * 1
"""


def nurseries() -> set[str]:
    """The numbers of the processes that a grader of this process has started; none where the system lists none."""
    children = Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children")
    found = children.read_text().split() if children.exists() else []
    return {child for child in found if b"nursery" in Path(f"/proc/{child}/cmdline").read_bytes()}


@pytest.fixture(scope="module")
def graded_alone(tmp_path_factory) -> tuple[Grade, set[str]]:
    """A grade, by a grader that it starts itself, and the processes which that one leaves."""
    path, before = tmp_path_factory.mktemp("three") / "three.py", nurseries()
    path.write_text(THREE_MISTAKES)
    return grade(path), nurseries() - before


@pytest.fixture(scope="module")
def three(graded_alone) -> Grade:
    return graded_alone[0]


def text_of(sheet: Sheet, *topics: str) -> str:
    return "\n".join(report.report(sheet, topics))


def joined(text: str) -> str:
    return " ".join(text.split())


# Right, to do, wrong


def test_the_solutions_score_full_marks(grader, tmp_path):
    found = grade(solved(tmp_path, "detection"), grader=grader).content()
    assert found["got"] == found["possible"] > 40
    assert [entry["verdict"] for entry in found["functions"]] == ["right"] * 7
    assert found["complaints"] == []


@pytest.mark.slow
@pytest.mark.parametrize("topic", TOPICS)
def test_the_solutions_of_every_topic_score_full_marks(topic, grader, tmp_path):
    found = grade(solved(tmp_path, topic), [topic], grader=grader)
    assert [line for outcome in found.sheet.outcomes for line in outcome.lines()] == []
    assert [sum(part.points for part in outcome.parts) for outcome in found.sheet.outcomes] == [
        outcome.points for outcome in found.sheet.outcomes
    ]


def test_untouched_stubs_score_nothing_and_are_listed_as_to_do(grader, tmp_path):
    found = grade(stubs(tmp_path, "detection"), grader=grader)
    names = [entry.name for entry in lecture.functions_of("detection") if entry.role == "written"]
    assert found.sheet.earned == 0
    text = text_of(found.sheet, "detection")
    assert re.findall(r"· (\w+)  to do", text) == names
    assert "7 functions to write. Begin with signed_distance (detection, step 1, slide 4). A distance" in joined(text)
    assert not found.sheet.complaints


@pytest.mark.slow
@pytest.mark.parametrize("topic", TOPICS[1:])
def test_untouched_stubs_of_every_topic_score_nothing(topic, grader, tmp_path):
    found = grade(stubs(tmp_path, topic), grader=grader)
    assert found.sheet.earned == 0
    assert {diagnosis.verdict for diagnosis in found.sheet.diagnoses.values()} == {"unwritten"}


def test_mistakes_are_named_and_right_functions_earn_their_points(three):
    text = joined(text_of(three.sheet, "impulse"))
    assert "r × ω turns the points the other way round. Hint: A wheel turns to the left" in text
    assert "The bodies cannot turn: the two terms with the inertia are missing." in text
    assert "+J went to both bodies, as the slide prints it: momentum is not conserved." in text
    points = {entry["name"]: (entry["got"], entry["possible"]) for entry in three.content()["functions"]}
    assert points["edge_edge_normal"] == (5, 5)
    assert points["collide"][0] == 0
    assert all(got < possible for name, (got, possible) in points.items() if name != "edge_edge_normal")


def test_a_student_sees_the_call_the_answer_and_what_physics_says(three):
    text = text_of(three.sheet, "impulse")
    assert "\n        gives   1\n        physics -1\n" in text
    assert all(len(line) <= 80 for line in text.splitlines())


def test_the_smallest_example_that_gains_momentum_is_small(three):
    said = next(
        part.said for outcome in three.sheet.outcomes for part in outcome.parts if part.reason == "momentum is kept"
    )
    assert said.startswith("the two together gain a momentum of [2. 2. 2.] kg m/s\nfor body_a=((1, 1, 1), (1, 1, 1)")


def test_a_hidden_test_reveals_no_number(three):
    hidden = [outcome for outcome in three.sheet.outcomes if outcome.hidden and not outcome.passed]
    said = {part.said for outcome in hidden for part in outcome.parts if not part.passed}
    assert hidden
    assert said <= {"the answer is wrong", "the function is not written yet", "the function raised an exception"}


@pytest.mark.slow
def test_grading_again_gives_the_same_grade(three, grader, tmp_path):
    (tmp_path / "three.py").write_text(THREE_MISTAKES)
    assert grade(tmp_path / "three.py", grader=grader).content() == three.content()


@pytest.mark.slow
def test_a_function_that_never_returns_is_stopped_and_the_rest_is_graded(grader, tmp_path, monkeypatch):
    monkeypatch.setattr(grader, "limits", Limits(call=0.6))
    (tmp_path / "lab.py").write_text(ENDLESS)
    found = grade(tmp_path / "lab.py", grader=grader)
    assert found.sheet.diagnoses["count_impacts"].verdict == "too slow"
    text = joined(text_of(found.sheet, "detection"))
    assert "✓ side_of_plane" in text
    assert "gave no answer within 0.6 s and was stopped → Does every loop in it come to an end" in text
    hidden = [outcome for outcome in found.sheet.outcomes if outcome.hidden and outcome.function == "count_impacts"]
    assert [outcome.parts[0].said for outcome in hidden] == ["the function took too long"]


def test_a_machine_that_is_too_busy_for_the_diagnosis_makes_no_grade(grader, tmp_path, monkeypatch):
    (tmp_path / "lab.py").write_text("def side_of_plane(separation, tolerance=0.0):\n    return 7\n")
    budget = Budget()

    def in_line(*given):
        budget.until = 0.0
        budget.refuse_if_overdue()

    monkeypatch.setattr(outcomes, "diagnose", in_line)
    with pytest.raises(MachineBusy):
        run(tmp_path / "lab.py", ("detection",), ("visible",), grader, budget=budget)


def test_no_process_is_left_once_a_grade_is_made(graded_alone):
    assert graded_alone[1] == set()
