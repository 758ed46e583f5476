"""When the submissions of a class came, from what its platform delivers: nobody's time is unknown without a word."""

from __future__ import annotations

from pathlib import Path

import pytest

from labs.gradebook.book import Book
from labs.gradebook.class_grading import Marker, marks
from labs.gradebook.class_list import read_class
from labs.gradebook.class_run import Failures
from labs.gradebook.deadlines import CALLED_LATE, NO_TIME, read_deadlines
from labs.gradebook.for_a_person import left_to_do
from labs.gradebook.mistakes.course_bank import CourseBank
from labs.gradebook.roster import read_roster
from labs.gradebook.written import Codes

UNGRADED = "not graded yet"
RULES = "[due]\nimpulse = 2026-11-30T23:59:00+01:00\n[late]\npercent_per_day = 10\n"
WORKSHEET = """\
Identifier,Full name,Status,Grade,Last modified (submission)
Participant 1,Ada,Submitted for grading - 1 day 2 hours late,,"Wednesday, 2 December 2026, 1:59 AM"
Participant 2,Bob,Submitted for grading,,"Monday, 30 November 2026, 11:58 PM"
Participant 3,Cyd,Submitted for grading - 3 days late,,30.11.2026
Participant 4,Dora,Submitted for grading,,30.11.2026
Participant 5,Eve,No submission,,-
"""
OTHERWISE = """\
Identifier,Full name,Status,Grade,Last modified (submission)
Participant 1,Ada,Submitted for grading - 1 day 2 hours late,,"Wednesday, 2 December 2026, 9:59 AM"
Participant 2,Bob,Submitted for grading,,"Wednesday, 2 December 2026, 1:58 AM"
Participant 3,Cyd,Submitted for grading - 5 mins late,,"Tuesday, 1 December 2026, 12:04 AM"
Participant 4,Dora,,,"Wednesday, 2 December 2026, 1:58 AM"
"""


@pytest.fixture
def late(tmp_path):
    """What is said of each student's time, the notes of each, and the lines for a person."""

    def read(*entries: str, roster: str = "", stamps: dict[str, str] | None = None):
        for entry in entries:
            path = tmp_path / "sub" / entry
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("x = 1\n", encoding="utf-8")
        for entry, stamp in (stamps or {}).items():
            (tmp_path / "sub" / entry / "timestamp.txt").write_text(stamp, encoding="utf-8")
        for name, text in (("course.toml", RULES), ("roster.csv", roster)):
            (tmp_path / name).write_text(text, encoding="utf-8")
        found = read_class(tmp_path / "sub", "impulse", read_roster(tmp_path / "roster.csv") if roster else None)
        rules, codes = read_deadlines(tmp_path / "course.toml"), Codes(tmp_path)
        marker = Marker(Book(tmp_path), rules, Failures(), codes, (), {}, CourseBank(tmp_path, ()))
        every = marks(found, marker)
        said = {
            mark.student.id: (mark.late.said, tuple(each for each in mark.notes if each != UNGRADED)) for mark in every
        }
        return said, list(left_to_do(Path("grades"), found, every, Failures(), ()))

    return read


def test_moodles_worksheet_says_when_each_submission_came(late):
    names = ("Ada_1", "Bob_2", "Cyd_3", "Dora_4", "Eve_5")
    entries = [f"{name}_assignsubmission_file_/impulse.ipynb" for name in names]
    said, (line,) = late(*entries, roster=WORKSHEET)
    assert {student: text for student, (text, _) in said.items()} == {
        "1": "2 days late", "2": "", "3": "3 days late", "4": NO_TIME, "5": NO_TIME,
    }  # fmt: skip
    assert said["4"][1] == ("the platform says '30.11.2026', which is not a time in one known zone",)
    assert line == (
        "2 of whom nobody knows when they handed in: 4, 5. Nothing is taken off, although the rules set a deadline."
    )


def test_who_handed_in_by_the_worksheet_and_is_not_in_the_folder_is_noted(late):
    said, _ = late("Ada_1_assignsubmission_file_/impulse.ipynb", roster=WORKSHEET)
    assert said["2"][1] == ("nothing handed in, although the platform says 'Monday, 30 November 2026, 11:58 PM'",)
    assert said["5"][1] == ("nothing handed in",)


def test_where_moodle_counts_from_another_deadline_a_person_is_told(late):
    entries = [f"{name}_assignsubmission_file_/impulse.ipynb" for name in ("Ada_1", "Bob_2", "Cyd_3", "Dora_4")]
    said, (line,) = late(*entries, roster=OTHERWISE)
    assert [text for text, _ in said.values()] == ["2 days late", "2 days late", "1 day late", "2 days late"]
    assert line.startswith("2 whose lateness Moodle counts from another deadline: 1, 2. The rules decide")


def test_nbgraders_zones_are_read_or_said(late):
    stamps = {
        "submitted/ada/impulse": "2026-12-04 15:58:23.948203 America/New_York",
        "submitted/bob/impulse": "2026-12-04 15:58:23.948203 CST",
        "submitted/cyd/impulse": "2026-11-30 23:58:00 CET",
    }
    said, (line,) = late(*(f"{entry}/impulse.ipynb" for entry in stamps), stamps=stamps)
    assert [text for text, _ in said.values()] == ["4 days late", NO_TIME, ""]
    assert said["bob"][1] == (
        "the platform says '2026-12-04 15:58:23.948203 CST', which is not a time in one known zone",
    )
    assert line.startswith("1 of whom nobody knows when they handed in: bob.")


@pytest.mark.parametrize(
    ("entries", "said", "lines"),
    [
        (["ada_LATE_1_11_impulse.ipynb", "bob_2_12_impulse.ipynb"], [CALLED_LATE, ""], ["1 late, but"]),
        (["ada_1_11_impulse.ipynb", "bob_2_12_impulse.ipynb"], [NO_TIME, NO_TIME], ["2 of whom nobody knows"]),
        (["ada.ipynb", "bob/impulse.ipynb"], [NO_TIME, NO_TIME], ["2 of whom nobody knows"]),
    ],
)
def test_where_a_platform_says_no_times_it_counts_as_in_time_only_beside_others_that_are_late(
    late, entries, said, lines
):
    found, todo = late(*entries)
    assert [text for text, _ in found.values()] == said
    assert [line[: len(start)] for line, start in zip(todo, lines, strict=True)] == lines
