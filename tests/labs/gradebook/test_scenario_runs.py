"""A submission's functions in scenarios: their numbers are judged as all others, and no mark depends on them."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from submissions import solved, stubs

from labs.gradebook import scenario_runs
from labs.gradebook.book import Book
from labs.gradebook.grading import Graded, Task, identity
from labs.gradebook.runs_compared import compared, spreads
from labs.gradebook.runs_figure import edges
from labs.gradebook.scenario_runs import RUNS, result
from labs.grading import budget
from labs.grading.budget import SECONDS
from labs.grading.errors import MachineBusy
from labs.grading.judging.grade import SCHEMA, VERSION
from reference import lecture
from reference.comparison.verdicts import Verdict
from reference.report.marks import AGREES

SAME_FOR_ALL = "\n\ndef respond_at_impact(*arguments):\n    return [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]\n"
HEIGHT = "dropped-ball/e=0.8"


def ran(path, lab, grader):
    """What is kept of the runs, as a file has it."""
    return json.loads(json.dumps(scenario_runs.run(path, lab, grader, SECONDS), allow_nan=False))


@pytest.fixture(scope="module")
def right(grader, tmp_path_factory):
    return ran(solved(tmp_path_factory.mktemp("right"), "response"), "response", grader)


@pytest.fixture(scope="module")
def untouched(grader, tmp_path_factory):
    return ran(stubs(tmp_path_factory.mktemp("stubs"), "response"), "response", grader)


def test_right_functions_bounce_as_high_as_theory_says_and_give_a_replay(right):
    found = [result(kept) for kept in right]
    assert {row.verdict for each in found for row in each.rows} <= {*AGREES, Verdict.SHOWN}
    assert next(row for row in found[0].rows if row.quantity == "rebound").measured == pytest.approx(0.64, rel=1e-9)
    shown = compared(right, "response")
    assert [each.agrees for each in shown] == [True, True]
    assert shown[0].headings == ("", "yours", "theory", "PyBullet*", "MuJoCo*", "DART*")
    assert "sandbox" in shown[0].replay


def test_an_unwritten_function_is_what_a_run_waits_for(untouched):
    (row,) = result(untouched[0]).rows
    assert row.verdict is Verdict.NEEDS
    assert "respond_at_impact" in compared(untouched, "response")[0].why


def test_an_answer_of_another_shape_costs_its_run_alone(grader, tmp_path):
    path = tmp_path / "odd.py"
    path.write_text(solved(tmp_path, "response").read_text() + SAME_FOR_ALL)
    found = [result(kept) for kept in ran(path, "response", grader)]
    assert all(row.verdict not in AGREES for each in found for row in each.rows if row.quantity == "rebound")
    assert not compared(ran(path, "response", grader), "response")[0].agrees


SLEEPS = "\n\nimport time\n\n\ndef respond_at_impact(*arguments):\n    time.sleep(60)\n"


def test_runs_have_a_third_of_the_seconds_of_the_submission(grader, tmp_path):
    path = tmp_path / "sleeps.py"
    path.write_text(solved(tmp_path, "response").read_text() + SLEEPS)
    kept = scenario_runs.run(path, "response", grader, 2.7)
    said = [result(each).rows[0].note for each in kept]
    assert said[0] == "respond_at_impact gave no answer: it has taken 0.3 s in all, which is its share of the 0.9 s" + (
        " that the whole file has"
    )


def test_runs_that_the_clock_ends_are_kept_by_nobody_and_can_be_made_again(grader, tmp_path, monkeypatch):
    monkeypatch.setattr(budget, "ON_THE_CLOCK", 1e-9)
    with pytest.raises(MachineBusy):
        scenario_runs.run(solved(tmp_path, "response"), "response", grader, SECONDS)


def test_a_class_is_a_distribution_beside_theory_and_the_engines(right, untouched):
    high = json.loads(json.dumps(right))
    place = [quantity.name for quantity in scenario_runs.find("dropped-ball")[0].quantities].index("rebound")
    high[0]["entry"][1][place] = 1.28
    found = spreads([right, right, high, untouched, []], "response")[0]
    assert (found.right, found.measured, found.median, found.theory) == (2, 3, "0.64", "0.64")
    ((why, count),) = found.without
    assert (count, "respond_at_impact" in why) == (1, True)
    assert "theory 0.64, PyBullet" in found.in_words
    assert found.picture.startswith("<svg")


@pytest.mark.parametrize("kept", [{}, {"case": "no-such/case", "entry": ["", [1.0]]}, {"case": HEIGHT, "entry": [1]}])
def test_runs_of_another_release_are_left_out(kept):
    assert compared([kept], "response") == []


@pytest.mark.parametrize(
    ("values", "marks"),
    [
        ([0.64, 0.64, 1e9], {"theory": 0.64, "PyBullet": 0.7}),
        ([-3.0, 5.0], {}),
        ([0.0, 0.0], {"theory": 0.0}),
        ([1e-12], {"theory": -2.0, "MuJoCo": 3.0}),
    ],
)
def test_the_picture_of_a_class_shows_every_engine_however_wild_a_student_is(values, marks):
    bins = edges(values, marks)
    assert np.all(np.diff(bins) > 0)
    for value in marks.values():
        assert bins[0] < value < bins[-1]
    if "theory" in marks:
        assert (bins[0] + bins[-1]) / 2 == pytest.approx(marks["theory"], abs=1e-12)


def test_runs_belong_to_the_grade_beside_them_and_are_made_when_they_are_wanted(tmp_path, right):
    task = Task("4711", "Ada", "response", "ada", "response.ipynb", b"x = 1", "", 60.0)
    wanted, book = replace(task, with_runs=True), Book(tmp_path / "grades")
    content = {"schema": SCHEMA, "version": VERSION, "identity": identity(task), "points": 1.0}
    book.keep(Graded("4711", content, {}))
    assert book.is_done(task)
    assert not book.is_done(wanted)
    book.keep(Graded("4711", content, {}, runs=right))
    assert book.is_done(wanted)
    assert book.runs_of("4711") == right
    book.keep(Graded("4711", content | {"identity": identity(replace(task, content=b"x = 2"))}, {}))
    assert book.runs_of("4711") is None


@pytest.mark.slow
@pytest.mark.parametrize("lab", RUNS)
def test_the_solutions_of_every_lab_get_every_number_right(lab, grader, tmp_path):
    found = ran(solved(tmp_path, lab), lab, grader)
    assert [each.agrees for each in compared(found, lab)] == [True] * len(RUNS[lab])


def test_labs_with_runs_have_functions_that_are_written():
    for lab, asked in RUNS.items():
        assert any(entry.role == "written" for entry in lecture.functions_of(lab))
        for each in asked:
            family, _ = each.place
            for name in each.quantities:
                family.quantity(name)
