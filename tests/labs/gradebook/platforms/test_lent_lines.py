"""A right function that lost nothing to a wrong one says so, once, on every platform."""

from __future__ import annotations

import pytest

from labs.gradebook.platforms.lines import lines

SAID = "collide calls your normal_velocity, and that one is not right yet."


def content(verdict, message, *passed):
    test = {"function": "collide", "title": "t", "hidden": False, "possible": 2, "message": "", "rationale": "Why."}
    tests = [test | {"passed": each, "got": 2 * each, "help": "", "parts": []} for each in passed]
    functions = [{"name": "collide", "verdict": verdict, "message": message, "mistakes": []}]
    return {"functions": functions, "tests": tests, "possible": 2 * len(tests)}


@pytest.mark.parametrize("passed", [(True,), (True, True), (True, True, True)])
def test_a_right_function_says_in_its_first_test_whose_mistake_cost_it_nothing(passed):
    said = [[each.text for each in line.words] for line in lines(content("right", SAID, *passed))]
    assert said == [[SAID], *([],) * (len(passed) - 1)]


def test_a_right_function_with_nothing_to_say_has_no_words():
    assert [line.words for line in lines(content("right", "", True, True))] == [(), ()]


def test_a_wrong_function_says_it_in_the_first_test_that_failed():
    said = [[each.text for each in line.words] for line in lines(content("wrong", "collide: wrong.", True, False))]
    assert said == [[], ["collide: wrong.", "Why."]]
