"""Runs and sweeps in a notebook: what they show, and that nothing in a student's code can hurt the kernel."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest
from cells import right_cells, said, write_notebook

from labs.desk import case_runs, sweep_picture, sweeps
from reference.errors import InvalidInput, UnknownName


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """Where the runs of this file are kept: what an engine has run once comes from the cache."""
    return tmp_path_factory.mktemp("kept")


@pytest.fixture(autouse=True)
def one_worker_and_cache(kept, monkeypatch):
    """One worker for all runs, in which each engine is imported once."""
    monkeypatch.setenv("COLLISIONS_CACHE", str(kept))
    monkeypatch.setattr(case_runs, "ThreadPoolExecutor", lambda _: ThreadPoolExecutor(1))


def test_a_run_shows_yours_beside_engines_theory_and_the_guess(lab, cells, monkeypatch, installed):
    installed("pybullet")
    installed("mujoco")

    def last_first(*asked):
        yield from reversed(list(run_all(*asked)))

    run_all = case_runs.run_all
    monkeypatch.setattr(case_runs, "run_all", last_first)  # several workers finish in any order
    cells += right_cells()
    lab.predict("high", "How high?", 0.3)
    lab.run("dropped-ball/e=0.5", predicted="high", quantity="rebound")
    pictures, table, verdict = lab.shown
    assert str(verdict) == "You predicted 0.3, but 0.25 is right."
    assert "yours" in str(table)
    assert ["you predicted", "0.3", "+20 %"] in [list(row[:3]) for row in table.rows]
    assert [row[-1] for row in table.rows if row[0] in ("yours", "PyBullet")] == ["1 ms", "1 ms"]
    assert [row[1] for row in table.rows if row[0] in ("yours", "theory")] == ["0.25", "0.25"]
    shown = pictures._repr_mimebundle_()
    assert shown["image/png"].startswith(b"\x89PNG")
    assert "<iframe" in shown["text/html"]
    assert "[replay: yours, PyBullet, MuJoCo]" in shown["text/plain"]
    assert "[gap below the ball, m over time: yours from 1 to " in shown["text/plain"]


def test_a_run_before_anything_is_written_names_the_missing_function(lab):
    lab.run("dropped-ball/e=0.5", quantity="rebound")
    assert "Your implementation waits for signed_distance (detection, step 1)." in str(lab.shown[-1])


def test_a_crash_is_a_line_with_its_error_its_cell_and_its_function(lab, cells):
    cells += [*right_cells(), "def signed_distance(point, normal, offset):\n    return 1 / 0"]
    lab.run("dropped-ball/e=0.5", quantity="rebound")
    where = "at cell [3], line 2, in signed_distance"
    assert f"Your implementation crashed: ZeroDivisionError: division by zero, {where}" in str(lab.shown[-1])


def test_a_crash_in_an_earlier_notebook_names_the_notebook(lab, cells, tmp_path):
    write_notebook(tmp_path / "detection.ipynb", "1", "def signed_distance(point, normal, offset):\n    return 1 / 0")
    lab.topic = "response"
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert "division by zero, at detection.ipynb, code cell 2, line 2, in signed_distance" in str(lab.shown[-1])


@pytest.mark.slow
def test_an_endless_loop_in_a_run_is_stopped_and_its_place_named(lab, cells, monkeypatch):
    monkeypatch.setattr(case_runs, "TIME_LIMIT", 3.0)  # a worker that has just started takes a second to begin
    loop = "def signed_distance(point, normal, offset):\n    while True:\n        time.sleep(0.01)"
    cells += [*right_cells(), "import time", loop]
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    told = "it took longer than 3 s and was stopped, at cell [4], line "
    assert told in str(lab.shown[-1])
    assert "in signed_distance" in str(lab.shown[-1])


def test_replay_and_curve_give_an_implementation_the_same_colour(lab, installed):
    installed("pybullet")
    installed("mujoco")
    lab.run("dropped-ball/e=0.5", quantity="rebound")
    page = lab.shown[0]._repr_mimebundle_()["text/html"]
    assert "&quot;title&quot;:&quot;PyBullet&quot;,&quot;tag&quot;:&quot;PyBullet&quot;,&quot;look&quot;:1," in page
    assert "&quot;title&quot;:&quot;MuJoCo&quot;,&quot;tag&quot;:&quot;MuJoCo&quot;,&quot;look&quot;:2," in page


@pytest.mark.slow
def test_a_table_shows_rounding_as_zero_and_leaves_out_empty_columns(lab, cells, installed):
    installed("pybullet")
    lab.topic = "impulse"
    lab.run("two-balls/e=1,m=1,b=0.5", quantity="corner", engines=("pybullet",))
    table = lab.shown[-1]
    assert table.title.startswith("v·w ÷ v₀²")
    assert [row[1] for row in table.rows if row[0] in ("PyBullet", "theory")] == ["0", "0"]
    lab.run("cradle/5 touching", quantity="first", engines=("pybullet",))
    assert "off by" not in lab.shown[-1].headings
    assert "· theory has no number" in str(lab.shown[-1])


@pytest.mark.slow
def test_a_run_at_parameters_is_named_after_them(lab, installed):
    installed("pybullet")
    lab.run("dropped-ball", restitution=0.37, quantity="rebound", engines=("pybullet",))
    assert lab.shown[-1].title == "First rebound ÷ drop height (Dropped ball: bounce heights, restitution=0.37)"


@pytest.mark.parametrize(
    ("scenario", "named", "words"),
    [
        ("droped-ball", {}, "Did you mean 'dropped-ball'?"),
        ("dropped-ball/e=2", {}, "unknown case of dropped-ball 'e=2'"),
        ("dropped-ball", {"restitution": 3.0}, "restitution is 3"),
        ("dropped-ball", {"colour": 3.0}, "unknown option, or parameter of dropped-ball, 'colour'"),
        ("dropped-ball/e=0.5", {"profil": "step"}, "Did you mean 'profile'?"),
        ("dropped-ball", {"profile": "stock"}, "Did you mean 'step'?"),
        ("dropped-ball", {"engines": ("bullet",)}, "unknown engine 'bullet'"),
        ("dropped-ball/e=0.5", {"timestep": -1.0}, "timestep"),
        ("dropped-ball/e=0.5", {"predicted": "nothing", "engines": ()}, "Folded until you have predicted 'nothing'"),
    ],
)
def test_a_run_that_is_refused_prints_one_line(lab, capsys, scenario, named, words):
    assert words in said(capsys, lab.run, scenario, **named)


@pytest.mark.slow
def test_a_sweep_shows_a_picture_and_a_table_of_every_value(lab, cells, monkeypatch):
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


def test_a_sweep_over_a_case_keeps_the_other_values_of_that_case():
    assert sweeps.point("rolling-ball/μ=0.1,θ=5°", "angle", 20.0) == {"friction": 0.1, "angle": 20.0}
    assert sweeps.point("rolling-ball", "angle", 20.0) == {"angle": 20.0}


def test_a_sweep_takes_recorded_values_where_none_are_given():
    values = sweeps.values_of("dropped-ball", "restitution")
    assert 4 <= len(values) <= sweeps.MOST
    with pytest.raises(UnknownName, match="timestep"):
        sweeps.values_of("dropped-ball", "mass")
    with pytest.raises(InvalidInput, match="at most 8"):
        sweeps.values_of("dropped-ball", "timestep", [0.1] * 9)


def test_no_line_is_drawn_across_a_jump():
    level = [(0.0, -0.6), (1.0, 0.0), (2.0, 0.0)]
    assert sweep_picture._pieces(level, spread=False) == [level[:1], level[1:]]
    slope = [(0.0, 0.0), (1.0, 0.2), (4.0, 0.9), (5.0, 1.0)]
    assert sweep_picture._pieces(slope, spread=False) == [slope]


@pytest.mark.slow
def test_a_timestep_is_swept_in_milliseconds(lab, monkeypatch):
    slid = []
    monkeypatch.setattr(sweeps, "slide", slid.append)
    lab.sweep("sliding-slab/μ=0.7,v=1", "timestep", (1 / 480, 0.01), engines=("pybullet",))
    table = lab.shown[-1]
    assert table.headings[0] == "timestep, ms"
    assert [row[0] for row in table.rows] == ["2.08", "10"]
    assert [slid[0].value(value) for value in slid[0].values] == ["timestep 2.08 ms", "timestep 10 ms"]


@pytest.mark.parametrize("count", [1, 5, *(pytest.param(count, marks=pytest.mark.slow) for count in (2, 8))])
@pytest.mark.slow
def test_a_sweep_of_any_length_has_its_picture(lab, count):
    values = tuple(0.1 * place for place in range(1, count + 1))
    lab.sweep("dropped-ball", "restitution", values, engines=("pybullet",))
    assert lab.shown[0].png.startswith(b"\x89PNG")
    assert len(lab.shown[1].rows) == count


def test_an_interrupt_prints_one_line(lab, monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(case_runs, "run_case", interrupted)
    assert said(capsys, lab.run, "dropped-ball/e=0.5") == "lab.run: interrupted\n"


def test_a_wrong_quantity_is_named_before_anything_runs(lab, monkeypatch, capsys):
    monkeypatch.setattr(case_runs, "run_case", None)
    assert "unknown quantity of dropped-ball 'hight'" in said(capsys, lab.run, "dropped-ball/e=0.5", quantity="hight")


def test_guesses_in_words_are_notes_and_guesses_in_numbers_are_rows(lab, capsys, installed):
    installed("pybullet")
    lab.predict("high", "How high?", 0.3)
    lab.predict("way", "Which way?", "up", choices=("up", "down"))
    lab.run("dropped-ball/e=0.5", predicted=("high", "way"), quantity="rebound", engines=("pybullet",))
    table, verdict = lab.shown[-2:]
    assert "0.25 is right" in str(verdict)
    assert [row[0] for row in table.rows] == ["you predicted", "PyBullet", "theory"]
    assert "You predicted “up”. Which way?" in table.notes


@pytest.mark.parametrize("made", [(), ("other",)])
def test_a_run_stays_folded_until_its_prediction_was_made(lab, capsys, made):
    for key in made:
        lab.predict(key, "?", 1.0)
    lab.predict("high", "How high?", ...)
    asked = {"predicted": "high", "quantity": "rebound", "engines": ("pybullet",)}
    out = said(capsys, lab.run, "dropped-ball/e=0.5", **asked)
    assert "Folded until you have predicted 'high' in a cell above" in out
    lab.sweep("dropped-ball", "restitution", (0.5,), **asked)
    assert not lab.shown
    lab.run("dropped-ball/e=0.5", unfold=True, **asked)
    assert lab.shown


def test_a_run_that_uses_no_function_of_the_student_is_called_given(lab, cells):
    lab.topic = "impulse"
    lab.run("cradle/5 touching", quantity="first", engines=())
    assert [row[0] for row in lab.shown[-1].rows] == ["given"]
    lab.topic = "detection"
    cells += right_cells()
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert lab.shown[-1].rows[0][0] == "yours"


def test_a_run_names_a_function_that_returns_nothing(lab, cells):
    cells += [*right_cells(), "def signed_distance(point, normal, offset):\n    point.sum()"]
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert "Your implementation crashed: signed_distance returned nothing: is a return missing?" in str(lab.shown[-1])
    assert "lab.check() says more about your functions." in str(lab.shown[-1])
    assert "value" not in str(lab.shown[-1])  # of a table without rows


def test_a_wrong_run_says_that_first_versions_have_no_check(lab, cells):
    """Only the last version of a function is checked."""
    lab.topic = "impulse"
    head = "def collide(body_a, body_b, normal, restitution, threshold=0.0):\n"
    cells += [f"{head}    return body_a[0], body_a[1], body_b[0], body_b[1]"]
    lab.run("two-balls/e=0.5,m=1,b=0", quantity="target", engines=())
    assert "says more about your functions. It checks the last version of collide." in str(lab.shown[-1])


def test_a_wrong_run_names_no_first_version_that_the_student_did_not_write(lab, cells):
    """The marbles call collide, which the lab on swept volumes lends."""
    lab.topic = "sweeping"
    cells += ["def sweep_sphere_sphere(*arguments):\n    return np.full(np.shape(arguments[-1]), np.inf)"]
    lab.run("passing-balls/v=40", quantity="passed", engines=())
    assert "It checks the last version of sweep_sphere_sphere." in str(lab.shown[-1])


def test_a_time_of_impact_in_the_past_is_reported_at_once(lab, cells):
    cells += [
        *right_cells(),
        "def time_of_impact_exact(separation, *motion):\n    return np.full(len(separation), -0.45)",
    ]
    lab.run("dropped-ball/e=0.5", quantity="rebound", engines=())
    assert "time_of_impact_exact answered -0.45 s: a time of impact is 0 or later" in str(lab.shown[-1])


def test_a_run_says_where_to_see_what_a_function_prints(lab, cells, capsys):
    printing = "def time_of_impact_interpolated(s0, s1, t, dt):\n    print(1)\n    return t + dt * s0 / (s0 - s1)"
    cells += [*right_cells(), printing]
    slide = {"quantity": "rebound", "engines": (), "profile": "slide"}
    told = said(capsys, lab.run, "dropped-ball/e=0.5", **slide)
    assert "What time_of_impact_interpolated prints is not shown here" in told
    assert "prints" not in said(capsys, lab.run, "dropped-ball/e=0.5", quantity="rebound", engines=())


def test_an_unknown_option_of_a_call_prints_one_line(lab, capsys):
    assert "lab.run: missing a required argument: 'scenario'" in said(capsys, lab.run)
    told = said(capsys, lab.watch, "dropped-ball/e=0.5", quantity="rebound")
    assert "unknown option, or parameter of dropped-ball, 'quantity'. Choices: engines, profile, timestep" in told
