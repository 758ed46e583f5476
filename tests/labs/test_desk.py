"""The desk of a notebook: what it says, what it keeps, and that nothing in a student's code can hurt it."""

from __future__ import annotations

import json
import textwrap
from pathlib import Path

import numpy as np
import pytest

import labs
from labs import notebook
from labs.building.points import points_of
from labs.desk import asking, hand, sweeping, tables
from reference.errors import InvalidInput, UnknownName
from reference.implementation import Implementation

ROOT = Path(__file__).parents[2]
CHECKS = (ROOT / "solutions" / "checks.py").read_text(encoding="utf-8")
DETECTION = (ROOT / "solutions" / "detection.py").read_text(encoding="utf-8")
STUB = """
def signed_distance(point, normal, offset):
    \"\"\"Distance.\"\"\"
    raise NotImplementedError("detection, step 1: signed_distance is yours to write")
"""


def right_cells():
    """The solutions as the cells of a notebook that imports nothing of ours."""
    imports = "from solutions.checks import finite, not_negative, positive, vector"
    return [text.replace(imports, "").replace("from __future__ import annotations", "") for text in (CHECKS, DETECTION)]


@pytest.fixture
def cells():
    """What the kernel has run."""
    return []


@pytest.fixture
def lab(cells, monkeypatch, tmp_path):
    monkeypatch.setattr(hand, "executed_cells", lambda: hand.without_mended(cells))
    monkeypatch.chdir(tmp_path)
    desk = notebook.Lab()
    desk.topic = "detection"
    shown = []
    monkeypatch.setattr(notebook, "_display", lambda *each: shown.extend(each))
    desk.shown = shown
    yield desk
    if desk._grader is not None:
        desk._grader.close()


def said(capsys, call, *arguments, **named):
    call(*arguments, **named)
    return capsys.readouterr().out


def test_a_lab_begins_by_saying_who_answers(lab, capsys):
    out = said(capsys, lab.begin, "detection")
    assert "Detecting a collision" in out
    assert "PyBullet" in out
    assert "MuJoCo" in out


def test_an_unknown_lab_is_a_line_and_no_traceback(lab, capsys):
    assert "lab.begin: unknown topic 'detektion'. Did you mean 'detection'?" in said(capsys, lab.begin, "detektion")


def test_before_a_lab_has_begun_every_call_says_what_to_do(lab, capsys):
    lab.topic = ""
    for call in (lab.check, lambda: lab.run("dropped-ball")):
        assert "which lab is this? Run the first cell" in said(capsys, call)


def test_what_is_not_written_is_to_do_and_what_is_written_is_checked_as_it_stands_now(lab, cells, capsys):
    assert "· signed_distance  to do" in said(capsys, lab.check, "signed_distance")
    cells += ["import numpy as np", STUB]
    assert "· signed_distance  to do" in said(capsys, lab.check, "signed_distance")
    cells.append("def signed_distance(point, normal, offset):\n    return np.vecdot(point, normal) + offset")
    wrong = said(capsys, lab.check, "signed_distance")
    assert "✗ signed_distance" in wrong
    assert "It is one only" in wrong
    assert "defined" not in wrong  # three times, as is right in a kernel
    cells += right_cells()
    assert "✓ signed_distance is right" in said(capsys, lab.check, "signed_distance")
    assert "is_colliding" not in said(capsys, lab.check, "signed_distance")


def test_an_endless_loop_costs_a_line(lab, cells, capsys):
    cells.append("def is_colliding(separation, tolerance=0.0):\n    while True:\n        pass")
    assert "gave no answer within" in said(capsys, lab.check, "is_colliding")


def test_given_functions_are_not_checked_and_unknown_ones_are_named(lab, capsys):
    assert "there is nothing of it to check" in said(capsys, lab.check, "sphere_inertia")
    assert "Did you mean 'is_colliding'?" in said(capsys, lab.check, "is_coliding")


@pytest.mark.parametrize(
    ("answer", "named", "words"),
    [
        (..., {"unit": "m"}, "Put your guess in place of the dots"),
        (0.5, {"unit": "m"}, "You predict 0.5 m."),
        ("up", {"choices": ("up", "down")}, "You predict up."),
        ("left", {"choices": ("up", "down")}, "'left' is none of the choices: 'up', 'down'"),
        (np.array(0.4), {}, "You predict 0.4"),
        (float("nan"), {}, "nan is no number"),
        ("much", {"unit": "m"}, "'much' is no number"),
        (True, {"unit": "m"}, "True is no number"),
    ],
)
def test_a_prediction_is_kept_or_refused_in_words(lab, capsys, answer, named, words):
    assert words in said(capsys, lab.predict, "key", "How high?", answer, **named)


def test_a_run_shows_yours_beside_engines_theory_and_the_guess(lab, cells, capsys):
    cells += right_cells()
    lab.predict("high", "How high?", 0.3)
    lab.run("dropped-ball/e=0.5", predicted="high", quantity="rebound")
    pictures, table = lab.shown
    assert "yours" in str(table)
    assert ["you predicted", "0.3", "+20 %"] in [list(row[:3]) for row in table.rows]
    assert [row[-1] for row in table.rows if row[0] in ("yours", "PyBullet")] == ["1 ms", "1 ms"]
    assert [row[1] for row in table.rows if row[0] in ("yours", "theory")] == ["0.25", "0.25"]
    shown = pictures._repr_mimebundle_()
    assert shown["image/png"].startswith(b"\x89PNG")
    assert "<iframe" in shown["text/html"]
    assert "[replay: yours, PyBullet, MuJoCo]" in shown["text/plain"]
    assert "[gap below the ball, m over time: yours, PyBullet, MuJoCo]" in shown["text/plain"]


def test_a_run_before_anything_is_written_says_what_it_needs(lab):
    lab.run("dropped-ball/e=0.5", quantity="rebound")
    assert "yours: needs signed_distance (detection, step 1)" in str(lab.shown[-1])


def test_a_crash_in_a_function_is_a_line_that_names_error_cell_and_function(lab, cells):
    cells += [*right_cells(), "def signed_distance(point, normal, offset):\n    return 1 / 0"]
    lab.run("dropped-ball/e=0.5", quantity="rebound")
    where = "at code cell 3, line 2, in signed_distance"
    assert f"yours: crashed: ZeroDivisionError: division by zero, {where}" in str(lab.shown[-1])


def test_a_crash_in_an_earlier_notebook_names_that(lab, cells, tmp_path):
    write_notebook(tmp_path / "detection.ipynb", "1", "def signed_distance(point, normal, offset):\n    return 1 / 0")
    lab.topic = "response"
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert "division by zero, at detection.ipynb, code cell 2, line 2, in signed_distance" in str(lab.shown[-1])


def test_an_endless_loop_in_a_run_is_stopped_and_its_place_said(lab, cells, monkeypatch):
    monkeypatch.setattr(asking, "TIME_LIMIT", 10.0)
    cells += [*right_cells(), "def signed_distance(point, normal, offset):\n    while True:\n        point = point"]
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    told = "no answer within 10 s; its process was stopped, at code cell 3, line "
    assert told in str(lab.shown[-1])
    assert "in signed_distance" in str(lab.shown[-1])


def test_every_implementation_has_the_same_colours_in_replay_and_curve_whoever_is_missing(lab):
    lab.run("dropped-ball/e=0.5", quantity="rebound")
    page = lab.shown[0]._repr_mimebundle_()["text/html"]
    assert "&quot;title&quot;:&quot;PyBullet&quot;,&quot;tag&quot;:&quot;P&quot;,&quot;look&quot;:1," in page
    assert "&quot;title&quot;:&quot;MuJoCo&quot;,&quot;tag&quot;:&quot;M&quot;,&quot;look&quot;:2," in page


def test_what_is_rounding_is_zero_and_a_column_without_content_is_left_out(lab, cells):
    lab.topic = "impulse"
    lab.run("two-balls/e=1,m=1,b=0.5", quantity="corner", engines=("pybullet",))
    table = lab.shown[-1]
    assert table.title.startswith("v·w ÷ v₀²")
    assert [row[1] for row in table.rows if row[0] in ("PyBullet", "theory")] == ["0", "0"]
    lab.run("cradle/5 touching", quantity="first", engines=("pybullet",))
    assert "off by" not in lab.shown[-1].headings
    assert "· theory has no number" in str(lab.shown[-1])


def test_parameters_that_stand_for_a_case_are_what_the_result_is_called(lab):
    lab.run("dropped-ball", restitution=0.37, quantity="rebound", engines=("pybullet",))
    assert lab.shown[-1].title == "First rebound ÷ drop height (Dropped ball: bounce heights, restitution=0.37)"


@pytest.mark.parametrize(
    ("scenario", "named", "words"),
    [
        ("droped-ball", {}, "Did you mean 'dropped-ball'?"),
        ("dropped-ball/e=2", {}, "unknown case of dropped-ball 'e=2'"),
        ("dropped-ball", {"restitution": 3.0}, "restitution is 3"),
        ("dropped-ball", {"colour": 3.0}, "unknown option, or parameter of dropped-ball, 'colour'"),
        ("dropped-ball/e=0.5", {"profil": "stock"}, "Did you mean 'profile'?"),
        ("dropped-ball", {"profile": "tunned"}, "Did you mean 'tuned'?"),
        ("dropped-ball", {"engines": ("bullet",)}, "unknown engine 'bullet'"),
        ("dropped-ball/e=0.5", {"timestep": -1.0}, "timestep"),
        ("dropped-ball/e=0.5", {"predicted": "nothing", "engines": ()}, "There is no prediction 'nothing' yet"),
    ],
)
def test_what_cannot_be_run_is_a_line(lab, capsys, scenario, named, words):
    assert words in said(capsys, lab.run, scenario, **named)


def test_a_sweep_shows_every_value_small_and_a_table_of_all(lab, cells, monkeypatch):
    slid = []
    monkeypatch.setattr(sweeping, "slide", slid.append)
    cells += right_cells()
    lab.predict("more", "?", answer="up", choices=("up", "down"))
    lab.sweep("dropped-ball", "restitution", (0.2, 0.5), predicted="more", quantity="rebound")
    picture, table = lab.shown
    assert "You predicted up." in table.notes
    assert [row[0] for row in table.rows] == ["0.2", "0.5"]
    assert [row[-1] for row in table.rows] == ["0.04", "0.25"]
    assert table.headings[1] == "yours"
    assert picture.png.startswith(b"\x89PNG")
    assert slid


def test_a_sweep_takes_recorded_values_where_none_are_given():
    values = sweeping.values_of("dropped-ball", "restitution")
    assert 4 <= len(values) <= sweeping.MOST
    with pytest.raises(UnknownName, match="timestep"):
        sweeping.values_of("dropped-ball", "mass")
    with pytest.raises(InvalidInput, match="at most 8"):
        sweeping.values_of("dropped-ball", "timestep", [0.1] * 9)


def test_a_timestep_is_swept_in_milliseconds(lab, monkeypatch):
    slid = []
    monkeypatch.setattr(sweeping, "slide", slid.append)
    lab.sweep("dropped-ball/e=0.5", "timestep", (1 / 480, 0.01), engines=("pybullet",))
    table = lab.shown[-1]
    assert table.headings[0] == "timestep, ms"
    assert [row[0] for row in table.rows] == ["2.08", "10"]
    assert [slid[0].value(value) for value in slid[0].values] == ["timestep 2.08 ms", "timestep 10 ms"]


@pytest.mark.parametrize("count", range(1, 9))
def test_a_sweep_of_any_length_has_its_picture(lab, count):
    values = tuple(0.1 * place for place in range(1, count + 1))
    lab.sweep("dropped-ball", "restitution", values, engines=("pybullet",))
    assert lab.shown[0].png.startswith(b"\x89PNG")
    assert len(lab.shown[1].rows) == count


def write_notebook(path, *sources):
    cells = [{"cell_type": "code", "metadata": {}, "source": source, "outputs": []} for source in sources]
    path.write_text(json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells}), encoding="utf-8")
    return path


def test_a_later_lab_uses_what_is_written_in_an_earlier_notebook_and_given_functions_for_the_rest(tmp_path):
    own = "def is_colliding(separation, tolerance=0.0):\n    return separation < -5"
    write_notebook(tmp_path / "detection.ipynb", STUB, own)
    now = write_notebook(tmp_path / "now.ipynb", "pass")
    found = hand.in_hand("impulse", now, hand.earlier_notebooks("impulse", tmp_path))
    assert found.earlier == (("is_colliding", "detection.ipynb"),)
    assert not Implementation(found.source).function("is_colliding")(-1.0)
    assert Implementation(found.source).function("signed_distance")([0, 0, 3], [0, 0, 2], -4) == 1  # given


def test_what_the_lab_has_written_is_never_answered_by_given_functions(tmp_path):
    found = hand.in_hand("detection", write_notebook(tmp_path / "now.ipynb", "pass"))
    with pytest.raises(Exception, match="needs signed_distance"):
        Implementation(found.source).function("signed_distance")([0, 0, 3], [0, 0, 1], 0)


def test_plots_and_experiments_of_a_notebook_are_not_run_with_it(tmp_path):
    text = "raise SystemExit\n\ndef is_colliding(separation, tolerance=0.0):\n    return separation < LIMIT"
    path = write_notebook(tmp_path / "now.ipynb", "LIMIT = -2", text, "import nothing_there")
    assert Implementation(hand.in_hand("detection", path).source).function("is_colliding")(-3.0)


def test_a_notebook_stands_for_an_implementation_on_the_command_line(tmp_path):
    path = write_notebook(tmp_path / "detection.ipynb", *right_cells())
    assert hand.with_hand("solutions") == "solutions"
    assert Implementation(hand.with_hand(str(path))).function("is_colliding")(-1.0)


def test_markup_of_a_table_is_escaped():
    table = tables.Table("<b>", ("", "<i>"), (("<script>", "1"),), ("<note>",))
    markup = table._repr_mimebundle_()["text/html"]
    assert "<script>" not in markup
    assert "&lt;script&gt;" in markup
    assert textwrap.dedent(str(table)).startswith("<b>")


def test_the_desk_is_loaded_by_name_alone():
    assert labs.lab is notebook.lab
    with pytest.raises(AttributeError, match="nothing"):
        _ = labs.nothing


def test_an_earlier_notebook_that_cannot_be_read_is_named(lab, capsys, tmp_path):
    write_notebook(tmp_path / "detection.ipynb", "def is_colliding(separation:\n    return")
    assert "detection.ipynb, code cell 1, line 1: Python cannot read" in said(capsys, lab.begin, "response")


def test_a_misspelt_function_is_set_against_those_of_this_lab(lab, capsys):
    told = said(capsys, lab.check, "is_coliding")
    assert "Did you mean 'is_colliding'?" in told
    assert "orca_half_plane" not in told


def test_a_mistake_that_was_mended_is_not_told_again(lab, cells, capsys):
    cells += [*right_cells(), "def is_colliding(separation, tolerance=0.0)\n    return separation < -tolerance"]
    assert "expected ':'" in said(capsys, lab.check, "is_colliding")
    cells.append("def is_colliding(separation, tolerance=0.0):\n    return separation < -tolerance")
    assert "✓ is_colliding is right" in (told := said(capsys, lab.check, "is_colliding"))
    assert "expected" not in told
    cells.append("x = = 3")
    assert "cannot read" not in said(capsys, lab.check, "is_colliding")


def test_a_function_whose_cell_was_not_run_since_the_start_is_said_to_be_so(lab, capsys):
    assert "No cell that defines is_colliding has been run" in said(capsys, lab.check, "is_colliding")


HALF_RIGHT = "def side_of_plane(separation, tolerance=0.0):\n    return np.sign(separation)"


def test_nbgrader_gets_the_points_of_a_checked_function_as_the_value_of_its_cell(lab, cells, monkeypatch):
    cells += right_cells()
    assert lab.check("side_of_plane") is None  # for a person the words are all
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    assert lab.check("side_of_plane") == points_of("side_of_plane")
    cells.append(HALF_RIGHT)
    assert 0 < lab.check("side_of_plane") < points_of("side_of_plane")
    cells.append("def side_of_plane(separation, tolerance=0.0):\n    raise NotImplementedError")
    assert lab.check("side_of_plane") == 0


def test_what_cannot_be_checked_ends_the_cell_for_nbgrader_in_an_error_which_is_no_points(lab, monkeypatch):
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


def test_a_function_that_is_not_there_any_more_is_named(lab, cells, capsys, monkeypatch):
    cells += right_cells()
    monkeypatch.setattr("IPython.get_ipython", lambda: Shell(signed_distance=1))
    told = said(capsys, lab.check, "is_colliding")
    assert "is_colliding is not there any more: deleted, or its cell ended in an error." in told
    assert "not there any more" not in said(capsys, lab.check, "signed_distance")


def test_of_a_function_that_prints_it_is_said_where_to_see_it(lab, cells, capsys):
    printing = "def is_colliding(separation, tolerance=0.0):\n    print(separation)\n    return separation < -tolerance"
    cells += [*right_cells(), printing]
    assert "What is_colliding prints is not shown here" in said(capsys, lab.check)
    assert "What is_colliding prints" not in said(capsys, lab.check, "signed_distance")
    cells += [printing.replace("print(separation)", "pass")]
    assert "prints" not in said(capsys, lab.check)


def test_an_interrupt_is_a_line(lab, monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(asking, "ask", interrupted)
    assert said(capsys, lab.run, "dropped-ball/e=0.5") == "lab.run: interrupted\n"


def test_a_wrong_quantity_is_named_before_anything_runs(lab, monkeypatch, capsys):
    monkeypatch.setattr(asking, "ask", None)
    assert "unknown quantity of dropped-ball 'hight'" in said(capsys, lab.run, "dropped-ball/e=0.5", quantity="hight")
