"""What a release holds: open labs, answers of closed ones, and what one lab borrows from another."""

from __future__ import annotations

import re
import sys
import zipfile
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from made_lessons import HEAD, WRITES

from labs.building import lessons
from labs.building.release import given, release
from labs.guidance import drawings
from labs.project_folders import ROOT
from reference import lecture
from reference.errors import InvalidInput
from reference.recording import checksums
from reference.recording.files import FOLDER


@pytest.fixture
def lesson(tmp_path, monkeypatch):
    """There is one lesson, of detection."""
    monkeypatch.setattr(lessons, "LESSONS", tmp_path)
    (tmp_path / "detection.md").write_text(HEAD + WRITES, encoding="utf-8")


def run(text, monkeypatch):
    """The module of a text."""
    found = ModuleType("given")
    monkeypatch.setitem(sys.modules, "given", found)  # where a dataclass looks for itself
    exec(text, found.__dict__)
    return found


@pytest.mark.usefixtures("lesson")
def test_a_release_has_answers_of_closed_labs_and_what_an_open_lab_lends(monkeypatch):
    modules = given(["detection"])
    assert set(modules) == {"response"}
    found = run(modules["response"], monkeypatch)
    assert found.kinematic_response([0.0, 0.0, -2.0], [0.0, 0.0, 1.0], 0.5).tolist() == [0.0, 0.0, 1.0]
    assert not hasattr(found, "penalty_force")
    assert "def kinematic_response" in given([], ["response"])["response"]


@pytest.mark.parametrize(
    "topic",
    [pytest.param(topic, marks=() if topic == "detection" else pytest.mark.slow) for topic in lessons.lessons()],
)
def test_what_a_lab_is_given_holds_no_answer_of_that_lab_or_of_a_later_one(topic):
    labs = lessons.lessons()
    closed = list(labs)[: list(labs).index(topic)]
    text = "\n".join(given([*closed, topic], closed).values())
    asked = [entry.name for entry in lecture.FUNCTIONS.values() if entry.role == "written"]
    later = [each.name for each in lecture.TOPICS[[each.name for each in lecture.TOPICS].index(topic) :]]
    still = [name for name in asked if lecture.function(name).topic in later]
    assert [name for name in still if f"def {name}(" in text] == []


@pytest.mark.slow
def test_two_open_labs_can_borrow_what_the_other_asks_for(monkeypatch):
    modules = given(["detection", "impulse"])
    assert "def signed_distance" not in modules["detection"]
    found = run(modules["detection"], monkeypatch)
    assert found.signed_distance(np.array([0.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0]), -0.5) == 1.5
    closed = given(["impulse"], ["detection"])
    assert "def signed_distance" in closed["detection"]
    assert "def count_impacts" in closed["detection"]


@pytest.mark.usefixtures("lesson")
def test_a_release_holds_no_solution_hidden_test_or_model_answer(tmp_path):
    release(tmp_path / "out", "detection")
    names = {path.relative_to(tmp_path / "out").as_posix() for path in (tmp_path / "out").rglob("*")}
    assert "labs/notebooks/detection.ipynb" in names
    assert "tests/autograder/visible/test_detection.py" in names
    for hidden in ("solutions", "tests/autograder/hidden", "tests/autograder/misconceptions", "labs/lessons"):
        assert hidden not in names
    others = [name for name in names if re.search(r"(labs|autograder)/.*(friction|impulse)", name)]
    assert others == [], "what belongs to a later lab does not ship"
    assert checksums.changed(tmp_path / "out" / FOLDER.relative_to(ROOT)) == {}, "recordings arrive as they were made"
    assert ".zip" not in (tmp_path / "out" / "README.md").read_text(encoding="utf-8")
    secret = "np.vecdot(normal, point)"  # of signed_distance
    for path in (tmp_path / "out").rglob("*"):
        if path.suffix in (".py", ".ipynb", ".md"):
            assert secret not in path.read_text(encoding="utf-8"), path


@pytest.mark.slow
def test_a_lab_alone_has_of_an_earlier_one_what_its_runs_need(tmp_path, monkeypatch):
    assert release(tmp_path / "out", only=["impulse"]) == ["impulse"]
    text = (tmp_path / "out/labs/given/detection.py").read_text(encoding="utf-8")
    assert "def signed_distance" in text
    assert "def count_impacts" not in text
    assert not [path for path in (tmp_path / "out/labs/given").glob("*.py") if "    Notes\n" in path.read_text("utf-8")]
    assert "turn.T" not in (tmp_path / "out/labs/assessment/suspects/impulse.py").read_text(encoding="utf-8")
    statements = (tmp_path / "out/reference/lecture/statements.py").read_text(encoding="utf-8")
    found: dict[str, Any] = {"__name__": "statements"}
    monkeypatch.setitem(sys.modules, "statements", ModuleType("statements"))  # where a dataclass looks for itself
    exec(statements, found)
    assert {(entry.right, entry.erratum) for entry in found["STATEMENTS"]} == {("", "")}
    assert [entry.slide for entry in found["STATEMENTS"]] == [entry.slide for entry in lecture.STATEMENTS]
    figures = {path.stem for path in (tmp_path / "out/labs/figures").glob("*.svg")}
    assert "contact" in figures
    assert "chord" not in figures
    with pytest.raises(InvalidInput, match="detection is not among the labs of the release, impulse"):
        release(tmp_path / "other", "detection", ["impulse"])


def test_a_release_without_a_drawn_figure_is_refused_with_the_command(tmp_path, monkeypatch):
    monkeypatch.setattr(drawings, "FIGURES", tmp_path)
    with pytest.raises(InvalidInput, match=r"labs/figures/\w+.svg, which is not there: `make docs` draws it"):
        release(tmp_path / "out.zip", only=["impulse"])
    assert not (tmp_path / "out.zip").exists()


@pytest.mark.slow
def test_of_some_labs_those_before_the_last_open_one_are_closed(tmp_path):
    labs = ["impulse", "detection"]
    assert release(tmp_path / "first", "detection", labs) == ["detection"]
    assert not (tmp_path / "first/labs/notebooks/impulse.ipynb").exists()
    assert release(tmp_path / "second", "impulse", labs) == ["detection", "impulse"]
    text = (tmp_path / "second/labs/given/detection.py").read_text(encoding="utf-8")
    assert "def count_impacts" in text  # an answer of the closed lab
    assert release(tmp_path / "both", only=labs) == ["detection", "impulse"]
    text = (tmp_path / "both/labs/given/detection.py").read_text(encoding="utf-8")
    assert "def count_impacts" not in text
    assert "def signed_distance" not in text  # it is there, packed, for the runs of the other lab


@pytest.mark.usefixtures("lesson")
def test_two_archives_are_the_same_and_a_full_folder_is_left_alone(tmp_path):
    first, second = tmp_path / "1" / "my lab.zip", tmp_path / "2" / "my lab.zip"
    for out in (first, second):
        out.parent.mkdir()
        release(out, "detection")
    assert first.read_bytes() == second.read_bytes()
    readme = zipfile.ZipFile(first).read("collisions-lab/README.md").decode("utf-8")
    assert "unzip 'my lab.zip'\n   cd collisions-lab\n" in readme
    assert "choose `my lab.zip`, the archive" in readme
    with pytest.raises(InvalidInput, match="not empty"):
        release(tmp_path, "detection")
    for out in (first / "folder", tmp_path / "missing" / "c.zip"):
        with pytest.raises(InvalidInput, match=r"cannot write the release to .*; choose another --out"):
            release(out, "detection")
    with pytest.raises(InvalidInput, match="no lesson yet"):
        release(tmp_path / "new", "avoidance")
