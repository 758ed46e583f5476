"""Marks as a plain table and as JUnit XML. What Canvas and Moodle take back is made in `upload`.

Threat: names and messages are hostile text. A cell that a spreadsheet would take for a formula begins with an
apostrophe; characters that XML cannot hold are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any
from xml.etree import ElementTree

from labs.gradebook.deadlines import Lateness
from labs.gradebook.roster import Student
from labs.gradebook.sheets import Dialect
from labs.grading.safe_text import plain

OUT_OF = 100.0
"""Points of a lab."""
_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")
_NOT_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
COLUMNS = (
    "student_id", "name", "assignment", "raw_score", "late_penalty", "score", "max_score", "open", "late", "notes",
    "protection",
)  # fmt: skip


@dataclass(frozen=True)
class Mark:
    """What a student gets. raw: points of a hundred so far; None if nothing was handed in. open: that a person gives.

    content: of the grade, empty if there is none. notes: what the instructor should know.
    """

    student: Student
    lab: str
    raw: float | None
    open: float = 0.0
    late: Lateness = field(default_factory=Lateness)
    content: Mapping[str, Any] | None = None
    notes: tuple[str, ...] = ()

    @property
    def score(self) -> float | None:
        """What is left after a late submission's loss."""
        return None if self.raw is None else self.raw * self.late.share


def defused(text: str) -> str:
    """Text on one line that no spreadsheet takes for a formula, with hidden characters made visible."""
    bare = re.sub(r"[\r\n]+", " ", plain(text))
    return f"'{bare}" if runs_as_formula(text) or runs_as_formula(bare) else bare


def runs_as_formula(text: str) -> bool:
    """Whether a spreadsheet may take a cell for a formula: it may leave out blanks at the start. `-` alone is none."""
    return len(text.strip()) > 1 and (text.startswith(_FORMULA) or text.lstrip().startswith(_FORMULA))


def plain_table(marks: Iterable[Mark]) -> str:
    """A line for each student."""
    return Dialect().text([COLUMNS, *map(_line, marks)])


def _line(mark: Mark) -> list[str]:
    raw, score = mark.raw, mark.score
    return [
        defused(mark.student.id), defused(mark.student.name), mark.lab, number(raw),
        number(None if raw is None or score is None else raw - score), number(score), number(OUT_OF),
        number(mark.open), defused(mark.late.said), defused("; ".join(mark.notes)),
        str((mark.content or {}).get("tier", "")),
    ]  # fmt: skip


def junit(marks: Iterable[Mark]) -> str:
    """A suite for each student and a case for each test; the points are properties."""
    root = ElementTree.Element("testsuites")
    for mark in marks:
        suite = ElementTree.SubElement(root, "testsuite", name=_fit(mark.student.id))
        tests = list(mark.content.get("tests", ())) if mark.content else []
        suite.set("tests", str(len(tests)))
        suite.set("failures", str(sum(not test["passed"] for test in tests)))
        for test in tests:
            case = ElementTree.SubElement(suite, "testcase", classname=_fit(test["topic"]), name=_fit(test["title"]))
            values = ElementTree.SubElement(case, "properties")
            for name in ("got", "possible"):
                ElementTree.SubElement(values, "property", name=name, value=str(test[name]))
            if not test["passed"]:
                ElementTree.SubElement(case, "failure", message=_fit(test["message"] or test["title"]))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=False) + "\n"


def _fit(text: str) -> str:
    return _NOT_XML.sub("", str(text))


def number(value: float | None) -> str:
    """A number of points with up to two decimals; empty if there is none."""
    return "" if value is None else f"{value:.2f}".rstrip("0").rstrip(".")
