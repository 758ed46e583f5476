"""`collisions show`: what a class sees, with and without engines."""

from __future__ import annotations

import itertools
import os
import re

import pytest
from made_results import EVERY, MISSING
from program import collisions
from rich.cells import cell_len

from labs.cli import jobs, show
from labs.demonstrations.catalogue import DEMONSTRATIONS, find
from reference.pace import slowness
from reference.running.isolate import stop_workers

pytestmark = pytest.mark.usefixtures("screen", "one_worker")
LIMIT = 45.0
"""What a demonstration may take with an empty cache: processor time, s, on the machine of the allowances.

A class should wait for half a minute at most. Two cores have 60 s in it, of which runs of unequal length leave some
unused. Wall time would depend on what else runs: one demonstration took 37 s beside another worker of the tests.
"""


def used() -> float:
    """Processor time of this process, and of all workers, which end here, s."""
    stop_workers()
    return sum(os.times()[:4])


def test_show_without_a_name_lists_every_demonstration():
    assert "show" in collisions("--help").output
    said = collisions("show")
    assert said.code == 0
    for demonstration in DEMONSTRATIONS:
        assert re.search(rf"^{demonstration.name} ", said.output, re.MULTILINE)
    assert max(map(cell_len, said.lines)) <= 80


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("bonce", "bounce"),
        ("Bouncing", "bounce"),
        ("wall", "tunnelling"),
        ("sliding-slab", "stop"),
        ("newton", "cradle"),
    ],
)
def test_an_unknown_demonstration_is_refused_with_the_one_that_was_meant(name, meant):
    said = collisions("show", name)
    choices = ", ".join(one.name for one in DEMONSTRATIONS)
    assert said.code == 2
    assert f"unknown demonstration '{name}'. Did you mean '{meant}'? Choices: {choices}." in said.error


def test_an_unknown_engine_is_refused_before_the_question_is_printed():
    said = collisions("show", "bounce", "--engine", "pybulet")
    assert (said.code, said.output) == (2, "")
    assert "unknown engine 'pybulet'. Did you mean 'pybullet'?" in said.error


def test_every_timestep_is_run_once_in_every_engine(without_runs):
    calls = without_runs()
    assert collisions("show", "tunnelling").code == 0
    (planned,) = calls
    demonstration = find("tunnelling")
    wanted = set(itertools.product(demonstration.profiles, demonstration.timesteps.values()))
    assert len(planned) == len(wanted)
    assert {(job.engine, dict(job.changes)["timestep"]) for job in planned} == wanted


@EVERY
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
def test_a_demonstration_fits_80_columns_with_and_without_engines(demonstration, missing, without_runs):
    without_runs(*missing)
    said = collisions("show", demonstration.name)
    assert max(map(cell_len, said.lines)) <= 80
    assert "…" not in said.output, "something was cut off"
    for engine in missing:
        assert f"not available: {engine} {MISSING}" in said.text
    assert not re.search(r"[{}\[\]]|: ?,|:\.", said.output)
    assert said.code == (0 if set(demonstration.profiles) - set(missing) else jobs.COULD_NOT_COMPARE)


@EVERY
def test_question_plot_table_and_lesson_fit_on_24_lines(demonstration, without_runs):
    without_runs()
    said = collisions("show", demonstration.name)
    assert said.text.startswith(f"{demonstration.title}. {demonstration.question} {demonstration.look}")
    assert len(said.lines) + show.RUNS_AND_PROMPT <= 24
    assert any(line.startswith("→ ") for line in said.lines[-2:])


def test_question_plot_table_and_lesson_come_in_this_order():
    pytest.importorskip("plotext")
    said = collisions("show", "bounce", "--engine", "handwritten")
    assert said.code == 0, said.errors
    wanted = ("What will happen", "Look at", "gap below", "time, s", "time of rest", "→ Infinitely many")
    places = [said.text.index(words) for words in wanted]
    assert places == sorted(places)
    assert re.search(
        r"^by hand ● exact 4\.0637 s +<10⁻⁹ % +× slide 4\.0592 s +−0\.11 %$", "\n".join(said.lines), re.MULTILINE
    )
    assert "PyBullet" not in said.output
    plot = said.text[places[2] : places[3]]
    assert all(mark in plot for mark in "●×○")
    assert "3 runs" in said.errors
    assert "run" not in said.lines[-1]


@pytest.mark.slow
def test_a_demonstration_shown_again_runs_nothing():
    arguments = ("show", "stop", "--engine", "handwritten", "--no-plot")
    first, second = collisions(*arguments), collisions(*arguments)
    assert first.output == second.output
    assert ("from the cache" in first.errors, "2 of them from the cache" in second.errors) == (False, True)
    assert "from the cache" not in collisions(*arguments, "--fresh").errors


def test_a_demonstration_can_show_a_students_own_code(tmp_path):
    mine = tmp_path / "homework.py"
    mine.write_text("", encoding="utf-8")
    said = collisions("show", "stop", "--engine", "handwritten", "--implementation", mine)
    assert said.code == 3
    assert re.search(r"by hand +exact +needs", said.output)


LONG = ("stack", "tip")
"""Demonstrations that take two thirds of the time of all of them together."""


@pytest.mark.parametrize(
    "demonstration",
    [
        pytest.param(one, marks=pytest.mark.weekly if one.name in LONG else pytest.mark.slow, id=one.name)
        for one in DEMONSTRATIONS
    ],
)
def test_every_demonstration_is_there_in_half_a_minute_and_fits_the_screen(demonstration, installed, tmp_path):
    for engine in demonstration.profiles:
        installed(engine)
    here, before = slowness(), used()
    said = collisions("show", demonstration.name, "--jobs", "2", "--plot", tmp_path / "plot.png")
    assert (used() - before) / max(here, slowness()) < LIMIT
    assert said.code == 0, said.errors
    assert said.output.count("→ ") == len(demonstration.lesson)
    assert max(cell_len(line) for line in said.lines if not line.startswith("The plot is in")) <= 80
    assert not any(word in said.output for word in ("crashed", "not available", "…"))
    assert said.output.count("fail") == (2 if demonstration.name == "stop" else 0), "stock DART never stops"
    assert len(said.lines) + show.RUNS_AND_PROMPT <= 24 + 2, "two lines name the picture"
