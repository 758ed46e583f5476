"""Where this copy of the project lies, and the folders of it that code reads by path rather than by import.

A checkout has all of them. A student's release has neither solutions nor lessons, and of the tests only the visible
ones. A wheel that was installed elsewhere has the packages alone, so there `AUTOGRADER` and `BENCHES` do not exist.
"""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
"""The folder that the packages `labs` and `reference` lie in."""
AUTOGRADER = ROOT / "tests" / "autograder"
"""The tests that grade a submission, and what proves these tests: known mistakes, and right answers in other words."""
BENCHES = ROOT / "tests" / "bench"
LESSONS = ROOT / "labs" / "lessons"
STUDENT_NOTEBOOKS = ROOT / "labs" / "notebooks"
SOLVED_NOTEBOOKS = ROOT / "solutions" / "notebooks"
INSTRUCTOR_PAGES = ROOT / "docs" / "instructors"
COURSE_PAGE = ROOT / "docs" / "course.md"
HINTS = ROOT / "labs" / "hints"
FIGURES = ROOT / "labs" / "figures"
DRAWING = ROOT / "docs" / "figures"
"""The programs that draw the figures of the labs and of the pages. Git does not keep what they draw."""
