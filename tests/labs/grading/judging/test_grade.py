"""What a sheet adds up and a grade's file says of it: every point once, and none for what was lost."""

from __future__ import annotations

import json
import os
import stat

import pytest

from labs.grading.budget import SECONDS
from labs.grading.diagnosis.findings import Diagnosis
from labs.grading.diagnosis.fingerprints import known
from labs.grading.diagnosis.words import told
from labs.grading.judging import grade as grading
from labs.grading.judging.grade import Grade, grade, read_grade
from labs.grading.judging.score_sheet import Outcome, Part, Sheet
from labs.grading.submission.cells import Complaint
from reference.errors import InvalidInput

KEPT, LOST = Part(2, "at rest"), Part(3, "the sign", "gives 1")
SIGN = known("impulse_magnitude").mistakes[0]
SHEET = Sheet(
    "lab.py",
    [Complaint("collide is missing", kind="missing")],
    tier="limits",
    missing=("no filter",),
    skipped=["no solutions", "no solutions"],
    outcomes=[
        Outcome("test_a_ball_bounces", 6, False, parts=(KEPT, LOST), function="impulse_magnitude"),
        Outcome("test_it_bounces_twice", 4, True, hidden=True, rationale="why", function="impulse_magnitude"),
        Outcome("test_touching", 2, False, True, "the answer is wrong", "why", "look", function="side_of_plane"),
        Outcome("test_all_together", 1, False, said="no"),
        Outcome("test_v", 7, True, parts=(Part(7, "all"),), function="normal_velocity"),
    ],
    diagnoses={"impulse_magnitude": Diagnosis("impulse_magnitude", "named", (SIGN,))},
)
GRADE = Grade(("impulse", "detection"), SHEET)


@pytest.mark.parametrize(
    ("passed", "parts", "earned"),
    [
        (True, (), 4),
        (True, (KEPT,), 4),
        (False, (), 0),
        (False, (KEPT, LOST), 2),
        (False, (LOST, LOST), 0),
        (False, (KEPT, Part(1, "again"), LOST), 3),
        (False, (Part(9, "more than all"), LOST), 4),
    ],
)
def test_a_failed_test_earns_its_passed_parts_up_to_its_points(passed, parts, earned):
    assert Outcome("test_x", 4, passed, parts=parts).earned == earned


def test_a_sheet_adds_up_points_and_names_each_losing_function_once():
    assert (SHEET.earned, SHEET.points) == (2 + 4 + 0 + 0 + 7, 6 + 4 + 2 + 1 + 7)
    assert SHEET.lost == ["impulse_magnitude", "side_of_plane"]


def test_lost_points_are_listed_part_by_part_and_passed_tests_not():
    assert [*SHEET.outcomes[0].lines()] == ["a ball bounces: 2 of 6", "2 of 2 for at rest", "0 of 3 for the sign"]
    assert [*SHEET.outcomes[2].lines()] == ["touching: 0 of 2", "the answer is wrong", "why", "look"]
    assert [*SHEET.outcomes[4].lines()] == []


def test_a_grade_lists_points_by_test_part_function_and_topic():
    content = GRADE.content()
    said = ("schema", "version", "submission", "tier", "missing", "left_out", "complaints")
    assert {name: content[name] for name in said} == {
        "schema": "collisions-lab/grade", "version": 1, "submission": "lab.py", "tier": "limits",
        "missing": ["no filter"], "left_out": {"no solutions": 2},
        "complaints": ["collide is missing"],
    }  # fmt: skip
    assert (content["got"], content["possible"]) == (13, 20)
    assert content["topics"] == [
        {"name": "impulse", "got": 13, "possible": 17},
        {"name": "detection", "got": 0, "possible": 2},
    ]
    named = {
        "topic": "impulse", "verdict": "named", "suspect": False, "mend_first": [], "mistakes": [SIGN.id],
        "message": told(SHEET.diagnoses["impulse_magnitude"]),
    }  # fmt: skip
    right = {"verdict": "right", "suspect": False, "mend_first": [], "mistakes": [], "message": ""}
    assert content["functions"] == [
        {"name": "impulse_magnitude", "got": 6, "possible": 10, **named},
        {"name": "side_of_plane", "got": 0, "possible": 2, "topic": "detection", **right, "verdict": "wrong"},
        {"name": "normal_velocity", "got": 7, "possible": 7, "topic": "impulse", **right},
    ]
    rebound, _, touching, together, _ = content["tests"]
    assert rebound == {
        "name": "test_a_ball_bounces", "title": "a ball bounces", "function": "impulse_magnitude", "topic": "impulse",
        "hidden": False, "passed": False, "got": 2, "possible": 6, "message": "", "rationale": "", "help": "",
        "parts": [
            {"reason": "at rest", "got": 2, "possible": 2, "message": ""},
            {"reason": "the sign", "got": 0, "possible": 3, "message": "gives 1"},
        ],
    }  # fmt: skip
    assert touching == {
        "name": "test_touching", "title": "touching", "function": "side_of_plane", "topic": "detection",
        "hidden": True, "passed": False, "got": 0, "possible": 2, "message": "the answer is wrong",
        "rationale": "why", "help": "look", "parts": [],
    }  # fmt: skip
    assert (together["function"], together["topic"], together["message"]) == ("", "", "no")


def test_a_grade_is_written_as_it_is_read(tmp_path):
    made = Grade(("impulse",), Sheet("größe.py"))
    made.write(str(tmp_path / "grade.json"))
    text = (tmp_path / "grade.json").read_text(encoding="utf-8")
    assert read_grade(str(tmp_path / "grade.json")) == json.loads(text) == made.content()
    assert '\n "submission": "größe.py",\n' in text
    assert text.endswith("}\n")


def test_only_its_owner_can_read_a_grade(tmp_path):
    GRADE.write(tmp_path / "grade.json")
    content = read_grade(tmp_path / "grade.json")
    assert content == json.loads(json.dumps(GRADE.content()))
    assert (content["schema"], content["version"]) == ("collisions-lab/grade", 1)
    assert content["got"] == sum(test["got"] for test in content["tests"]) == sum(t["got"] for t in content["topics"])
    assert all(type(test[key]) is int for test in content["tests"] for key in ("got", "possible"))
    assert stat.S_IMODE(os.stat(tmp_path / "grade.json").st_mode) == 0o600
    assert [path.name for path in tmp_path.iterdir()] == ["grade.json"]


def test_a_grade_that_cannot_be_written_leaves_the_old_one(tmp_path, monkeypatch):
    (tmp_path / "grade.json").write_text("old")
    monkeypatch.setattr(grading.os, "replace", lambda *_: (_ for _ in ()).throw(OSError("no space")))
    with pytest.raises(OSError, match="no space"):
        GRADE.write(tmp_path / "grade.json")
    assert [path.name for path in tmp_path.iterdir()] == ["grade.json"]
    assert (tmp_path / "grade.json").read_text() == "old"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[]", "is no grade"),
        ("{", "is no grade"),
        ('{"schema": "collisions-lab/grade", "version": 2}', "is collisions-lab/grade 2, not collisions-lab/grade 1"),
        ('{"schema": "other", "version": 1}', "is other 1, not"),
    ],
)
def test_a_file_that_is_no_grade_is_refused(text, says, tmp_path):
    (tmp_path / "grade.json").write_text(text)
    with pytest.raises(InvalidInput, match=says):
        read_grade(tmp_path / "grade.json")


def test_a_file_without_functions_is_graded_only_for_a_named_topic(tmp_path):
    (tmp_path / "lab.py").write_text("x = 3\n")
    for topics in (None, ()):
        with pytest.raises(InvalidInput, match=r"^lab\.py defines no function of the lab; name the topic"):
            grade(tmp_path / "lab.py", topics)


def test_only_the_named_topics_are_graded(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(grading, "run", lambda *given, budget: asked.append((*given, budget.seconds)) or SHEET)
    path = tmp_path / "lab.py"
    path.write_text("def side_of_plane(separation, tolerance=0.0):\n    return separation < tolerance\n")
    assert grade(path, ["impulse", "friction"]).topics == ("impulse", "friction")
    assert grade(path, folders=("visible",), seconds=5).topics == ("detection",)
    assert asked == [
        (path, ("impulse", "friction"), ("visible", "hidden"), None, SECONDS),
        (path, ("detection",), ("visible",), None, 5),
    ]  # fmt: skip
