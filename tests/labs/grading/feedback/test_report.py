"""The report on a file that a student reads, line by line."""

from __future__ import annotations

import numpy as np
import pytest

from labs.grading.diagnosis.deviations import Answer, Right
from labs.grading.diagnosis.findings import Counterexample, Diagnosis
from labs.grading.diagnosis.fingerprints import known
from labs.grading.diagnosis.probes.probe import usual
from labs.grading.feedback.report import RIGHT, TO_DO, WRONG, all_right, report, state
from labs.grading.feedback.tries import Tries
from labs.grading.judging.score_sheet import Outcome, Part, Sheet
from labs.grading.submission.cells import Complaint
from reference import lecture

FIRST, SECOND = known("impulse_magnitude").mistakes[:2]

EXAMPLE = Counterexample(
    "impulse_magnitude", usual("down", -2.0, 0.5), ("v", "e"), Answer(-1.0), Right((np.array(1.0),), (1.0,))
)


def outcome(function, passed, *parts, **more):
    return Outcome("test_they_bounce", 3, passed, parts=parts, function=function, **more)


def lines(*outcomes, complaints=(), topics=("impulse",), tries=None, unread=(), **diagnoses):
    sheet = Sheet("lab.py", list(complaints), unread, outcomes=list(outcomes), diagnoses=diagnoses)
    return [*report(sheet, topics, tries)]


# The report


def test_a_function_is_right_wrong_or_to_do():
    unwritten = Diagnosis("collide", "unwritten")
    outcomes = [outcome("normal_velocity", True), outcome("collide", True), outcome("collide", False)]
    sheet = Sheet(outcomes=outcomes)
    assert [state(sheet, name) for name in ("normal_velocity", "collide")] == [RIGHT, WRONG]
    sheet.diagnoses["collide"] = unwritten
    assert state(sheet, "collide") == TO_DO
    sheet.diagnoses["collide"] = Diagnosis("collide", "unknown")
    assert state(sheet, "collide") == WRONG
    assert not all_right(sheet)
    assert all_right(Sheet(outcomes=outcomes[:2]))


def test_the_report_follows_topic_and_step_and_ends_with_the_next_step():
    right = outcome("impulse_magnitude", True), outcome("normal_velocity", True), outcome("side_of_plane", True)
    assert lines(*right, topics=("detection", "impulse")) == [
        "", f"{lecture.topic('detection').title} (detection)", "  ✓ side_of_plane",
        "", f"{lecture.topic('impulse').title} (impulse)", "  ✓ normal_velocity", "  ✓ impulse_magnitude",
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


def test_a_file_without_requested_functions_has_no_next_step():
    assert lines()[-2].startswith("0 of 0 functions right.")


def test_complaints_come_first_except_for_listed_functions():
    complaints = Complaint("odd", line=3), Complaint("collide is missing", kind="missing")
    assert lines(complaints=complaints)[:2] == ["line 3: odd", ""]


def test_functions_that_cannot_be_read_share_one_line_and_lead_to_its_place():
    complaint = Complaint("Python cannot read 'x = )'", 3, 2, "unreadable")
    lost = [outcome(name, False) for name in ("collide", "normal_velocity")]
    found = lines(*lost, complaints=[complaint], unread=("collide", "normal_velocity"))
    assert "  ✗ normal_velocity and collide  cannot be read, see the first lines" in found
    assert found[-1] == "0 of 2 functions right. Next: mend code cell 3, line 2, so that it can be read."


SEVERAL = Diagnosis("impulse_magnitude", "several", (FIRST, SECOND), EXAMPLE)
LIKELY = Diagnosis("impulse_magnitude", "likely", (FIRST,), EXAMPLE, odd=EXAMPLE)
CRASH = Diagnosis("impulse_magnitude", "crashes", counterexample=EXAMPLE)


@pytest.mark.parametrize(
    ("diagnosis", "helps"),
    [
        (Diagnosis("impulse_magnitude", "named", (FIRST,), EXAMPLE), ["Hint: ", "into each other"]),
        (LIKELY, ["Hint: ", "Most of its numbers fit this mistake"]),
        (SEVERAL, ["Its numbers fit more than one mistake"]),
        (Diagnosis("impulse_magnitude", "unknown", counterexample=EXAMPLE), ["Hint: Look there."]),
        (CRASH, []),
    ],
    ids=lambda value: value.verdict if isinstance(value, Diagnosis) else "",
)
def test_each_try_after_the_first_shows_one_level_of_help_more(diagnosis, helps):
    tries, part = Tries(), Part(1, "one", "impulse_magnitude(2)\ngives   -1\nphysics 1")
    for count in range(1, 5):
        tries.add("impulse_magnitude", f"try {count}")
        failed = outcome("impulse_magnitude", False, part, help="Look there.")
        text = "\n".join(lines(failed, tries=tries, impulse_magnitude=diagnosis))
        assert f"  ✗ impulse_magnitude  try {count}\n    Not yet: one\n" in text
        assert "physics 1" in text
        assert [words in text for words in helps] == [at < count - 1 for at in range(len(helps))]
        assert ("lab.hint(" in text) == (count <= len(helps))


def test_tries_count_changed_code_and_begin_again_once_it_is_right():
    tries = Tries()
    for code in ("a", "a", "b", "a"):
        tries.add("collide", code)
    assert (tries.count("collide"), tries.levels("collide")) == (2, 1)
    tries.request("collide")
    assert (tries.count("collide"), tries.levels("collide")) == (2, 2)
    assert "  ✓ collide  at try 3" in lines(outcome("collide", True), tries=tries)
    tries.forget("collide")
    assert (tries.count("collide"), tries.levels("collide")) == (0, 0)


def test_the_first_two_failed_parts_are_shown_with_their_calls():
    parts = [Part(1, "one", "collide(a=2)\ngives 1"), Part(1, "kept"), Part(1, "two", "also"), Part(1, "three", "too")]
    found = lines(outcome("collide", False, *parts, help="Statement 12."))
    assert found[2:-2] == [
        "  ✗ collide  1 of 4 parts right",
        "    Not yet: one", "        collide(a=2)", "        gives 1", "    Not yet: two", "        also",
        "    Hint: Statement 12.", "    Not yet either: three",
    ]  # fmt: skip
    assert found[-1] == "0 of 1 functions right, 1 in part. Next: collide, marked ✗ above."


def test_a_named_mistake_has_one_example_and_one_hint():
    parts = [Part(1, "one", "tried\ngives   -1\nphysics 1"), Part(1, "two", "also")]
    diagnosis = Diagnosis("impulse_magnitude", "named", (FIRST,), EXAMPLE, accepted=("less",))
    text = "\n".join(lines(outcome("impulse_magnitude", False, *parts, help="Look."), impulse_magnitude=diagnosis))
    assert "    Not yet: one\n        tried\n        gives   -1\n        physics 1\n    The minus is missing" in text
    assert "\n    Not yet either: two\n" in text
    assert text.count("Hint: ") == 1
    for left_out in ("Look.", "also", "For example", "refuse", "impulse_magnitude: "):
        assert left_out not in text


def test_a_test_without_parts_has_its_title_and_an_example():
    diagnosis = Diagnosis("collide", "unknown", counterexample=EXAMPLE)
    found = lines(outcome("collide", False), outcome("collide", False, said="gives 1"), collide=diagnosis)
    example = [
        "    For example",
        "        impulse_magnitude(v=-2, e=0.5), down",
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


def test_a_need_that_several_parts_repeat_is_printed_once():
    parts = [Part(1, reason, "needs collide") for reason in ("one", "two")]
    assert "\n".join(lines(outcome("collide", False, *parts))).count("needs collide") == 1
