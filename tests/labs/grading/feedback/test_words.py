"""What a student reads: numbers, diagnoses, and the report on a file, line by line."""

from __future__ import annotations

import math

import numpy as np
import pytest

from labs.grading.diagnosis.deviations import Answer, Right
from labs.grading.diagnosis.findings import Counterexample, Diagnosis
from labs.grading.diagnosis.fingerprints import known
from labs.grading.diagnosis.probes.probe import usual
from labs.grading.diagnosis.words import MOST, called, compared, shown, told
from labs.grading.feedback.report import RIGHT, TO_DO, WRONG, all_right, report, state
from labs.grading.judging.score_sheet import Outcome, Part, Sheet
from labs.grading.submission.cells import Complaint
from reference import lecture

FIRST, SECOND = known("rebound_velocity").mistakes[:2]
EXAMPLE = Counterexample(
    "rebound_velocity", usual("down", -2.0, 0.5), ("v", "e"), Answer(-1.0), Right((np.array(1.0),), (1.0,))
)


# Numbers


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (1 / 3, "0.333333"),
        (-0.0, "0"),
        (1e-12, "1e-12"),
        (math.inf, "inf"),
        (True, "True"),
        (np.array([True, False]), "(True, False)"),
        ([1, 2.5], "(1, 2.5)"),
        (((1.0, 2), np.zeros(2)), "((1, 2), (0, 0))"),
        ("up", "'up'"),
        (np.zeros(MOST), f"({', '.join(['0'] * MOST)})"),
        (np.zeros((1, MOST + 1)), f"an array (1, {MOST + 1})"),
        (np.array([[1.0, 0.0], [2.0, 1.0]]), "((1, 0), (2, 1))"),
        (np.diag([1.0, 2.0]), "diag(1, 2)"),
        (np.eye(2, dtype=bool), "((True, False), (False, True))"),
        (np.zeros((2, 3)), "((0, 0, 0), (0, 0, 0))"),
        (np.ones((1, 1)), "((1))"),
    ],
)
def test_a_value_is_shown_in_few_digits_and_a_long_array_by_its_shape(value, words):
    assert shown(value) == words


def test_arguments_are_told_by_name_as_many_as_there_are():
    assert called(("v", "e"), (-2.0, np.ones(2))) == "v=-2, e=(1, 1)"
    assert called(("v", "e"), (-2.0,)) == "v=-2"


@pytest.mark.parametrize(
    ("answer", "right", "came"),
    [
        (Answer(2), (1.0,), "2"),
        (Answer((2, [1, 2])), (1.0, [1.0, 1.0]), "2, (1, 2)"),
        (Answer(error="ValueError: no"), (1.0,), "ValueError: no"),
        (Answer("up"), (1.0,), "the text 'up' instead of a number or an array"),
        (Answer(2.0), (1.0, 1.0), "one float instead of 2 arrays"),
        (Answer([2.0]), (1.0,), "(2) of shape (1,) instead of ()"),
        (Answer(([2.0], 1.0)), (1.0, 1.0), "(2), 1 of shape (1,), () instead of (), ()"),
    ],
)
def test_what_came_stands_above_what_physics_says(answer, right, came):
    arrays = tuple(np.asarray(each) for each in right)
    physics = ", ".join(shown(each) for each in arrays)
    assert compared(answer, Right(arrays, (1.0,) * len(arrays))) == f"gives   {came}\nphysics {physics}"


# A diagnosis


def words(verdict, *mistakes, **more):
    return " ".join(told(Diagnosis("f", verdict, mistakes, **more)).split())


def test_each_verdict_has_its_words():
    assert words("right") == "f: right on every probe."
    assert words("unwritten", crashes=("no",), accepted=("less",)) == "f: not written yet."
    assert words("crashes", crashes=("no",)) == "f: it ends in an error."
    assert words("named", FIRST) == f"f: {FIRST.rationale} Hint: {FIRST.help}"
    assert words("likely", FIRST).endswith(f"is wrong besides. - {FIRST.rationale} Hint: {FIRST.help}")
    several = words("several", FIRST, SECOND)
    assert several.endswith(f"and do not say which it is: - {FIRST.rationale} - {SECOND.rationale}")
    assert "Hint" not in several
    for verdict in ("shape", "one at a time", "unknown"):
        assert words(verdict).startswith("f: ")


def test_what_else_is_known_is_added():
    example = "For example rebound_velocity(v=-2, e=0.5), down gives -1 physics 1"
    assert words("unknown", counterexample=EXAMPLE).endswith(example)
    assert "writes into its arguments" in words("right", changes_input=True)
    assert words("right", accepted=("less", "more")).endswith("It should refuse, with a ValueError: less; more.")
    assert words("unknown", crashes=("first", "second")).endswith("On some input it ends in an error: first")
    alone = "With several cases in one call it is wrong in another way besides."
    assert words("named", FIRST, one_alone=True).endswith(alone)
    crash = words("named", FIRST, one_alone=True, crash_in_many=True, crashes=("no",))
    assert crash.endswith("With several cases in one call it ends in an error: no")
    assert alone not in crash


def test_a_diagnosis_is_as_wide_as_a_terminal():
    for entry in known("collide").mistakes:
        lines = told(Diagnosis("collide", "named", (entry,))).splitlines()
        assert max(map(len, lines)) <= 80
        assert len(lines) < 2 + (len(entry.rationale) + len(entry.help)) / 40


# The report


def outcome(function, passed, *parts, **more):
    return Outcome("test_they_bounce", 3, passed, parts=parts, function=function, **more)


def lines(*outcomes, complaints=(), topics=("impulse",), **diagnoses):
    sheet = Sheet("lab.py", list(complaints), outcomes=list(outcomes), diagnoses=diagnoses)
    return [*report(sheet, topics)]


def test_a_function_is_right_wrong_or_to_do():
    unwritten = Diagnosis("collide", "unwritten")
    outcomes = [outcome("point_velocity", True), outcome("collide", True), outcome("collide", False)]
    sheet = Sheet(outcomes=outcomes)
    assert [state(sheet, name) for name in ("point_velocity", "collide")] == [RIGHT, WRONG]
    sheet.diagnoses["collide"] = unwritten
    assert state(sheet, "collide") == TO_DO
    sheet.diagnoses["collide"] = Diagnosis("collide", "unknown")
    assert state(sheet, "collide") == WRONG
    assert not all_right(sheet)
    assert all_right(Sheet(outcomes=outcomes[:2]))


def test_the_report_goes_by_topic_and_step_and_ends_with_what_is_next():
    right = outcome("rebound_velocity", True), outcome("point_velocity", True), outcome("is_colliding", True)
    assert lines(*right, topics=("detection", "impulse")) == [
        "", f"{lecture.topic('detection').title} (detection)", "  ✓ is_colliding",
        "", f"{lecture.topic('impulse').title} (impulse)", "  ✓ point_velocity", "  ✓ rebound_velocity",
        "", "3 of 3 functions right. Hidden tests ask the same of other inputs, at limits and",
        "  of many cases at once.",
    ]  # fmt: skip
    entry = lecture.function("collide")
    at, slide = f"impulse, step {entry.step}", f"slide {entry.statement}"
    unwritten = {"collide": Diagnosis("collide", "unwritten")}
    to_do = lines(*right, outcome("collide", False, rationale="Go."), **unwritten)
    assert to_do[-3:] == [
        f"  · collide  to do, {slide}",
        "",
        f"2 of 3 functions right. Next: write collide ({at}, {slide}). Go.",
    ]
    first = lines(outcome("collide", False), **unwritten)[-1]
    assert first == f"1 function to write. Begin with collide ({at}, {slide})."
    assert lines(outcome("collide", False))[-1] == "0 of 1 functions right. Next: collide, marked ✗ above."


def test_of_a_file_without_a_function_that_was_asked_for_no_function_is_next():
    assert lines()[-2].startswith("0 of 0 functions right.")


def test_complaints_come_first_but_for_what_is_on_the_list_anyway():
    complaints = Complaint("odd", line=3), Complaint("collide is missing", kind="missing")
    assert lines(complaints=complaints)[:2] == ["line 3: odd", ""]


def test_what_failed_is_told_part_by_part_with_what_was_tried_for_the_first_two():
    parts = [Part(1, "one", "collide(a=2)\ngives 1"), Part(1, "kept"), Part(1, "two", "also"), Part(1, "three", "too")]
    found = lines(outcome("collide", False, *parts, help="Statement 12."))
    assert found[2:-2] == [
        "  ✗ collide  1 of 4 parts right",
        "    Not yet: one", "        collide(a=2)", "        gives 1", "    Not yet: two", "        also",
        "    Hint: Statement 12.", "    Not yet either: three",
    ]  # fmt: skip
    assert found[-1] == "0 of 1 functions right, 1 in part. Next: collide, marked ✗ above."


def test_of_a_mistake_that_has_a_name_one_example_and_the_hint_will_do():
    parts = [Part(1, "one", "tried\ngives   -1\nphysics 1"), Part(1, "two", "also")]
    diagnosis = Diagnosis("rebound_velocity", "named", (FIRST,), EXAMPLE, accepted=("less",))
    text = "\n".join(lines(outcome("rebound_velocity", False, *parts, help="Look."), rebound_velocity=diagnosis))
    assert "    Not yet: one\n        tried\n        gives   -1\n        physics 1\n    It is the fraction" in text
    assert "\n    Not yet either: two\n" in text
    assert text.count("Hint: ") == 1
    for left_out in ("Look.", "also", "For example", "refuse", "rebound_velocity: "):
        assert left_out not in text


def test_a_test_without_parts_is_told_by_its_title_and_an_example_is_shown_where_none_was_told():
    diagnosis = Diagnosis("collide", "unknown", counterexample=EXAMPLE)
    found = lines(outcome("collide", False), outcome("collide", False, said="gives 1"), collide=diagnosis)
    example = [
        "    For example",
        "        rebound_velocity(v=-2, e=0.5), down",
        "        gives   -1",
        "        physics 1",
    ]
    assert found[3:-2] == ["    Not yet: they bounce", "        gives 1", *example]
    said = "collide(a=2)\ngives 1\nphysics 2"
    found = lines(outcome("collide", False), outcome("collide", False, said=said), collide=diagnosis)
    assert found[3:-2] == ["    Not yet: they bounce", *(f"        {line}" for line in said.splitlines())]
    found = lines(outcome("collide", False), collide=diagnosis)
    unknown = "    Its numbers are wrong, in a way that the lab does not know."
    assert found[3:-2] == [unknown, *example, "    Not yet: they bounce"]
