"""Notebooks are made of lessons and solutions: stubs tell nothing, solved ones hold it all, and a release no more."""

from __future__ import annotations

import ast
import json
import re
import sys
from types import ModuleType

import pytest
from made_lessons import EACH_LAB, HEAD, WRITES, sources
from program import collisions

from labs.building import course_page, instructor_page, lessons, notebooks
from labs.building.points import points_of
from labs.cli import lab
from labs.grading.submission.excerpts import TopicExcerpts, imports_of, text_of
from labs.grading.submission.reading import read
from labs.project_folders import LESSONS, STUDENT_NOTEBOOKS
from reference import lecture
from reference.errors import CollisionsError

QUESTION = """
<!-- #region answer="why" points=3 -->
Why is T early?
<!-- #endregion -->

<!-- #region model="why" -->
The chord lies below the parabola.

*3 points* for the chord.
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
    assert "Parameters" in described
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


@EACH_LAB
def test_stub_is_the_solutions_own_header_and_docstring_without_notes(topic):
    excerpts = TopicExcerpts.of(topic)
    for entry in lecture.functions_of(topic):
        if entry.role != "written":
            continue
        stub = notebooks.stub(excerpts, entry.name).split("\n")
        (whole,) = (each.text.split("\n") for each in excerpts.every if entry.name in each.defines)
        (function,) = (node for node in ast.parse("\n".join(whole)).body if isinstance(node, ast.FunctionDef))
        (header,) = (node for node in ast.parse("\n".join(stub)).body if isinstance(node, ast.FunctionDef))
        names = [argument.arg for argument in function.args.args]
        assert [argument.arg for argument in header.args.args] == names
        assert "@" not in stub[0]
        whole, stub = (lines[node.body[0].lineno - 1 :] for lines, node in ((whole, function), (stub, header)))
        end = next((at for at, line in enumerate(whole) if line == "    Notes"), 0)
        closed = (function.body[0].end_lineno or 0) - function.body[0].lineno
        end = end - 1 if end else closed
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
        (HEAD + WRITES + QUESTION.replace("*3 points* for", "Full marks for"), "no rubric for answer='why'"),
        (HEAD + WRITES + '\n```python colour="red"\n```\n', "colour"),
        (HEAD + WRITES + PREDICT.replace("0.4 | ", ""), "for 2 predictions"),
        (HEAD + WRITES + PREDICT.replace(""" guess="0.4 | 'up'\"""", ""), "guess='' for 2 predictions"),
        (HEAD.replace("kinematic_response", "kinematic_respons") + WRITES, "Did you mean"),
        (HEAD.replace("finite not", "finite side_of_plane not") + WRITES, "gives finite side_of_plane"),
        (HEAD.replace("finite not", "finit not") + WRITES, "define no 'finit'"),
        (HEAD + WRITES + "\n```python\nreturn (np.vecdot(normal, point) + offset) / length\n```\n", "line"),
    ],
)
def test_a_lesson_that_does_not_fit_is_refused_by_name(lesson, text, said):
    lesson(text)
    with pytest.raises(CollisionsError) as error:
        notebooks.student("detection")
    assert said in str(error.value)


@EACH_LAB
def test_every_function_cut_out_of_the_solutions_works_by_itself(topic, monkeypatch):
    excerpts = TopicExcerpts.of(topic)
    for entry in lecture.functions_of(topic):
        found = excerpts.needed([entry.name])
        module = ModuleType("cut")
        monkeypatch.setitem(sys.modules, "cut", module)  # where a dataclass looks for itself
        exec(f"from __future__ import annotations\n{imports_of(found)}\n{text_of(found)}", module.__dict__)
        assert callable(getattr(module, entry.name))


def test_build_check_names_what_is_stale_and_writes_nothing(lesson, tmp_path, monkeypatch):
    monkeypatch.setattr(lab, "ROOT", tmp_path)
    monkeypatch.setattr(lab, "STUDENT_NOTEBOOKS", tmp_path / "student")
    monkeypatch.setattr(lab, "SOLVED_NOTEBOOKS", tmp_path / "solved")
    monkeypatch.setattr(lab, "INSTRUCTOR_PAGES", tmp_path / "pages")
    monkeypatch.setattr(lab, "COURSE_PAGE", tmp_path / "course.md")
    stale = collisions("lab", "build", "--check", "detection")
    assert stale.code == 1
    assert "student/detection.ipynb, solved/detection.ipynb, pages/detection.md, course.md" in stale.error
    assert not (tmp_path / "student").exists()
    assert collisions("lab", "build", "detection").code == 0
    assert json.loads((tmp_path / "student" / "detection.ipynb").read_text(encoding="utf-8"))["nbformat"] == 4
    assert collisions("lab", "build", "--check", "detection").code == 0


@EACH_LAB
def test_the_students_notebook_of_a_lab_is_up_to_date(topic):
    kept = STUDENT_NOTEBOOKS / f"{topic}.ipynb"
    assert kept.read_text(encoding="utf-8") == notebooks.text(notebooks.student(topic)), "run collisions lab build"


def test_there_is_a_lesson_of_every_lab():
    assert set(lessons.lessons()) == {each.name for each in lecture.TOPICS}


def test_the_page_of_the_course_names_every_lab_and_adds_up_its_minutes():
    page = course_page.page()
    assert set(course_page.IDEAS) == {topic.name for topic in lecture.TOPICS}
    for topic in lessons.lessons():
        planned = sum(
            int(minutes)
            for minutes in re.findall(
                r"^## .*\((\d+) minutes\)", (LESSONS / f"{topic}.md").read_text(encoding="utf-8"), re.MULTILINE
            )
        )
        assert f"| `{topic}` | [{planned / 60:.2g}](instructors/{topic}.md) |" in page


@EACH_LAB
def test_a_lecturer_can_read_the_page_of_a_lab_between_two_classes(topic):
    assert len(instructor_page.page(topic).split()) <= 2000


def test_the_page_of_a_lab_has_every_question_with_its_rubric_and_every_prediction():
    lesson, page = lessons.read("impulse"), instructor_page.page("impulse")
    questions = [cell for cell in lesson.cells if cell.kind == "answer"]
    assert sum(map(int, re.findall(r"^### .* \((\d+) points\)\n\n\*1 point\* for", page, re.MULTILINE))) == sum(
        cell.points for cell in questions
    )
    for cell in questions:
        (model,) = lesson.models(cell.key)
        assert model.text.endswith(lesson.rubric(cell.key))
        assert f"\n\n{lesson.rubric(cell.key)}\n\n" in page
        assert cell.text not in page
    assert f"| `collide` | {points_of('collide')} | " in page
    assert "| How fast is the struck ball after the impact? | 1.5 m/s | with e = 0.5" in page
    assert "| How fast does the gap open then? (Negative: it still closes.) | −2 m/s |" in page
    assert "| Step 1 · On a line | 25 | `collide`, a first version |" in page
