"""`collisions grade` from a folder of submissions to marks, as an instructor runs it."""

from __future__ import annotations

import csv
import json

import pytest
from program import collisions
from submissions import notebook

from labs.project_folders import SOLVED_NOTEBOOKS, STUDENT_NOTEBOOKS

ROSTER = "student_id,name,canvas_id\n4711,Ada Lovelace,7\n4712,Zoë Müller,8\n4713,Bob,9\n4714,Carl,10\n"
NORMAL_VELOCITY = """\
import numpy as np


def normal_velocity(body_a, body_b, normal):
    return np.asarray(body_a[0]) - body_b[0]
"""


@pytest.fixture(scope="module")
def handed_in(tmp_path_factory):
    """Canvas' files: a solved notebook, a stub, one with a mistake, and one that cannot be read."""
    folder = tmp_path_factory.mktemp("class")
    place = folder / "submissions"
    place.mkdir()
    (place / "lovelaceada_7_21_impulse.ipynb").write_bytes((SOLVED_NOTEBOOKS / "impulse.ipynb").read_bytes())
    (place / "mullerzoe_LATE_8_22_impulse.ipynb").write_bytes((STUDENT_NOTEBOOKS / "impulse.ipynb").read_bytes())
    (place / "bob_9_23_impulse.ipynb").write_bytes(notebook(NORMAL_VELOCITY))
    (place / "mallory_66_24_impulse.ipynb").write_bytes(b"{")
    (folder / "roster.csv").write_text(ROSTER, encoding="utf-8")
    return folder


def marks(folder) -> dict[str, dict[str, str]]:
    with open(folder / "grades" / "grades.csv", encoding="utf-8", newline="") as file:
        return {row["student_id"]: row for row in csv.DictReader(file)}


def grade(folder, *more: str):
    return collisions(
        *("grade", str(folder / "submissions"), "--lab", "impulse", "--out", str(folder / "grades")),
        *("--roster", str(folder / "roster.csv"), *more),
    )


def test_a_class_is_graded_once_and_only_what_changed_is_graded_again(handed_in):
    done = grade(handed_in)
    assert done.code == 0, done.error
    assert "4 submissions are graded, 0 could not be graded." in done.output
    assert "The written questions of 1 are to be marked" in done.output
    found = marks(handed_in)
    assert (found["4711"]["raw_score"], found["4711"]["open"]) == ("65", "35")
    assert (found["4712"]["raw_score"], found["4712"]["late"]) == ("0", "late, says the platform, but not by how much")
    content = json.loads((handed_in / "grades" / "students" / "4713" / "grade.json").read_text(encoding="utf-8"))
    function = next(each for each in content["functions"] if each["name"] == "normal_velocity")
    assert function["got"] < function["possible"]
    assert function["verdict"] != "right"
    assert found["4713"]["raw_score"] == f"{content['points']:g}"
    assert (found["4714"]["raw_score"], found["4714"]["notes"]) == ("", "nothing handed in")
    assert found["Canvas 66"]["notes"].startswith("not on the roster; impulse.ipynb: ")

    paths = sorted((handed_in / "grades" / "students").glob("*/grade.json"))
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in paths}
    wrong = notebook(NORMAL_VELOCITY + "# again\n")
    (handed_in / "submissions" / "bob_9_30_impulse-1.ipynb").write_bytes(wrong)
    (handed_in / "submissions" / "mallory_66_24_impulse.ipynb").unlink()
    again = grade(handed_in)
    assert again.code == 0, again.error
    assert "The grade of Canvas 66 is put away: nothing is handed in any more." in again.output
    changed = [path.parent.name for path in paths if path.exists() and path.stat().st_mtime_ns != before[path][1]]
    assert changed == ["4713"]
    content = json.loads((handed_in / "grades" / "students" / "4713" / "grade.json").read_text(encoding="utf-8"))
    assert (content["identity"]["entry"], content["identity"]["student"]) == ("bob_9_30_impulse-1.ipynb", "4713")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("grade", "missing", "--lab", "impulse"), "'missing' is no folder"),
        (("grade", ".", "--lab", "impuls"), "impulse"),
    ],
)
def test_what_cannot_be_graded_is_said_in_a_line(tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    found = collisions(*arguments)
    assert found.code == 2
    assert said in found.error
    assert not (tmp_path / "grades").exists()
