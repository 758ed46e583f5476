"""Rosters as platforms export them."""

from __future__ import annotations

CANVAS_FILE = """\
Student,ID,SIS User ID,SIS Login ID,Section,impulse (90)
    Points Possible,,,,,100
"Lovelace, Ada",100,4711,ada@example.org,A,
"Müller, Zoë",8,4712,zoe@example.org,A,
"Student, Test",9,,,A,
"""
MOODLE_FILE = """\
Identifier,Full name,ID number,Email address,Status,Grade
Participant 31,Ada Lovelace,4711,ada@example.org,Submitted,
Participant 32,Zoë Müller,,zoe@example.org,Submitted,
"""
PLAIN_FILE = "student_id,name,email,canvas_id\n4711,Ada Lovelace,ada@example.org,7\n4712,Zoë Müller,,8\n"
GERMAN_FILE = """\
ID,Vollständiger Name,ID-Nummer,Status,Bewertung,Bestwertung,Zuletzt geändert (Abgabe),Zuletzt geändert (Bewertung)
Teilnehmer/in31,Ada Lovelace,0815,Zur Bewertung abgegeben - 36 Tage 10 Stunden zu spät -  - ,,"50,00",\
"Dienstag, 2. Dezember 2025, 10:37",-
"""
