"""`collisions check`: what a student reads of a file that is right, wrong, unfinished or unreadable."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from cells import SIDE
from program import collisions
from submissions import solved

from labs.grading.calling import scenario_runs
from labs.grading.judging import pytest_run
from reference import lecture

pytestmark = pytest.mark.usefixtures("one_grader")

BOUNCE = """
import numpy as np

def kinematic_response(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    along = np.sum((velocity - np.asarray(plane_velocity)) * normal, axis=-1, keepdims=True)
    return np.where(along < 0, velocity - (1 + np.asarray(restitution)[..., None]) * along * normal, velocity)
"""


def checked(path: Path, *options: str) -> tuple[int, str]:
    found = collisions("check", path, *options)
    return found.code, found.errors + found.output


def joined(text: str) -> str:
    return " ".join(text.split())


def test_a_right_file_is_right(tmp_path):
    code, text = checked(solved(tmp_path, "detection"))
    assert code == 0
    assert text.count("✓") == 7
    assert "7 of 7 functions right" in text


def test_a_file_with_a_mistake_is_wrong_and_gets_a_hint(tmp_path):
    (tmp_path / "lab.py").write_text(
        "def side_of_plane(separation, tolerance=0.0):\n    return int(separation > 0) - int(separation < 0)\n"
    )
    code, text = checked(tmp_path / "lab.py")
    assert code == 1
    assert "✗ side_of_plane" in text
    assert "Hint" in text
    assert "0 of 7 functions right, 1 in part. Next: side_of_plane, marked ✗ above." in text


@pytest.mark.parametrize(
    ("text", "code", "says"),
    [
        ("", 2, "it is empty"),
        ("x = 3\n", 1, "defines no function of the lab"),
    ],
)
def test_a_file_without_functions_is_refused_with_the_reason(text, code, says, tmp_path):
    (tmp_path / "lab.py").write_text(text)
    found = checked(tmp_path / "lab.py")
    assert found[0] == code
    assert says in joined(found[1])


def test_a_topic_without_tests_is_refused(tmp_path, monkeypatch):
    (tmp_path / "lab.py").write_text("x = 3\n")
    assert checked(tmp_path / "lab.py", "--topic", "nothing")[0] == 2
    released = tmp_path / "autograder" / pytest_run.VISIBLE  # as students get it with one lab
    released.mkdir(parents=True)
    (released / "test_detection.py").touch()
    monkeypatch.setattr(pytest_run, "AUTOGRADER", released.parent)
    code, text = checked(tmp_path / "lab.py", "--topic", "meshes")
    assert code == 2
    assert "there are tests of detection" in joined(text)


def test_without_pytest_nothing_can_be_checked(tmp_path, monkeypatch):
    monkeypatch.setattr(pytest_run.importlib.util, "find_spec", lambda name: None)
    (tmp_path / "lab.py").write_text("def side_of_plane(separation, tolerance=0.0):\n    return separation < 0\n")
    code, text = checked(tmp_path / "lab.py")
    assert code == 3
    assert 'pip install -e ".[dev]"' in text


def test_a_notebook_is_checked_like_a_file(tmp_path):
    cell = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    sources = ["%matplotlib inline", SIDE]
    sources.append("lab.predict('high', 'How high?', answer=0.3)\nlab.predict('late', 'Too late?', answer=...)")
    cells = [cell | {"source": source} for source in sources]
    notebook = {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells}
    (tmp_path / "lab.ipynb").write_text(json.dumps(notebook))
    code, text = checked(tmp_path / "lab.ipynb")
    assert code == 1  # six are to do
    assert "✓ side_of_plane" in text
    assert "Predictions: 1 of 2 made." in text


PARTLY = """
import numpy as np

def normal_velocity(body_a, body_b, normal):
    p, q = (body[0] + np.cross(body[1], body[2]) for body in (body_a, body_b))
    return np.sum((q - p) * normal, axis=-1)

def impulse_magnitude(body_a, body_b, normal, restitution):
    print(-(1 + restitution) * normal_velocity(body_a, body_b, normal))

def apply_impulse(body_a, body_b, impulse):
    raise NotImplementedError

def collide(body_a, body_b, normal, restitution, threshold=0.0):
    return apply_impulse(body_a, body_b, 0.0 * normal)

def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    across = np.cross(edge_a, edge_b)
    return across / np.linalg.norm(across) if centre_a[..., 2] > 0 else apply_impulse(across, centre_a, centre_b)

def inverse_efective_mass(body_a, body_b, normal):
    return body_a[3] + body_b[3]
"""


def test_an_unfinished_file_hears_where_to_continue(tmp_path):
    """What waits for something, what uses something wrong, what prints, loops or has another name."""
    (tmp_path / "lab.py").write_text(PARTLY)
    code, text = checked(tmp_path / "lab.py")
    text = joined(text)
    assert code == 1
    assert "line 21: is inverse_efective_mass meant to be inverse_effective_mass?" in text
    assert "impulse_magnitude It calls your normal_velocity, which is not right yet: mend that first." in text
    assert "gives nothing (None): it prints, and has to return" in text
    assert "collide waits for apply_impulse" in text
    step = lecture.function("apply_impulse").step
    assert f"edges along no axis needs apply_impulse (impulse, step {step}): it is not written yet" in text
    assert text.endswith("0 of 8 functions right. Next: normal_velocity, marked ✗ above.")


def test_a_right_function_waits_for_another_that_its_scenario_needs(tmp_path):
    text = solved(tmp_path, "detection").read_text().replace("def signed_distance(", "def left_out(")
    (tmp_path / "solved.py").write_text(text)
    said = checked(tmp_path / "solved.py")[1]
    assert "· signed_distance  to do, slide 4\n" in said
    assert re.search(r"· time_of_impact_exact  \d of \d parts right  waits for signed_distance\n", said)
    assert "5 of 7 functions right. Next: write signed_distance (detection, step 1, slide 4)." in joined(said)


def test_a_function_that_python_cannot_read_is_not_listed_as_to_do(tmp_path):
    (tmp_path / "lab.py").write_text("def side_of_plane(separation:\n    return separation < 0\n")
    code, text = checked(tmp_path / "lab.py")
    assert code == 1
    assert "add its ). Until then side_of_plane cannot be checked." in joined(text)
    assert "✗ side_of_plane  cannot be read, see the first lines" in text
    assert "· signed_distance  to do, slide 4" in text


def test_no_advice_is_given_twice(tmp_path):
    names = ("signed_distance", "missing_probability")
    (tmp_path / "lab.py").write_text("".join(f"def {name}(*given): return np.dot(*given)\n" for name in names))
    text = checked(tmp_path / "lab.py")[1]
    assert text.count("name 'np' is not defined") == 2
    assert text.count("→ `import numpy as np` is missing.") == 1


def test_without_the_solutions_scenarios_are_left_out_and_cost_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(scenario_runs, "RIGHT", "a_package_that_a_student_lacks")
    (tmp_path / "lab.py").write_text(BOUNCE)
    code, text = checked(tmp_path / "lab.py")
    assert code == 1  # six are to do
    assert "✓ kinematic_response" in text
    assert "1 test left out: whole scenarios need right functions of other labs" in joined(text)
