"""How late a submission is, and what that costs, by the rules of a course."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta

import pytest

from labs.gradebook.deadlines import CALLED_LATE, NO_TIME, read_deadlines
from labs.gradebook.layouts import CANVAS
from labs.gradebook.roster import Student
from labs.gradebook.times import Received
from reference.errors import CollisionsError

RULES = """\
[due]
impulse = 2026-11-30T23:59:00+01:00

[late]
grace_minutes = 10
free_days = 1
percent_per_day = 20
most_days = 4

[due.students.4711]
impulse = 2026-12-07T23:59:00+01:00
"""
DUE = datetime.fromisoformat("2026-11-30T23:59:00+01:00")


def at(moment: datetime) -> Received:
    return Received(at=moment)


@pytest.fixture
def rules(tmp_path):
    def read(text: str = RULES):
        path = tmp_path / "course.toml"
        path.write_text(text, encoding="utf-8")
        return read_deadlines(path)

    return read


@pytest.mark.parametrize(
    ("hours", "share", "said"),
    [
        (-1, 1.0, ""),
        (10 / 60, 1.0, ""),
        (11 / 60, 1.0, "1 day late, 1 of them free"),
        (24, 1.0, "1 day late, 1 of them free"),
        (24.1, 0.8, "2 days late, 1 of them free"),
        (95, 0.4, "4 days late, 1 of them free"),
        (97, 0.0, "5 days late, 1 of them free"),
    ],
)
def test_each_day_that_has_begun_costs_after_grace_and_free_days(rules, hours, share, said):
    found = rules().lateness("4712", "impulse", at(DUE + timedelta(hours=hours)))
    assert (found.share, found.said) == (pytest.approx(share), said)


def test_a_student_may_have_a_deadline_of_their_own(rules):
    assert rules().lateness("4711", "impulse", at(DUE + timedelta(days=6))).share == 1.0
    assert rules().lateness("4711", "impulse", at(DUE + timedelta(days=9))).share == pytest.approx(0.8)


def test_where_nobody_knows_when_it_came_nothing_is_taken_off(rules):
    called = Received(called_late=True)
    assert rules().lateness("4712", "impulse", called).share == 1.0
    assert rules().lateness("4712", "impulse", called).said == CALLED_LATE
    assert CALLED_LATE.endswith("but not by how much: nothing is taken off")
    assert rules().lateness("4712", "detection", at(DUE + timedelta(days=99))).said == ""


def test_where_no_rule_says_what_lateness_costs_it_costs_nothing_and_that_is_said(rules):
    found = rules("[due]\nimpulse = 2026-11-30T23:59:00+01:00\n").lateness(
        "1", "impulse", at(DUE + timedelta(hours=25))
    )
    assert (found.share, found.said) == (1.0, "2 days late: nothing is taken off")


def test_a_deadline_of_a_student_whom_nobody_knows_is_named_with_who_may_be_meant(rules):
    ada = Student("4711", "Ada Lovelace", keys={CANVAS: frozenset({"70310"})})
    bob = Student("4799", "Bob")
    table = "[due.students.{}]\nimpulse = 2026-12-07T23:59:00Z\n".format
    assert rules().without_student([ada, bob]) == ""
    assert rules().without_student([bob]) == "'4711'"
    found = rules(table("4713") + table("70310") + table("xyz")).without_student([ada, bob])
    assert found == "'4713' (perhaps 4711 (Ada Lovelace)), '70310' (perhaps 4711 (Ada Lovelace)) and 'xyz'"


def test_a_course_says_whom_to_ask_about_a_mark_and_for_how_long(rules):
    assert (rules().contact, rules().days_to_ask) == ("your instructor", None)
    found = rules('[regrade]\ncontact = "Ada, ada@example.org"\ndays = 14\n')
    assert (found.contact, found.days_to_ask) == ("Ada, ada@example.org", 14)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[regrade]\ncontact = 3\n", "contact is 3 in the rules; it is a text in quotes"),
        ("[regrade]\nday = 3\n", "unknown entry of .regrade. 'day'"),
        ("[due]\nimpulse = 2026-11-30T23:59:00\n", "write it with its zone"),
        ("[due]\nimpuls = 2026-11-30T23:59:00Z\n", "impuls"),
        ("[late]\nfree = 2\n", "free"),
        ("[late]\npercent_per_day = 120\n", "must lie between 0 and 1"),
        ("[late]\nfree_days = -1\n", "free_days is -1 in the rules; it is a number from 0 to 1000000"),
        ("[late]\ngrace_minutes = 1e300\n", "grace_minutes is 1e.300 in the rules; it is a number from 0"),
        ("[late]\nmost_days = nan\n", "most_days is nan in the rules"),
        ("[late]\nfree_days = " + "[" * 5000, "is no TOML file"),
        ("late = 3\n", r"it is a table, \[late\]"),
        ("[due\n", "is no TOML file"),
    ],
)
def test_rules_that_cannot_be_meant_are_refused_by_name(rules, text, said):
    with pytest.raises(CollisionsError, match=said):
        rules(text)


@pytest.mark.parametrize("stamp", ["", "2026-12-04 15:58:23 XYZ", "2026-12-04 15:58:23 IST", "4.12.2026", "yesterday"])
def test_a_time_that_nobody_can_read_is_never_silent_where_there_is_a_deadline(rules, stamp):
    found = rules().lateness("4712", "impulse", Received(stamp))
    assert (found.share, found.said) == (1.0, NO_TIME)
    assert rules().lateness("4712", "detection", Received(stamp)).said == ""
    assert rules().lateness("4712", "impulse", Received(stamp), others_late=True).said == ""


@pytest.mark.parametrize(
    ("received", "said"),
    [
        (Received("2026-12-04 15:58:23.948203 America/Los_Angeles"), "5 days late, 1 of them free"),
        (Received("2026-12-01 23:59:00 CET"), "1 day late, 1 of them free"),
        (Received("2026-12-01 23:59 +0200"), "1 day late, 1 of them free"),
        (Received("2026-11-30T22:59:00Z"), ""),
        (Received(at=datetime(2026, 12, 2, 0, 0)), "2 days late, 1 of them free"),
        (Received(late_by=timedelta(days=1, hours=2)), "2 days late, 1 of them free"),
        (Received(at=datetime(2026, 11, 30, 12, 0), late_by=timedelta(days=9)), ""),
    ],
)
def test_lateness_is_read_from_zones_clocks_and_durations(rules, received, said):
    assert rules().lateness("4712", "impulse", received).said == said


@pytest.mark.parametrize(
    ("student", "received", "differs"),
    [
        ("4712", Received(at=datetime(2026, 12, 2, 1, 59), late_by=timedelta(hours=26)), False),
        ("4712", Received(at=datetime(2026, 12, 2, 1, 59), late_by=timedelta(hours=20)), True),
        ("4712", Received(at=datetime(2026, 12, 1, 0, 10)), True),
        ("4712", Received(at=datetime(2026, 11, 30, 23, 59)), False),
        ("4711", Received(at=datetime(2026, 12, 2, 1, 59), late_by=timedelta(hours=26)), False),
        ("4711", Received(at=datetime(2026, 12, 8, 1, 59), late_by=timedelta(hours=2)), False),
        ("4711", Received(late_by=timedelta(hours=2)), False),
    ],
)
def test_a_platform_that_counts_from_another_deadline_is_noticed(rules, student, received, differs):
    found = rules(RULES.replace("grace_minutes = 10", "grace_minutes = 5"))
    assert found.is_judged_otherwise(student, "impulse", replace(received, says_lateness=True)) == differs


def test_a_duration_counts_from_the_deadline_that_everybody_has(rules):
    assert rules().lateness("4711", "impulse", Received(late_by=timedelta(days=6))).said == ""
    assert rules().lateness("4711", "impulse", Received(late_by=timedelta(days=8))).said == "1 day late, 1 of them free"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_rules_that_an_editor_saved_in_its_own_way_are_read(tmp_path, encoding):
    path = tmp_path / "course.toml"
    path.write_bytes('# für alle\r\n[regrade]\r\ncontact = "Zoë"\r\n'.encode(encoding))
    assert read_deadlines(path).contact == "Zoë"
