"""`collisions bench`: who is timed, what is said of whom is missing, and that nothing is judged by a clock."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from labs.benching import programs, timing
from labs.benching.programs import Environment, run
from labs.benching.timing import Bench, benches, measure
from labs.cli import app
from reference.errors import CollisionsError, RunFailed

BENCHES = sorted(benches())
MADE_UP = """
from labs.benching.timing import Bench

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
    monkeypatch.setattr(timing, "BENCHES", tmp_path)
    return tmp_path


def test_programs_are_timed_in_turn_after_a_first_call_that_is_not_counted(made_up):
    (bench,) = benches(made_up).values()
    calls = bench.ours.__globals__["CALLS"]
    measure(bench, repeats=3)
    assert calls == ["ours prepared", "ours", "theirs prepared", "theirs", *["ours", "theirs"] * 3]


def test_a_rival_that_is_not_installed_is_named_and_the_others_are_timed(made_up):
    ours, theirs, gone = measure(benches(made_up)["quick"], repeats=2)
    assert (gone.who, gone.median, gone.note) == ("gone", None, "not installed: no_such_package_anywhere")
    for each in (ours, theirs):
        assert 0 <= each.fastest <= each.median < math.inf


def test_the_command_prints_a_table_of_the_requested_benches(made_up):
    said = CliRunner().invoke(app, ["bench", "quick", "--repeats", "1"])
    assert said.exit_code == 0
    assert "quick: nothing. Goal: 0.5 s." in said.stdout
    for who in ("hand-written", "theirs", "gone", "not installed: no_such_package_anywhere"):
        assert who in said.stdout


def test_an_unknown_bench_is_refused_with_the_known_ones(made_up):
    said = CliRunner().invoke(app, ["bench", "quik"])
    assert (said.exit_code, "Did you mean 'quick'?" in said.stderr) == (2, True)


def test_the_command_says_when_there_are_no_benches(tmp_path, monkeypatch):
    monkeypatch.setattr(timing, "BENCHES", tmp_path)
    said = CliRunner().invoke(app, ["bench"])
    assert (said.exit_code, "there is nothing to time" in said.stderr) == (2, True)


@pytest.mark.parametrize("name", BENCHES)
def test_every_bench_describes_itself_under_a_name_of_its_own(name):
    bench = benches()[name]
    assert isinstance(bench, Bench)
    assert bench.what
    assert bench.who not in bench.rivals
    files = sorted(Path(timing.BENCHES).glob("bench_*.py"))
    assert sum(f'"{name}"' in path.read_text(encoding="utf-8") for path in files) == 1


@pytest.mark.slow
@pytest.mark.parametrize("name", BENCHES)
def test_every_bench_runs(name):
    timings = measure(benches()[name], repeats=1)
    assert timings[0].who == benches()[name].who
    assert timings[0].median > 0


@pytest.fixture
def grading(tmp_path):
    return timing._load(Path(timing.BENCHES) / "bench_grading.py")


@pytest.mark.slow
def test_the_submission_of_the_bench_gets_full_marks_and_uses_memory(grading, tmp_path):
    run = grading.graded(grading.written(tmp_path))
    if sys.platform == "linux":
        assert run.memory > 30e6, "the interpreter with NumPy and pytest alone takes more"


def test_other_graders_get_the_calls_of_our_tests_as_asserts(grading):
    recorder = grading.Recorder()
    recorder.note("collide", (np.array([1.0, math.inf]), np.float32(0.5), (True, [2])), (np.array(3), -1.0))
    space = {"np": np, "inf": math.inf, "nan": math.nan, "collide": lambda *arguments: (3, -1.0)}
    (lines,) = recorder.asserts.values()
    assert lines[0] == "answer = collide(np.array([1.0, inf]), 0.5, (True, [2], ))"
    exec("\n".join(lines), space)
    space["collide"] = lambda *arguments: (3, 1.0)
    with pytest.raises(AssertionError):
        exec("\n".join(lines), space)


@pytest.mark.slow
@pytest.mark.parametrize("who", ["otter", "nbgrader"])
def test_other_graders_give_the_solutions_full_marks(grading, who, monkeypatch):
    monkeypatch.delenv("COLLISIONS_CACHE")
    try:
        grade = getattr(grading, who)()
    except ImportError:
        pytest.skip(f"no environment for {who}: `collisions bench grading` makes it")
    grade()


def test_a_program_that_fails_is_reported_with_its_output(tmp_path):
    with pytest.raises(RunFailed, match="ended with 3: no such lab"):
        run([sys.executable, "-c", "import sys; print('no such lab'); sys.exit(3)"], tmp_path)
    with pytest.raises(RunFailed, match="cannot be started"):
        run([tmp_path / "nobody"], tmp_path)


@pytest.mark.skipif(sys.platform != "linux", reason="memory is counted on Linux alone")
def test_memory_is_summed_over_all_processes(tmp_path):
    grows = "import time; kept = bytearray(60_000_000); time.sleep(0.3)"
    parent = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {grows!r}])"
    assert 60e6 < run([sys.executable, "-c", grows], tmp_path).memory < 100e6
    assert run([sys.executable, "-c", f"kept = bytearray(40_000_000); {parent}"], tmp_path).memory > 100e6


def test_an_environment_that_cannot_be_installed_says_why(tmp_path, monkeypatch):
    def refuse(command, folder):
        raise RunFailed("python ended with 1: No matching distribution found")

    monkeypatch.setattr(programs, "run", refuse)
    environment = Environment("none", ("no-such-package-anywhere",))
    with pytest.raises(CollisionsError, match=r"no-such-package-anywhere cannot be installed: .*No matching"):
        environment.install()
    assert not environment.ready
    with pytest.raises(ImportError, match="no-such-package-anywhere"):
        environment.program("anything")
