"""What the lesson on impulses says in words, beside the tests that measure it."""

from __future__ import annotations

import functools
import re

import pytest
from made_lessons import EACH_LAB, text_of

from labs.building import lessons, notebooks
from labs.building.notebooks import WIDTH
from labs.project_folders import LESSONS
from reference import lecture


@pytest.fixture(scope="module")
def text() -> str:
    return text_of("impulse")


def test_the_lesson_tells_the_struck_point_from_the_still_one(text):
    # test_the_struck_end_is_the_centre_of_percussion_of_the_still_point
    assert "The *struck* point has a name: it is the centre of percussion of a rod that is held at the still" in text
    assert "the point to hold a bat at" not in text


def test_the_lesson_follows_the_parting_balls_into_their_second_collision(text):
    # test_after_mujocos_reversal_the_parting_balls_collide_again
    reversal, end = text.index("(−0.27, 0.73, 0.63)"), text.index("(−0.27, 0.63, 0.73)")
    assert "collide in the next step" in text[reversal:end]


@EACH_LAB
def test_a_lesson_has_the_title_that_its_check_shows(topic):
    first = next(cell for cell in lessons.read(topic).cells if not cell.code)
    assert first.text.splitlines()[0] == f"# {lecture.topic(topic).title}"


HOURS = {"four": 4, "five": 5, "six": 6}
"""Of a lab, in words: it takes four hours, or five at most; the last one takes six, in two sessions."""


def minutes_of(topic: str) -> int:
    """How long a lab takes, as its lesson says at the beginning."""
    text = "\n".join(cell.text for cell in lessons.read(topic).cells if not cell.code)
    (hours,) = re.findall(r"\*\*Time:\*\* (\w+) hours", text)
    return 60 * HOURS[hours]


@EACH_LAB
def test_the_minutes_of_the_headings_make_the_hours_that_the_lesson_names(topic):
    text = "\n".join(cell.text for cell in lessons.read(topic).cells if not cell.code)
    planned = map(int, re.findall(r"^## .* \((\d+) minutes\)$", text, re.MULTILINE))
    assert sum(planned) == minutes_of(topic)


@functools.cache
def cells_of(topic: str) -> list[dict]:
    """The cells of a student's notebook, built once for the tests of this file."""
    return notebooks.student(topic)["cells"]


@EACH_LAB
def test_a_students_code_can_be_read_at_800_pixels(topic):
    cells = [cell for cell in cells_of(topic) if cell["cell_type"] == "code"]
    assert [line for cell in cells for line in cell["source"] if len(line.rstrip()) > WIDTH] == []


@EACH_LAB
def test_no_formula_is_broken_where_its_second_line_begins_a_list(topic):
    prose = re.sub(r"(?ms)^```.*?^```", "", (LESSONS / f"{topic}.md").read_text(encoding="utf-8"))
    for paragraph in re.split(r"\n\s*\n", prose):
        for mark in re.finditer(r"\n[-+*] ", paragraph):
            assert paragraph[: mark.start()].count("$") % 2 == 0, paragraph
