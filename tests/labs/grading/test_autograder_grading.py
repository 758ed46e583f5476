"""Whole files, graded by the real tests in the real worker: what is right, to do, wrong, or hostile."""

from __future__ import annotations

import importlib
import inspect
import json
import os
import re
import stat
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from labs.cli.app import app
from labs.grading.calling import scenario_runs
from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader
from labs.grading.feedback import report
from labs.grading.judging import grade as grading
from labs.grading.judging import pytest_run
from labs.grading.judging.grade import Grade, grade, read_grade
from labs.grading.judging.score_sheet import Outcome, Part, Sheet
from labs.grading.wrapping import folded
from reference import lecture
from reference.errors import InvalidInput

TOPICS = ("detection", "response", "friction", "impulse")
MODULES = {
    "detection": ("detection",),
    "response": ("detection", "forces.integrators", "response.kinematic", "response.stepping", "response.penalty"),
    "friction": tuple(
        f"friction.{name}" for name in ("complementarity", "cone", "contacts", "dry", "support", "cradle", "impact")
    ),
    "impulse": tuple(f"impulse.{name}" for name in ("body", "points", "normals", "momentum", "inertia", "impact")),
}
"""The modules of the solutions that hold a topic and what it needs, in an order in which they may stand in one file."""
THREE_MISTAKES = """
import numpy as np

def point_velocity(velocity, angular_velocity, arm):
    return velocity + np.cross(arm, angular_velocity)

def normal_velocity(point_velocity_a, point_velocity_b, normal):
    return np.sum((point_velocity_a - point_velocity_b) * normal, axis=-1)

def rebound_velocity(normal_velocity, restitution):
    return -restitution * np.asarray(normal_velocity)

def apply_impulse(body_a, body_b, impulse):
    (va, wa, ra, ma, ia), (vb, wb, rb, mb, ib) = body_a, body_b
    return va + ma * impulse, wa + ia @ np.cross(ra, impulse), vb + mb * impulse, wb + ib @ np.cross(rb, impulse)
"""

BOUNCE = """
import numpy as np

def kinematic_response(velocity, normal, restitution):
    along = np.sum(velocity * normal, axis=-1, keepdims=True)
    return np.where(along < 0, velocity - (1 + np.asarray(restitution)[..., None]) * along * normal, velocity)
"""


def solved(folder: Path, *topics: str) -> Path:
    """The solutions of some topics as one file, as a student hands them in."""
    names = dict.fromkeys(name for topic in topics for name in MODULES[topic])
    texts = [inspect.getsource(importlib.import_module(f"solutions.{name}")) for name in ("checks", *names)]
    ours = r"^from (solutions|__future__)[^\n(]*(\([^)]*\))?[^\n]*\n"
    path = folder / "solved.py"
    path.write_text("from __future__ import annotations\n" + re.sub(ours, "", "\n".join(texts), flags=re.MULTILINE))
    return path


def stubs(folder: Path, topic: str) -> Path:
    """What a student starts from: signatures and docstrings."""
    module, text = importlib.import_module(f"solutions.{topic}"), "import numpy as np\n"
    for entry in lecture.functions_of(topic):
        if entry.role == "written":
            function = getattr(module, entry.name)
            names = ", ".join(
                name if parameter.default is parameter.empty else f"{name}={parameter.default!r}"
                for name, parameter in inspect.signature(function).parameters.items()
            )
            text += f"\n\ndef {entry.name}({names}):\n    {function.__doc__!r}\n    raise NotImplementedError\n"
    path = folder / "stubs.py"
    path.write_text(text)
    return path


@pytest.fixture(scope="module")
def three(tmp_path_factory) -> Grade:
    path = tmp_path_factory.mktemp("three") / "three.py"
    path.write_text(THREE_MISTAKES)
    return grade(path)


def text_of(sheet: Sheet, *topics: str) -> str:
    return "\n".join(report.report(sheet, topics))


def joined(text: str) -> str:
    return " ".join(text.split())


# Right, to do, wrong


def test_the_solutions_score_full_marks(tmp_path):
    found = grade(solved(tmp_path, "detection")).content()
    assert found["got"] == found["possible"] > 40
    assert [entry["verdict"] for entry in found["functions"]] == ["right"] * 8
    assert found["complaints"] == []


@pytest.mark.slow
@pytest.mark.parametrize("topic", TOPICS)
def test_the_solutions_of_every_topic_score_full_marks(topic, tmp_path):
    found = grade(solved(tmp_path, topic), [topic])
    assert [line for outcome in found.sheet.outcomes for line in outcome.lines()] == []
    assert [sum(part.points for part in outcome.parts) for outcome in found.sheet.outcomes] == [
        outcome.points for outcome in found.sheet.outcomes
    ]


def test_untouched_stubs_score_nothing_and_are_a_list_of_things_to_do(tmp_path):
    found = grade(stubs(tmp_path, "detection"))
    names = [entry.name for entry in lecture.functions_of("detection")]
    assert found.sheet.earned == 0
    text = text_of(found.sheet, "detection")
    assert re.findall(r"· (\w+)  to do", text) == names
    assert "8 functions to write. Begin with signed_distance (detection, step 1, slide 4). A distance" in joined(text)
    assert not found.sheet.complaints


@pytest.mark.slow
@pytest.mark.parametrize("topic", TOPICS[1:])
def test_untouched_stubs_of_every_topic_score_nothing(topic, tmp_path):
    found = grade(stubs(tmp_path, topic))
    assert found.sheet.earned == 0
    assert {diagnosis.verdict for diagnosis in found.sheet.diagnoses.values()} == {"unwritten"}


def test_mistakes_are_named_and_what_is_right_is_paid(three):
    text = joined(text_of(three.sheet, "impulse"))
    assert "r × ω turns the point the other way round. Hint: A wheel turns to the left" in text
    assert "Points that move apart already are turned round as well" in text
    assert "+J went to both bodies, as the slide prints it: momentum is not conserved." in text
    points = {entry["name"]: (entry["got"], entry["possible"]) for entry in three.content()["functions"]}
    assert points["normal_velocity"] == (4, 4)
    assert points["relative_velocity"] == (0, 4)
    assert all(got < possible for name, (got, possible) in points.items() if name != "normal_velocity")


def test_a_student_sees_what_was_tried_what_came_and_what_physics_says(three):
    text = text_of(three.sheet, "impulse")
    assert "rebound_velocity(normal_velocity=2, restitution=0.5)\n        gives   -1\n        physics 2\n" in text
    assert all(len(line) <= 80 for line in text.splitlines())


def test_the_smallest_example_that_gains_momentum_is_small(three):
    said = next(
        part.said for outcome in three.sheet.outcomes for part in outcome.parts if part.reason == "momentum is kept"
    )
    assert said.startswith("the two together gain a momentum of [2. 2. 2.] kg m/s\nfor body_a=((1, 1, 1), (1, 1, 1)")


def test_a_hidden_test_tells_no_number(three):
    hidden = [outcome for outcome in three.sheet.outcomes if outcome.hidden and not outcome.passed]
    said = {part.said for outcome in hidden for part in outcome.parts if not part.passed}
    assert hidden
    assert said <= {"the answer is wrong", "the function is not written yet", "the function raised an exception"}


@pytest.mark.slow
def test_grading_again_gives_the_same_grade(three, tmp_path):
    (tmp_path / "three.py").write_text(THREE_MISTAKES)
    assert grade(tmp_path / "three.py").content() == three.content()


# The file


def test_a_grade_is_a_file_for_its_owner_alone(three, tmp_path):
    three.write(tmp_path / "grade.json")
    content = read_grade(tmp_path / "grade.json")
    assert content == json.loads(json.dumps(three.content()))
    assert (content["schema"], content["version"]) == ("collisions-lab/grade", 1)
    assert content["got"] == sum(test["got"] for test in content["tests"]) == sum(t["got"] for t in content["topics"])
    assert all(type(test[key]) is int for test in content["tests"] for key in ("got", "possible"))
    assert stat.S_IMODE(os.stat(tmp_path / "grade.json").st_mode) == 0o600
    assert [path.name for path in tmp_path.iterdir()] == ["grade.json"]


def test_a_grade_that_cannot_be_written_leaves_the_old_one(three, tmp_path, monkeypatch):
    (tmp_path / "grade.json").write_text("old")
    monkeypatch.setattr(grading.os, "replace", lambda *_: (_ for _ in ()).throw(OSError("no space")))
    with pytest.raises(OSError, match="no space"):
        three.write(tmp_path / "grade.json")
    assert [path.name for path in tmp_path.iterdir()] == ["grade.json"]
    assert (tmp_path / "grade.json").read_text() == "old"


def test_what_is_no_grade_is_refused(tmp_path):
    for text in ("[]", "{", '{"schema": "collisions-lab/grade", "version": 0}'):
        (tmp_path / "grade.json").write_text(text)
        with pytest.raises(InvalidInput):
            read_grade(tmp_path / "grade.json")


# The student's command


def checked(path: Path, *options: str) -> tuple[int, str]:
    found = CliRunner().invoke(app, ["check", str(path), *options])
    return found.exit_code, found.output


def test_a_right_file_is_right(tmp_path):
    code, text = checked(solved(tmp_path, "detection"))
    assert code == 0
    assert text.count("✓") == 8
    assert "8 of 8 functions right" in text


def test_a_file_with_a_mistake_is_not_right(tmp_path):
    (tmp_path / "lab.py").write_text(
        "def is_colliding(separation, tolerance=0.0):\n    return separation < tolerance\n"
    )
    code, text = checked(tmp_path / "lab.py")
    assert code == 1
    assert "✗ is_colliding" in text
    assert "Hint" in text
    assert "0 of 8 functions right, 1 in part. Next: is_colliding, marked ✗ above." in text


@pytest.mark.parametrize(
    ("text", "code", "says"),
    [
        ("", 2, "it is empty"),
        ("def point_velocity(v, w, r:\n    return v\n", 1, "so point_velocity cannot be read"),
        ("x = 3\n", 1, "defines no function of the lab"),
    ],
)
def test_a_file_without_functions_is_told_why(text, code, says, tmp_path):
    (tmp_path / "lab.py").write_text(text)
    found = checked(tmp_path / "lab.py")
    assert found[0] == code
    assert says in joined(found[1])


def test_a_topic_that_is_none_is_a_mistake_in_the_command(tmp_path):
    (tmp_path / "lab.py").write_text("x = 3\n")
    assert checked(tmp_path / "lab.py", "--topic", "nothing")[0] == 2
    code, text = checked(tmp_path / "lab.py", "--topic", "world")
    assert code == 2
    assert "there are tests of detection" in joined(text)


def test_without_pytest_nothing_can_be_checked(tmp_path, monkeypatch):
    monkeypatch.setattr(pytest_run.importlib.util, "find_spec", lambda name: None)
    (tmp_path / "lab.py").write_text("def is_colliding(separation, tolerance=0.0):\n    return separation < 0\n")
    code, text = checked(tmp_path / "lab.py")
    assert code == 3
    assert 'pip install -e ".[dev]"' in text


def test_a_notebook_is_checked_as_well(tmp_path):
    cell = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    sources = ["%matplotlib inline", "def is_colliding(separation, tolerance=0.0):\n    return separation < -tolerance"]
    cells = [cell | {"source": source} for source in sources]
    notebook = {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells}
    (tmp_path / "lab.ipynb").write_text(json.dumps(notebook))
    code, text = checked(tmp_path / "lab.ipynb")
    assert code == 1  # seven are to do
    assert "✓ is_colliding" in text


# In words


def test_a_part_that_several_parts_repeat_is_told_once():
    parts = tuple(Part(1, reason, "needs collide") for reason in ("one", "two"))
    sheet = Sheet(outcomes=[Outcome("test_x", 2, False, parts=parts, function="collide")])
    assert text_of(sheet, "impulse").count("needs collide") == 1


PARTLY = """
import numpy as np

def relative_velocity(point_velocity_a, point_velocity_b):
    return point_velocity_b - point_velocity_a

def normal_velocity(point_velocity_a, point_velocity_b, normal):
    print(np.sum(relative_velocity(point_velocity_a, point_velocity_b) * normal, axis=-1))

def contact_impulses(magnitude, normal):
    raise NotImplementedError

def collide(body_a, body_b, normal, restitution, threshold=0.0):
    return contact_impulses(0.0, normal)

def rebound_velocity(normal_velocity, restitution):
    return contact_impulses(1.0, normal_velocity) if normal_velocity > 0 else -restitution * normal_velocity

def clasify_contact(normal_velocity, threshold=0.0):
    return np.sign(normal_velocity)
"""
ENDLESS = """
def is_colliding(separation, tolerance=0.0):
    while True:
        pass

def side_of_plane(separation, tolerance=0.0):
    return (separation > tolerance) * 1 - (separation < -tolerance) * 1
"""


def test_a_partly_finished_file_is_told_where_to_go_on(tmp_path):
    """What waits for something, what uses something wrong, what prints, loops or has another name."""
    (tmp_path / "lab.py").write_text(PARTLY)
    code, text = checked(tmp_path / "lab.py")
    text = joined(text)
    assert code == 1
    assert "line 19: is clasify_contact meant to be classify_contact?" in text
    assert "normal_velocity It calls your relative_velocity, which is not right yet: mend that first." in text
    assert "gives nothing (None): it prints, and has to return" in text
    assert "collide waits for contact_impulses" in text
    step = lecture.function("contact_impulses").step
    assert f"parting already needs contact_impulses (impulse, step {step}): it is not written yet" in text
    assert text.endswith("0 of 17 functions right. Next: relative_velocity, marked ✗ above.")


def test_what_is_right_and_needs_a_function_in_a_scenario_waits_for_it(tmp_path):
    text = solved(tmp_path, "detection").read_text().replace("def signed_distance(", "def left_out(")
    (tmp_path / "solved.py").write_text(text)
    said = checked(tmp_path / "solved.py")[1]
    assert "· signed_distance  to do, slide 4\n" in said
    assert re.search(r"· time_of_impact_exact  \d of \d parts right  waits for signed_distance\n", said)
    assert "6 of 8 functions right. Next: write signed_distance (detection, step 1, slide 4)." in joined(said)


def test_what_never_answers_is_not_waited_for_again_and_the_rest_is_graded(tmp_path):
    (tmp_path / "lab.py").write_text(ENDLESS)
    with Grader(Limits(call=2.0)) as hasty:
        found = grade(tmp_path / "lab.py", grader=hasty)
    assert found.sheet.diagnoses["is_colliding"].verdict == "too slow"
    text = joined(text_of(found.sheet, "detection"))
    assert "✓ side_of_plane" in text
    assert "gave no answer within 2 s and was stopped → Does every loop in it come to an end" in text
    hidden = [outcome for outcome in found.sheet.outcomes if outcome.hidden and outcome.function == "is_colliding"]
    assert [outcome.parts[0].said for outcome in hidden] == ["the function took too long"]


def test_what_python_cannot_read_is_not_called_to_do(tmp_path):
    (tmp_path / "lab.py").write_text("def point_velocity(v, w, r:\n    return v\n")
    text = checked(tmp_path / "lab.py")[1]
    assert "✗ point_velocity  cannot be read, see the first lines" in text
    assert "· relative_velocity  to do, slide 15" in text


def test_no_piece_of_advice_is_given_twice(tmp_path):
    names = ("signed_distance", "missing_probability")
    (tmp_path / "lab.py").write_text("".join(f"def {name}(*given): return np.dot(*given)\n" for name in names))
    text = checked(tmp_path / "lab.py")[1]
    assert text.count("name 'np' is not defined") == 2
    assert text.count("→ `import numpy as np` is missing.") == 1


@pytest.mark.parametrize(
    "text",
    [
        "point_velocity(velocity=(0, 0, 0), angular_velocity=(0, 0, 2), arm=(1, 0, 0))",
        "inverse_effective_mass(body_a=((0, 0, -2), (0, 0, 0), (0, 0, 0), 1, diag(2, 2, 2)), normal=(0, 0, 1))",
        "long(first=(" + ", ".join(["(0, 0.12345, 0)"] * 12) + "), second=1)",
        "words " * 40 + "(in a bracket that never closes",
    ],
)
def test_a_long_line_breaks_between_arguments_and_loses_nothing(text):
    lines = folded(text, 2)
    assert all(len(line) <= 80 for line in lines)
    assert "".join("".join(lines).split()) == "".join(text.split())
    if text.startswith(("point", "inverse")):
        assert all(line.count("(") - line.count(")") == (0, 1)[at == 0] for at, line in enumerate(lines[:-1]))


def test_without_the_solutions_whole_scenarios_are_left_out_and_cost_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(scenario_runs, "RIGHT", "a_package_that_a_student_lacks")
    (tmp_path / "lab.py").write_text(BOUNCE)
    code, text = checked(tmp_path / "lab.py")
    assert code == 1  # seven are to do
    assert "✓ kinematic_response" in text
    assert "1 test left out: a whole scenario needs right answers of other topics" in joined(text)


@pytest.mark.skipif(sys.platform != "linux", reason="modes of files are POSIX's")
def test_no_process_is_left_when_a_grade_is_there(three):
    children = Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children")
    if not children.exists():
        pytest.skip("this kernel does not list children")
    names = [Path(f"/proc/{child}/cmdline").read_bytes() for child in children.read_text().split()]
    assert [name for name in names if b"nursery" in name] == []
