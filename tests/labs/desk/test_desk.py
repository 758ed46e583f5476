"""The desk of a notebook: what it says, what it keeps, and whose functions it takes."""

from __future__ import annotations

import textwrap

import numpy as np
import pytest
from cells import STUB, right_cells, said, write_notebook

import labs
from labs import notebook
from labs.desk import student_code, tables
from labs.desk.predictions import Prediction
from reference.engines.implementation import Implementation


def test_a_lab_begins_by_saying_which_engines_answer(lab, capsys):
    out = said(capsys, lab.begin, "detection")
    assert "Detecting a collision" in out
    assert "PyBullet" in out
    assert "MuJoCo" in out


def test_an_unknown_lab_prints_one_line_without_a_traceback(lab, capsys):
    assert "lab.begin: unknown topic 'detektion'. Did you mean 'detection'?" in said(capsys, lab.begin, "detektion")


def test_every_call_before_the_first_cell_says_to_run_it(lab, capsys):
    lab.topic = ""
    for call in (lab.check, lambda: lab.run("dropped-ball")):
        assert "which lab is this? Run the first cell" in said(capsys, call)


@pytest.mark.parametrize(
    ("answer", "named", "words"),
    [
        (..., {"unit": "m"}, "Put your guess in place of the dots"),
        (0.5, {"unit": "m"}, "You predict 0.5 m."),
        ("up", {"choices": ("up", "down")}, "You predict “up”."),
        ("left", {"choices": ("up", "down")}, "'left' is none of the choices: 'up', 'down'"),
        (np.array(0.4), {}, "You predict 0.4"),
        (float("nan"), {}, "nan is no number"),
        ("much", {"unit": "m"}, "'much' is no number"),
        (True, {"unit": "m"}, "True is no number"),
    ],
)
def test_a_prediction_is_kept_or_refused_in_words(lab, capsys, answer, named, words):
    assert words in said(capsys, lab.predict, "key", "How high?", answer, **named)


def test_a_later_lab_uses_earlier_notebooks_and_given_functions(tmp_path):
    own = "def side_of_plane(separation, tolerance=0.0):\n    return -int(separation < -5)"
    write_notebook(tmp_path / "detection.ipynb", STUB, own)
    now = write_notebook(tmp_path / "now.ipynb", "pass")
    found = student_code.collect("impulse", now, student_code.earlier_notebooks("impulse", tmp_path))
    assert found.earlier == (("side_of_plane", "detection.ipynb"),)
    assert Implementation(found.source).function("side_of_plane")(-1.0) == 0
    assert Implementation(found.source).function("signed_distance")([0, 0, 3], [0, 0, 2], -4) == 1  # given


def test_a_notebook_calls_an_earlier_function_as_it_was_written_or_as_it_is_given(lab, capsys, tmp_path):
    own = "def total_force(position, velocity, *others):\n    return 2 * position"
    said(capsys, lab.begin, "world")
    ball = np.zeros((1, 3)), np.zeros((1, 3)), [2.0], [0.1], [0, 0, -10.0], 0.0, [0, 0, 0.0], np.zeros((0, 2), int)
    no_springs = np.zeros((3, 0))
    assert lab.earlier("total_force")(*ball, *no_springs).tolist() == [[0, 0, -20]]  # given: its weight
    write_notebook(tmp_path / "forces.ipynb", own)
    assert lab.earlier("total_force")(np.ones(3), None).tolist() == [2, 2, 2]


def test_an_earlier_function_that_nobody_knows_is_named(lab, capsys):
    said(capsys, lab.begin, "world")
    assert "unknown function 'total_forces'. Did you mean 'total_force'?" in said(capsys, lab.earlier, "total_forces")


def test_given_functions_never_replace_those_of_the_lab_itself(tmp_path):
    found = student_code.collect("detection", write_notebook(tmp_path / "now.ipynb", "pass"))
    with pytest.raises(Exception, match="needs signed_distance"):
        Implementation(found.source).function("signed_distance")([0, 0, 3], [0, 0, 1], 0)


def test_plots_and_experiments_of_a_notebook_are_not_run(tmp_path):
    text = "raise SystemExit\n\ndef side_of_plane(separation, tolerance=0.0):\n    return -int(separation < LIMIT)"
    path = write_notebook(tmp_path / "now.ipynb", "LIMIT = -2", text, "import nothing_there")
    assert Implementation(student_code.collect("detection", path).source).function("side_of_plane")(-3.0) == -1


def test_a_notebook_is_an_implementation_on_the_command_line(tmp_path):
    path = write_notebook(tmp_path / "detection.ipynb", *right_cells())
    assert student_code.named_implementation("solutions") == "solutions"
    assert Implementation(student_code.named_implementation(str(path))).function("side_of_plane")(-1.0) == -1


def test_markup_of_a_table_is_escaped():
    table = tables.Table("<b>", ("", "<i>"), (("<script>", "1"),), ("<note>",))
    markup = table._repr_mimebundle_()["text/html"]
    assert "<script>" not in markup
    assert "&lt;script&gt;" in markup
    assert 'overflow-x:auto"><table' in markup  # a wide table scrolls where the page is narrow
    assert textwrap.dedent(str(table)).startswith("<b>")


def test_the_desk_is_loaded_by_name_alone():
    assert labs.lab is notebook.lab
    with pytest.raises(AttributeError, match="nothing"):
        _ = labs.nothing


def test_an_earlier_notebook_that_cannot_be_read_is_named(lab, capsys, tmp_path):
    write_notebook(tmp_path / "detection.ipynb", "def side_of_plane(separation:\n    return")
    assert "detection.ipynb, code cell 1, line 1: Python cannot read" in said(capsys, lab.begin, "response")


@pytest.mark.parametrize(
    ("answer", "theory", "off"),
    [(-2.0, -1.0, "−100 %"), (0.3, 0.25, "+20 %"), (1e99, 1.0, ">1000 %"), (0.3, 1e-17, ""), (0.3, 0.0, "")],
)
def test_a_guess_is_off_by_a_signed_share_of_theory(answer, theory, off):
    assert tables._off(Prediction("key", "?", answer), theory) == off
