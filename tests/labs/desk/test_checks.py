"""`lab.check` in a notebook: what it says of functions that are right, wrong, gone or not written, and to nbgrader."""

from __future__ import annotations

import re

import pytest
from cells import SIDE, STUB, right_cells, said

from labs.building.points import points_of
from labs.grading.calling.processes import Limits
from labs.guidance import hint_files
from reference.errors import UnknownName


@pytest.fixture
def lab(lab, grader):
    """The desk, with the grader of all tests of this file in the place of its own."""
    lab._grader = grader
    yield lab
    lab._grader = None


def test_the_desk_starts_its_grader_once_and_keeps_it(lab):
    lab._grader = None
    with lab._started_grader() as own:
        assert lab._started_grader() is own


def test_a_check_takes_each_function_as_its_last_cell_defines_it(lab, cells, capsys):
    assert "· signed_distance  to do" in said(capsys, lab.check, "signed_distance")
    cells += ["import numpy as np", STUB]
    assert "· signed_distance  to do" in said(capsys, lab.check, "signed_distance")
    cells.append("def signed_distance(point, normal, offset):\n    return np.vecdot(point, normal) + offset")
    wrong = said(capsys, lab.check, "signed_distance")
    assert "✗ signed_distance" in wrong
    assert "defined" not in wrong  # three times, as is right in a kernel
    cells += right_cells()
    assert "✓ signed_distance is right" in said(capsys, lab.check, "signed_distance")
    assert "side_of_plane" not in said(capsys, lab.check, "signed_distance")


ONE_ONLY = "def signed_distance(point, normal, offset):\n    return np.vecdot(point, normal) + offset"
AGAIN = ONE_ONLY.replace("np.vecdot(point, normal) + offset", "offset + np.vecdot(normal, point)")
TRIED, HINT, MISTAKE = "        physics ", "    Hint: ", "It is one only"


@pytest.mark.slow
def test_help_comes_one_level_with_each_try(lab, cells, capsys):
    cells += [*right_cells(), ONE_ONLY]
    first = said(capsys, lab.check, "signed_distance")
    assert re.search(r"✗ signed_distance  \d of \d parts right, try 1\n", first)
    assert TRIED in first
    assert HINT not in first
    assert MISTAKE not in first
    assert 'on your code comes with your next try; lab.hint("signed_distance") helps' in " ".join(first.split())
    assert "Tries are counted since this kernel started" in first
    cells.append(f"{ONE_ONLY}  # so it is")
    assert said(capsys, lab.check, "signed_distance") == first
    cells.append(AGAIN)
    second = said(capsys, lab.check, "signed_distance")
    assert "parts right, try 2\n" in second
    assert HINT in second
    assert MISTAKE not in second
    assert 'said with your next try; lab.hint("signed_distance") helps' in " ".join(second.split())
    cells.append(ONE_ONLY)
    assert said(capsys, lab.check, "signed_distance") == second, "it was tried before"
    cells.append(AGAIN.replace("offset +", "offset - -"))
    third = said(capsys, lab.check, "signed_distance")
    assert MISTAKE in third
    assert "lab.hint" not in third
    cells += right_cells()
    assert "✓ signed_distance is right at try 4, as far as" in said(capsys, lab.check, "signed_distance")
    cells.append(ONE_ONLY)
    assert said(capsys, lab.check, "signed_distance") == first, "a function that was right begins again"


def test_a_hint_may_be_asked_for_before_the_next_try(lab, cells, capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(hint_files, "HINTS", tmp_path)  # where a lab has no hints of its own
    cells += [*right_cells(), ONE_ONLY]
    first = said(capsys, lab.hint, "signed_distance")
    assert "try 1\n" in first
    assert HINT in first
    assert MISTAKE not in first
    assert HINT in said(capsys, lab.check, "signed_distance"), "what was shown once stays"
    second = said(capsys, lab.hint, "signed_distance")
    assert MISTAKE in second
    assert "no further hint" not in second
    assert "There is no further hint on signed_distance." in said(capsys, lab.hint, "signed_distance")


def test_nbgrader_reads_all_help_at_once(lab, cells, capsys, monkeypatch):
    cells += [*right_cells(), ONE_ONLY]
    monkeypatch.setenv("NBGRADER_EXECUTION", "validate")
    told = said(capsys, lab.check, "signed_distance")
    assert HINT in told
    assert MISTAKE in told
    assert "try" not in told


def test_a_definition_before_one_that_python_cannot_read_is_not_diagnosed(lab, cells, capsys):
    cells += [*right_cells(), ONE_ONLY, ONE_ONLY.replace("normal)", "normal")]
    told = said(capsys, lab.check, "signed_distance")
    assert "cell [4], line 2: Python cannot read 'return np.vecdot(point, normal + offset'" in " ".join(told.split())
    assert "np.vecdot( is opened here and never closed" in " ".join(told.split())
    assert "✗ signed_distance  cannot be read" in told
    assert "mend cell [4], line 2, so that it can be read" in told
    assert "Not yet" not in told


def test_an_endless_loop_in_a_check_prints_one_line(lab, cells, capsys, grader, monkeypatch):
    monkeypatch.setattr(grader, "limits", Limits(call=0.4, test=1.0))
    cells.append("def side_of_plane(separation, tolerance=0.0):\n    while True:\n        pass")
    assert "gave no answer within" in said(capsys, lab.check, "side_of_plane")


def test_given_functions_are_not_checked_and_unknown_ones_are_refused(lab, capsys):
    assert "so there is nothing to check" in said(capsys, lab.check, "sphere_inertia")
    assert "Did you mean 'side_of_plane'?" in said(capsys, lab.check, "side_of_plan")


def test_a_misspelt_function_is_compared_with_those_of_this_lab_alone(lab, capsys):
    told = said(capsys, lab.check, "side_of_plan")
    assert "Did you mean 'side_of_plane'?" in told
    assert "orca_half_plane" not in told


def test_a_corrected_mistake_is_not_reported_again(lab, cells, capsys):
    cells += [*right_cells(), SIDE.replace("):", ")")]
    assert "a colon is missing" in said(capsys, lab.check, "side_of_plane")
    cells.append(SIDE)
    assert "✓ side_of_plane is right" in (told := said(capsys, lab.check, "side_of_plane"))
    assert "colon" not in told
    cells.append("x = = 3")
    assert "cannot read" not in said(capsys, lab.check, "side_of_plane")


def test_a_check_says_which_function_no_executed_cell_defines(lab, cells, capsys):
    assert "No cell that defines side_of_plane has been run" in said(capsys, lab.check, "side_of_plane")
    assert "No cell that defines a function of this lab has been run" in said(capsys, lab.check)
    cells += right_cells()
    assert "has been run" not in said(capsys, lab.check)


def test_a_check_of_the_whole_lab_says_how_many_predictions_were_made(lab, cells, capsys):
    cells += ["lab.predict('high', 'How high?', answer=...)", "lab.predict('high', 'How high?', answer=0.3)"]
    assert "Predictions: 1 of 1 made." in said(capsys, lab.check)
    assert "Predictions" not in said(capsys, lab.check, "signed_distance")


def test_a_function_may_be_named_without_quotes(lab, cells, capsys):
    def side_of_plane():
        pass

    cells += right_cells()
    assert "✓ side_of_plane is right" in said(capsys, lab.check, side_of_plane)


def test_a_cell_is_named_by_the_number_the_kernel_gave_it(lab, cells, capsys):
    cells += [*right_cells(), "1", "def side_of_plane(separation, tolerance=0.0):\n    return 1 / 0"]
    assert "cell [4], line 2" in (told := said(capsys, lab.check, "side_of_plane"))
    assert "code cell" not in told


HALF_RIGHT = "def side_of_plane(separation, tolerance=0.0):\n    return np.sign(separation)"


@pytest.mark.slow
def test_nbgrader_gets_the_points_of_a_checked_function_as_a_value(lab, cells, monkeypatch):
    cells += right_cells()
    assert lab.check("side_of_plane") is None  # for a person the words are all
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    assert lab.check("side_of_plane") == points_of("side_of_plane")
    cells.append(HALF_RIGHT)
    assert 0 < lab.check("side_of_plane") < points_of("side_of_plane")
    cells.append("def side_of_plane(separation, tolerance=0.0):\n    raise NotImplementedError")
    assert lab.check("side_of_plane") == 0


FOR_ONE = """
def side_of_plane(separation, tolerance=0.0):
    return 1 if separation > tolerance else -int(separation < -tolerance)


def missing_probability(speed, thickness, radius, dt):
    return 0.0 if speed * dt <= thickness + 2 * radius else 1 - (thickness + 2 * radius) / (speed * dt)
"""
"""Two functions that are right for one case alone."""


@pytest.mark.slow
def test_nbgrader_takes_one_part_from_a_lab_whose_functions_are_of_one_case(lab, cells, monkeypatch):
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    cells += [*right_cells(), FOR_ONE]
    assert lab.check("side_of_plane") == points_of("side_of_plane") - 1
    assert lab.check("missing_probability") == points_of("missing_probability")
    assert lab.check("side_of_plane") == points_of("side_of_plane") - 1


@pytest.mark.slow
def test_one_part_is_lost_in_all_checks_together_until_its_function_is_mended(lab, cells, capsys):
    cells += [*right_cells(), FOR_ONE]
    assert "✗ side_of_plane" in said(capsys, lab.check, "side_of_plane")
    assert "✓ missing_probability is right for one case at a time" in said(capsys, lab.check, "missing_probability")
    cells += right_cells()
    cells.append(FOR_ONE[FOR_ONE.index("def missing_probability") :])
    assert "✓ side_of_plane is right at try 2, as far" in said(capsys, lab.check, "side_of_plane")
    assert "✗ missing_probability" in said(capsys, lab.check, "missing_probability")


def test_a_failed_check_raises_for_nbgrader_which_gives_no_points(lab, monkeypatch):
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    with pytest.raises(UnknownName, match="no_such"):
        lab.check("no_such")


def test_validating_says_right_or_not(lab, cells, monkeypatch):
    monkeypatch.setenv("NBGRADER_EXECUTION", "validate")
    cells += right_cells()
    assert lab.check("side_of_plane") is None
    cells.append(HALF_RIGHT)
    assert lab.check("side_of_plane") == 0


class Shell:
    """A kernel that has run cells. user_ns: what they left behind."""

    def __init__(self, **user_ns):
        self.user_ns = user_ns


def test_a_function_that_the_kernel_lost_is_named(lab, cells, capsys, monkeypatch):
    cells += right_cells()
    monkeypatch.setattr("IPython.get_ipython", lambda: Shell(signed_distance=1))
    told = said(capsys, lab.check, "side_of_plane")
    assert "side_of_plane is not there any more: deleted, or its cell ended in an error." in told
    assert "not there any more" not in said(capsys, lab.check, "signed_distance")


@pytest.mark.slow
def test_a_check_says_where_to_see_what_a_function_prints(lab, cells, capsys):
    printing = SIDE.replace("    return", "    print(separation)\n    return")
    cells += [*right_cells(), printing]
    assert "What side_of_plane prints is not shown here" in said(capsys, lab.check)
    assert "What side_of_plane prints" not in said(capsys, lab.check, "signed_distance")
    cells += [printing.replace("print(separation)", "pass")]
    assert "prints" not in said(capsys, lab.check, "side_of_plane")
