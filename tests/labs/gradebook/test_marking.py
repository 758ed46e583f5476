"""Tables of points that a marker saved with a spreadsheet: read, checked, and continued without any loss."""

from __future__ import annotations

import csv
import io
import shutil

import pytest

from labs.gradebook import written
from labs.gradebook.marking import COLUMNS, Given, read_table
from labs.gradebook.written import POINTS, Codes, marked_for_nobody, read_tables, write_questions
from reference.errors import InvalidInput

POSSIBLE = {"third-law": 3, "weight": 2}
OLD = ["23E45", "2E345", "JAN22", "87654", "ABCDE"]
HEADER = "question,code,possible,points,comment\n"


@pytest.fixture
def table(tmp_path):
    def read(text: str, encoding: str = "utf-8"):
        (tmp_path / POINTS).write_bytes(text.encode(encoding))
        return read_table(tmp_path / POINTS, POSSIBLE)

    return read


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("question;code;possible;points;comment\r\nthird-law;ABCDE;3;2,5;schön\r\n;;;;\r\nweight;ABCDE;2;;\r\n",
         "cp1252"),
        ("Question\tCode\tPoints\tComment\tMarker\nThird-Law\t abcde \t 2.50 \tschön\tBob\n\nweight\tABCDE\t\t\t\n",
         "utf-16"),
        ('sep=;\n"question";"code";"points";"comment"\nthird-law;ABCDE;"2,5";schön\nweight;ABCDE;;\n', "utf-8-sig"),
    ],
)  # fmt: skip
def test_what_a_marker_wrote_is_read_whatever_saved_it(table, text, encoding):
    assert table(text, encoding).given == {
        ("third-law", "ABCDE"): Given(2.5, "schön"),
        ("weight", "ABCDE"): Given(None),
    }


def test_a_table_to_which_nothing_is_added_is_not_touched(table):
    text = "question;code;possible;points;comment\r\nweight;ABCDE;2;1,5;=\u00fc\r\nthird-law;ABCDE;3;;\r\n;;;;\r\n"
    found = table(text, "cp1252")
    found.write([("third-law", "ABCDE", 3), ("weight", "ABCDE", 2)])
    assert found.path.read_bytes() == text.encode("cp1252")


def test_a_table_that_is_continued_keeps_its_columns_its_form_and_every_filled_line(table):
    text = "question;code;possible;points;marker;comment\r\nweight;ABCDE;9;1,5;Bob;schön\r\nweight;XYZXY;2;;;\r\n"
    found = table(text, "cp1252")
    found.write([("third-law", "FGHKL", 3)])
    after = found.path.read_bytes()
    assert after.decode("utf-8-sig").splitlines() == [
        "question;code;possible;points;marker;comment",
        "third-law;FGHKL;3;;;",
        "weight;ABCDE;2;1,5;Bob;schön",
    ]
    assert after.startswith(b"\xef\xbb\xbf")
    assert b"\r\n" in after


def test_a_comment_that_an_earlier_release_defused_is_read_as_it_was_written(table):
    found = table(HEADER + "weight,ABCDE,2,1,'=well\nweight,FGHKL,2,1,'so' he says\n").given
    assert [each.comment for each in found.values()] == ["=well", "'so' he says"]


@pytest.mark.parametrize(
    ("shown", "meant"),
    [("2.3E+46", "23E45"), ("2,30E+46", "23E45"), ("22-JAN", "JAN22"), ("ABCD", "ABCDE"), ("008", ".*23E45 or 2E345")],
)
def test_a_code_that_nobody_has_is_refused_with_the_line_and_the_codes_that_may_be_meant(table, shown, meant):
    found = table(f'{HEADER}third-law,{OLD[0]},3,,\n\nweight,"{shown}",2,2,good\nweight,"9E+99",2,,\n')
    with pytest.raises(
        InvalidInput, match=f"^line 4 of points.csv has the code .*, which nobody has; perhaps it is {meant}"
    ):
        found.refuse_codes_of_nobody(OLD)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("weight,ABCDE,2,1_0,\n", "line 2 of points.csv has '1_0' points: write a number"),
        ("weight,ABCDE,2,2. Mai,\n", "has '2. Mai' points"),
        ("weight,ABCDE,2,1,\n,,,,\nweight,abcde,2,2,\n", "line 4 of points.csv and line 2 mark the same answer, ABCDE"),
        ("weight,ABCDE,2,1,5,good\n", "line 2 of .* has 6 cells, and the header, .* has 5"),
        ("weight,ABCDE,2,9,\nmass,ABCDE,2,1,\n", "gives 9 points; .* has 2; line 3 of points.csv has the"),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused_with_every_line(table, lines, said):
    with pytest.raises(InvalidInput, match=said):
        table(HEADER + lines)


def test_a_table_whose_column_of_points_was_renamed_or_doubled_loses_no_points(table):
    for header in ("question,code,Punkte", "question,code,points,points", "question;code", ""):
        with pytest.raises(InvalidInput, match="it needs question, code and points once each"):
            table(header + "\nweight,ABCDE,1\n" * bool(header))


def test_no_spreadsheet_changes_a_new_code_and_an_old_folder_keeps_its_codes(tmp_path):
    codes = [Codes(tmp_path)(str(student)) for student in range(400)]
    assert all(len(code) == 6 and set(code) <= set("BCDFGHJKLMNPQRSTVWXZ") for code in codes)
    (tmp_path / ".codes").write_text("0" * 64, encoding="utf-8")
    assert [Codes(tmp_path)(name) for name in ("ada", "bob")] == ["WTXWY", "WY27G"]


def test_points_that_count_for_nobody_are_said(tmp_path):
    codes = Codes(tmp_path)
    found = {("weight", codes("ada")): Given(2.0), ("weight", codes("bob")): Given(None), ("weight", "X"): Given(1.0)}
    said = marked_for_nobody(found, codes, ["bob"])
    assert said.startswith("2 of the filled lines in points.csv count for nobody, because nothing of their students is")
    assert marked_for_nobody(found | {("weight", "X"): Given(None)}, codes, ["ada"]) == ""


def test_a_students_code_that_a_spreadsheet_changed_is_said_and_nothing_is_lost(tmp_path):
    key = written.questions("impulse")[0].key
    answers = {name: {key: "yes"} for name in ("ada", "bob", "cyd")}
    write_questions(tmp_path, "impulse", answers)
    path = tmp_path / "questions" / POINTS
    lines = list(csv.reader(io.StringIO(path.read_text(encoding="utf-8"))))
    right = lines[1][1]
    lines[1][1:5] = ["1E+45", "3", "2", "good"]
    path.write_text("\n".join(map(";".join, lines)), encoding="utf-16")
    before = path.read_bytes()
    with pytest.raises(InvalidInput, match=f"line 2 of points.csv has the code '1E.45', .* perhaps it is {right}"):
        read_tables(tmp_path, "impulse", answers)
    assert path.read_bytes() == before
    write_questions(tmp_path, "impulse", answers)
    assert "1E+45;3;2;good" in path.read_text(encoding="utf-8")
    assert tuple(lines[0]) == COLUMNS
    shutil.rmtree(tmp_path / "questions")
    assert [each.given for each in read_tables(tmp_path, "impulse", answers)] == [{}, {}]
