"""Our marks in nbgrader's gradebook, with nbgrader's own commands: they are shown, and no notebook can forge them."""

from __future__ import annotations

import copy
import csv
import json
import os
import subprocess
from pathlib import Path

import pytest
from made_platform_grades import HOSTILE
from program import collisions
from submissions import solved_notebook

from labs.benching.timing import benches
from labs.project_folders import STUDENT_NOTEBOOKS
from reference.running.shelf import VARIABLE, default_folder

pytestmark = pytest.mark.weekly
CACHE = default_folder()
"""The user's own; every test has another."""
NAME = "impulse.ipynb"
RAISES = f"def collide(*bodies, **named):\n    raise ValueError({HOSTILE!r})\n"


def cell_id(cell: dict) -> str:
    return cell["metadata"].get("nbgrader", {}).get("grade_id", "")


def solved(released: dict, *names: str) -> dict:
    """The released notebook, with some functions as in the solutions."""
    solutions = {cell_id(cell): cell for cell in json.loads(solved_notebook("impulse"))["cells"]}
    found = copy.deepcopy(released)
    for cell in found["cells"]:
        if cell_id(cell) in names:
            cell["source"] = solutions[cell_id(cell)]["source"]
    return found


def forged(released: dict) -> dict:
    """Nothing is written, and every check says that it gave all points, of which there are a thousand."""
    found = copy.deepcopy(released)
    for cell in found["cells"]:
        grading = cell["metadata"].get("nbgrader", {})
        if cell_id(cell).startswith("check-"):
            result = {"output_type": "execute_result", "execution_count": 1, "metadata": {}}
            cell["outputs"] = [{**result, "data": {"text/plain": str(grading["points"])}}]
            grading["points"], cell["source"] = 1000, f"{grading['points']}"
    return found


@pytest.fixture
def programs(monkeypatch) -> Path:
    """The folder of nbgrader's programs, in the environment that the bench of grading has made for it."""
    (environment,) = (each for each in benches()["grading"].environments if each.name == "nbgrader")
    with monkeypatch.context() as patch:
        patch.setenv(VARIABLE, str(CACHE))
        try:
            return environment.program("nbgrader").parent
        except ImportError:
            pytest.skip("nbgrader is not installed: collisions bench grading installs it")


class Course:
    """A course of nbgrader in a folder."""

    def __init__(self, folder: Path, programs: Path) -> None:
        self.folder, self.programs = folder, programs
        (folder / "source" / "impulse").mkdir(parents=True)
        (folder / "source" / "impulse" / NAME).write_bytes((STUDENT_NOTEBOOKS / NAME).read_bytes())
        (folder / "nbgrader_config.py").write_text("c = get_config()\nc.ClearSolutions.enabled = False\n")

    def run(self, *command: str | Path, fine: tuple[int, ...] = (0,)) -> str:
        """What one of the environment's programs prints."""
        places = {name: str(self.folder / name) for name in ("JUPYTER_CONFIG_DIR", "IPYTHONDIR", "HOME")}
        path = f"{self.programs}{os.pathsep}{os.environ['PATH']}"
        program = [self.programs / command[0], *command[1:]]
        done = subprocess.run(
            program, cwd=self.folder, env={**os.environ, **places, "PATH": path}, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        assert done.returncode in fine, done.stdout
        return done.stdout

    def hand_in(self, student: str, content: dict) -> None:
        place = self.folder / "submitted" / student / "impulse"
        place.mkdir(parents=True, exist_ok=True)
        (place / NAME).write_text(json.dumps(content), encoding="utf-8")

    def scores(self) -> dict[str, float]:
        """What `nbgrader export` says."""
        self.run("nbgrader", "export")
        with open(self.folder / "grades.csv", encoding="utf-8", newline="") as file:
            return {row["student_id"]: float(row["score"]) for row in csv.DictReader(file)}


def test_nbgrader_shows_our_marks_and_comments_and_none_that_a_notebook_forges(tmp_path, programs):
    course = Course(tmp_path / "course", programs)
    course.run("nbgrader", "generate_assignment", "impulse", "--create")
    released = json.loads((course.folder / "release" / "impulse" / NAME).read_text(encoding="utf-8"))
    wrong = solved(released, "normal_velocity")
    (collide,) = (cell for cell in wrong["cells"] if cell_id(cell) == "collide")
    collide["source"] = RAISES
    course.hand_in("ada", wrong)
    course.hand_in("mallory", forged(released))
    course.run("nbgrader", "autograde", "impulse", "--no-execute")
    assert course.scores()["mallory"] == 66  # all points of all functions: nbgrader believes the notebook

    grades, marks = tmp_path / "grades", tmp_path / "marks"
    done = collisions("grade", course.folder / "submitted", "--lab", "impulse", "--out", grades, "--jobs", "1")
    assert done.code == 0, done.error
    assert collisions("export", "nbgrader", "--lab", "impulse", "--grades", grades, "--out", marks).code == 0
    said = course.run("python", marks / "into_gradebook.py", "--course", course.folder)
    assert said == "The marks of 2 submissions are in the gradebook.\n"
    assert course.scores() == {"ada": 6, "mallory": 0}

    course.run("nbgrader", "generate_feedback", "impulse")
    page = (course.folder / "feedback" / "ada" / "impulse" / "impulse.html").read_text(encoding="utf-8")
    assert "Score: 6.0 / 85.0" in page
    comment = page[page.index("<b>Comments:</b> <pre><code>collide: it ends in an error.") :]
    assert "<script>" not in comment[: comment.index("</pre>")]
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in comment[: comment.index("</pre>")]

    course.hand_in("mallory", solved(released, "normal_velocity", "audit"))  # another file than the one graded
    said = course.run("python", marks / "into_gradebook.py", "--course", course.folder, fine=(1,))
    assert "'mallory' has no points, because the file was not graded" in said
