"""Marks in a platform's own file: the right column, the right scale, and nothing else is changed."""

from __future__ import annotations

import csv
import io

import pytest
from made_rosters import CANVAS_FILE, GERMAN_FILE, MOODLE_FILE, PLAIN_FILE

from labs.gradebook.deadlines import Lateness
from labs.gradebook.roster import read_roster
from labs.gradebook.tables import Mark
from labs.gradebook.upload import filled, target
from reference.errors import InvalidInput

SEVERAL = """\
Student,ID,SIS User ID,SIS Login ID,Section,Impulse pre-quiz (4600),Lab 5 (4711),Essay (1),Assignments Current Score
Manual Posting,,,,,,,,
    Points Possible,,,,,10,50,20,(read only)
"Lovelace, Ada",7,s7,ada,A,9,,-1,80
=HYPERLINK(1),8,s8,zoe,A,8,,,70
-1,9,s9,bob,A,7,EX,,60
"o'brien; rm -rf",10,s10,obr,A,6,31,,50
"""


@pytest.fixture
def roster(tmp_path):
    def read(text: str):
        path = tmp_path / "roster.csv"
        path.write_bytes(text.encode())
        return read_roster(path)

    return read


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def marked(found, *points: float | None) -> list[Mark]:
    return [Mark(student, "impulse", each) for student, each in zip(found.students, points, strict=False)]


@pytest.mark.parametrize("column", ["Lab 5 (4711)", "4711", "lab 5"])
def test_marks_go_into_the_column_that_was_named_and_are_scaled_to_its_points(roster, column):
    found = roster(SEVERAL)
    to = target(found, "impulse", column)
    assert (to.title, to.possible) == ("Lab 5 (4711)", 50)
    assert to.said == "column 'Lab 5 (4711)', which has 50 points, so every mark of 100 is multiplied by 0.5"
    given = [row["Lab 5 (4711)"] for row in rows(filled(found, marked(found, 61, 90, 40, None), to))]
    assert given == ["", "50", "30.5", "45", "EX", "31"]  # who is excused or has no mark of ours keeps what is there


def test_no_other_assignment_can_be_changed_by_the_upload(roster):
    found = roster(SEVERAL)
    header = filled(found, [], target(found, "impulse", "4711")).partition("\n")[0]
    assert header == "Student,ID,SIS User ID,SIS Login ID,Section,Lab 5 (4711)"


@pytest.mark.parametrize(
    ("text", "column", "said"),
    [
        (SEVERAL, "", r"no column titled 'impulse' or .*Impulse pre-quiz \(4600\); Lab 5 \(4711\); Essay \(1\)"),
        (SEVERAL, "impulse", r"unknown assignment .* Choices: Impulse pre-quiz \(4600\), Lab 5 \(4711\), Essay \(1\)"),
        (SEVERAL, "Section", "unknown assignment"),
        (SEVERAL.replace("Essay", "impulse").replace("Lab 5", "Impulse"), "", "2 columns titled"),
        (SEVERAL.replace("Essay", "Lab 5"), "Lab 5", "2 columns titled 'Lab 5'"),
        (SEVERAL.replace("10,50,20", "10,0,20"), "4711", r"'Lab 5 \(4711\)' has 0 points in Canvas"),
        (MOODLE_FILE, "Grade", "leave it out"),
        (PLAIN_FILE, "4711", "leave it out"),
        (MOODLE_FILE.replace(",Grade", ",Mark"), "", "no columns 'Grade'"),
        (MOODLE_FILE.replace(",Grade", ",Grade,Grade"), "", "2 columns 'Grade'"),
    ],
)
def test_a_column_that_is_not_the_only_one_is_refused_and_the_choices_are_named(roster, text, column, said):
    with pytest.raises(InvalidInput, match=said):
        target(roster(text), "impulse", column)


def test_a_quiz_before_the_lab_is_not_taken_for_it(roster):
    found = roster(SEVERAL.replace("Lab 5", "Impulse"))
    assert target(found, "impulse").title == "Impulse (4711)"
    found = roster(SEVERAL.replace("Lab 5", "Impulses between rigid bodies"))
    assert target(found, "impulse").title == "Impulses between rigid bodies (4711)"


def test_where_no_column_is_wanted_there_is_no_file(roster):
    assert target(roster(SEVERAL), "impulse", "none") is None
    assert target(roster(PLAIN_FILE), "impulse") is None


def test_a_name_comes_back_as_it_was_unless_a_spreadsheet_would_run_it(roster):
    found = roster(SEVERAL.replace("ada,A", "=ada,A"))
    names = [(row["Student"], row["SIS Login ID"]) for row in rows(filled(found, [], target(found, "impulse", "4711")))]
    assert names == [
        ("Manual Posting", ""), ("    Points Possible", ""), ("Lovelace, Ada", "=ada"), ("'=HYPERLINK(1)", "zoe"),
        ("-1", "bob"), ("o'brien; rm -rf", "obr"),
    ]  # fmt: skip


@pytest.mark.parametrize("mark", ["", "\ufeff"])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_the_file_keeps_its_line_ends_and_its_first_bytes(roster, newline, mark):
    text = mark + CANVAS_FILE.replace("\n", newline)
    found = roster(text)
    assert filled(found, marked(found, 60.0), target(found, "impulse")) == text.replace(
        f"ada@example.org,A,{newline}", f"ada@example.org,A,60{newline}"
    )


@pytest.mark.parametrize(
    ("text", "grades", "said"),
    [
        (MOODLE_FILE, ["48", ""], "column 'Grade'; the file does not say its maximum, so the marks are of 100 points"),
        (
            "Identifier,Full name,Grade,Maximum Grade,Feedback comments\n"
            'Participant 31,=Ada,,"20,00",- well done\nParticipant 32,Zoë,3,20.00,\n',
            ["9.6", "3"],
            "column 'Grade', which has 20 points, so every mark of 100 is multiplied by 0.2",
        ),
        (
            "Identifier,Full name,Last modified (submission),Grade,Feedback comments\n"
            "Participant 31,-,-,,-\nParticipant 32,+,-,,@\n",
            ["48", ""],
            "column 'Grade'; the file does not say its maximum, so the marks are of 100 points",
        ),
    ],
)
def test_moodles_worksheet_comes_back_with_the_marks_in_it(roster, text, grades, said):
    found = roster(text)
    to = target(found, "impulse")
    after = rows(filled(found, [Mark(found.students[0], "impulse", 60.0, late=Lateness(2, 0.8))], to))
    assert ([row["Grade"] for row in after], to.said) == (grades, said)
    for before, row in zip(rows(text), after, strict=True):
        assert row | {"Grade": ""} == before | {"Grade": "", "Full name": before["Full name"].replace("=", "'=")}


def test_a_worksheet_in_another_language_that_excel_saved_comes_back_as_moodle_wrote_it(tmp_path):
    path = tmp_path / "moodle.csv"
    lines = [";".join(line) for line in csv.reader(io.StringIO(GERMAN_FILE))]
    path.write_bytes("\r\n".join([*lines, ";;;;;;;", ""]).encode("cp1252"))
    found = read_roster(path)
    after = filled(found, marked(found, 60.0), target(found, "impulse"))
    assert list(csv.reader(io.StringIO(after.removeprefix("\ufeff")))) == [
        [cell if (at, place) != (1, 4) else "30" for place, cell in enumerate(line)]
        for at, line in enumerate(csv.reader(io.StringIO(GERMAN_FILE)))
    ]


def test_canvas_gradebook_with_semicolons_and_two_columns_of_names_is_filled_as_it_is(roster):
    text = "LastName;FirstName;ID;SIS Login ID;Section;impulse (90)\n    Points Possible;;;;;12,5\n=A;-;7;ada;S;\n"
    found = roster(text)
    to = target(found, "impulse")
    assert to.possible == 12.5
    assert filled(found, marked(found, 60.0), to) == text.replace("=A", "'=A").replace("S;\n", "S;7.5\n")
