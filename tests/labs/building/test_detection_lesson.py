"""What the lesson on detection says in numbers: its minutes, its loops, and the answers to its questions."""

from __future__ import annotations

import ast
import math
import re
from types import SimpleNamespace
from typing import Any

import pytest

from labs.building import lessons


@pytest.fixture(scope="module")
def lesson():
    return lessons.read("detection")


def defined_in_cell_of(lesson: lessons.Lesson, name: str) -> dict[str, Any]:
    """What a cell of the lesson defines that defines a function of this name."""
    (cell,) = (cell for cell in lesson.cells if cell.code and not cell.kind and f"def {name}(" in cell.text)
    defined: dict[str, Any] = {"lab": SimpleNamespace(show=lambda experiment, predicted: experiment())}
    exec(compile(cell.text, name, "exec"), defined)
    return defined


def model(lesson: lessons.Lesson, key: str) -> str:
    """The model answer to a question, in one line."""
    return " ".join(" ".join(cell.text for cell in lesson.models(key)).split())


def choices(lesson: lessons.Lesson, key: str) -> dict[str, tuple[float, ...]]:
    """The numbers that a question draws from."""
    calls = (node for cell in lesson.cells if cell.code and "lab.numbers(" in cell.text
             for node in ast.walk(ast.parse(cell.text)) if isinstance(node, ast.Call))  # fmt: skip
    call = next(node for node in calls if node.args and ast.literal_eval(node.args[0]) == key)
    return {str(each.arg): ast.literal_eval(each.value) for each in call.keywords}


def test_three_orders_of_the_loop_have_the_errors_that_are_named(lesson, capsys):
    shown = defined_in_cell_of(lesson, "mean_apex")
    e = shown["e"]
    printed = [float(number) for number in re.findall(r": (-[\d.]+) times", capsys.readouterr().out)]
    assert printed == pytest.approx([-(1 - e), -(1 - e**2), -(1 + e)], abs=0.006)


def test_the_puck_that_loses_time_counts_what_the_answer_says(lesson, capsys):
    count = defined_in_cell_of(lesson, "impacts_by_steps")["impacts_by_steps"]
    capsys.readouterr()
    asked, said = choices(lesson, "puck"), model(lesson, "puck")
    for speed in asked["speed"]:
        found = ", ".join(str(count(speed, dt, 10.0)) for dt in asked["dt"])
        assert f"{found} at {speed:g} m/s" in said


def test_the_puck_loses_nothing_if_its_way_takes_whole_steps(lesson, capsys):
    """Rounding makes some of these steps fall short of the wall by a part in 10¹⁶."""
    count = defined_in_cell_of(lesson, "impacts_by_steps")["impacts_by_steps"]
    for speed in choices(lesson, "puck")["speed"]:
        for steps in range(1, 30):
            assert count(speed, 1 / (steps * speed), 10.0) == 10 * speed, (speed, steps)


def test_parts_of_a_step_are_those_of_the_answer(lesson):
    said, ways = model(lesson, "wall"), [speed / 240 for speed in choices(lesson, "wall")["speed"]]
    for seen in (0.05, 0.025):
        parts = [math.floor(way / seen) + 1 for way in ways]
        assert f"n = {', '.join(map(str, parts))}" in said
        for way in ways:  # no whole number of parts, where rounding would decide
            assert abs(way / seen - round(way / seen)) > 0.05
