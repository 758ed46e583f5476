"""Tests of a submission: they look like any test, are worth points, and keep to themselves what is hidden."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from types import SimpleNamespace

import pytest

from labs.grading.calling.remote import Grader
from labs.grading.judging.plugin import GRADER, SHEET, Functions
from labs.grading.judging.score_sheet import Sheet

pytest_plugins = "pytester"

VISIBLE = """
import pytest
from hypothesis import given, settings, strategies as st

@pytest.mark.points(3)
@pytest.mark.rationale("A ball leaves with e times the speed it came with.")
@pytest.mark.help("Statement 12.")
def test_rebound(submission):
    assert submission.rebound_velocity(-2.0, 0.5) == 1.0

@pytest.mark.points(4)
def test_in_parts(submission, part):
    with part(1, "a ball at rest"):
        assert submission.rebound_velocity(0.0, 0.5) == 0.0
    with part(2, "the sign"):
        assert submission.rebound_velocity(-1.0, 1.0) > 0
    with part(1, "each function"):
        submission.normal_velocity(1.0)

@settings(max_examples=20)
@given(speed=st.floats(0, 40))
def test_property(submission, speed):
    print("drawn", speed.hex())
    assert abs(submission.rebound_velocity(-speed, 1.0)) < 50

def test_without_a_submission():
    pass
"""
HIDDEN = """
import pytest

@pytest.mark.points(5)
@pytest.mark.rationale("Nothing is gained by a bounce.")
def test_secret(submission):
    assert submission.rebound_velocity(-7.125, 0.5) == 3.5625

def test_error(submission):
    submission.normal_velocity(-7.125)

@pytest.mark.points(2)
def test_secret_parts(submission, part, examples):
    with part(1, "a sign"):
        assert submission.rebound_velocity(-7.125, 1.0) == 7.125, "7.125"
    with part(1, "an error"):
        submission.normal_velocity(-7.125)
    assert not examples.shown
"""
RIGHT = "def rebound_velocity(v, e): return -e * v\ndef normal_velocity(u): return u\n"
WRONG = """
class Told(Exception): pass
def rebound_velocity(v, e): return e * v
def normal_velocity(u): raise Told(f"asked for {u}")
"""


@pytest.fixture
def graded(pytester: pytest.Pytester, grader: Grader) -> Callable[..., tuple[pytest.RunResult, Sheet]]:
    """Grade a text, with the grader of this file in the place of the plugin's own."""
    return functools.partial(grade_with, pytester, grader)


def grade_with(
    pytester: pytest.Pytester, grader: Grader | None, text: str | None, *options: str, visible: str = VISIBLE
) -> tuple[pytest.RunResult, Sheet]:
    for folder, tests in (("visible", visible), ("hidden", HIDDEN)):
        (pytester.path / folder).mkdir(exist_ok=True)
        (pytester.path / folder / "test_impulse.py").write_text(tests)
    (pytester.path / "lab.py").write_text(text or "")
    sheets: list[Sheet] = []

    class Keep:
        @pytest.hookimpl(tryfirst=True)
        def pytest_configure(self, config: pytest.Config) -> None:
            if grader is not None:
                config.stash[GRADER] = grader

        def pytest_unconfigure(self, config: pytest.Config) -> None:
            sheets.append(config.stash[SHEET])

    given = ["--submission", "lab.py"] if text is not None else []
    common = [
        "-p",
        "labs.grading.judging.plugin",
        "-p",
        "no:cacheprovider",
        "-p",
        "no:randomly",  # these tests say what comes after what
        "--import-mode=importlib",
        "--strict-markers",
    ]
    result = pytester.runpytest_inprocess(*common, *given, *options, plugins=[Keep()])
    return result, sheets[0]


def test_a_right_submission_earns_every_point(pytester):
    result, sheet = grade_with(pytester, None, RIGHT)
    result.assert_outcomes(passed=7)
    assert (sheet.earned, sheet.points) == (16, 3 + 4 + 1 + 5 + 1 + 2)
    assert sheet.submission == "lab.py"
    assert not [line for outcome in sheet.outcomes for line in outcome.lines()]
    assert {outcome.said for outcome in sheet.outcomes} == {""}
    assert not sheet.diagnoses
    section = next(number for number, line in enumerate(result.outlines) if " lab.py " in line)
    told = result.outlines[section + 1 : -1]
    assert told == [*map(str, sheet.complaints), "", f"16 of 16 points ({sheet.tier})"]
    assert sheet.tier


def test_a_wrong_submission_hears_why_and_gets_the_points_of_its_parts(graded):
    result, sheet = graded(WRONG)
    result.assert_outcomes(passed=2, failed=5)
    outcomes = {outcome.test: outcome for outcome in sheet.outcomes}
    assert outcomes["test_in_parts"].earned == 1
    assert [part.passed for part in outcomes["test_in_parts"].parts] == [True, False, False]
    told = "\n".join(outcomes["test_rebound"].lines())
    assert told.startswith("rebound: 0 of 3\nassert -1.0 == 1.0\n+  where -1.0 = rebound_velocity(-2.0, 0.5)\nA ball")
    assert told.endswith("leaves with e times the speed it came with.\nStatement 12.")
    assert sheet.earned == 1 + 1
    assert outcomes["test_in_parts"].parts[2].said == "normal_velocity raised Told: asked for 1.0 (line 4)"
    result.stdout.fnmatch_lines(["edge_edge_normal, world_inverse_inertia, *are missing", "2 of 16 points (*)"])
    result.stdout.fnmatch_lines(["_* test_error _*", "normal_velocity raised Told: asked for *"], consecutive=True)
    result.stdout.fnmatch_lines(["_* test_rebound _*", "*", "E*assert -1.0 == 1.0*"])


def test_a_hidden_test_keeps_its_numbers_even_if_a_submission_prints_them(graded):
    result, sheet = graded(WRONG)
    hidden = [line for outcome in sheet.outcomes if outcome.hidden for line in outcome.lines()]
    assert hidden == [
        "secret: 0 of 5", "the answer is wrong", "Nothing is gained by a bounce.",
        "error: 0 of 1", "the function raised an exception",
        "secret parts: 0 of 2",
    ]  # fmt: skip
    parts = next(outcome.parts for outcome in sheet.outcomes if outcome.test == "test_secret_parts")
    assert [part.said for part in parts] == ["the answer is wrong", "the function raised an exception"]
    assert {outcome.test for outcome in sheet.outcomes if outcome.hidden} == {
        "test_secret", "test_error", "test_secret_parts",
    }  # fmt: skip
    assert "7.125" not in result.stdout.str().partition(" lab.py ")[2].partition("short test summary")[0]


def test_a_failed_property_shows_its_smallest_example(graded):
    _, sheet = graded("def rebound_velocity(v, e): return 99.0 if v < -3 else 0.0", "-k", "property")
    (outcome,) = sheet.outcomes
    assert outcome.said.splitlines()[0] == "assert 99.0 < 50"
    assert outcome.said.splitlines()[-1] == "for speed=4.0"


def test_unwritten_functions_are_listed_as_to_do(graded):
    _, sheet = graded("def rebound_velocity(v, e):\n    raise NotImplementedError\n")
    assert sheet.earned == 0
    assert "normal_velocity" in sheet.complaints[0].text
    told = {outcome.test: outcome.said for outcome in sheet.outcomes}
    assert told["test_rebound"] == "needs rebound_velocity (impulse, step 1): it is not written yet"
    assert told["test_property"] == told["test_rebound"]


def test_an_unreadable_file_stops_the_tests_and_is_no_mark(graded):
    result, sheet = graded("\n")
    result.stdout.fnmatch_lines(["*lab.py: it is empty*"])
    assert sheet.outcomes == []


@pytest.mark.parametrize("body", ["pass", "with part(1, 'nothing'): pass"])
def test_a_test_that_passes_without_a_call_stops_the_grading(body, graded):
    result, sheet = graded(RIGHT, visible=f"def test_nothing(submission, part):\n    {body}\n")
    result.stdout.fnmatch_lines(["*it passes, but has called no function of the submission*"])
    assert "test_nothing" not in {outcome.test for outcome in sheet.outcomes}


def test_each_test_has_its_own_process_that_ends_with_it():
    began, ended = [], []

    @contextlib.contextmanager
    def fresh():
        began.append(
            SimpleNamespace(sealing=SimpleNamespace(tier=SimpleNamespace(title="limits"), missing=("no filter",)))
        )
        yield began[-1]
        ended.append(began[-1])

    sheet = Sheet()
    functions = Functions(SimpleNamespace(fresh=fresh), sheet)
    functions.end_test()
    assert functions.process() is functions.process() is began[0]
    assert (sheet.tier, sheet.missing, ended) == ("limits", ("no filter",), [])
    functions.end_test()
    assert ended == began
    assert functions.process() is began[1]


def test_without_a_submission_the_tests_are_skipped(graded):
    result, sheet = graded(None)
    result.assert_outcomes(passed=1, skipped=6)
    assert sheet.outcomes == []


ALONE = """
import pytest

@pytest.mark.points()
@pytest.mark.parametrize("time", ["first", "second"])
def test_counts(submission, time):
    assert submission.rebound_velocity(0.0, 0.5) == 1

@pytest.fixture
def breaks_down():
    yield
    raise OSError("afterwards")

@pytest.mark.points(2)
def test_breaks_down(submission, breaks_down):
    assert submission.rebound_velocity(0.0, 0.5) == 1

@pytest.mark.points(0.5)
def test_of_something_else():
    pass

@pytest.mark.points(7)
def test_skipped(submission):
    pytest.skip("the scenario needs what a student's tree lacks")

def test_in_vain(submission, part):
    with part(1, "a part"):
        assert submission.rebound_velocity(0.0, 0.5) == 2, "two" + 2 * chr(10) + "lines"
"""


def test_each_test_starts_afresh_and_counts_once_unless_skipped(pytester, graded):
    pytester.makepyfile(test_impulse=ALONE)
    result, sheet = graded(
        "calls = []\ndef rebound_velocity(v, e):\n    calls.append(v)\n    return len(calls)",
        "test_impulse.py",
    )
    result.assert_outcomes(passed=4, skipped=1, failed=1, errors=1)
    assert [(outcome.test, outcome.earned, outcome.points) for outcome in sheet.outcomes] == [
        ("test_counts[first]", 1, 1), ("test_counts[second]", 1, 1), ("test_breaks_down", 2, 2),
        ("test_in_vain", 0, 1),
    ]  # fmt: skip
    assert sheet.outcomes[-1].parts[0].said == "two\nlines"
    result.stdout.no_fnmatch_line("*plugin.py*")


def test_grading_a_file_again_draws_the_same_examples(graded):
    def drawn(text: str) -> list[str]:
        result, _ = graded(text, "-k", "property", "-s")
        return [line for line in result.outlines if line.startswith(("drawn", ".drawn"))]

    first = drawn(RIGHT)
    assert len(first) > 10
    assert drawn(RIGHT) == first
    assert drawn(RIGHT + "# changed\n") != first


def test_points_must_be_whole_numbers(pytester):
    pytester.makepyfile(test_impulse="import pytest\n@pytest.mark.points(0.5)\ndef test_x(submission): pass\n")
    result = pytester.runpytest_inprocess("-p", "labs.grading.judging.plugin", "-p", "no:cacheprovider")
    result.stderr.fnmatch_lines(["*points are a whole number, not 0.5*"])
