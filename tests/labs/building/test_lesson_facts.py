"""What the lesson on impulses says in words, beside the tests that measure it."""

from __future__ import annotations

import re

import pytest

from labs.building import lessons


@pytest.fixture(scope="module")
def text() -> str:
    return " ".join(" ".join(cell.text for cell in lessons.read("impulse").cells).split())


def test_the_lesson_tells_the_struck_point_from_the_still_one(text):
    # test_the_struck_end_is_the_centre_of_percussion_of_the_still_point
    assert "The *struck* point has a name: it is the centre of percussion of a rod that is held at the still" in text
    assert "the point to hold a bat at" not in text


def test_the_lesson_follows_the_parting_balls_into_their_second_collision(text):
    # test_after_mujocos_reversal_the_parting_balls_collide_again
    reversal, end = text.index("(−0.27, 0.73, 0.63)"), text.index("(−0.27, 0.63, 0.73)")
    assert "collide in the next step" in text[reversal:end]


def test_the_minutes_of_the_headings_add_up_to_the_hours_promised(text):
    lines = [line for cell in lessons.read("impulse").cells if not cell.code for line in cell.text.split("\n")]
    headings = [line for line in lines if line.startswith("## ") and "extension" not in line]
    minutes = [int(re.search(r"\((\d+) minutes\)$", heading)[1]) for heading in headings]
    assert "**Time:** four hours" in text
    assert sum(minutes) == 4 * 60


def test_every_line_of_code_of_the_lesson_can_be_read_at_800_pixels():
    code = [cell.text for cell in lessons.read("impulse").cells if cell.code and cell.kind != "given"]
    assert [line for text in code for line in text.split("\n") if len(line) > 79] == []
