"""`collisions compare --published` and `collisions record --published`: what they print and what they end with."""

from __future__ import annotations

import json
import re

import pytest
from program import collisions

BY_HAND = ("--engine", "handwritten")
pytestmark = pytest.mark.usefixtures("one_worker")


def test_named_cases_are_run_in_three_tables_and_end_with_0():
    said = collisions("compare", "--published", "P22", "p26", "P9", *BY_HAND)
    assert said.code == 0
    assert re.search("Verification.*P22.*✓ 1/1.*Validation.*P26.*✓ 4/4.*Cross-engine.*P9.*✓ 12/12", said.text)
    assert "3 of 3 published cases agree in every number" in said.text
    assert "3 runs" in said.errors


def test_a_second_run_comes_from_the_cache_and_prints_the_same():
    arguments = ("compare", "--published", "P22", *BY_HAND)
    first, second, anew = collisions(*arguments), collisions(*arguments), collisions(*arguments, "--fresh")
    assert first.text == second.text == anew.text
    assert "1 of them from the cache" in second.errors
    assert "from the cache" not in first.errors + anew.errors


def test_a_wrong_function_fails_and_a_missing_one_is_named(homework):
    wrong = homework("right = kinematic_response\ndef kinematic_response(v, n, e):\n    return right(v, n, 0.9 * e)\n")
    said = collisions("compare", "--published", "P5", *BY_HAND, "--implementation", wrong)
    assert said.code == 1
    assert "✗ 0/3" in said.text
    missing = homework("del kinematic_response\n")
    said = collisions("compare", "--published", "P5", *BY_HAND, "--implementation", missing)
    assert said.code == 3
    assert "P5, hand-written: needs kinematic_response (response, step 1)" in said.text
    said = collisions("compare", "--published", "P5", "P24", *BY_HAND, "--implementation", missing)
    assert said.code == 3  # of P24's functions there is none either


def test_a_function_that_raises_ends_the_command_with_3_and_its_error(homework):
    broken = homework("def kinematic_response(v, n, e):\n    raise ZeroDivisionError('by the moon')\n")
    said = collisions("compare", "--published", "P5", "P22", *BY_HAND, "--implementation", broken)
    assert said.code == 3
    assert "P5, hand-written: crashed: ZeroDivisionError: by the moon" in said.text
    assert "P22 Change of momentum in an elastic bounce ✓ 1/1" in said.text


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("P99",), "unknown published case 'P99'"),
        (("P5", "--profile", "stock"), "--profile does not go with --published"),
        (("P5", "--timestep", "0.1"), "--timestep does not go with --published"),
        (("P5", "--set", "solver=cg"), "--set does not go with --published"),
        (("P5", "--at", "restitution=0.4"), "--at does not go with --published"),
        (("P5", "--engine", "havok"), "unknown engine 'havok'"),
    ],
)
def test_unknown_cases_and_options_of_scenarios_are_refused_with_2(arguments, complaint):
    refused = collisions("compare", "--published", *arguments)
    assert refused.code == 2
    assert complaint in refused.error


def test_an_engine_runs_a_published_case_and_its_answers_are_recorded(installed, tmp_path, monkeypatch):
    installed("mujoco")
    monkeypatch.setattr("reference.published.jobs.published_cases", lambda: {"P22": None, "P24": None})
    said = collisions("record", "--published", "--engine", "mujoco", "--out", tmp_path)
    assert said.code == 0
    assert re.search(r"published +\d+ *1 files", said.text)
    content = json.loads((tmp_path / "mujoco" / "published.json").read_text(encoding="utf-8"))
    assert content["cases"].keys() == {"P22", "P24"}
    # 2 g h, and the lab's own tolerance of three digits
    assert content["cases"]["P22"]["answers"]["impulse"]["value"] == pytest.approx(2.71, abs=5e-3)
    assert content["cases"]["P24"]["refused"][0] == "cannot express"


def test_recording_scenarios_with_published_is_refused_and_writes_nothing(tmp_path):
    refused = collisions("record", "incline", "--published", "--out", tmp_path)
    assert refused.code == 2
    assert "--published takes no scenarios, and 'incline' is one" in refused.error
    assert not list(tmp_path.iterdir())


def test_an_engine_that_is_not_installed_keeps_its_recordings(monkeypatch, tmp_path):
    monkeypatch.setattr("labs.cli.record.absent", lambda name: True)
    said = collisions("record", "--published", "--engine", "dart", "--out", tmp_path)
    assert said.code == 3
    assert "DART is not installed here: its recordings stay as they are." in said.text
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_by_hand_every_published_case_but_two_has_every_number_right():
    said = collisions("compare", "--published", *BY_HAND)
    assert said.code == 0
    assert "39 of 41 published cases agree in every number" in said.text
    assert re.search(
        "implementation that is not their own. P11: hand-written: known deviation: a real contact", said.text
    )
