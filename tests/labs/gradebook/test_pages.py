"""Pages of a class: what a student reads, and what an instructor may show."""

from __future__ import annotations

import math
import re

import pytest

from labs.gradebook.deadlines import Deadlines, Lateness
from labs.gradebook.in_common import items, mistakes, weakest
from labs.gradebook.marking import Given
from labs.gradebook.pages import class_page, student_page
from labs.gradebook.roster import Student
from labs.gradebook.tables import Mark
from labs.gradebook.written import questions
from labs.grading.diagnosis.misconceptions import read_bank

KNOWN = next(entry for entry in read_bank() if entry.function == "normal_velocity")
HOSTILE = Student("<script>1</script>", "<img src=x onerror=alert(1)>")


def function(name: str, got: int, verdict: str, mistakes: tuple[str, ...] = ()) -> dict:
    return {
        "name": name, "topic": "impulse", "got": got, "possible": 6, "verdict": verdict, "mistakes": list(mistakes),
        "message": "gives <b>3</b>",
    }  # fmt: skip


def content(*functions: dict) -> dict:
    test = {
        "function": "normal_velocity", "title": "points that approach have a negative normal velocity", "passed": False,
        "got": 1, "possible": 3, "rationale": "It is a rate.", "help": "Slides 14 and 15.",
    }  # fmt: skip
    marks = {"functions": {"reached": 7, "possible": 66}, "written questions": {"reached": None, "possible": 19}}
    return {
        "identity": {"file": "a<b>.ipynb"}, "functions": list(functions), "tests": [test], "marks": marks,
        "got": sum(each["got"] for each in functions), "points": 10.0,
        "complaints": ["collide is defined 2 times; the one at cell <3> counts"],
    }  # fmt: skip


WRONG = content(function("normal_velocity", 1, "named", (KNOWN.id,)), function("collide", 0, "unwritten"))
RIGHT = content(function("normal_velocity", 6, "right"), function("collide", 6, "right"))
HALF = content(function("normal_velocity", 2, "named", (KNOWN.id,)), function("collide", 6, "right"))


def test_a_student_reads_what_is_wrong_where_to_read_on_and_what_it_cost():
    late = Lateness(2, 0.8, "3 days late, 1 of them free")
    key = questions("impulse")[0].key
    page = student_page(
        Mark(HOSTILE, "impulse", 50.0, 35.0, late, WRONG), questions("impulse"), {key: Given(2.5, "<i>good</i>")}
    )
    text = re.sub(r"\s+", " ", re.sub(r"<[^>]*>", "", page))
    assert "40.0 of 100 points; the written questions, 35 points, are still to be marked." in text
    assert "It came 3 days late, 1 of them free, so 80 % of the points are left." in text
    assert "About your file collide is defined 2 times; the one at cell &lt;3&gt; counts" in text
    assert "normal_velocity: not right yet gives &lt;b&gt;3&lt;/b&gt;" in text
    assert (
        "Points that approach have a negative normal velocity: 1 of 3 points. It is a rate. Read on: Slides 14" in text
    )
    assert "1. Newton&#39;s third law: 2.5 of 3 points &lt;i&gt;good&lt;/i&gt;" in text
    assert "If you think that a mark is wrong Write to your instructor: name the function" in text
    assert "<script>" not in page
    assert "<img" not in page


def test_who_handed_in_nothing_reads_that():
    page = student_page(Mark(HOSTILE, "impulse", None, notes=("nothing handed in",)), (), {})
    assert "There is no grade: nothing handed in." in page


def test_the_page_of_the_class_has_no_names_and_counts_each_mistake_once_a_student():
    marks = [
        Mark(Student(f"s{at}", "Ada"), "impulse", at * 30.0, content=each)
        for at, each in enumerate((WRONG, HALF, RIGHT))
    ]
    marks.append(Mark(HOSTILE, "impulse", None))
    page = class_page("impulse", marks, {"ABCDE": 2.25})
    assert "3 of 4 students" in page
    assert "th { overflow-wrap: normal; }" in page  # a heading over a narrow column is not broken within a word
    assert "The median is 30 of 100 points." in page
    assert "Ada" not in page
    assert "<script>" not in page
    assert "no evidence that somebody copied" in page
    assert "ABCDE" in page
    assert mistakes([WRONG, HALF, RIGHT])[0].students == 2
    assert mistakes([WRONG, HALF, RIGHT])[0].rationale == KNOWN.rationale


def test_a_student_reads_whom_to_ask_and_for_how_long_if_the_course_says_so():
    mark = Mark(HOSTILE, "impulse", 50.0, content=WRONG)
    page = student_page(mark, (), {}, rules=Deadlines(contact="Ada <ada@example.org>", days_to_ask=14))
    assert "Write to Ada &lt;ada@example.org&gt; within 14 days: name" in page


def test_who_hands_in_a_python_file_reads_what_it_lacks_and_so_does_the_class():
    file = WRONG | {"identity": {"file": "a.PY"}, "answers": {"third-law": ""}}
    page = " ".join(student_page(Mark(HOSTILE, "impulse", 9.0, content=file), (), {}).split())
    assert "can reach 45 of the 100 points: the written answers (35 points), the inputs (15)" in page
    assert "You handed in a Python file" not in student_page(Mark(HOSTILE, "impulse", 9.0, content=WRONG), (), {})
    marks = [Mark(Student(str(at)), "impulse", 9.0, content=each) for at, each in enumerate((file, file, WRONG))]
    assert "2 of the 3 students handed in a Python file instead of the notebook" in class_page("impulse", marks, {})


def test_what_waits_for_another_function_is_not_called_a_mistake():
    waits = content(
        function("normal_velocity", 1, "named", (KNOWN.id,)), function("collide", 2, "calls a wrong function")
    )
    late = content(function("normal_velocity", 6, "right"), function("collide", 0, "not tried"))
    found = {item.name: item for item in items("impulse", [waits, late, RIGHT])}
    assert (found["collide"].tried, found["collide"].right, found["collide"].wrong, found["collide"].waits) == (
        3,
        1,
        0,
        2,
    )
    marks = [Mark(Student(str(at)), "impulse", 9.0, content=each) for at, each in enumerate((waits, late, RIGHT))]
    text = " ".join(class_page("impulse", marks, {}).split())
    assert "Of 3 who wrote <code>normal_velocity</code> (step 2), 1 have a mistake in it." in text
    assert weakest(items("impulse", [late])) is None


def test_a_mistake_of_one_student_is_counted_but_not_listed():
    other = next(entry for entry in read_bank() if entry.function == "collide")
    once = content(function("normal_velocity", 6, "right"), function("collide", 1, "named", (other.id,)))
    marks = [Mark(Student(str(at)), "impulse", 9.0, content=each) for at, each in enumerate((WRONG, HALF, once))]
    page = class_page("impulse", marks, {})
    assert KNOWN.id in page
    assert other.id not in page
    assert "One other known mistake was made by one student." in page
    alone = class_page("impulse", marks[:1], {})
    assert KNOWN.id not in alone
    assert "One known mistake was made by one student." in alone


def test_an_inherited_mistake_says_what_it_comes_from_and_is_not_counted_twice():
    inherited = f"collide < {KNOWN.id}"
    both = content(function("normal_velocity", 1, "named", (KNOWN.id,)), function("collide", 2, "named", (inherited,)))
    alone = content(function("normal_velocity", 6, "right"), function("collide", 2, "named", (inherited,)))
    assert [(each.id, each.students) for each in mistakes([both])] == [(KNOWN.id, 1)]
    (found,) = mistakes([alone])
    assert found.id == "collide with a wrong normal_velocity"
    assert found.rationale == f"It would be right itself, but uses a wrong normal_velocity: {KNOWN.rationale}"


def test_an_item_says_who_has_it_right_and_what_it_tells():
    found = {item.name: item for item in items("impulse", [WRONG, HALF, RIGHT])}
    velocity, collide = found["normal_velocity"], found["collide"]
    assert (velocity.tried, velocity.right, velocity.share) == (3, 1, pytest.approx(0.5))
    assert (collide.tried, collide.right) == (2, 2)
    assert collide.tells == pytest.approx(2 / math.sqrt(28 / 3))  # of (0, 1, 1) and (1, 2, 6)
    assert found["audit"].tells is None
    assert weakest(list(found.values())).name == "normal_velocity"
    assert weakest(items("impulse", [RIGHT])) is None
