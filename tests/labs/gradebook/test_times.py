"""Time stamps as platforms write them: with the names of zones, in words, and in the languages of Moodle."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest

from labs.gradebook.moodle import language_of, languages
from labs.gradebook.times import moment

IN_SHANGHAI, IN_CHICAGO = (datetime.fromisoformat(f"2026-06-30T23:59:00{zone}") for zone in ("+08:00", "-05:00"))


@pytest.mark.parametrize(
    ("zone", "hour"),
    [
        ("UTC", 12), ("Z", 12), ("gmt", 12), ("CET", 11), ("EST", 17), ("+0530", 6.5), ("-03", 15), ("UTC+2", 10),
        ("GMT-05:00", 17), ("Asia/Kolkata", 6.5), ("America/Sao_Paulo", 15), ("Japan", 3),
    ],
)  # fmt: skip
def test_a_zone_is_an_offset_a_name_or_an_abbreviation(zone, hour):
    expected = datetime(2026, 12, 4, tzinfo=UTC) + timedelta(hours=hour)
    assert moment(f"2026-12-04 12:00:00.000000 {zone}") == expected


@pytest.mark.parametrize(
    "zone", ["", "XYZ", "CST", "PST", "IST", "../../etc/passwd", "America", "+99", "UTC UTC", "CEST"]
)
def test_a_zone_that_nobody_knows_or_that_may_be_several_is_not_guessed(zone):
    assert moment(f"2026-12-04 12:00:00 {zone}") is None


def test_the_deadline_decides_which_zone_an_abbreviation_means():
    assert moment("2026-12-04 12:00:00 CST", IN_SHANGHAI) == datetime(2026, 12, 4, 4, tzinfo=UTC)
    assert moment("2026-12-04 12:00:00 CST", IN_CHICAGO) == datetime(2026, 12, 4, 18, tzinfo=UTC)
    assert moment("2026-12-04 12:00:00 IST", IN_CHICAGO) is None


@pytest.mark.parametrize(
    ("header", "submitted", "status", "at", "late_by"),
    [
        ("Identifier,Full name", "Friday, September 4, 2026, 11:59 PM", "Submitted for grading", (9, 4, 23, 59), None),
        ("Identifier,Status,Grade", "Wednesday, 10 June 2026, 12:05 AM",
         "Submitted for grading - Assignment was submitted late: 1 day 2 hours", (6, 10, 0, 5), (1, 2, 0)),
        ("Identifier,Status,Grade", "Wednesday, 10 June 2026, 2:14\u202fp.m.",
         "Submitted for grading - 59 mins 3 secs late - Graded", (6, 10, 14, 14), (0, 0, 59)),
        ("Identifier,Status,Grade", "-", "No submission - Assignment is overdue by: 3 days", None, None),
        ("Identifier,Status,Grade", "", "Extension granted until: Wednesday, 10 June 2026, 2:14 PM", None, None),
        ("ID,Vollständiger Name,Status", "Dienstag, 2. März 2026, 10:37",
         "Zur Bewertung abgegeben - 36 Tage 10 Stunden zu spät -  - ", (3, 2, 10, 37), (36, 10, 0)),
        ("Identifiant,Nom complet", "lundi 3 août 2026, 10:00", "Remis - En retard de 2 jours 1 heure",
         (8, 3, 10, 0), (2, 1, 0)),
        ("Identificador,Estado,Calificación", "lunes, 5 de octubre de 2026, 10:00", "3 horas 5 minutos después",
         (10, 5, 10, 0), (0, 3, 5)),
        ("Identificador,Status,Nota", "segunda-feira, 5 de outubro de 2026, 10:00", "3 dias 5 minutos atrasado",
         (10, 5, 10, 0), (3, 0, 5)),
        ("Identificativo,Stato,Valutazione", "lunedì, 5 ottobre 2026, 10:00", "1 giorno 1 ora in ritardo",
         (10, 5, 10, 0), (1, 1, 0)),
        ("Identificatie,Status,Cijfer", "maandag, 5 oktober 2026, 10:00", "2 dagen 4 uren laat",
         (10, 5, 10, 0), (2, 4, 0)),
        ("Identifier,Full name", "Smarch 13, 2026, 10:00", "late by " + "9" * 5000 + " days", None, None),
        ("Identifier,Full name", "Wednesday, 31 June 2026, 25:99", "", None, None),
    ],
)  # fmt: skip
def test_moodles_worksheet_says_when_in_every_language_that_is_known(header, submitted, status, at, late_by):
    words = language_of(header.split(","))
    assert words is not None
    found = words.received(submitted, status)
    assert found.at == (at and datetime(2026, *at))
    days, hours, minutes = late_by or (0, 0, 0)
    assert found.late_by == (late_by and timedelta(days=days, hours=hours, minutes=minutes))
    assert found.called_late == bool(late_by)


def test_every_language_names_twelve_months_and_a_table_of_ones_own_is_no_worksheet():
    assert [len(set(each.months)) for each in languages()] == [12] * len(languages())
    assert language_of(["ID", "Full name", "Status"]) is None
