"""A machine on which no engine can be imported: every command takes results from recordings, and says so."""

from __future__ import annotations

import re

import pytest
from program import collisions

from labs.cli import show
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.engines import engine_names, load_engine
from reference.recording import files
from reference.recording.entries import Entry
from reference.recording.reading import replay

pytestmark = pytest.mark.usefixtures("no_engine_here", "one_worker")

ENGINES = [name for name in engine_names() if load_engine(name).package]
TITLES = [load_engine(name).title for name in ENGINES]


def test_a_comparison_marks_the_numbers_of_every_engine_as_recorded():
    said = collisions("compare", "parting-ball", "--profile", "tuned")
    assert said.code == 0, said.errors
    for title in TITLES:
        assert re.search(rf"^{title}\*, tuned .*✓ 3/3", said.output, re.MULTILINE)
        assert re.search(rf"\* {title} \S+ was recorded on \S+ \(.*?\); it is not run here", said.text)


def test_a_value_between_recorded_ones_moves_all_to_the_nearest():
    said = collisions("compare", "sliding-slab", "--at", "friction=0.37", "--profile", "tuned")
    assert said.code == 0, said.errors
    names = f"{', '.join(TITLES[:-1])} and {TITLES[-1]}"
    assert f"friction 0.37 → 0.4 for all, since {names} are shown from recordings" in said.text
    assert all(f"{title}*, tuned" in said.output for title in TITLES)


def test_all_are_asked_at_the_nearest_point_that_a_missing_engine_has():
    wish = "ball-to-rest", "--at", "restitution=0.57", "--timestep", "0.003", "--cases", "--profile", "tuned"
    said = collisions("compare", *wish, "--engine", "handwritten", "--engine", "mujoco")
    assert (
        "ball-to-rest: restitution 0.57 → 0.6, timestep 3 ms → 2 ms for all, since MuJoCo is shown from recordings"
        in said.text
    )
    # √(2h/g) (1 + e)/(1 − e) = 0.451524 · 1.6/0.4
    assert "e=0.6 1.8061 s expected hand-written, exact 1.8061 s" in said.text
    assert re.search(r"MuJoCo\*, tuned 1\.[78]\d* s", said.text)


def test_a_missing_engine_is_not_recorded_and_keeps_its_recordings(tmp_path):
    said = collisions("record", "cradle", "--engine", "mujoco", "--out", tmp_path / "new")
    assert (said.code, said.text) == (3, "MuJoCo is not installed here: its recordings stay as they are.")
    assert not (tmp_path / "new").exists()


def test_published_cases_are_answered_from_recordings():
    said = collisions("compare", "--published", "P13", "P17")
    assert said.code == 0, said.errors
    assert "2 of 2 published cases agree in every number" in said.text
    assert "was recorded on" in said.text


@pytest.mark.slow
def test_a_demonstration_shows_recorded_engines_or_names_the_missing(tmp_path, monkeypatch):
    said = collisions("show", "stop")
    assert said.code == 0, said.errors
    numbers = re.findall(r"^(PyBullet|MuJoCo|DART)\* +\S tuned +0\.\d+ m.* stock +(0\.\d+ m|fail)", said.output, re.M)
    assert [stock == "fail" for _, stock in numbers] == [False, False, True]
    assert "PyBullet*, MuJoCo* and DART*: recorded elsewhere, not run here." in said.output
    assert len(said.lines) + show.RUNS_AND_PROMPT <= 24
    monkeypatch.setattr(files, "FOLDER", tmp_path)  # no recording there
    said = collisions("show", "stop", "--fresh")
    lines = "\n".join(said.lines)
    assert len(re.findall(r"^(PyBullet|MuJoCo|DART) +tuned +– +stock +–$", lines, re.MULTILINE)) == 3
    assert "PyBullet, tuned; PyBullet, stock: not available: PyBullet is not installed here" in said.text
    assert re.search(r"by hand +● exact +0\.50968 m", said.output)
    assert collisions("show", "stack").code == 3


@pytest.mark.slow
def test_a_demonstration_without_hand_written_code_is_shown_as_recorded():
    said = collisions("show", "roll", "--no-plot")
    assert said.code == 0, said.errors
    assert "1.4286 m/s" in said.output


@pytest.mark.slow  # runs six seconds of hand-written code
def test_names_with_a_star_leave_room_for_every_column(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    said = collisions("show", "tip", "--no-plot")
    assert said.code == 0, said.errors
    assert "…" not in said.output


@pytest.mark.parametrize("name", [ENGINES[0], *(pytest.param(name, marks=pytest.mark.slow) for name in ENGINES[1:])])
@pytest.mark.slow
def test_every_recorded_case_has_a_replay(name):
    for family in catalogue().values():
        if files.never_recorded(family.name, (name,)):  # a new family, of which the tests of recordings warn
            continue
        job = Job(family.name, name, "tuned")
        entries = files.content_of(name, family.name)["profiles"]["tuned"]["entries"]
        for case in (case.name for case in family.cases if Entry.read(entries[case.name]).verdict is None):
            poses = replay(job, case)
            assert poses.positions.shape[0] == len(poses.times) > 10
            assert "was recorded on" in poses.recording
