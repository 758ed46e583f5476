"""`collisions show`: what a class sees, with and without engines, colours, room and plotext."""

from __future__ import annotations

import dataclasses
import itertools
import math
import os
import re
import sys
import time

import pytest
from program import collisions
from rich.cells import cell_len
from rich.console import Console

from labs.cli import jobs, show
from labs.demonstrations.catalogue import DEMONSTRATIONS, find
from labs.demonstrations.demonstration import Demonstration
from labs.demonstrations.lesson import Error, IfKnown, Line, Listed, Magnitude, Measured, Predicted, Theory
from labs.demonstrations.outcomes import Outcome
from reference.catalogue.scenarios import catalogue
from reference.comparison.curves import Series
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.engines.base import EXACT
from reference.errors import UnknownName
from reference.report import terminal_plot
from reference.report.terminal_plot import Points
from reference.running.study import run_job

ALL = pytest.mark.parametrize("demonstration", DEMONSTRATIONS, ids=[one.name for one in DEMONSTRATIONS])
MISSING = "is not there; to get it: pip install it"
pytestmark = pytest.mark.usefixtures("one_worker")
LIMIT = 30.0  # s: what a demonstration may take on two cores with an empty cache
MAGIC = {".svg": b"<?xml", ".png": b"\x89PNG", ".pdf": b"%PDF"}


@pytest.fixture(autouse=True)
def screen(monkeypatch):
    """A terminal of 80 × 24 without colour; call it for another size."""

    def resize(width: int = 80, height: int = 24) -> None:
        monkeypatch.setattr(show, "output", Console(width=width, height=height))

    resize()
    return resize


def made(job: Job, number: float) -> JobResult:
    """A result that nobody ran: every quantity has this number, and theory says 1."""
    family = catalogue()[job.family]
    rows = tuple(
        Row(job.family, case, job.engine, job.profile, one.name, one.unit, Verdict.PASS, number, expected=1.0)
        for case in job.cases
        for one in family.quantities
    )
    times = tuple(place / 10 for place in range(11))
    series = Series(times, tuple(number * time for time in times)) if family.curve.case in job.cases else None
    return JobResult(job, load_engine(job.engine).title, "", rows, series=series)


def absent(job: Job) -> JobResult:
    row = Row(job.family, "all", job.engine, job.profile, "", "", Verdict.NOT_AVAILABLE, note=f"{job.engine} {MISSING}")
    return JobResult(job, load_engine(job.engine).title, "", (row,))


@pytest.fixture
def without_runs(monkeypatch):
    """Let the command get results that nobody ran, with those of some engines missing; counts the calls."""
    calls = []

    def use(*missing: str) -> list[list[Job]]:
        def run(planned, workers, cache):
            calls.append(list(planned))
            numbers = itertools.count(1)
            return [absent(job) if job.engine in missing else made(job, 0.1 + next(numbers) / 100) for job in planned]

        monkeypatch.setattr(jobs, "run", run)
        return calls

    return use


def seen_of(demonstration: Demonstration, *missing: str) -> Outcome:
    planned = show._planned(demonstration, None, "solutions")
    results = [absent(job) if job.engine in missing else made(job, 0.5) for job in planned]
    return Outcome(demonstration, tuple(results))


# The list


def test_it_is_a_command_and_without_a_name_lists_every_demonstration():
    assert "show" in collisions("--help").output
    said = collisions("show")
    assert said.code == 0
    for demonstration in DEMONSTRATIONS:
        assert re.search(rf"^{demonstration.name} ", said.output, re.MULTILINE)
    assert max(map(cell_len, said.lines)) <= 80


def test_an_unknown_name_is_refused_with_the_nearest_one():
    said = collisions("show", "bonce")
    choices = ", ".join(one.name for one in DEMONSTRATIONS)
    assert said.code == 2
    assert f"unknown demonstration 'bonce'. Did you mean 'bounce'? Choices: {choices}." in said.error


def test_an_unknown_engine_is_refused_before_anything_is_asked():
    said = collisions("show", "bounce", "--engine", "pybulet")
    assert (said.code, said.output) == (2, "")
    assert "unknown engine 'pybulet'. Did you mean 'pybullet'?" in said.error


def test_the_seven_of_the_lecture_are_there():
    assert [one.name for one in DEMONSTRATIONS] == ["bounce", "stop", "stack", "tunnelling", "roll", "tip", "cradle"]


# The demonstrations as data


@ALL
def test_a_demonstration_names_what_there_is(demonstration):
    family = catalogue()[demonstration.family]
    cases = [family.case(case) for case in demonstration.cases.values()]
    for quantity in (demonstration.quantity, *demonstration.beside):
        assert family.quantity(quantity).name == quantity
    for engine, profiles in demonstration.profiles.items():
        assert engine in engine_names()
        assert set(profiles) <= set(family.profiles(load_engine(engine)))
    assert demonstration.timesteps or family.curve.case in [case.name for case in cases], "nothing to plot"
    assert bool(demonstration.timesteps) == (demonstration.predicted is not None)


@ALL
def test_a_demonstration_asks_first_and_teaches_in_three_lines_at_most(demonstration):
    assert "What will happen" in demonstration.question
    assert demonstration.question.endswith("?")
    assert 1 <= len(demonstration.lesson) <= 3


@ALL
def test_the_numbers_of_the_question_are_those_of_the_scenario(demonstration):
    family, (label, name) = catalogue()[demonstration.family], next(iter(demonstration.cases.items()))
    told = demonstration.question + label
    parameters = family.case(name).parameters
    for parameter in ("restitution", "speed", "friction"):
        if parameter in parameters:
            assert re.search(rf"(?<![\d.]){re.escape(f'{parameters[parameter]:g}')}(?![\d.])", told), parameter
    if "slope" in parameters:
        assert f"{math.degrees(parameters['slope']):.0f}°" in told


@ALL
def test_every_number_that_a_lesson_asks_for_can_be_had(demonstration):
    seen = seen_of(demonstration)
    family = catalogue()[demonstration.family]
    for line in demonstration.lesson:
        for number in line.numbers:
            assert seen.written(number), number
            if not isinstance(number, Predicted):
                assert family.quantity(number.quantity), number
    assert len(seen.lesson()) == len(demonstration.lesson)


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (Measured("bullet", "stock", "rest_time"), "unknown engine in the lesson of 'bounce' 'bullet'"),
        (Error("pybullet", "stack", "rest_time"), "unknown profile of pybullet in the lesson of 'bounce' 'stack'"),
        (Theory("rest_time", at="e = 0.8"), "unknown case or timestep in the lesson of 'bounce' 'e = 0.8'"),
        (Predicted("1 ms"), "unknown timestep in the lesson of 'bounce' '1 ms'"),
    ],
    ids=["engine", "profile", "case", "timestep"],
)
def test_a_lesson_that_asks_for_a_number_of_no_run_is_refused(number, said):
    with pytest.raises(UnknownName, match=re.escape(said)):
        dataclasses.replace(find("bounce"), lesson=(Line("It is ", IfKnown(number), "."),))


@ALL
def test_the_marks_of_a_demonstration_differ_without_any_colour(demonstration):
    marks = [terminal_plot.marked(line).plain for line in seen_of(demonstration).implementations.values()]
    assert len(set(marks)) == len(marks)


def test_what_is_predicted_for_a_timestep_is_what_the_family_expects_of_a_step_method():
    demonstration = find("tunnelling")
    family = catalogue()[demonstration.family]
    case, quantity = family.case(*demonstration.cases.values()), family.quantity(demonstration.quantity)
    for engine, profiles in demonstration.profiles.items():
        for profile, timestep in itertools.product(profiles, demonstration.timesteps.values()):
            loaded = load_engine(engine)
            settings = loaded.settings(case.scenarios[0], profile).change(timestep=timestep)
            method = loaded.method(case.scenarios[0], settings)
            expectation = quantity.expect(case, settings, method)
            if method.kind == EXACT:
                assert expectation.value + expectation.shift == 0
                continue
            assert demonstration.predicted(timestep) == pytest.approx(expectation.value + expectation.shift)


def test_every_timestep_is_run_once_in_every_engine(without_runs):
    calls = without_runs()
    assert collisions("show", "tunnelling").code == 0
    (planned,) = calls
    demonstration = find("tunnelling")
    wanted = set(itertools.product(demonstration.profiles, demonstration.timesteps.values()))
    assert len(planned) == len(wanted)
    assert {(job.engine, dict(job.changes)["timestep"]) for job in planned} == wanted


# What a lesson says


def test_a_number_in_a_lesson_is_the_number_of_the_run():
    seen = seen_of(find("bounce"))
    for value in (2.345, 6.789):
        results = [
            dataclasses.replace(result, rows=tuple(dataclasses.replace(row, measured=value) for row in result.rows))
            if (result.job.engine, result.job.profile) == ("pybullet", "stock")
            else result
            for result in seen.results
        ]
        lesson = " ".join(Outcome(seen.demonstration, tuple(results)).lesson())
        assert f"PyBullet rests at {value:g} s" in lesson
        assert "MuJoCo 0.5 s" in lesson


def test_a_number_of_one_timestep_or_case_is_not_that_of_another():
    demonstration = find("tunnelling")
    planned = show._planned(demonstration, None, "solutions")
    seen = Outcome(demonstration, tuple(made(job, 50 * dict(job.changes)["timestep"]) for job in planned))
    assert seen.written(Measured("pybullet", "tuned", "passed", at="1 ms")) == "5 %"
    assert seen.written(Measured("pybullet", "tuned", "passed", at="1/60 s")) == "83 %"
    tip = seen_of(find("tip"))
    (other,) = [row for row in tip.results[-1].rows if (row.quantity, row.case) == ("way", "h=0.2,μ=0.7,θ=20°")]
    rows = tuple(dataclasses.replace(row, measured=0.9) if row is other else row for row in tip.results[-1].rows)
    tip = Outcome(tip.demonstration, (*tip.results[:-1], dataclasses.replace(tip.results[-1], rows=rows)))
    assert tip.written(Measured("mujoco", "stock", "way", at="20°, μ = 0.7")) == "0.9 m"
    assert tip.written(Measured("mujoco", "stock", "way", at="20°, μ = 0.3")) == "0.5 m"


A, B, GONE = Theory("a"), Theory("b"), Theory("gone")


def list_of(first, second):
    return Listed(IfKnown(first, " here"), IfKnown(second, " there"))


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        (["plain"], "plain"),
        ([A, " and ", B], "1 and 2"),
        ([A, " and ", GONE], ""),
        (["so: ", list_of(A, B), "."], "so: 1 here, 2 there."),
        (["so: ", list_of(GONE, B), "."], "so: 2 there."),
        (["so: ", list_of(A, GONE), "."], "so: 1 here."),
        (["so: ", list_of(GONE, GONE), "."], ""),
        ([A, IfKnown("; ", GONE), "."], "1."),
        (["so", IfKnown(": ", GONE), IfKnown(", ", GONE), "."], ""),
        ([A, IfKnown("; so: ", list_of(GONE, GONE)), "."], "1."),
    ],
)
def test_what_has_no_number_is_left_out_of_a_lesson(parts, said):
    assert Line(*parts).text(lambda number: {A: "1", B: "2"}.get(number, "")) == said


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (Measured("mujoco", "stock", "height"), "−0.25 m"),
        (Magnitude("mujoco", "stock", "height"), "0.25 m"),
        (Error("mujoco", "stock", "height"), "−1.2 m"),
        (Theory("height"), "0 m"),
    ],
)
def test_a_lesson_gives_a_number_its_magnitude_its_error_or_theory(number, said):
    demonstration = find("stack")
    planned = show._planned(demonstration, None, "solutions")
    assert Outcome(demonstration, tuple(made(job, -0.25) for job in planned)).written(number) == said


# The whole of it


@ALL
@pytest.mark.parametrize(
    "missing",
    [
        (),
        pytest.param(("pybullet",), marks=pytest.mark.slow),
        pytest.param(("mujoco",), marks=pytest.mark.slow),
        ("pybullet", "mujoco"),
    ],
    ids=lambda missing: " and ".join(missing) or "none",
)
def test_it_fits_eighty_columns_with_and_without_engines(demonstration, missing, without_runs):
    without_runs(*missing)
    said = collisions("show", demonstration.name)
    assert max(map(cell_len, said.lines)) <= 80
    assert "…" not in said.output, "something was cut off"
    for engine in missing:
        assert f"not available: {engine} {MISSING}" in said.text
    assert not re.search(r"[{}\[\]]|: ?,|:\.", said.output)
    assert said.code == (0 if set(demonstration.profiles) - set(missing) else jobs.COULD_NOT_COMPARE)


@ALL
def test_plot_table_and_lesson_stand_on_a_screen_of_24_lines(demonstration, without_runs):
    without_runs()
    lines = collisions("show", demonstration.name).lines
    assert lines[0] == demonstration.title
    assert len(lines) - lines.index("") <= 24  # the blank line scrolls away for the prompt
    assert lines[-1].startswith("→ ")


def test_question_plot_table_and_lesson_come_in_this_order_from_hand_written_code_alone():
    pytest.importorskip("plotext")
    said = collisions("show", "bounce", "--engine", "handwritten")
    assert said.code == 0, said.errors
    wanted = ("What will happen", "Look at", "gap below the ball, m", "time, s", "difference", "→ Infinitely many")
    places = [said.output.index(words) for words in wanted]
    assert places == sorted(places)
    assert re.search(r"^●  hand-written +exact +4\.0637 s +4\.0637 s +<10⁻⁹ %$", "\n".join(said.lines), re.MULTILINE)
    assert "PyBullet" not in said.output
    plot = said.output[places[2] : places[3]]
    assert all(mark in plot for mark in "●×○")
    assert "3 runs" in said.errors
    assert "run" not in said.lines[-1]


def test_shown_a_second_time_nothing_is_run():
    arguments = ("show", "stop", "--engine", "handwritten", "--no-plot")
    first, second = collisions(*arguments), collisions(*arguments)
    assert first.output == second.output
    assert ("from the cache" in first.errors, "2 of them from the cache" in second.errors) == (False, True)
    assert "from the cache" not in collisions(*arguments, "--fresh").errors


def test_students_own_code_can_be_shown(tmp_path):
    mine = tmp_path / "homework.py"
    mine.write_text("", encoding="utf-8")
    said = collisions("show", "stop", "--engine", "handwritten", "--implementation", mine)
    assert said.code == 3
    assert re.search(r"hand-written +exact +needs", said.output)


# The plot in the terminal


def test_without_a_plot_there_is_none(without_runs):
    without_runs()
    said = collisions("show", "bounce", "--no-plot")
    assert "time, s" not in said.output
    assert "time of rest" in said.output


def test_without_plotext_it_says_how_to_get_it_and_goes_on(without_runs, monkeypatch):
    without_runs()
    monkeypatch.setitem(sys.modules, "plotext", None)
    said = collisions("show", "bounce")
    assert said.code == 0
    assert 'pip install -e ".[show]"' in said.output
    assert "time, s" not in said.output
    assert "time of rest" in said.output


def test_a_wider_and_higher_terminal_is_used(without_runs, screen):
    pytest.importorskip("plotext")
    without_runs()
    sizes = {}
    for width, height in ((80, 24), (120, 24), (120, 45), (400, 45)):
        screen(width, height)
        said = collisions("show", "roll")
        (axis,) = [number for number, line in enumerate(said.lines) if "└" in line]
        sizes[width, height] = cell_len(said.lines[axis]), axis
    widths = [size[0] for size in sizes.values()]
    assert widths == [80, 120, 120, show.MOST_WIDTH]
    assert sizes[120, 45][1] > sizes[120, 24][1] + 10


def lines_of(demonstration: str) -> list:
    return list(seen_of(find(demonstration)).implementations.values())


def test_a_plot_has_its_size_its_labels_and_round_numbers_on_its_axes():
    pytest.importorskip("plotext")
    xs = [place / 100 for place in range(498)]
    lines = terminal_plot.plot([Points(None, xs, [0.73 * x for x in xs])], "time, s", "way, m", 80, 14).plain.split(
        "\n"
    )
    assert len(lines) == 14
    assert max(map(cell_len, lines)) == 80
    assert lines[0] == "way, m"
    assert lines[-1].split() == ["0", "1", "2", "3", "4", "time,", "s"]
    assert [number for line in lines[1:-2] for number in re.findall(r"^ *([−\d.]+)┤", line)] == ["3", "2", "1", "0"]


def test_where_curves_coincide_the_marks_of_all_are_seen():
    pytest.importorskip("plotext")
    xs = [place / 100 for place in range(500)]
    curves = [Points(line, xs, [math.sin(x) for x in xs]) for line in lines_of("bounce")]
    plain = terminal_plot.plot(curves, "time, s", "", 80, 14).plain
    for curve in curves:
        assert plain.count(terminal_plot.marked(curve.line).plain) >= 2


@pytest.mark.parametrize(("xs", "ys"), [([], []), ([1.0], [2.0]), ([0.0, 1.0], [3.0, 3.0]), ([0, 1e-9], [-1e9, 1e9])])
def test_hardly_any_curve_can_be_plotted_too(xs, ys):
    pytest.importorskip("plotext")
    for joined in (True, False):
        text = terminal_plot.plot([Points(lines_of("bounce")[0], xs, ys, joined)], "time, s", "way, m", 80, 11)
        assert len(text.plain.split("\n")) == 11


def test_colour_only_helps(without_runs, monkeypatch):
    pytest.importorskip("plotext")
    without_runs()
    plain = collisions("show", "bounce").output
    monkeypatch.setattr(
        show, "output", Console(width=80, height=24, force_terminal=True, color_system="256", no_color=False)
    )
    coloured = collisions("show", "bounce").output
    assert "\x1b[38;5;33m■" in coloured
    assert "\x1b[" not in plain
    stripped = re.sub(r"\x1b\[[\d;]*m", "", coloured)
    assert [line.rstrip() for line in stripped.splitlines()] == [line.rstrip() for line in plain.splitlines()]


# The plot in a file


@pytest.mark.parametrize(
    ("name", "suffix"),
    [
        *(("bounce", ".svg"), ("bounce", ".PNG"), ("tunnelling", ".svg"), ("tunnelling", ".pdf")),
        *(
            pytest.param(name, suffix, marks=pytest.mark.slow)
            for name, suffix in (("bounce", ".png"), ("bounce", ".pdf"), ("tunnelling", ".png"), ("tunnelling", ".PNG"))
        ),
    ],
)
def test_the_plot_is_written_to_a_file_and_nothing_else_is(name, suffix, tmp_path, without_runs):
    without_runs()
    file = tmp_path / f"plot{suffix}"
    said = collisions("show", name, "--no-plot", "--plot", file)
    assert said.code == 0, said.errors
    content = file.read_bytes()
    assert content.startswith(MAGIC[suffix.lower()])
    assert list(tmp_path.iterdir()) == [file]
    assert str(file) in said.output.replace("\n", "")
    if suffix == ".svg":
        text = content.decode()
        wanted = {"bounce": ("time, s", "gap below the ball, m", "PyBullet, stock"), "tunnelling": ("timestep, ms",)}
        assert all(words in text for words in wanted[name])


def test_the_same_numbers_make_the_same_bytes(tmp_path, without_runs):
    without_runs()
    for name in ("one.svg", "two.svg"):
        collisions("show", "roll", "--no-plot", "--plot", tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("plot.gif", "plot.gif' is no picture that can be drawn; it ends in .svg, .png, .pdf"),
        ("plot", "plot' is no picture that can be drawn"),
        ("nowhere/plot.png", "No such file or directory; choose another --plot"),
        ("folder.png", "Is a directory; choose another --plot"),
    ],
)
def test_a_file_that_cannot_be_is_refused_before_anything_runs(file, said, tmp_path, without_runs):
    calls = without_runs()
    (tmp_path / "folder.png").mkdir()
    ended = collisions("show", "bounce", "--plot", tmp_path / file)
    assert (ended.code, calls) == (2, [])
    assert said in ended.error
    assert [path.name for path in tmp_path.iterdir()] == ["folder.png"]


def test_a_disk_that_is_full_leaves_the_old_file_and_no_half_of_a_new_one(tmp_path, without_runs, monkeypatch):
    without_runs()
    file = tmp_path / "plot.svg"
    file.write_text("old", encoding="utf-8")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    said = collisions("show", "bounce", "--plot", file)
    assert said.code == 2
    assert "No space left on device" in said.error
    assert (file.read_text(encoding="utf-8"), list(tmp_path.iterdir())) == ("old", [file])


# With the engines


@pytest.mark.slow
@ALL
def test_every_demonstration_is_over_in_half_a_minute_and_teaches_all_it_has_to(demonstration, installed, tmp_path):
    for engine in demonstration.profiles:
        installed(engine)
    start = time.monotonic()
    said = collisions("show", demonstration.name, "--jobs", "2", "--plot", tmp_path / "plot.png")
    assert time.monotonic() - start < LIMIT
    assert said.code == 0, said.errors
    assert said.output.count("→ ") == len(demonstration.lesson)
    assert max(cell_len(line) for line in said.lines if not line.startswith("The plot is in")) <= 80
    assert not any(word in said.output for word in ("crashed", "not available", "fail"))


def test_a_hand_written_run_is_drawn_as_the_report_draws_it():
    (job, *_) = show._planned(find("stop"), ["handwritten"], "solutions")
    seen = Outcome(find("stop"), (run_job(job),))
    (curve,) = seen.curves
    assert (curve.xs, curve.ys) == (seen.results[0].series.times, seen.results[0].series.values)
    assert seen.axes == ("time, s", "way, m")
