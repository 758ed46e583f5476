"""`collisions bench`: who is timed, what is said of whom is missing, and that nothing is judged by a clock."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from typer.testing import CliRunner

from labs import benching
from labs.benching import Bench, benches, measure
from labs.cli import app

BENCHES = sorted(benches())
MADE_UP = """
from labs.benching import Bench

CALLS = []


def prepare(who):
    CALLS.append(f"{who} prepared")
    return lambda: CALLS.append(who)


def missing():
    import no_such_package_anywhere


BENCHES = (
    Bench("quick", "nothing", lambda: prepare("ours"), {"theirs": lambda: prepare("theirs"), "gone": missing}, 0.5),
)
"""


@pytest.fixture
def made_up(tmp_path, monkeypatch) -> Path:
    (tmp_path / "bench_made_up.py").write_text(MADE_UP, encoding="utf-8")
    monkeypatch.setattr(benching, "PLACE", tmp_path)
    return tmp_path


def test_all_are_timed_in_turn_after_a_call_that_is_not_counted(made_up):
    (bench,) = benches(made_up).values()
    calls = bench.ours.__globals__["CALLS"]
    measure(bench, repeats=3)
    assert calls == ["ours prepared", "ours", "theirs prepared", "theirs", *["ours", "theirs"] * 3]


def test_a_rival_that_is_not_installed_is_named_and_the_others_are_timed(made_up):
    ours, theirs, gone = measure(benches(made_up)["quick"], repeats=2)
    assert (gone.who, gone.median, gone.note) == ("gone", None, "not installed: no_such_package_anywhere")
    for timing in (ours, theirs):
        assert 0 <= timing.fastest <= timing.median < math.inf


def test_the_command_prints_a_table_of_what_is_asked_for(made_up):
    said = CliRunner().invoke(app, ["bench", "quick", "--repeats", "1"])
    assert said.exit_code == 0
    assert "quick: nothing. Goal: 0.5 s." in said.stdout
    for who in ("hand-written", "theirs", "gone", "not installed: no_such_package_anywhere"):
        assert who in said.stdout


def test_an_unknown_bench_is_refused_with_the_known_ones(made_up):
    said = CliRunner().invoke(app, ["bench", "quik"])
    assert (said.exit_code, "Did you mean 'quick'?" in said.stderr) == (2, True)


def test_where_the_project_has_no_benches_it_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(benching, "PLACE", tmp_path)
    said = CliRunner().invoke(app, ["bench"])
    assert (said.exit_code, "there is nothing to time" in said.stderr) == (2, True)


@pytest.mark.parametrize("name", BENCHES)
def test_every_bench_says_what_it_does_and_every_name_is_used_once(name):
    bench = benches()[name]
    assert isinstance(bench, Bench)
    assert bench.what
    assert "hand-written" not in bench.rivals
    files = sorted(Path(benching.PLACE).glob("bench_*.py"))
    assert sum(f'"{name}"' in path.read_text(encoding="utf-8") for path in files) == 1


@pytest.mark.slow
@pytest.mark.parametrize("name", BENCHES)
def test_every_bench_runs(name):
    timings = measure(benches()[name], repeats=1)
    assert timings[0].who == "hand-written"
    assert timings[0].median > 0
