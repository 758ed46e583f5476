"""Students of a course, from the files that platforms export, and whose a submission is."""

from __future__ import annotations

import pytest
from made_rosters import CANVAS_FILE, GERMAN_FILE, MOODLE_FILE, PLAIN_FILE

from labs.gradebook.layouts import CANVAS, MOODLE, PLAIN, Owner
from labs.gradebook.roster import read_roster
from reference.errors import InvalidInput


@pytest.fixture
def roster(tmp_path):
    def read(text: str):
        path = tmp_path / "roster.csv"
        path.write_text(text, encoding="utf-8-sig")
        return read_roster(path)

    return read


@pytest.mark.parametrize(
    ("text", "kind", "ids"),
    [
        (CANVAS_FILE, CANVAS, ["4711", "4712"]),
        (MOODLE_FILE, MOODLE, ["4711", "32"]),
        (PLAIN_FILE, PLAIN, ["4711", "4712"]),
    ],
)
def test_a_platforms_own_file_is_known_by_its_columns(roster, text, kind, ids):
    found = roster(text)
    assert (found.kind, [each.id for each in found.students]) == (kind, ids)


@pytest.mark.parametrize(
    ("text", "kind", "students"),
    [
        ("LastName;FirstName;ID;SIS Login ID;Section\nLovelace;Ada;7;ada;S\nStudent;Test;9;;S\n", CANVAS,
         [("ada", "Lovelace, Ada")]),
        ("Identifier\tStatus\tGrade\n\t\t\nParticipant 31\t\t\n", MOODLE, [("31", "")]),
        (GERMAN_FILE, MOODLE, [("0815", "Ada Lovelace")]),
        ("Identifiant;Nom complet\nParticipant 31;Ada\n", MOODLE, [("31", "Ada")]),
        ("sep=;\nSTUDENT_ID ; Last Name;First Name\n  007;Lovelace;Ada\n", PLAIN, [("007", "Lovelace, Ada")]),
        ("First Name,Last Name,SID,Email,Role\nAda,Lovelace,12,a@b,Student\n", PLAIN, [("12", "Lovelace, Ada")]),
        ("OrgDefinedId,Username,Last Name,First Name,End-of-Line Indicator\n#40,#ada,Lovelace,Ada,#\n", PLAIN,
         [("40", "Lovelace, Ada")]),
        ("Matrikelnummer;Nachname;Vorname\n0815;Müller;Zoë\n", PLAIN, [("0815", "Müller, Zoë")]),
        ("Nachname,Vorname,Matrikelnr.,E-Mail\nLovelace,Ada,12,a@b\n", PLAIN, [("12", "Lovelace, Ada")]),
        ("MATRIKELNR\n0815\n", PLAIN, [("0815", "")]),
        ('"Last Name","First Name","Username","Student ID"\n"Lovelace","Ada","ada",""\n', PLAIN,
         [("ada", "Lovelace, Ada")]),
    ],
)  # fmt: skip
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
def test_rosters_of_every_platform_are_read_however_they_were_saved(tmp_path, text, kind, students, encoding):
    (tmp_path / "roster.csv").write_bytes(text.replace("\n", "\r\n").encode(encoding))
    found = read_roster(tmp_path / "roster.csv")
    assert (found.kind, [(each.id, each.name) for each in found.students]) == (kind, students)


@pytest.mark.parametrize(
    ("text", "owner"),
    [
        (CANVAS_FILE, Owner(CANVAS, "8", "mullerzoe")),
        (CANVAS_FILE, Owner(PLAIN, "zoe@example.org")),
        (CANVAS_FILE, Owner(PLAIN, "ZOE  MULLER")),
        (CANVAS_FILE, Owner(PLAIN, "4712")),
        (MOODLE_FILE, Owner(MOODLE, "32", "Zoë Müller")),
        (PLAIN_FILE, Owner(CANVAS, "8")),
        (PLAIN_FILE, Owner(CANVAS, "99", "mullerzoe")),
    ],
)
def test_a_submission_finds_its_student_by_number_address_or_name(roster, text, owner):
    student = roster(text).owner(owner)
    assert student is not None
    assert student.name in ("Müller, Zoë", "Zoë Müller")


def test_a_number_of_one_platform_is_not_that_of_another(roster):
    found = roster(PLAIN_FILE)
    assert found.owner(Owner(MOODLE, "7")) is None
    assert found.owner(Owner(CANVAS, "4713", "somebody")) is None


def test_canvas_number_of_one_student_is_not_the_course_number_of_another(roster):
    crossed = roster("Student,ID,SIS User ID,SIS Login ID\nAda,7,8,a\nBob,8,7,b\n")
    assert crossed.owner(Owner(CANVAS, "7")).name == "Ada"
    assert crossed.owner(Owner(CANVAS, "8")).name == "Bob"
    assert crossed.owner(Owner(PLAIN, "8")).name == "Ada"
    plain = roster("student_id,name\n7,Ada\n")
    assert plain.owner(Owner(CANVAS, "7", "bob")) is None


def test_two_students_of_one_name_are_told_apart_by_nothing(roster):
    found = roster("student_id,name\n1,Ada Lovelace\n2,Ada Lovelace\n")
    assert found.owner(Owner(PLAIN, "Ada Lovelace")) is None
    assert found.owner(Owner(PLAIN, "2")).id == "2"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "name,mark\nAda,3\n",
            "has the columns name, mark. A roster is Canvas' gradebook .* or a table with student_id",
        ),
        ("student_id\n1\n\n1\n", "has the student '1' twice, in the lines 2 and 4"),
        ("student_id,name\n1,Lovelace, Ada\n", "line 2 of .* has 3 cells, and the header, .* has 2. .* in quotes"),
        ("student_id;name\n;Ada\n", "line 2 of roster.csv has no number of a student .Ada."),
        ("student_id;name\n4,71E+11;Ada\n", "line 2 of roster.csv has the number '4,71E.11', which a spreadsheet has"),
        ("Student,ID,SIS User ID\nAda,1.2E+05,7\n", "line 2 of roster.csv has the number '1.2E.05'"),
        ("student_id,name\n", "names no student"),
        ('student_id\n"1\n', "is no CSV file"),
        ("", "has the columns of an empty file"),
    ],
)
def test_a_file_that_is_no_roster_is_refused_by_what_it_has(roster, text, said):
    with pytest.raises(InvalidInput, match=said):
        roster(text)
