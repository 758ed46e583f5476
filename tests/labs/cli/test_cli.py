"""The program `collisions`: what it ends with, what it says, and that it can be interrupted."""

from __future__ import annotations

import functools
import importlib.metadata
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from program import Said, collisions

from labs.cli import jobs, main
from reference.catalogue.scenarios import catalogue
from reference.engines import engine_names
from reference.errors import InvalidInput
from reference.report.row_files import read_published, read_rows
from reference.running.availability import absent
from reference.running.isolate import stop_workers

QUICK = ("ball-to-rest/e=0.5", "--engine", "handwritten")
TUNED = (*QUICK, "--profile", "tuned")
SLIDE = "sliding-slab/μ=0.7,v=1"
TOY = str(Path(__file__).parents[2] / "reference" / "toy_engine.py")
ENOUGH = 120.0  # s: whatever is run here takes some seconds, on a busy machine too
PROMPTLY = 30.0  # s: on a busy machine some seconds, and a small part of what the interrupted job would take
START = (
    "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler);"  # some shells have it ignored
    " sys.argv[0] = 'collisions'; from labs.cli import main; main()"
)
ENGINE_FILE = """
import os, time

from reference.engines.base import Engine, Method
from reference.errors import CannotExpress
from reference.scene.settings import Settings
from reference.scene.trajectory import Recorder


class Odd(Engine):
    name, title, package = "odd", "an odd one", {package!r}

    def settings(self, scenario, profile):
        self.check_profile(scenario, profile)
        return Settings({{"tuned": 0.01, "stock": 0.02}}[profile])

    def method(self, scenario, settings):
        return Method("at step")

    def run(self, scenario, settings):
        recorder = Recorder(self.name, scenario, settings)
        state = [n for b in scenario.bodies for n in (*b.position, *b.orientation, *b.velocity, *b.angular_velocity)]
        recorder.sample(state)
        {body}
        return recorder.trajectory()


ENGINE = Odd
"""
CRASH = "os._exit(3)"
RAISE = "raise ZeroDivisionError('[bold]by the moon[/]')"
NAN = "recorder.sample([float('nan')] * len(state))"
NO_WORDS = "raise CannotExpress('an odd one has no words for it')"
EVERYTHING = "".join(f"from solutions.{topic} import *\n" for topic in ("detection", "response", "forces", "friction"))
WRONG = EVERYTHING + "right = kinematic_response\ndef kinematic_response(v, n, e):\n    return right(v, n, 0.9 * e)\n"
MISSING = EVERYTHING + "del kinematic_response\n"


@pytest.fixture
def odd(tmp_path) -> Iterator[functools.partial[str]]:
    """Write an engine to a file; `body` is a line that its run does."""

    def write(body: str = "pass", package: str | None = None) -> str:
        path = tmp_path / "odd.py"
        path.write_text(ENGINE_FILE.format(body=body, package=package), encoding="utf-8")
        return str(path)

    return write


@pytest.fixture
def homework(tmp_path):
    """Write hand-written code to a file, as a student hands it in."""

    def write(text: str) -> str:
        path = tmp_path / "homework.py"
        path.write_text(text, encoding="utf-8")
        return str(path)

    return write


# The program as such


def test_the_program_that_is_installed_is_this_one():
    (script,) = importlib.metadata.entry_points(group="console_scripts", name="collisions")
    assert script.load() is main


def test_without_a_command_it_lists_its_commands_and_with_a_wrong_one_it_refuses():
    for name in ("compare", "report", "engines"):
        assert re.search(rf"\b{name}\b", collisions("--help").text)
        assert collisions(name, "--help").code == 0
    assert collisions("--help").code == 0
    wrong = collisions("compere")
    assert (wrong.code, "No such command 'compere'" in wrong.error) == (2, True)


def test_it_says_its_version():
    said = collisions("--version")
    assert (said.code, said.output) == (0, f"collisions-lab {importlib.metadata.version('collisions-lab')}\n")


def test_it_speaks_of_e_squared_on_a_console_that_knows_ascii_alone(tmp_path):
    environment = os.environ | {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    ended = subprocess.run(
        [sys.executable, "-c", START, "compare", *TUNED],
        env=environment,
        cwd=tmp_path,
        capture_output=True,
        check=False,
        timeout=ENOUGH,
    )
    assert ended.returncode == 0, ended.stderr
    assert "2 eⁿ t₁ with t₁ = √(2h/g)" in ended.stdout.decode("utf-8")
    assert "1 run, " in ended.stderr.decode("utf-8"), "progress goes where errors go"
    assert "run, " not in ended.stdout.decode("utf-8")


def test_with_verbose_it_logs_what_is_run():
    assert "started" in collisions("-v", "compare", *TUNED).error
    assert "started" not in collisions("compare", *TUNED).error


# What is refused, with the choices there are


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ["balltorest"],
            f"unknown scenario 'balltorest'. Did you mean 'ball-to-rest'? Choices: {', '.join(catalogue())}.",
        ),
        (["nowhere"], f"unknown scenario 'nowhere'. Choices: {', '.join(catalogue())}."),
        (
            ["ball-to-rest/e=0.55"],
            "unknown case of ball-to-rest 'e=0.55'. Did you mean 'e=0.5'? Choices: e=0.5, e=0.8, e=0.9.",
        ),
        (["ball-to-rest/"], "unknown case of ball-to-rest ''."),
        (
            ["--engine", "pybulet"],
            f"unknown engine 'pybulet'. Did you mean 'pybullet'? Choices: {', '.join(engine_names())}.",
        ),
        (
            ["--engine", "no/such.py"],
            f"such.py'; an engine is a name ({', '.join(engine_names())}) or a .py file",
        ),
        (
            [*QUICK, "--profile", "tunde"],
            "unknown profile 'tunde'. Did you mean 'tuned'? Choices: tuned, slide, stock.",
        ),
        ([*QUICK, "--profile", "spring"], "unknown profile 'spring'. Choices: tuned, slide, stock."),
        ([*QUICK, "--timestep", "-1"], "timestep is -1.0; it must be above zero"),
        ([*QUICK, "--timestep", "0"], "timestep is 0.0; it must be above zero"),
        ([*QUICK, "--timestep", "nan"], "timestep is nan; it must be a finite number"),
        ([*QUICK, "--timestep", "inf"], "timestep is inf; it must be a finite number"),
        ([*QUICK, "--timestep", "100"], "is longer than ball-to-rest/e=0.5, which lasts 6.6"),
        ([*QUICK, "--timestep", "soon"], "Invalid value for '--timestep'"),
        ([*QUICK, "--set", "timestep=-1"], "timestep is '-1'; it must be above zero"),
        ([*QUICK, "--set", "timestep=soon"], "timestep is 'soon'; it must be a number"),
        ([*QUICK, "--set", "policy"], "--set 'policy' is not of the form name=value, such as"),
        ([*QUICK, "--set", "[bold]"], "--set '[bold]' is not of the form name=value, such as"),
        (["incline", "--at", "friction"], "--at 'friction' is not of the form name=value, such as"),
        (["incline", "--at", "friction=much"], "friction is 'much'; it must be a number"),
        (["incline", "--at", "friction=2"], "friction is 2.0; it must be a number from 0 to 1"),
        (
            ["incline", "--at", "frictoin=1"],
            "unknown parameter of incline 'frictoin'. Did you mean 'friction'? Choices: friction, angle.",
        ),
        (["stack", "--at", "friction=1"], "stack has no parameters that can be moved; these have: "),
        ([*QUICK, "--at", "restitution=0.5"], "ball-to-rest/e=0.5 is one case, and so is what parameters make"),
        ([*QUICK, "--set", "=3"], "--set '=3' is not of the form name=value, such as"),
        ([*QUICK, "--set", "policy="], "--set 'policy=' is not of the form name=value, such as"),
        (
            [*QUICK, "--set", "polcy=at_step"],
            "unknown setting of hand-written's tuned profile 'polcy'. Did you mean 'policy'? Choices: timestep, ",
        ),
        ([*QUICK, "--set", "shortest_flight=long"], "shortest_flight is 'long'; it must be a number"),
        ([*QUICK, "--set", "policy=guess"], "policy is 'guess'; here it is one of exact_root, interpolated, at_step"),
        ([*QUICK, "--jobs", "0"], "Invalid value for '--jobs' / '-j'"),
        ([*QUICK, "--jobs", "-2"], "Invalid value for '--jobs' / '-j'"),
        ([*QUICK, "--implementation", "solution"], "no implementation 'solution'; give a package such as 'solutions'"),
        ([*QUICK, "--implementation", "no/such/homework.py"], "homework.py': there is no such file"),
        ([*QUICK, "--implementation", "../homework"], "no implementation '../homework'; give a package"),
    ],
    ids=lambda value: " ".join(value).replace(" ".join(QUICK), "…") if isinstance(value, list) else "",
)
def test_what_cannot_be_run_is_refused_with_the_choices_there_are(arguments, said):
    refused = collisions("compare", *arguments)
    assert refused.code == 2
    assert said in refused.error
    assert "Traceback" not in refused.error
    assert refused.output == ""


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--only", "balltorest"], "unknown scenario 'balltorest'. Did you mean 'ball-to-rest'?"),
        (["--engine", "mojoco"], "unknown engine 'mojoco'. Did you mean 'mujoco'?"),
        (["--only", QUICK[0], "--engine", "handwritten", "--implementation", "nobody"], "no implementation 'nobody'"),
        (["--jobs", "0"], "Invalid value for '--jobs' / '-j'"),
    ],
    ids=lambda value: value[-1] if isinstance(value, list) else "",
)
def test_a_report_of_what_cannot_be_run_is_refused_and_leaves_no_folder(arguments, said, tmp_path):
    refused = collisions("report", "--out", tmp_path / "new" / "report", *arguments)
    assert (refused.code, said in refused.error) == (2, True)
    assert os.listdir(tmp_path) == []


def test_a_report_that_cannot_be_written_is_refused_before_anything_runs(tmp_path):
    occupied = tmp_path / "occupied"
    occupied.write_text("mine")
    for out in (occupied, occupied / "below", tmp_path / ("long" * 100)):
        refused = collisions("report", "--only", QUICK[0], "--engine", "handwritten", "--out", out)
        assert refused.code == 2
        assert "cannot write the report to" in refused.error
        assert "choose another --out" in refused.error
        assert "run" not in refused.error.partition("Error:")[0]
    assert occupied.read_text() == "mine"
    assert os.listdir(tmp_path) == ["occupied"]


# Which runs a command line asks for


def test_a_scenario_named_without_a_case_means_all_of_its_cases():
    def cases(*names: str) -> dict[str, tuple[str, ...]]:
        return {job.family: job.cases for job in jobs.planned(names, ["handwritten"], ["tuned"])}

    assert cases("ball-to-rest/e=0.8", "incline", "ball-to-rest/e=0.5", "ball-to-rest/e=0.8") == {
        "ball-to-rest": ("e=0.8", "e=0.5"),
        "incline": (),
    }
    for names in (("ball-to-rest", "ball-to-rest/e=0.8"), ("ball-to-rest/e=0.8", "ball-to-rest")):
        assert cases(*names) == {"ball-to-rest": ()}
    assert cases().keys() == catalogue().keys()


def test_a_setting_may_be_written_as_it_is_printed():
    for text in ("shortest_flight=3", "shortest-flight = 3", "shortest flight=3"):
        (job,) = jobs.planned([QUICK[0]], ["handwritten"], ["tuned"], assignments=[text])
        assert job.changes == (("shortest_flight", "3"),)


def test_parameters_take_the_place_of_the_cases_and_may_have_any_value_in_range():
    found = jobs.planned(["incline"], ["handwritten"], ["tuned"], parameters=["friction=0.123", "angle = 7"])
    assert [job.at for job in found] == [(("friction", 0.123), ("angle", 7.0))]
    rest = "ball-to-rest", "--engine", "handwritten", "--profile", "tuned", "--at", "restitution=0.37", "--cases"
    # √(2h/g) (1 + e)/(1 − e) = 0.451524 · 1.37/0.63
    assert "e=0.37 0.98188 s expected hand-written, tuned 0.98188 s" in collisions("compare", *rest).text


@pytest.fixture
def without_mujoco(tmp_path, monkeypatch) -> Iterator[None]:
    """MuJoCo cannot be imported, neither here nor in a worker."""

    def forget() -> None:
        stop_workers()  # those that are idle have the old path
        absent.cache_clear()

    (tmp_path / "mujoco.py").write_text("raise ImportError('not here')")
    monkeypatch.syspath_prepend(tmp_path)
    forget()
    yield
    forget()


@pytest.mark.usefixtures("without_mujoco")
def test_a_missing_engine_answers_at_the_nearest_recorded_point_and_all_others_too():
    wish = "ball-to-rest", "--at", "restitution=0.57", "--timestep", "0.003", "--cases", "--profile", "tuned"
    said = collisions("compare", *wish, "--engine", "handwritten", "--engine", "mujoco")
    assert (
        "ball-to-rest: restitution 0.57 → 0.6, timestep 3 ms → 2 ms for all, since MuJoCo answers from recordings"
        in said.text
    )
    # √(2h/g) (1 + e)/(1 − e) = 0.451524 · 1.6/0.4
    assert "e=0.6 1.8061 s expected hand-written, tuned 1.8061 s" in said.text
    assert re.search(r"MuJoCo\*, tuned 1\.[78]\d* s", said.text)


@pytest.mark.usefixtures("without_mujoco")
def test_an_engine_that_is_missing_is_not_recorded_and_its_recordings_stay(tmp_path):
    said = collisions("record", "cradle", "--engine", "mujoco", "--out", tmp_path / "new")
    assert (said.code, said.text) == (3, "MuJoCo is not installed here: its recordings stay as they are.")
    assert not (tmp_path / "new").exists()


def test_only_what_is_stale_is_recorded_and_sizes_are_printed(tmp_path, installed):
    installed("mujoco")
    wish = "record", "parting-ball", "--engine", "mujoco", "--only-stale", "--out", tmp_path
    first, again = collisions(*wish), collisions(*wish)
    assert first.text.startswith("parting-ball in MuJoCo: never recorded kB of numbers + poses MuJoCo parting-ball ")
    assert sorted(path.name for path in (tmp_path / "mujoco").iterdir()) == ["parting-ball.json", "parting-ball.npz"]
    assert (again.code, again.text) == (0, "All recordings are of today's scenarios and settings.")
    refused = collisions("record", "parting-ball/v=0.1")
    assert (refused.code, "'parting-ball/v=0.1' is one case" in refused.error) == (2, True)


def test_what_is_set_reaches_the_run():
    assert "e=0.5 1.3546 s expected" in collisions("compare", *TUNED, "--cases").text
    late = collisions("compare", *TUNED, "--cases", "--set", "policy=at_step", "--timestep", "0.01").text
    assert "hand-written, tuned 1.3546 s <10" not in late
    with pytest.raises(InvalidInput):
        jobs.planned([QUICK[0]], ["handwritten"], ["tuned"], timestep=-1.0)


# How a comparison ends


def test_a_comparison_in_which_all_agree_ends_with_0_and_says_so():
    said = collisions("compare", *QUICK)
    assert said.code == 0
    for title in ("Ball coming to rest", "hand-written, tuned", "hand-written, slide", "hand-written, stock"):
        assert title in said.text
    assert said.text.endswith("4 of 4 checks of tuned settings agree with theory, 0 fail.")
    assert "3 runs, " in said.error


def test_with_cases_the_numbers_are_printed():
    assert "e=0.5 1.3546 s expected hand-written, tuned 1.3546 s" in collisions("compare", *TUNED, "--cases").text


def test_a_tuned_verdict_that_fails_ends_with_1(homework):
    said = collisions("compare", *TUNED, "--implementation", homework(WRONG))
    assert said.code == 1
    assert "✗ fail" in said.text
    assert said.text.endswith("3 of 4 checks of tuned settings agree with theory, 1 fails.")  # it rests too early


def test_a_stock_verdict_that_fails_is_shown_and_not_counted(homework):
    said = collisions("compare", *QUICK, "--profile", "stock", "--implementation", homework(WRONG))
    assert said.code == 0
    assert "✗ fail" in said.text
    assert said.text.endswith("0 of 0 checks of tuned settings agree with theory, 0 fail.")


def test_a_setting_that_makes_an_engine_wrong_fails(installed):
    installed("pybullet")
    # A slide of 0.15 s loses some percent of its speed to so much damping, in 1/s; 0.1 % of the way is accepted.
    said = collisions("compare", SLIDE, "--engine", "pybullet", "--profile", "tuned", "--set", "linear_damping=0.5")
    assert said.code == 1
    assert "✗ 0/1" in said.text


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (CRASH, "its process died (exit code 3)"),
        (RAISE, "ZeroDivisionError: [bold]by the moon[/]"),
        (NAN, "are not finite from t = 0.01 s on"),
    ],
    ids=["crash", "exception", "NaN"],
)
def test_a_run_without_a_usable_answer_ends_with_3_and_the_others_are_printed(body, said, odd):
    ended = collisions("compare", *TUNED, "--engine", odd(body))
    assert ended.code == 3
    assert f"an odd one, tuned: crashed: {said}" in ended.text or said in ended.text
    assert "hand-written, tuned ✓ 1/1" in ended.text
    assert "gave no answer." in ended.text


def test_a_run_that_hangs_is_stopped_and_ends_with_3(odd, monkeypatch):
    # 1 s: whatever the limit, it hangs for longer; what it is here only makes the test quick.
    monkeypatch.setattr(jobs, "TIME_LIMIT", 1.0)
    ended = collisions("compare", QUICK[0], "--profile", "tuned", "--engine", odd("time.sleep(600)"))
    assert ended.code == 3
    assert "an odd one, tuned: crashed: no answer within 1 s" in ended.text


def test_a_tuned_failure_counts_for_more_than_a_crash(odd, homework):
    ended = collisions("compare", *TUNED, "--engine", odd(CRASH), "--implementation", homework(WRONG))
    assert ended.code == 1


def test_an_engine_that_is_not_installed_costs_nothing_beside_others_and_says_how_to_get_it(odd):
    missing = odd(package="no_such_package")
    beside = collisions("compare", *TUNED, "--engine", missing)
    assert beside.code == 0
    alone = collisions("compare", QUICK[0], "--profile", "tuned", "--engine", missing)
    assert alone.code == 3
    for ended in (beside, alone):
        assert "an odd one is not installed here" in ended.text
        assert "pip install no_such_package" in ended.text


def test_where_no_engine_has_words_for_a_scenario_nothing_was_compared(odd):
    speechless = odd(NO_WORDS)
    assert collisions("compare", QUICK[0], "--profile", "tuned", "--engine", speechless).code == 3
    beside = collisions("compare", *TUNED, "--engine", speechless)
    assert (beside.code, "cannot express: an odd one has no words for it" in beside.text) == (0, True)


def test_a_function_that_is_not_written_yet_is_named_and_costs_nothing_where_an_engine_answers(homework):
    ours = ("compare", "dropped-ball/e=0.5", "--profile", "tuned", "--engine", "handwritten")
    unfinished = ("--implementation", homework(MISSING))
    beside = collisions(*ours, "--engine", TOY, *unfinished)
    assert beside.code == 0
    assert "a toy, tuned ✓ 1/1" in beside.text
    alone = collisions(*ours, *unfinished)
    assert alone.code == 3
    for ended in (beside, alone):
        assert "hand-written, tuned: needs kinematic_response (response, step 1)" in ended.text


def test_a_file_that_is_no_engine_is_refused(tmp_path):
    for name, text in (("empty.py", ""), ("other.py", "ENGINE = 3\n"), ("broken.py", "def (\n")):
        (tmp_path / name).write_text(text)
        refused = collisions("compare", QUICK[0], "--engine", tmp_path / name)
        assert refused.code == 2, name
        assert name in refused.error
        assert "Traceback" not in refused.error


# The report


def report(out: Path, *more: str, only: str = QUICK[0]) -> Said:
    return collisions("report", "--only", only, "--engine", "handwritten", "--out", out, *more)


def listing(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_report_is_written_where_it_is_asked_for_and_the_page_is_named(tmp_path):
    out = tmp_path / "new [draft]" / "report"
    said = report(out, only=SLIDE)
    assert said.code == 0
    assert "4 of 4 checks of tuned settings agree with theory, 0 fail." in said.text
    assert f"Open {out / 'index.html'} in a browser." in said.output
    names = {"index.html", "rows.json", "rows.csv", "timings.json", "provenance.json", "figures"}
    assert set(os.listdir(out)) == names
    assert len(read_rows(out / "rows.json")) == 2 * 4
    studied = {it["profile"] for it in json.loads((out / "rows.json").read_text(encoding="utf-8"))["convergence"]}
    assert studied == {"tuned", "stock"}, "a report always shows error against timestep"


def test_a_report_goes_over_an_earlier_one_and_a_refused_one_leaves_it_alone(tmp_path, homework):
    out = tmp_path / "out"
    out.mkdir()
    for name in ("index.html", "notes.txt"):
        (out / name).write_text("earlier")
    before = listing(out)
    assert report(out, "--implementation", "nobody").code == 2
    assert listing(out) == before
    assert report(out, "--implementation", homework(WRONG)).code == 1
    after = listing(out)
    assert after["notes.txt"] == b"earlier"
    assert b", 1 fails." in after["index.html"]


def test_a_report_with_a_crashed_engine_is_finished_and_ends_with_3(tmp_path, odd):
    said = report(tmp_path / "out", "--engine", odd("raise RuntimeError('<script>x</script>')"), only=SLIDE)
    assert said.code == 3
    page = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert "crashed: RuntimeError: &lt;script&gt;x&lt;/script&gt;" in page


# What is installed


def test_the_list_of_engines_names_each_with_its_version():
    said = collisions("engines")
    assert said.code == 0
    assert f"hand-written handwritten {importlib.metadata.version('collisions-lab')} ✓ ready" in said.text
    for name in engine_names():
        assert re.search(rf" {name} .*(✓ ready|– not installed|! broken)", said.output)


def test_the_list_of_engines_says_how_to_get_one_that_is_missing_and_why_one_is_broken(tmp_path, monkeypatch):
    (tmp_path / "pybullet.py").write_text("raise ImportError('a library of it is missing')\n")
    (tmp_path / "mujoco.py").write_text("import os\nos._exit(3)\n")
    monkeypatch.syspath_prepend(tmp_path)  # workers get this path too
    stop_workers()  # those that are idle have the old one
    try:
        said = collisions("engines")
    finally:
        stop_workers()
    assert said.code == 0
    assert re.search(r"PyBullet +pybullet +– not installed", said.output)
    assert re.search(r"MuJoCo +mujoco +! broken", said.output)
    assert 'pip install -e ".[pybullet]"' in said.text
    assert "MuJoCo is installed but cannot be imported: its process died (exit code 3)" in said.text


# Interrupts

posix_only = pytest.mark.skipif(os.name != "posix", reason="where a process can be interrupted by a signal")


def alive(pid: int) -> bool:
    state = subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True, check=False).stdout
    return bool(state.strip()) and not state.strip().startswith("Z")


def interrupt(command: list[str], running: Path, workers: int) -> tuple[int, str, list[int]]:
    """Start the program, interrupt it when its workers have said their numbers; return code, errors and numbers."""
    program = subprocess.Popen([sys.executable, "-c", START, *command], stderr=subprocess.PIPE, text=True)
    try:
        deadline = time.monotonic() + ENOUGH
        while len(os.listdir(running)) < workers:
            assert time.monotonic() < deadline
            assert program.poll() is None, program.stderr.read()
            time.sleep(0.02)
        start = time.monotonic()
        program.send_signal(signal.SIGINT)
        _, said = program.communicate(timeout=ENOUGH)
        assert time.monotonic() - start < PROMPTLY
    finally:
        program.kill()
    return program.returncode, said, [int(name) for name in os.listdir(running)]


@posix_only
@pytest.mark.parametrize("command", ["compare", "report"])
def test_an_interrupt_ends_the_program_promptly_with_130_and_leaves_nothing_behind(command, tmp_path, odd):
    running, out = tmp_path / "running", tmp_path / "out"
    running.mkdir()
    out.mkdir()
    (out / "index.html").write_text("an earlier report")
    # Tuned, at 0.01 s, it answers, and its worker waits for another job; stock, it sleeps for longer than any test.
    begun = f"open(os.path.join({str(running)!r}, str(os.getpid())), 'w').close()"
    body = f"{begun}; time.sleep(600 if settings.timestep > 0.01 else 0)"
    engine = ("--engine", odd(body), "--jobs", "2")
    chosen = ["compare", QUICK[0], *engine] if command == "compare" else ["report", "--only", QUICK[0], *engine]
    code, said, workers = interrupt([*chosen, *(["--out", str(out)] if command == "report" else [])], running, 2)
    assert code == 130
    assert "Interrupted." in said
    assert "Traceback" not in said
    assert len(workers) == 2
    assert not any(map(alive, workers))
    assert listing(out) == {"index.html": b"an earlier report"}
    assert os.listdir(out) == ["index.html"]


# The cache


def test_a_second_run_is_taken_from_the_cache_prints_the_same_and_says_so(tmp_path):
    first, second, anew = (collisions("compare", *QUICK, *more) for more in ((), (), ("--fresh",)))
    assert "from the cache" not in first.errors + anew.errors
    assert re.search(r"(\d+) runs, \1 of them from the cache", second.errors)
    assert first.output == second.output == anew.output


def test_a_run_that_overlaps_an_earlier_one_takes_what_there_is():
    collisions("compare", *TUNED)
    assert re.search(r"[2-9] runs, 1 of them from the cache", collisions("compare", *QUICK).errors)


def test_a_report_from_the_cache_is_the_same_report(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    for out in (first, second):
        assert collisions("report", "--only", "ball-to-rest", "--engine", "handwritten", "--out", out).code == 0
    for name in (
        "index.html",
        "rows.json",
        "rows.csv",
        *(f"figures/{it.name}" for it in (first / "figures").iterdir()),
    ):
        assert (second / name).read_bytes() == (first / name).read_bytes(), name
    cached = [
        [it["cached"] for it in json.loads((out / "timings.json").read_text())["seconds"]] for out in (first, second)
    ]
    assert [set(found) for found in cached] == [{False}, {True}]


def test_a_changed_line_of_homework_is_run_and_not_taken_from_the_cache(homework):
    text = "from solutions import *\nfrom solutions.detection import *\nfrom solutions.response import *\n"
    command = ("compare", *TUNED, "--implementation", homework(text))
    collisions(*command)
    assert "1 of them from the cache" in collisions(*command).errors
    homework(text + "# a second thought\n")
    assert "from the cache" not in collisions(*command).errors


# All of it


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_the_whole_report_is_written_all_tuned_verdicts_agree_and_it_is_small_enough_to_send(
    tmp_path, installed, capsys
):
    for name in engine_names():
        installed(name)
    start = time.monotonic()
    said = collisions("report", "--out", tmp_path / "report")
    with capsys.disabled():
        print(f"\nthe whole report took {time.monotonic() - start:.0f} s")
    assert said.code == 0
    rows = read_rows(tmp_path / "report" / "rows.json")
    tuned = [row for row in rows if row.profile == "tuned" and row.expected is not None]
    families = set(catalogue())
    waiting = {"corner", "two-walls", "sliding-ball", "rolling-ball", "box-flat", "box-on-edge", "stack"}  # for a world
    assert {(row.family, row.engine) for row in tuned} == {
        (family, name)
        for name in engine_names()
        for family in (families - waiting if name == "handwritten" else families)
    }
    assert {str(row.verdict) for row in tuned} <= {"pass", "known deviation"}
    assert re.search(rf"^{len(tuned)} of {len(tuned)} checks of tuned settings agree with theory", said.text)
    assert not [row for row in rows if str(row.verdict) in ("crashed", "not available", "cannot express")]
    needs = [row for row in rows if str(row.verdict) == "needs"]
    assert {(row.engine, row.note) for row in needs} == {("handwritten", "needs a rigid-body world (world)")}
    assert "49 cases wait for hand-written functions" in " ".join(said.text.split())
    assert len(needs) == 2 * 49  # in both of its profiles
    assert len(os.listdir(tmp_path / "report" / "figures")) == 2 * len(catalogue()) + 2
    others = {str(row.verdict) for row in read_published(tmp_path / "report" / "published.json")}
    assert others == {"pass", "known deviation", "cannot express"}
    size = (tmp_path / "report" / "index.html").stat().st_size
    assert size < 3_000_000  # bytes: what any mail takes, and a phone on the move loads


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ("--at", "restitution=0.4"),
            "--at 'restitution=0.4' is of which scenario? Name one of: thin-wall, dropped-ball,",
        ),
        (
            ("dropped-ball", "--at", "restitution=0.4", "--at", "restitution=0.7"),
            "restitution is given twice, as 0.4 and",
        ),
        (("dropped-ball", "--set", "timestep=0.002", "--timestep", "0.003"), "timestep is given twice, as 0.002 and"),
        (("dropped-ball", "--set", "contact_erp=0.2", "--engine", "pybullet"), "setting of PyBullet's stock profile"),
        (("p15",), "p15 is other people's case, no scenario: collisions compare --published p15"),
        (("--published", "dropped-ball"), "unknown published case 'dropped-ball'"),
    ],
)
def test_what_could_be_meant_in_two_ways_is_refused_with_what_to_say_instead(arguments, said):
    refused = collisions("compare", *arguments)
    assert refused.code == 2
    assert said in refused.error


@pytest.mark.parametrize("name", ["handwritten", "mine.py"])
def test_what_answers_everywhere_or_for_one_alone_is_not_recorded(name, tmp_path):
    refused = collisions("record", "parting-ball", "--engine", name, "--out", tmp_path)
    assert refused.code == 2
    assert f"'{name}' is not recorded; these engines are: pybullet, mujoco, dart" in refused.error
