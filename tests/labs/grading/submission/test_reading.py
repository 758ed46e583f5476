"""What a submission defines, which of several definitions counts, and what is said of the rest."""

from __future__ import annotations

import pytest
from submissions import BOTH, WANTED, defined, handed_in, notebook, tagged, told

from labs.grading.submission import reading


@pytest.mark.parametrize("name", ["lab.py", "lab.ipynb"])
def test_functions_are_read_whole_and_without_complaint(name, tmp_path):
    content = BOTH if name.endswith("py") else notebook(*BOTH.split("\n\n\n"))
    submission = handed_in(tmp_path, content, name)
    assert submission.functions == WANTED
    assert submission.complaints == ()
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0


def test_the_last_of_several_definitions_counts_with_a_complaint(tmp_path):
    wrong, right = "def rebound_velocity(v, e): return 0.0", "def rebound_velocity(v, e): return -e * v"
    submission = handed_in(tmp_path, notebook(wrong, "x = 1\n" + right))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert "rebound_velocity is defined 2 times; the one at code cell 2, line 2 counts" in told(submission)


@pytest.mark.parametrize("made_for_it", [tagged, None])
def test_the_cell_made_for_a_function_counts_before_a_later_copy(made_for_it, tmp_path):
    right, wrong = "def rebound_velocity(v, e): return -e * v", "def rebound_velocity(v, e): return 0.0"
    cell = tagged(right, "rebound_velocity")
    if made_for_it is None:  # as nbgrader names it
        cell["metadata"] = {"nbgrader": {"grade_id": "rebound_velocity", "solution": True}}
    submission = handed_in(tmp_path, notebook(cell, wrong))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert "the one at code cell 1, line 1 counts" in told(submission)


def test_a_missing_and_an_imported_function_are_named(tmp_path):
    submission = handed_in(tmp_path, "from solutions.impulse import rebound_velocity\n", "lab.py")
    assert submission.functions == ()
    assert told(submission) == "line 1: rebound_velocity is imported, not written\nnormal_velocity is missing"


def test_a_syntax_error_costs_only_its_cell_and_names_its_line(tmp_path):
    broken = "x = 1\ndef rebound_velocity(v, e:\n    return 1"
    submission = handed_in(tmp_path, notebook("import numpy as np", broken, BOTH.split("\n\n\n")[1]))
    assert submission.functions == ("normal_velocity",)
    assert "code cell 2, line 2: Python cannot read 'def rebound_velocity(v, e:'" in told(submission)


@pytest.mark.parametrize(
    ("names", "effect"),
    [("", ""), ("a", "; so a cannot be read"), ("abc", "; so a, b, c cannot be read"),
     ("abcd", "; so a, b, c … cannot be read")],
)  # fmt: skip
def test_a_syntax_error_names_the_functions_it_costs(names, effect, tmp_path):
    source = "".join(f"def {name}(): pass\n" for name in names) + "x = )"
    first = told(handed_in(tmp_path, source, "lab.py")).splitlines()[0]
    assert first == f"line {len(names) + 1}: Python cannot read 'x = )': unmatched ')'{effect}"


@pytest.mark.parametrize("error", [RecursionError, MemoryError, ValueError])
def test_source_too_deep_for_python_is_reported(error, tmp_path, monkeypatch):
    def groups(source):
        raise error

    monkeypatch.setattr(reading, "groups", groups)
    found = handed_in(tmp_path, notebook(BOTH))
    assert told(found).splitlines()[0] == "code cell 1: Python cannot read this: too deeply nested"
    assert found.functions == ()


def test_an_error_line_leads_back_to_the_cell(tmp_path):
    submission = handed_in(tmp_path, notebook("# one\n", {"cell_type": "markdown", "source": "words"}, "\n\n" + BOTH))
    line = submission.text.splitlines().index("def rebound_velocity(v, e):") + 1
    assert submission.where(line) == "code cell 2, line 3"


@pytest.mark.parametrize(
    ("name", "near"),
    [("reboundVelocity", True), ("rebound_velocty", True), ("rebound", False), ("velocity_of_sound", False)],
)
def test_a_misspelt_function_name_is_pointed_out(name, near, tmp_path):
    submission = handed_in(tmp_path, f"def {name}(v, e):\n    return -e * v\n", "lab.py")
    assert (f"line 1: is {name} meant to be rebound_velocity?" in told(submission)) == near
