"""`collisions bench`: who is timed, what is said of whom is missing, and that nothing is judged by a clock."""

from __future__ import annotations

import contextlib
import functools
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from labs.benching import programs, timing
from labs.benching.programs import Environment, run
from labs.benching.timing import Bench, Watched, benches, measure
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


def test_a_bench_has_its_own_number_of_calls_and_shows_the_largest_number_it_watches():
    results = iter([99.0, 3.0, 5.0, 4.0])  # the first call is not counted
    watched = Watched("depth, mm", lambda meters: 1000 * meters)
    bench = Bench("deep", "nothing", lambda: lambda: next(results), repeats=3, watched=watched)
    (ours,) = measure(bench)
    assert ours.watched == 5000
    assert not list(results)


def test_the_command_shows_what_is_watched_beside_the_times(made_up):
    path = made_up / "bench_made_up.py"
    watching = MADE_UP.replace("0.5)", '0.5, watched=Watched("depth, mm", lambda made: 12.5))')
    path.write_text(watching.replace("import Bench", "import Bench, Watched"), encoding="utf-8")
    said = CliRunner().invoke(app, ["bench", "quick"]).stdout
    heading, ours, theirs = said.splitlines()[1:4]
    assert heading.split()[-2:] == ["depth,", "mm"]
    assert [line.split()[-1] for line in (ours, theirs)] == ["12.5", "12.5"]


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


FEWER = {
    "inside-parity": {"COUNT": 1000},
    "inside-parity-grid": {"COUNT": 1000},
    "inside-winding": {"COUNT": 1000},
    "point-plane": {"COUNT": 1000},
    "contacts": {"CONTACTS": 400, "A_CALL": 200},
    "impact-laws": {"ODD_IMPACTS": 50},
    "impacts": {"PAIRS": 50},
    "cloth-step": {"SIDE": 10},
    "cloth-implicit": {"SIDE": 10},
    "edge-edge": {"QUERIES": 100},
    "pile": {"FALLING": 2, "SETTLING": 2},
    "grading-class": {"CLASS": 2},
}
"""Numbers of a bench that say how much is computed: so little shows that it runs."""
OF_WHOLE_PROGRAMS = {"grading", "grading-class", "notebook-detection", "notebook-impulse"}


def do_little(ours, name):
    """Put the small numbers in the place of a bench's own."""
    numbers = FEWER.get(name, {})
    assert numbers.keys() <= ours.__globals__.keys()
    ours.__globals__.update(numbers)


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in BENCHES if name not in OF_WHOLE_PROGRAMS])
def test_every_bench_of_functions_runs(name):
    bench = benches()[name]
    do_little(bench.ours, name)
    timings = measure(bench, repeats=1)
    assert timings[0].who == bench.who
    assert timings[0].median > 0


@pytest.mark.weekly
@pytest.mark.parametrize("name", sorted(OF_WHOLE_PROGRAMS - {"notebook-impulse"}))
def test_a_bench_of_whole_programs_runs(name):
    """Called once, as a second call starts them again. One notebook is enough: `test_notebooks.py` runs them all."""
    bench = benches()[name]
    do_little(getattr(bench.ours, "func", bench.ours), name)
    for prepare in (bench.ours, *bench.rivals.values()):
        call = None
        with contextlib.suppress(ImportError):  # a rival that is not installed
            call = prepare()
        if call:
            call()


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


@pytest.mark.weekly
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
@pytest.mark.slow
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


@pytest.fixture
def world():
    return timing._load(Path(timing.BENCHES) / "bench_world.py")


def test_the_overlap_of_a_pile_is_the_deepest_of_balls_and_walls(world):
    """Balls of radius 0.1 between walls at 1.25; the tolerance is the rounding of these numbers."""
    apart = [[0.3, -0.2, 0.1], [0.3, -0.2, 0.32], [1.1, 0.5, 0.7]]
    assert world.deepest_overlap(np.array(apart)) == 0
    pair = [[0.5, 0.6, 0.5], [0.5 + 0.09, 0.6 + 0.12, 0.5 + 0.08]]  # 0.17 from one another
    for deepest, ball in [
        (0.03, apart[1]),
        (0.04, [0, 0, 0.06]),
        (0.05, [1.2, 0, 0.3]),
        (0.06, [-1.21, 0, 0.3]),
        (0.07, [0, 1.22, 0.3]),
        (0.08, [0, -1.23, 0.3]),
    ]:
        assert world.deepest_overlap(np.array([*pair, ball])) == pytest.approx(deepest, abs=1e-15)


def test_the_balls_of_the_pile_start_apart_and_in_the_box(world):
    assert world.above_the_box().position.shape == (666, 3)
    assert world.deepest_overlap(world.above_the_box().position) == 0


@pytest.mark.slow
def test_the_engines_of_the_pile_read_one_state_and_give_it_alike(world, installed):
    """Balls that touch nothing fly and turn freely for a step, each about an axis of its own.

    The positions agree to rounding. The orientations agree to 1e-9 because Bullet turns by a series in (ω dt)².
    """
    installed("pybullet"), installed("mujoco")
    rng = np.random.default_rng(7)
    start = world.above_the_box()
    turned = rng.normal(size=(len(start.position), 4))
    turned /= np.linalg.norm(turned, axis=1, keepdims=True)
    spins = rng.normal(size=(len(start.position), 3))
    start = start._replace(orientation=turned, velocity=0.1 * spins[::-1], angular_velocity=spins)
    found = []
    for world_of in (functools.partial(world.bullet, 10), functools.partial(world.mujoco_cg, "elliptic")):
        made = world_of(start)
        found.append(made.pile(made.step(made.state)))
    ours = start.position + world.DT * (start.velocity - [0, 0, 9.81 * world.DT])
    for pile in found:
        np.testing.assert_allclose(pile.position, ours, rtol=0, atol=1e-14)
        np.testing.assert_allclose(pile.angular_velocity, spins, rtol=0, atol=1e-14)
    same = np.abs(np.vecdot(found[0].orientation, found[1].orientation))
    np.testing.assert_allclose(same, 1, rtol=0, atol=1e-9)
    assert np.abs(np.vecdot(found[0].orientation, turned)).min() < 1 - 1e-6
