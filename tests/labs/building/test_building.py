"""Notebooks are made of lessons and solutions: stubs tell nothing, solved ones hold it all, and a release no more."""

from __future__ import annotations

import ast
import json
import re
import sys
import zipfile
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from made_lessons import HEAD, WRITES, sources
from program import collisions

from labs.building import lessons, notebooks
from labs.building.excerpts import TopicExcerpts, imports_of, text_of
from labs.building.points import points_of
from labs.building.release import given, release
from labs.cli import lab
from labs.grading.submission.reading import read
from labs.project_folders import ROOT, SOLVED_NOTEBOOKS, STUDENT_NOTEBOOKS
from reference import lecture
from reference.errors import CollisionsError, InvalidInput
from reference.recording import checksums
from reference.recording.files import FOLDER

GRADED = ("detection", "response", "friction", "impulse")
EVERY_TOPIC = pytest.mark.parametrize(
    "topic",
    [
        pytest.param(topic.name, marks=() if topic.name in GRADED else pytest.mark.slow)
        for topic in lecture.TOPICS
        if topic.name != "world"
    ],
)
"""Among the slow tests those of which nothing is graded yet."""
QUESTION = """
<!-- #region answer="why" points=3 -->
Why is T early?
<!-- #endregion -->

<!-- #region model="why" -->
The chord lies below the parabola.
<!-- #endregion -->

<!-- #region instructor=true -->
An hour.
<!-- #endregion -->

```python broken="bug"
gap = +1
```

```python model="bug"
gap = -1
```
"""


@pytest.fixture
def lesson(tmp_path, monkeypatch):
    """Writes a lesson of detection and returns how to build it."""
    monkeypatch.setattr(lessons, "LESSONS", tmp_path)

    def write(text: str = HEAD + WRITES + QUESTION) -> None:
        (tmp_path / "detection.md").write_text(text, encoding="utf-8")

    write()
    return write


def test_a_stub_has_its_signature_and_contract_and_raises(lesson):
    found = sources(notebooks.student("detection"))
    (stub,) = (source for source in found if source.startswith("def signed_distance("))
    described = ast.get_docstring(ast.parse(stub).body[0]) or ""
    assert "n·p + d = 0" in described
    assert "Raises" in described
    assert "Notes" not in described
    assert "".join(stub[stub.index("raise") :].split()) == (
        'raiseNotImplementedError("detection,step1:signed_distanceisyourstowrite")'
    )
    assert 'lab.check("signed_distance")' in found


def test_only_the_solved_notebook_holds_solutions_and_model_answers(lesson):
    solved, student = notebooks.solved("detection"), notebooks.student("detection")
    for told in ("np.vecdot(normal, point)", "gap = -1"):
        assert any(told in source for source in sources(solved))
        assert not any(told in source for source in sources(student))
    for told in ("The chord lies below", "An hour."):
        assert any(told in source for source in sources(solved, "markdown"))
        assert not any(told in source for source in sources(student, "markdown"))
    assert "gap = +1" in sources(student)
    assert "gap = +1" not in sources(solved)


def test_cells_are_named_for_the_grader_and_carry_its_points(lesson):
    cells = {cell["metadata"]["nbgrader"]["grade_id"]: cell["metadata"]["nbgrader"]
             for cell in notebooks.student("detection")["cells"] if "nbgrader" in cell["metadata"]}  # fmt: skip
    assert cells["signed_distance"]["solution"]
    assert cells["check-signed_distance"]["points"] == points_of("signed_distance") > 0
    assert cells["answer-why"]["points"] == 3


def test_a_solved_notebook_is_a_submission_with_every_function(lesson, tmp_path):
    path = tmp_path / "solved.ipynb"
    path.write_text(notebooks.text(notebooks.solved("detection")), encoding="utf-8")
    written = [entry.name for entry in lecture.functions_of("detection") if entry.role == "written"]
    found = read(path, written)
    assert found.functions == tuple(written)
    assert found.complaints == ()


@EVERY_TOPIC
def test_stub_is_the_solutions_own_header_and_docstring_without_notes(topic):
    excerpts = TopicExcerpts.of(topic)
    for entry in lecture.functions_of(topic):
        if entry.role != "written":
            continue
        stub = notebooks.stub(excerpts, entry.name).split("\n")
        (whole,) = (each.text.split("\n") for each in excerpts.every if entry.name in each.defines)
        (function,) = (node for node in ast.parse("\n".join(whole)).body if isinstance(node, ast.FunctionDef))
        end = next((at for at, line in enumerate(whole) if line == "    Notes"), 0)
        end = end - 1 if end else (function.body[0].end_lineno or 0) - 1
        assert ast.get_docstring(function)
        widest = notebooks.WIDTH if topic in lessons.lessons() else 88  # a topic is narrowed with its lesson
        assert max(map(len, stub)) <= widest
        assert stub[:end] == whole[:end]
        rest = "\n".join(stub[end:])
        assert re.fullmatch(r'\s*"""\n    raise NotImplementedError\([^)]*\)', rest), rest


PREDICT = """
```python guess="0.4 | 'up'"
lab.predict("high", "How high?", answer=...)
lab.predict("way", "Which way?", answer=..., choices=("up", "down"))
```
"""


def test_only_the_solved_notebook_replaces_the_dots_by_a_good_guess(lesson):
    lesson(HEAD + WRITES + QUESTION + PREDICT)
    (asked,) = [source for source in sources(notebooks.student("detection")) if "lab.predict" in source]
    (guessed,) = [source for source in sources(notebooks.solved("detection")) if "lab.predict" in source]
    assert asked.count("answer=...") == 2
    assert guessed == asked.replace("answer=...", "answer=0.4", 1).replace("answer=...", "answer='up'")


def test_the_dots_of_whole_arguments_are_replaced_by_guesses_too(lesson):
    cell = 'lab.expose("thrown", ..., ...)\nfirst = values[..., 0]'
    lesson(f'{HEAD}{WRITES}\n```python guess="[1.0, 2.0] | -9.81"\n{cell}\n```\n')
    assert cell in sources(notebooks.student("detection"))
    assert cell.replace("..., ...)", "[1.0, 2.0], -9.81)") in sources(notebooks.solved("detection"))


def test_the_same_lesson_makes_the_same_bytes(lesson):
    assert notebooks.text(notebooks.student("detection")) == notebooks.text(notebooks.student("detection"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (HEAD + WRITES.replace('write="count_impacts"', 'write="side_of_plane"', 1), "count_impacts"),
        (HEAD + WRITES + QUESTION.replace('model="why"', 'model="who"'), "no model for answer='why'"),
        (HEAD + WRITES + '\n```python colour="red"\n```\n', "colour"),
        (HEAD + WRITES + PREDICT.replace("0.4 | ", ""), "for 2 predictions"),
        (HEAD + WRITES + PREDICT.replace(""" guess="0.4 | 'up'\"""", ""), "guess='' for 2 predictions"),
        (HEAD.replace("kinematic_response", "kinematic_respons") + WRITES, "Did you mean"),
        (HEAD.replace("finite not", "finite side_of_plane not") + WRITES, "gives finite side_of_plane"),
        (HEAD.replace("finite not", "finit not") + WRITES, "define no 'finit'"),
        (HEAD + WRITES + "\n```python\nreturn np.asarray((np.vecdot(normal, point) + offset) / length)\n```\n", "line"),
    ],
)
def test_a_lesson_that_does_not_fit_is_refused_by_name(lesson, text, said):
    lesson(text)
    with pytest.raises(CollisionsError) as error:
        notebooks.student("detection")
    assert said in str(error.value)


@EVERY_TOPIC
def test_every_function_cut_out_of_the_solutions_works_by_itself(topic, monkeypatch):
    excerpts = TopicExcerpts.of(topic)
    for entry in lecture.functions_of(topic):
        found = excerpts.needed([entry.name])
        module = ModuleType("cut")
        monkeypatch.setitem(sys.modules, "cut", module)  # where a dataclass looks for itself
        exec(f"from __future__ import annotations\n{imports_of(found)}\n{text_of(found)}", module.__dict__)
        assert callable(getattr(module, entry.name))


def test_a_release_has_answers_of_closed_labs_and_what_an_open_lab_lends(lesson):
    modules = given(["detection"])
    assert set(modules) == {"response"}
    assert "def kinematic_response" in modules["response"]
    assert "def penalty_force" not in modules["response"]


def test_what_a_lab_is_given_holds_no_answer_of_the_lab_itself():
    through = []
    for topic in lessons.lessons():
        through.append(topic)
        text = "\n".join(given(through).values())
        asked = [entry.name for lab in through for entry in lecture.functions_of(lab) if entry.role == "written"]
        assert [name for name in asked if f"def {name}(" in text] == []


def test_two_open_labs_can_borrow_what_the_other_asks_for(monkeypatch):
    modules = given(["detection", "impulse"])
    assert "def signed_distance" not in modules["detection"]
    found = ModuleType("given")
    monkeypatch.setitem(sys.modules, "given", found)  # where a dataclass looks for itself
    found.__dict__["__name__"] = "given"
    exec(modules["detection"], found.__dict__)
    assert found.signed_distance(np.array([0.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0]), -0.5) == 1.5
    closed = given(["impulse"], ["detection"])
    assert "def signed_distance" in closed["detection"]
    assert "def count_impacts" in closed["detection"]


def test_a_release_holds_no_solution_hidden_test_or_model_answer(lesson, tmp_path):
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


def test_two_archives_are_the_same_and_a_full_folder_is_left_alone(lesson, tmp_path):
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


def test_build_check_names_what_is_stale_and_writes_nothing(lesson, tmp_path, monkeypatch):
    monkeypatch.setattr(lab, "ROOT", tmp_path)
    monkeypatch.setattr(lab, "STUDENT_NOTEBOOKS", tmp_path / "student")
    monkeypatch.setattr(lab, "SOLVED_NOTEBOOKS", tmp_path / "solved")
    stale = collisions("lab", "build", "--check", "detection")
    assert stale.code == 1
    assert "student/detection.ipynb, solved/detection.ipynb" in stale.error
    assert not (tmp_path / "student").exists()
    assert collisions("lab", "build", "detection").code == 0
    assert json.loads((tmp_path / "student" / "detection.ipynb").read_text(encoding="utf-8"))["nbformat"] == 4
    assert collisions("lab", "build", "--check", "detection").code == 0


def test_the_built_notebooks_are_up_to_date():
    for topic in lessons.lessons():
        for folder, made in ((STUDENT_NOTEBOOKS, notebooks.student), (SOLVED_NOTEBOOKS, notebooks.solved)):
            assert Path(folder, f"{topic}.ipynb").read_text(encoding="utf-8") == notebooks.text(made(topic)), topic
