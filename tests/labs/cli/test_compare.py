"""`collisions compare`: what it prints, what it ends with, and what it takes from the cache."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from odd_engine import CRASH, ELSE, NAN, NO_WORDS, RAISE
from program import EXACT, QUICK, SLIDE, collisions

from reference.comparison.results import Job
from reference.recording import files
from reference.report.row_files import rows_json
from reference.running.study import run_job

TOY = str(Path(__file__).parents[2] / "reference" / "toy_engine.py")
METHODS = ("--profile", "exact", "--profile", "slide", "--profile", "step")
"""All methods but the world, which takes seconds to bring a ball to rest."""
WRONG = """
at_impact, at_step = respond_at_impact, respond_at_step

def respond_at_impact(p, v, a, n, e, time, dt):
    return at_impact(p, v, a, n, 0.9 * e, time, dt)

def respond_at_step(p, v, a, n, behind, e, dt):
    return at_step(p, v, a, n, behind, 0.9 * e, dt)
"""
MISSING = "del respond_at_impact\n"
REST = "Besides, 2 checks would pass even if no body moved."
"""Those of the speed and the drift at the end: a ball that never leaves its start has neither."""

pytestmark = pytest.mark.usefixtures("one_worker")


def test_a_comparison_in_which_all_agree_ends_with_0():
    said = collisions("compare", *QUICK, *METHODS)
    assert said.code == 0
    for title in ("Ball coming to rest", *(f"hand-written, {how}" for how in ("exact", "slide", "step"))):
        assert title in said.text
    assert said.text.endswith(
        f"Of 2 checks that count, 2 came out as predicted and near theory and none failed. {REST}"
    )
    assert "3 runs, " in said.error


def test_with_cases_the_numbers_are_printed():
    assert "e=0.5 1.3546 s expected hand-written, exact 1.3546 s" in collisions("compare", *EXACT, "--cases").text


def test_a_verdict_that_counts_and_fails_ends_with_1(homework):
    said = collisions("compare", *EXACT, "--implementation", homework(WRONG))
    assert said.code == 1
    assert "✗ fail" in said.text
    assert "Of the functions in homework.py these runs called respond_at_impact, and not respond_at_step." in said.text
    assert said.text.endswith(
        f"Of 2 checks that count, 1 came out as predicted and near theory and 1 failed. {REST}"
    )  # it rests too early


def test_a_failure_at_the_step_is_shown_and_not_counted(homework):
    said = collisions("compare", *QUICK, "--profile", "step", "--implementation", homework(WRONG))
    assert said.code == 0
    assert "✗ fail" in said.text
    assert said.text.endswith("Of 0 checks that count, 0 came out as predicted and near theory and none failed.")


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
        pytest.param(NAN, "are not finite from t = 0.01 s on", marks=pytest.mark.slow),
        pytest.param(ELSE, "an odd one says timestep 0.02 s, and was told 0.01 s", marks=pytest.mark.slow),
    ],
    ids=["crash", "exception", "NaN", "not as told"],
)
def test_a_run_without_a_usable_answer_ends_with_3_beside_the_others(body, said, odd):
    ended = collisions("compare", *EXACT, "--engine", odd(body))
    assert ended.code == 3
    assert f"An odd one (tuned) crashed: {said}" in ended.text or said in ended.text
    assert "hand-written, exact ✓ 1/1" in ended.text
    assert f"gave no answer. {REST} crashed: ball-to-rest, an odd one, tuned" in ended.text


@pytest.mark.slow
def test_a_run_that_hangs_is_stopped_and_ends_with_3(odd):
    # 1 s: whatever the limit, it hangs for longer; what it is here only makes the test quick.
    ended = collisions("compare", QUICK[0], "--profile", "tuned", "--engine", odd("time.sleep(600)"), "--seconds", "1")
    assert ended.code == 3
    assert "and near theory and none failed. Besides, 1 run was lost and not judged." in ended.text
    assert "lost: ball-to-rest, an odd one, tuned: it took longer than 1 s and was stopped" in ended.text
    assert "A lost run has neither passed nor failed. Give each run more time with --seconds" in ended.text


@pytest.mark.slow
def test_a_tuned_failure_counts_for_more_than_a_crash(odd, homework):
    ended = collisions("compare", *EXACT, "--engine", odd(RAISE), "--implementation", homework(WRONG))
    assert ended.code == 1


def test_an_engine_that_is_not_installed_costs_nothing_beside_others(odd):
    missing = odd(package="no_such_package")
    beside = collisions("compare", *EXACT, "--engine", missing)
    assert beside.code == 0
    alone = collisions("compare", QUICK[0], "--profile", "tuned", "--engine", missing)
    assert alone.code == 3
    for ended in (beside, alone):
        assert "an odd one is not installed here" in ended.text
        assert "pip install no_such_package" in ended.text


def test_a_scenario_that_no_engine_can_express_is_not_compared(odd):
    speechless = odd(NO_WORDS)
    assert collisions("compare", QUICK[0], "--profile", "tuned", "--engine", speechless).code == 3
    beside = collisions("compare", *EXACT, "--engine", speechless)
    assert beside.code == 0
    assert "An odd one (tuned) cannot express this: an odd one has no words for it" in beside.text


def test_an_unwritten_function_is_named_and_costs_nothing_beside_engines(homework):
    ours = ("compare", "dropped-ball/e=0.5", "--profile", "exact", "--engine", "handwritten")
    unfinished = ("--implementation", homework(MISSING))
    beside = collisions(*ours, "--engine", TOY, *unfinished)
    assert beside.code == 0
    assert "a toy, tuned ✓ 1/1" in beside.text
    alone = collisions(*ours, *unfinished)
    assert alone.code == 3
    for ended in (beside, alone):
        assert "Hand-written code (exact) needs respond_at_impact (response, step 4)." in ended.text


def test_a_file_that_is_no_engine_is_refused(tmp_path):
    for name, text in (("empty.py", ""), ("other.py", "ENGINE = 3\n"), ("broken.py", "def (\n")):
        (tmp_path / name).write_text(text)
        refused = collisions("compare", QUICK[0], "--engine", tmp_path / name)
        assert refused.code == 2, name
        assert name in refused.error
        assert "Traceback" not in refused.error


@pytest.mark.parametrize("command", [("compare", *EXACT), ("compare", "--published", "P15"), ("show", "bounce")])
def test_code_that_cannot_be_used_is_refused_before_anything_is_printed(command, tmp_path):
    (tmp_path / "wrong.py").write_text("x = 1\ndef holds(:\n")
    for source, said in (
        (tmp_path, "give a package such as 'solutions'"),
        (tmp_path / "wrong.py", "wrong.py', line 2: "),
    ):
        refused = collisions(*command, "--implementation", source)
        assert (refused.code, refused.output, said in refused.error) == (2, "", True)
        assert len(refused.errors.splitlines()) == 1, "neither a run nor a second line"


def test_a_scenario_that_was_never_recorded_warns_and_runs(installed, tmp_path, monkeypatch):
    installed("mujoco")
    monkeypatch.setattr(files, "FOLDER", tmp_path)
    said = collisions("compare", "parting-ball", "--engine", "mujoco", "--profile", "tuned")
    assert (said.code, "MuJoCo, tuned" in said.text) == (0, True)
    assert "parting-ball was never recorded in MuJoCo; collisions record parting-ball does it." in said.error


def test_a_comparison_with_an_earlier_report_says_what_differs(tmp_path):
    file, text = tmp_path / "rows.json", rows_json([run_job(Job("ball-to-rest", "handwritten", "exact", ("e=0.5",)))])
    file.write_text(text, encoding="utf-8")
    same = collisions("compare", *EXACT, "--against", file)
    assert (same.code, "4 of 4 rows are as they were; 0 are new, and 0 have" in same.text) == (0, True)
    version = json.loads(text)["rows"][0]["engine_version"]
    file.write_text(text.replace(f'"engine_version": "{version}"', '"engine_version": "0.0"'), encoding="utf-8")
    other = collisions("compare", *EXACT, "--against", file)
    assert f"The rows of hand-written are of different versions: 0.0 then, {version} now." in other.text
    file.write_text(text.replace('"version": 3', '"version": 2'), encoding="utf-8")
    refused = collisions("compare", *EXACT, "--against", file)
    assert (refused.code, "this program reads collisions-lab/rows version 3" in refused.error) == (2, True)


# The cache


def test_a_second_run_comes_from_the_cache_and_prints_the_same():
    first, second, fresh = (collisions("compare", *EXACT, *more) for more in ((), (), ("--fresh",)))
    assert "from the cache" not in first.errors + fresh.errors
    assert "1 run, 1 of them from the cache" in second.errors
    assert first.output == second.output == fresh.output


@pytest.mark.slow
def test_a_comparison_takes_what_the_cache_has_and_runs_the_rest():
    collisions("compare", *EXACT)
    assert re.search(r"3 runs, 1 of them from the cache", collisions("compare", *QUICK, *METHODS).errors)


def test_changed_homework_is_run_and_not_taken_from_the_cache(homework):
    command = ("compare", *EXACT, "--implementation", homework("# a thought\n"))
    collisions(*command)
    assert "1 of them from the cache" in collisions(*command).errors
    homework("# a second thought\n")
    assert "from the cache" not in collisions(*command).errors
