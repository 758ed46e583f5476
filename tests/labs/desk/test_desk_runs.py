"""Runs and sweeps in a notebook: what they show, and that nothing in a student's code can hurt the kernel."""

from __future__ import annotations

import pytest
from cells import right_cells, said, write_notebook

from labs.desk import case_runs, sweeps
from reference.errors import InvalidInput, UnknownName


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
    where = "at cell [3], line 2, in signed_distance"
    assert f"yours: crashed: ZeroDivisionError: division by zero, {where}" in str(lab.shown[-1])


def test_a_crash_in_an_earlier_notebook_names_that(lab, cells, tmp_path):
    write_notebook(tmp_path / "detection.ipynb", "1", "def signed_distance(point, normal, offset):\n    return 1 / 0")
    lab.topic = "response"
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert "division by zero, at detection.ipynb, code cell 2, line 2, in signed_distance" in str(lab.shown[-1])


def test_an_endless_loop_in_a_run_is_stopped_and_its_place_said(lab, cells, monkeypatch):
    monkeypatch.setattr(case_runs, "TIME_LIMIT", 10.0)
    cells += [*right_cells(), "def signed_distance(point, normal, offset):\n    while True:\n        point = point"]
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    told = "no answer within 10 s; its process was stopped, at cell [3], line "
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
    monkeypatch.setattr(sweeps, "slide", slid.append)
    cells += right_cells()
    lab.predict("more", "?", answer="up", choices=("up", "down"))
    lab.sweep("dropped-ball", "restitution", (0.2, 0.5), predicted="more", quantity="rebound")
    picture, table = lab.shown
    assert "You predicted “up”." in table.notes
    assert [row[0] for row in table.rows] == ["0.2", "0.5"]
    assert [row[-1] for row in table.rows] == ["0.04", "0.25"]
    assert table.headings[1] == "yours"
    assert picture.png.startswith(b"\x89PNG")
    assert slid


def test_a_sweep_takes_recorded_values_where_none_are_given():
    values = sweeps.values_of("dropped-ball", "restitution")
    assert 4 <= len(values) <= sweeps.MOST
    with pytest.raises(UnknownName, match="timestep"):
        sweeps.values_of("dropped-ball", "mass")
    with pytest.raises(InvalidInput, match="at most 8"):
        sweeps.values_of("dropped-ball", "timestep", [0.1] * 9)


def test_a_timestep_is_swept_in_milliseconds(lab, monkeypatch):
    slid = []
    monkeypatch.setattr(sweeps, "slide", slid.append)
    lab.sweep("dropped-ball/e=0.5", "timestep", (1 / 480, 0.01), engines=("pybullet",))
    table = lab.shown[-1]
    assert table.headings[0] == "timestep, ms"
    assert [row[0] for row in table.rows] == ["2.08", "10"]
    assert [slid[0].value(value) for value in slid[0].values] == ["timestep 2.08 ms", "timestep 10 ms"]


@pytest.mark.parametrize("count", [1, 2, 5, 8])
def test_a_sweep_of_any_length_has_its_picture(lab, count):
    values = tuple(0.1 * place for place in range(1, count + 1))
    lab.sweep("dropped-ball", "restitution", values, engines=("pybullet",))
    assert lab.shown[0].png.startswith(b"\x89PNG")
    assert len(lab.shown[1].rows) == count


def test_an_interrupt_is_a_line(lab, monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(case_runs, "run_case", interrupted)
    assert said(capsys, lab.run, "dropped-ball/e=0.5") == "lab.run: interrupted\n"


def test_a_wrong_quantity_is_named_before_anything_runs(lab, monkeypatch, capsys):
    monkeypatch.setattr(case_runs, "run_case", None)
    assert "unknown quantity of dropped-ball 'hight'" in said(capsys, lab.run, "dropped-ball/e=0.5", quantity="hight")


def test_guesses_in_words_stand_below_and_numbers_beside_theory(lab, capsys):
    lab.predict("high", "How high?", 0.3)
    lab.predict("way", "Which way?", "up", choices=("up", "down"))
    lab.run("dropped-ball/e=0.5", predicted=("high", "way"), quantity="rebound", engines=("pybullet",))
    table = lab.shown[-1]
    assert [row[0] for row in table.rows] == ["you predicted", "PyBullet", "theory"]
    assert "You predicted “up”. Which way?" in table.notes


@pytest.mark.parametrize("made", [(), ("other",)])
def test_a_run_before_its_guess_says_so_and_runs(lab, capsys, made):
    for key in made:
        lab.predict(key, "?", 1.0)
    lab.predict("high", "How high?", ...)
    out = said(capsys, lab.run, "dropped-ball/e=0.5", predicted="high", quantity="rebound", engines=("pybullet",))
    assert "There is no prediction 'high' yet: guess first" in out
    assert lab.shown


def test_a_run_that_asks_for_no_function_of_the_student_is_called_given(lab, cells):
    lab.topic = "impulse"
    lab.run("cradle/5 touching", quantity="first", engines=())
    assert [row[0] for row in lab.shown[-1].rows] == ["given"]
    lab.topic = "detection"
    cells += right_cells()
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert lab.shown[-1].rows[0][0] == "yours"


def test_a_function_that_returns_nothing_is_named_by_a_run_and_where_to_learn_more(lab, cells):
    cells += [*right_cells(), "def signed_distance(point, normal, offset):\n    point.sum()"]
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert "yours: crashed: signed_distance returned nothing: is a return missing?" in str(lab.shown[-1])
    assert "lab.check() says more about your functions." in str(lab.shown[-1])
    assert "value" not in str(lab.shown[-1])  # of a table without rows


def test_a_time_of_impact_in_the_past_is_named_at_once(lab, cells):
    cells += [
        *right_cells(),
        "def time_of_impact_exact(separation, *motion):\n    return np.full(len(separation), -0.45)",
    ]
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert "time_of_impact_exact answered -0.45 s: a time of impact is 0 or later" in str(lab.shown[-1])


def test_of_a_function_that_prints_in_a_run_it_is_said_where_to_see_it(lab, cells, capsys):
    printing = "def is_colliding(separation, tolerance=0.0):\n    print(1)\n    return separation < -tolerance"
    cells += [*right_cells(), printing]
    stock = {"quantity": "rebound", "engines": (), "profile": "stock"}
    assert "What is_colliding prints is not shown here" in said(capsys, lab.run, "dropped-ball/e=0.5", **stock)
    assert "prints" not in said(capsys, lab.run, "dropped-ball/e=0.5", quantity="rebound", engines=())


def test_what_is_asked_of_a_call_that_has_no_such_option_is_a_line(lab, capsys):
    assert "lab.run: missing a required argument: 'scenario'" in said(capsys, lab.run)
    told = said(capsys, lab.watch, "dropped-ball/e=0.5", quantity="rebound")
    assert "unknown option, or parameter of dropped-ball, 'quantity'. Choices: engines, profile, timestep" in told
