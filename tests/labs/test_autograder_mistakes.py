"""Every known mistake loses points in the tests of its function, and what is right in other words loses none.

The tests run here, without a worker: what they ask is what matters.
"""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import zlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from labs.grading.bank import read_bank
from labs.grading.examples import Examples
from reference import lecture
from reference.errors import CollisionsError

FOLDER = Path(__file__).parents[1] / "autograder"
TOPICS = ("detection", "response", "friction", "impulse")
WRITTEN = [entry for topic in TOPICS for entry in lecture.functions_of(topic) if entry.role == "written"]
BANK = read_bank()
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero


class Here:
    """A submission of some functions, called in this process; all others are the solutions'."""

    def __init__(self, **functions):
        self.functions = functions

    def process(self):
        def function(name):
            return lambda *arguments, **named: getattr(self, name)(*arguments, **named)

        own = SimpleNamespace(function=function)
        return SimpleNamespace(implementation=lambda: own, defines=lambda name: False)

    def __getattr__(self, name):
        solutions = importlib.import_module(f"solutions.{lecture.function(name).topic}")
        return Asked(name, self.functions.get(name) or getattr(solutions, name))


class Asked:
    def __init__(self, name, function):
        self.name, self.function = name, function
        self.functions = SimpleNamespace(process=lambda: SimpleNamespace(changed=self.changed))

    def __call__(self, *arguments, **named):
        before = repr(arguments)
        try:
            answer = self.function(*arguments, **named)
        except Exception as error:
            raise AssertionError(f"raised {error!r}") from None
        self.changed = repr(arguments) != before
        return answer


def tests_by_function():
    found = {}
    for folder in ("visible", "hidden"):
        for topic in TOPICS:
            path = FOLDER / folder / f"test_{topic}.py"
            spec = importlib.util.spec_from_file_location(f"{folder}_{topic}", path)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            for name, test in vars(module).items():
                marks = {mark.name: mark.args for mark in getattr(test, "pytestmark", ())} if callable(test) else {}
                if name.startswith("test_") and "function" in marks:
                    found.setdefault(marks["function"][0], []).append((folder, test, marks["points"][0]))
    return found


TESTS = tests_by_function()


def lost(function, submission, seed=1):
    """The points that a submission loses in the tests of a function, and what was said."""
    total, said = 0, []
    for _, test, points in TESTS[function]:
        earned = []

        @contextlib.contextmanager
        def part(worth, reason, earned=earned):
            try:
                yield
            except (AssertionError, CollisionsError) as error:
                said.append(f"{reason}: {error}")
            else:
                earned.append(worth)

        given = {"submission": submission, "part": part, "examples": Examples(seed, told=False)}
        wanted = test.__code__.co_varnames[: test.__code__.co_argcount]
        test(**{name: given[name] for name in wanted})
        total += points - sum(earned)
    return total, said


def test_every_function_that_a_student_writes_has_visible_and_hidden_tests():
    for entry in WRITTEN:
        assert [folder for folder, *_ in TESTS[entry.name]] == ["visible", "hidden"], entry.name


@pytest.mark.parametrize("topic", TOPICS)
def test_the_solutions_lose_no_point(topic):
    for entry in lecture.functions_of(topic):
        if entry.role == "written":
            assert lost(entry.name, Here()) == (0, [])


def unpunished(bank):
    return [entry.id for entry in bank if not lost(entry.function, Here(**{entry.function: entry.formula}))[0]]


def test_mistakes_lose_points():
    assert unpunished(BANK[zlib.crc32(b"a sample") % 12 :: 12]) == []


@pytest.mark.slow
def test_every_mistake_loses_points():
    assert unpunished(BANK) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 8))
def test_every_mistake_loses_points_whatever_the_examples(seed):
    def still(entry):
        return lost(entry.function, Here(**{entry.function: entry.formula}), seed)[0]

    assert [entry.id for entry in BANK if not still(entry)] == []
    assert [entry.name for entry in WRITTEN if lost(entry.name, Here(), seed)[0]] == []


@pytest.mark.parametrize("path", sorted((FOLDER / "alternatives").glob("*.py")), ids=lambda path: path.stem)
def test_other_answers_by_hand_lose_no_point(path):
    space = {}
    exec(compile(path.read_text(encoding="utf-8"), path, "exec"), space)
    written = {entry.name: space[entry.name] for entry in WRITTEN if entry.name in space}
    told = [line for name in written for line in lost(name, Here(**written))[1]]
    if path.stem == "single":  # for one contact alone: what asks for several is all that is lost
        told = [line for line in told if "one call" not in line.split(":")[0] and "at once" not in line.split(":")[0]]
    assert told == []


@pytest.mark.parametrize("shape", ["lists", "single precision"])
def test_lists_and_single_precision_lose_no_point(shape):
    def said(value):
        if isinstance(value, tuple):
            return tuple(map(said, value))
        return np.asarray(value).tolist() if shape == "lists" else np.asarray(value, dtype=np.float32)

    def answering(name):
        right = getattr(Here(), name)
        return lambda *arguments: said(right(*arguments))

    assert [
        line for entry in WRITTEN for line in lost(entry.name, Here(**{entry.name: answering(entry.name)}))[1]
    ] == []
