"""Marks as files that platforms take back, with hostile names in them."""

from __future__ import annotations

import csv
import io
from xml.etree import ElementTree

import pytest

from labs.gradebook.deadlines import Lateness
from labs.gradebook.roster import Student
from labs.gradebook.tables import Mark, defused, junit, plain_table

ADA, ZOE = Student("4711", "Ada Lovelace"), Student("4712", "Zoë Müller")
TEST = {
    "topic": "impulse",
    "title": "a ball rebounds",
    "passed": False,
    "message": "\x1b[0m <b>",
    "got": 1,
    "possible": 4,
}


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_a_mark_says_what_was_reached_and_what_lateness_took(tmp_path):
    mark = Mark(ADA, "impulse", 60.0, 35.0, Lateness(2, 0.8, "3 days late, 1 of them free"), notes=("a", "b"))
    (row, none) = rows(plain_table([mark, Mark(ZOE, "impulse", None, notes=("nothing handed in",))]))
    assert (row["raw_score"], row["late_penalty"], row["score"], row["max_score"]) == ("60", "12", "48", "100")
    assert (row["open"], row["late"], row["notes"]) == ("35", "3 days late, 1 of them free", "a; b")
    assert (none["raw_score"], none["score"], none["notes"]) == ("", "", "nothing handed in")


@pytest.mark.parametrize("text", ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1", "\n=1"])
def test_no_cell_is_a_formula(text):
    (row,) = rows(plain_table([Mark(Student(text, text), "impulse", 1.0, notes=(text,))]))
    assert [row["student_id"], row["name"], row["notes"]] == ["'" + text.replace("\n", " ").replace("\r", "␍")] * 3
    assert defused("Ada - Lovelace") == "Ada - Lovelace"


def test_junit_has_a_case_for_each_test_and_no_character_that_xml_forbids():
    text = junit([Mark(Student("a<b\x00&", ""), "impulse", 1.0, content={"tests": [TEST, TEST | {"passed": True}]})])
    (suite,) = ElementTree.fromstring(text)
    assert (suite.get("name"), suite.get("tests"), suite.get("failures")) == ("a<b&", "2", "1")
    assert [case.find("failure") is not None for case in suite] == [True, False]
    assert suite[0].find("failure").get("message") == "[0m <b>"
