"""Tests of a submission run in this process, on functions that are here: what the tests ask is what matters."""

from __future__ import annotations

import contextlib
import importlib.util
import pickle
from pathlib import Path
from types import SimpleNamespace

from labs.grading.judging.case_by_case import CaseByCase
from labs.grading.judging.examples import Examples
from labs.grading.judging.outcomes import NOTHING_COMPUTED
from labs.grading.judging.same_answers import SameAnswers
from reference.errors import CollisionsError

FOLDER = Path(__file__).parents[1] / "autograder"
TOPICS = (
    "detection", "response", "friction", "impulse", "polyhedra", "sweeping", "forces", "meshes", "avoidance", "world",
)  # fmt: skip


class Asked:
    """A function as a test gets it."""

    def __init__(self, name, function, case_by_case=None, answers=None):
        self.name, self.function = name, function
        process = SimpleNamespace(changed=(), printed="")
        self.functions = SimpleNamespace(process=lambda: process, case_by_case=case_by_case or CaseByCase())
        self.answers = answers or SameAnswers()

    def __call__(self, *arguments, **named):
        before = pickle.dumps(arguments)
        try:
            answer = self.function(*arguments, **named)
        except Exception as error:
            self.answers.note_error()
            raise AssertionError(f"raised {error!r}") from None
        self.functions.process().changed = (0,) if pickle.dumps(arguments) != before else ()
        self.answers.note(answer)
        return answer

    def foresee(self, several):
        pass


def loaded(name, path):
    """A file of tests as a module."""
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def collected(*folders):
    """By function: folder, test and points."""
    found = {}
    for folder in folders:
        for topic in TOPICS:
            module = loaded(f"{folder}_{topic}", FOLDER / folder / f"test_{topic}.py")
            for name, test in vars(module).items():
                marks = {mark.name: mark.args for mark in getattr(test, "pytestmark", ())} if callable(test) else {}
                if name.startswith("test_") and "function" in marks:
                    found.setdefault(marks["function"][0], []).append((folder, test, marks["points"][0]))
    return found


class Lost(Exception):
    """A part of a test is lost, and nobody wants to know of the others."""


def loses_a_part(test, points, submission, seed=1):
    """Whether a submission loses a part of one test; none is tried after that."""
    try:
        lost, _ = run_test(test, points, submission, seed, to_the_end=False)
    except Lost:
        return True
    return lost > 0


def run_test(test, points, submission, seed=1, to_the_end=True):
    """The points that a submission loses in one test, and what was said."""
    said, earned = [], []
    submission.same_answers.clear()

    @contextlib.contextmanager
    def part(worth, reason):
        submission.case_by_case.begin_part()
        try:
            yield
        except (AssertionError, CollisionsError, *NOTHING_COMPUTED) as error:
            if not to_the_end:
                raise Lost from error
            said.append(f"{reason}: {error}")
        else:
            failure = submission.case_by_case.charge()
            (said.append(f"{reason}: {failure}") if failure else earned.append(worth))

    given = {"submission": submission, "part": part, "examples": Examples(seed, shown=False)}
    test(**{name: given[name] for name in test.__code__.co_varnames[: test.__code__.co_argcount]})
    asked = next((mark.args[0] for mark in getattr(test, "pytestmark", ()) if mark.name == "function"), "")
    if same := submission.same_answers[asked].found():
        return points, [*said, same]
    return points - sum(earned), said
