"""Grades in the formats of Gradescope, Classroom 50, PrairieLearn and nbgrader, and checks that refuse wrong ones."""

from __future__ import annotations

import json
import re
from copy import deepcopy
from datetime import UTC, datetime

import pytest
from made_platform_grades import HIDDEN_TITLE, HOSTILE, grade, unreadable

from labs.gradebook.marking import Given
from labs.gradebook.platforms import classroom50, gradescope, nbgrader, prairielearn
from labs.gradebook.platforms.lines import lines
from labs.gradebook.platforms.running import FAILED, run, written
from labs.gradebook.written import Question
from labs.grading.errors import GraderFailed
from reference.errors import InvalidInput

RUNNER = {
    "CLASSROOM": "physics", "ASSIGNMENT": "impulse", "SUBMISSION_TAG": "submit/2026-11-01T10-00-00Z-abc",
    "COMMIT_URL": "https://a/commit/1", "RELEASE_URL": "https://a/releases/1", "OWNER": "ada",
}  # fmt: skip
NOW = datetime(2026, 11, 1, 10, 0, 5, tzinfo=UTC)
ASKED = (Question("third-law", "Third law", "?", "!", 3), Question("weight", "Weight", "?", "!", 3))
POINTS = {"collide": 6, "audit": 6, "apply_impulse": 3}


def of_gradescope(content):
    return gradescope.result(content, 1.234)


def of_classroom50(content):
    return classroom50.result(content, RUNNER, NOW)


def of_nbgrader(content):
    given = {"ada": {"third-law": Given(2.5, HOSTILE), "weight": Given(None)}}
    return nbgrader.marks("impulse", POINTS, {"ada": content}, given, ASKED)


FORMATS = {
    "gradescope": (of_gradescope, gradescope.CHECK),
    "classroom50": (of_classroom50, classroom50.CHECK),
    "prairielearn": (prairielearn.result, prairielearn.CHECK),
    "nbgrader": (of_nbgrader, nbgrader.CHECK),
}
EVERY = pytest.mark.parametrize("platform", FORMATS)


@EVERY
@pytest.mark.parametrize("content", [grade(), grade(said=""), unreadable()], ids=["wrong", "quiet", "unreadable"])
def test_a_grade_has_the_shape_that_the_platform_takes(platform, content):
    made, check = FORMATS[platform]
    before = deepcopy(content)
    result = made(content)
    assert list(check(result, "")) == []
    assert json.loads(json.dumps(result, allow_nan=False)) == result
    assert content == before


def test_on_gradescope_the_points_of_the_lines_are_the_score():
    found = of_gradescope(grade())
    assert found["score"] == 42
    assert sum(test["score"] for test in found["tests"]) == pytest.approx(42)
    assert sum(test["max_score"] for test in found["tests"]) == pytest.approx(65)
    assert [test["status"] for test in found["tests"]] == ["failed", "failed", "passed", "failed", "failed", "passed"]
    assert [test["number"] for test in found["tests"]] == ["1.1", "1.2", "2.1", "3.1", "4", "5"]
    assert found["extra_data"]["mistakes"] == {"collide": ["reversed-order"]}


def test_gradescope_shows_hidden_tests_when_grades_are_published_and_says_nothing_of_them_before():
    content = grade()
    found = of_gradescope(content)
    visible = {test["name"]: test["visibility"] == "visible" for test in found["tests"]}
    hidden = [test for test in content["tests"] if test["hidden"]]
    assert [visible[f"{test['function']}: {test['title']}"] for test in hidden] == [False] * len(hidden)
    before = json.dumps([found["output"], [test for test in found["tests"] if test["visibility"] == "visible"]])
    assert HIDDEN_TITLE not in before
    assert "apply_impulse" not in before  # only hidden tests of it failed
    assert "the order is wrong" in before


def test_no_name_of_a_student_is_sent_to_gradescope():
    assert "=Ada" not in json.dumps(of_gradescope(grade()))


def test_classroom_50_gets_whole_points_of_visible_tests_alone():
    found = of_classroom50(grade())
    assert (found["score"], found["max-score"]) == (7, 9)
    assert [test["test-name"] for test in found["tests"]] == [
        "collide: a collision keeps momentum",
        "audit: what is lost",
    ]
    assert (found["owner"], found["review"], found["datetime"]) == ("ada", "https://a/commit/1", "2026-11-01T10:00:05Z")
    body = classroom50.body(grade(), "impulse")
    assert "7 of 9 points" in body
    assert HIDDEN_TITLE not in body


def test_classroom_50_is_told_which_variable_its_runner_has_not_set():
    with pytest.raises(InvalidInput, match="has not set SUBMISSION_TAG, COMMIT_URL"):
        classroom50.result(grade(), {**RUNNER, "SUBMISSION_TAG": "", "COMMIT_URL": ""}, NOW)


def test_prairielearn_gets_the_share_of_what_needs_no_person():
    found = prairielearn.result(grade())
    assert found["score"] == pytest.approx(42 / 65, abs=5e-5)  # four digits are kept
    assert [test["description"] for test in found["tests"][:2]] == ["", "Its inputs are hidden."]
    assert sum(test["max_points"] for test in found["tests"]) == pytest.approx(65)


def test_on_prairielearn_a_file_that_cannot_be_read_costs_no_attempt():
    found = prairielearn.result(unreadable("it is empty"))
    assert found == {"gradable": False, "format_errors": ["it is empty"]}


def test_nbgrader_gets_the_points_of_each_function_and_of_marked_answers():
    student = of_nbgrader(grade())["students"]["ada"]
    assert {name: score["got"] for name, score in student["scores"].items()} == {
        "check-collide": 3, "check-audit": 6, "check-apply_impulse": 0,
    }  # fmt: skip
    assert set(student["comments"]) == {"collide", "apply_impulse"}
    assert {key: answer["points"] for key, answer in student["answers"].items()} == {"answer-third-law": 2.5}
    assert all(line.startswith("    ") for line in student["answers"]["answer-third-law"]["comment"].splitlines())


def test_an_unreadable_file_gets_nothing_on_nbgrader_and_every_function_says_why():
    student = of_nbgrader(unreadable("it is empty"))["students"]["ada"]
    assert {score["got"] for score in student["scores"].values()} == {0}
    assert all("it is empty" in said for said in student["comments"].values())
    assert set(student["comments"]) == set(POINTS)


def test_a_kind_of_work_that_a_lab_has_nothing_of_gives_its_points_to_everybody():
    content = grade()
    content["marks"]["inputs found"] = {"reached": 0, "possible": 0}
    (line,) = (each for each in lines(content) if each.kind == "inputs found")
    assert line.passed
    assert (of_gradescope(content)["tests"][4]["score"], of_gradescope(content)["tests"][4]["max_score"]) == (15, 15)


WRONG = {
    "gradescope": [
        ({"score": -1}, "score is -1"),
        ({"score": True}, "score is True"),
        ({"score": float("nan")}, "score is nan"),
        ({"score": 66}, "from 0 to 65"),
        ({"stdout_visibility": "visible"}, "has to be one of hidden"),
        ({"visibilty": "visible"}, "'visibilty', which the platform does not know"),
        ({"tests": {}}, "tests is no list"),
        ({"tests": [{"name": "a", "score": 2, "max_score": 1}]}, r"tests\[0\].score is 2, more than max_score, 1"),
        ({"tests": [{"name": "a\nb", "score": 1, "max_score": 1}]}, "has to be one line"),
        ({"tests": [{"name": "a", "score": 1}]}, r"tests\[0\] lacks max_score"),
        ({"output": "\ud800"}, "half a character"),
        ({"output_format": "markdown"}, "one of text, html"),
    ],
    "classroom50": [
        ({"schema": "classroom50/result/v2"}, "schema"),
        ({"score": 1.0}, "whole number"),
        ({"score": 10}, "more than max-score, 9"),
        ({"submission": "main"}, "has to be like submit/"),
        ({"datetime": "2026-11-01"}, "datetime"),
        ({"owner": ""}, "owner is ''"),
        ({"tests": [{"test-name": "a", "passed": 1, "score": 0, "max-score": 0}]}, "true or false"),
    ],
    "prairielearn": [
        ({"score": 1.01}, "from 0 to 1"),
        ({"score": "1"}, "has to be a number"),
        ({"gradable": False}, "which the platform does not know"),
        ({"tests": [{"name": "a", "points": 2, "max_points": 1}]}, "more than max_points"),
    ],
    "nbgrader": [
        ({"lab": ""}, "lab is ''"),
        ({"students": {"a": {"sha256": "", "scores": {}, "comments": {}, "answers": {}}}}, "has to be like"),
        ({"students": {"a": {"scores": {"check-a": {"got": 2, "possible": 1}}}}}, "more than possible"),
    ],
}  # fmt: skip


@pytest.mark.parametrize(
    ("platform", "change", "said"), [(name, *each) for name, changes in WRONG.items() for each in changes]
)
def test_a_wrong_result_is_refused(platform, change, said):
    made, check = FORMATS[platform]
    assert any(re.search(said, line) for line in check({**made(grade()), **change}, ""))


@EVERY
@pytest.mark.parametrize("nothing", [None, [], "", 1])
def test_what_is_no_table_is_no_result(platform, nothing):
    assert list(FORMATS[platform][1](nothing, ""))


def test_a_result_of_the_wrong_shape_is_not_written(tmp_path):
    path = tmp_path / "results.json"
    with pytest.raises(GraderFailed, match="score is 66"):
        written({**of_gradescope(grade()), "score": 66}, gradescope.CHECK, path)
    assert list(tmp_path.iterdir()) == []


def test_a_grader_that_fails_ends_with_an_exit_code(capsys):
    def fails():
        raise GraderFailed("no tests\n::error::a command of the runner")

    assert run(fails) == FAILED
    assert capsys.readouterr().err == "Error: no tests ::error::a command of the runner\n"


@pytest.mark.parametrize(
    ("text", "number"), [('{"id": 12}', "12"), ("{", ""), ("[1]", ""), ("{}", ""), ("[" * 100000, ""), (None, "")]
)
def test_metadata_that_gradescope_did_not_write_is_no_reason_to_fail(tmp_path, text, number):
    path = tmp_path / "submission_metadata.json"
    if text is not None:
        path.write_text(text, encoding="utf-8")
    assert gradescope.submission_id(path) == number
