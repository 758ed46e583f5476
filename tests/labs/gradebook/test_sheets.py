"""Tables that somebody saved with a spreadsheet: what they say is read, and what cannot be meant is refused."""

from __future__ import annotations

import pytest

from labs.gradebook.sheets import number_in, read_sheet, read_text
from reference.errors import InvalidInput

TABLE = "code,points,comment\nAB2C3,2.5,schön\n\n ,,\nD4E5F,0,“a, b”\n"


def saved(tmp_path, content: bytes):
    path = tmp_path / "points.csv"
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_a_table_says_the_same_however_it_was_saved(tmp_path, encoding, delimiter, newline):
    text = TABLE.replace("“a, b”", '"a, b"').replace(", b", "_").replace(",", delimiter).replace("_", ", b")
    found = read_sheet(saved(tmp_path, text.replace("\n", newline).encode(encoding)), ("code", "points", "comment"))
    rows = list(found.rows())
    assert [(row.number, row["Code"], number_in(row["points"]), row["comment"]) for row in rows] == [
        (2, "AB2C3", 2.5, "schön"),
        (5, "D4E5F", 0.0, "a, b"),
    ]


def test_a_table_is_written_as_it_was_saved_and_in_utf_8(tmp_path):
    for encoding, mark in (("utf-8", ""), ("utf-8-sig", "\ufeff"), ("cp1252", "\ufeff"), ("utf-16", "\ufeff")):
        text = "code;comment\r\nA;schön\r\n"
        found = read_sheet(saved(tmp_path, text.encode(encoding)), ("code",))
        assert found.dialect.text([found.header, *found.lines]) == mark + text


def test_the_delimiter_is_the_one_that_shows_the_headings(tmp_path):
    found = read_sheet(saved(tmp_path, b"student_id,a;b;c;d\n1,2\n"), ("student_id",))
    assert found.header == ("student_id", "a;b;c;d")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"PK\x03\x04rest", "is a workbook or an archive and no text: save the table as CSV"),
        (b"\xd0\xcf\x11\xe0rest", "an old workbook of Excel"),
        (b"a,b\n\x00\x01\x02,\x81\n", "is neither UTF-8 nor UTF-16 nor Windows-1252 text"),
        (b"code,points,comment\nA,2,5,good\n", "line 2 of .* has 4 cells, and the header, .* has 3"),
        (b'code\n"A\n', "is no CSV file"),
        (b"x" * (10 * 2**20 + 1), "has more than 10 MB"),
        (b"code" + b"," * 9999 + b"x" + b"\n1" * 100, "has 101 lines of 10000 cells"),
        (b"Course 101\ncode,points\n", "line 2 of .* the header, which begins with 'Course 101', has 1"),
    ],
)
def test_a_file_that_is_no_such_table_is_refused_with_what_it_is(tmp_path, content, said):
    with pytest.raises(InvalidInput, match=said):
        read_sheet(saved(tmp_path, content), ("code",))


def test_a_long_text_of_a_student_in_one_cell_stops_nobody(tmp_path):
    found = read_sheet(saved(tmp_path, f'code,text\nA,"{"x, " * 300_000}"\nB,\n'.encode()), ("code",))
    assert [row["code"] for row in found.rows()] == ["A", "B"]


def test_the_rules_of_a_course_may_have_been_saved_by_any_editor(tmp_path):
    for encoding in ("utf-8", "utf-8-sig", "utf-16", "cp1252"):
        assert read_text(saved(tmp_path, 'contact = "Zoë"'.encode(encoding))) == 'contact = "Zoë"'


@pytest.mark.parametrize(
    ("text", "number"),
    [("2,5", 2.5), (" 10.0 ", 10.0), ("-,5", -0.5), ("1_0", None), ("nan", None), ("٣", None), ("1.000,5", None)],
)
def test_a_number_has_a_decimal_point_or_a_comma_and_nothing_else(text, number):
    assert number_in(text) == number
