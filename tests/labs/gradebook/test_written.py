"""Written questions of a class: collected with names hidden, marked in a table, and read back."""

from __future__ import annotations

import csv

import pytest
from submissions import solved_notebook

from labs.gradebook.marking import Given, read_table
from labs.gradebook.written import (
    POINTS,
    Codes,
    agreement,
    answers_in,
    given_to,
    questions,
    read_tables,
    write_questions,
)
from labs.project_folders import STUDENT_NOTEBOOKS
from reference.errors import InvalidInput

ASKED = questions("impulse")
POSSIBLE = {question.key: question.points for question in ASKED}
KEYS = [*POSSIBLE]
ANSWERS = {f"{number}": {KEYS[0]: f"<b>{number}</b>", KEYS[1]: "" if number == 3 else "=yes"} for number in range(25)}


def fill(path, change) -> None:
    with open(path, encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, lines[0])
        writer.writeheader()
        writer.writerows(line | change(line) for line in lines)


@pytest.fixture
def folder(tmp_path):
    write_questions(tmp_path, "impulse", ANSWERS)
    return tmp_path / "questions"


def test_questions_have_their_points_their_rubric_and_their_heading():
    assert sum(question.points for question in ASKED) == 19
    assert ASKED[0].title == "1. Newton's third law"
    assert all("*1 point*" in question.model for question in ASKED)


def test_an_answer_is_what_stands_in_its_cell_without_what_the_lab_wrote_there(tmp_path):
    assert set(answers_in(STUDENT_NOTEBOOKS / "impulse.ipynb", KEYS).values()) == {""}
    (tmp_path / "solved.ipynb").write_bytes(solved_notebook("impulse"))
    solved = answers_in(tmp_path / "solved.ipynb", KEYS)
    assert ASKED[2].model.split("\n")[0] in solved[KEYS[2]]


def test_no_page_or_table_has_a_name_and_a_page_escapes_what_students_write(folder):
    page = (folder / f"{KEYS[0]}.html").read_text(encoding="utf-8")
    assert "&lt;b&gt;24&lt;/b&gt;" in page
    assert "<b>24" not in page
    codes = Codes(folder.parent)
    assert len({codes(student) for student in ANSWERS}) == len(ANSWERS)
    assert codes("1") == Codes(folder.parent)("1")
    orders = [codes.order(ANSWERS, key) for key in KEYS[:2]]
    assert orders[0] != orders[1]
    assert sorted(orders[0]) == sorted(orders[1]) == sorted(ANSWERS)


def test_a_question_that_nobody_answered_asks_for_no_points(tmp_path):
    write_questions(tmp_path, "impulse", {"1": {KEYS[0]: "yes"}, "2": {}, "3": {}}, code_alone=2)
    answered, empty = ((tmp_path / "questions" / f"{key}.html").read_text(encoding="utf-8") for key in KEYS[:2])
    assert "1 of 3 students answered. Write the points beside each code" in answered
    assert "None of 3 students answered, so there is nothing to mark here." in empty
    assert "Write the points" not in empty
    assert "2 of the 3 handed in a Python file, which holds no written answers." in empty


def test_what_a_marker_filled_in_comes_back_and_is_never_overwritten(folder):
    fill(
        folder / POINTS,
        lambda line: {"points": "2,5", "comment": "=well, “seen”"} if line["question"] == KEYS[0] else {},
    )
    for _ in range(2):
        write_questions(folder.parent, "impulse", ANSWERS)
        found = read_table(folder / POINTS, POSSIBLE).given
        codes = Codes(folder.parent)
        assert found[KEYS[0], codes("7")] == Given(2.5, "=well, “seen”")
        assert found[KEYS[1], codes("7")] == Given(None, "")
        assert (KEYS[1], codes("3")) not in found  # nothing was answered there
    write_questions(folder.parent, "impulse", {"1": ANSWERS["1"]})  # the wrong folder: only one student is in it
    write_questions(folder.parent, "impulse", ANSWERS)
    assert read_table(folder / POINTS, POSSIBLE).given == found


def test_points_count_once_every_answer_of_a_student_is_marked(folder):
    codes, found = Codes(folder.parent), {}
    assert given_to("7", codes, ASKED, found, ANSWERS["7"]) is None
    found[KEYS[0], codes("7")] = Given(2.0)
    assert given_to("7", codes, ASKED, found, ANSWERS["7"]) is None
    found[KEYS[1], codes("7")] = Given(1.0)
    assert given_to("7", codes, ASKED, found, ANSWERS["7"]) == 3.0
    assert given_to("9", codes, ASKED, found, {}) == 0.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"points": "4"}, rf"line 2 of points.csv gives 4 points; the question {KEYS[0]} has 3"),
        ({"points": "-1"}, "gives -1 points"),
        ({"points": "nan"}, "has 'nan' points: write a number"),
        ({"points": "2", "code": ""}, "line 2 of points.csv has no code; .* There are 44 others like these"),
        ({"points": "good"}, "has 'good' points: write a number"),
        ({"question": "other"}, "has the question 'other'"),
    ],
)
def test_a_line_that_cannot_be_meant_is_named(folder, change, said):
    fill(folder / POINTS, lambda line: change)
    with pytest.raises(InvalidInput, match=said):
        read_table(folder / POINTS, POSSIBLE)


def test_every_tenth_answer_goes_to_a_second_marker_and_their_agreement_is_said(folder):
    first, second = (table.given for table in read_tables(folder.parent, "impulse", ANSWERS))
    assert len(first) == 49
    assert len(second) == 5
    assert set(second) < set(first)
    assert agreement(first, second) == ""
    first = dict.fromkeys(first, Given(2.0))
    apart = dict(zip(second, (Given(2.0), Given(2.0), Given(3.0), Given(2.5), Given(None)), strict=True))
    assert agreement(first, apart) == (
        "Two markers agree about 2 of 4 answers; the second gives 0.38 points more on average,"
        " and they are at most 1 apart."
    )
