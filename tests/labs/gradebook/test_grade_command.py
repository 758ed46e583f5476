"""`collisions grade` from a folder of submissions to marks, as an instructor runs it."""

from __future__ import annotations

import contextlib
import csv
import json
import os
from concurrent.futures import ThreadPoolExecutor

import pytest
from program import collisions
from submissions import notebook, solved_notebook

from labs.gradebook import protection
from labs.gradebook.deadlines import CALLED_LATE
from labs.grading.worker.sandbox import Sealing
from labs.grading.worker.tier import Tier
from labs.project_folders import STUDENT_NOTEBOOKS
from labs.workers import Workers

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
    (place / "lovelaceada_7_21_impulse.ipynb").write_bytes(solved_notebook("impulse"))
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


@pytest.fixture
def bars(monkeypatch):
    """The progress bars that a command shows: name, length, and how far it came."""
    shown = []

    @contextlib.contextmanager
    def bar(what: str, total: int):
        shown.append([what, total, 0])
        yield lambda: shown[-1].__setitem__(2, shown[-1][2] + 1)

    monkeypatch.setattr("labs.cli.grade._progress", bar)
    return shown


@pytest.mark.slow
def test_a_class_is_graded_once_and_only_what_changed_is_graded_again(handed_in, bars):
    alone = ("--jobs", "1", "--no-runs")  # a second worker takes longer to start than these submissions take
    done = grade(handed_in, *alone)
    assert bars == [["Grading", 4, 4], ["Writing pages", 5, 5]]
    assert done.code == 0, done.error
    assert "4 submissions are graded, 0 could not be graded." in done.output
    assert "The written questions of 1 are to be marked" in done.output
    assert "1 not on the roster: Canvas 66." in done.output
    assert "1 with nothing that could be graded: Canvas 66." in done.output
    assert "1 late, but the platform does not say by how much: 4712. Nothing is taken off." in done.output
    assert "nothing handed in" not in done.output  # a note that needs nobody
    of_others = 0o077
    out = handed_in / "grades"
    for place in (out, *out.rglob("*")):
        if place.is_dir() or place.stat().st_size:  # an empty file is a lock
            assert not place.stat().st_mode & of_others, place
    found = marks(handed_in)
    assert (found["4711"]["raw_score"], found["4711"]["open"]) == ("65", "35")
    assert (found["4712"]["raw_score"], found["4712"]["late"]) == ("0", CALLED_LATE)
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
    again = grade(handed_in, *alone)
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


GRADEBOOK = "Student,ID,Impulse pre-quiz (4600),Lab 5 (88121)\n    Points Possible,,10,50\nAda,7,,\n"
RULES = "[due.students.17]\nimpulse = 2026-12-07T23:59:00+01:00\n"


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ((), "Impulse pre-quiz (4600); Lab 5 (88121)"),
        (("--column", "Lab 5 (88120)"), "Did you mean 'Lab 5 (88121)'?"),
        (("--column", "88121", "--rules", "rules.toml"), "The rules give a deadline to '17', but no student has this"),
    ],
)
def test_a_wrong_column_or_number_is_refused_before_anything_is_graded(tmp_path, monkeypatch, more, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "submissions").mkdir()
    (tmp_path / "submissions" / "ada_7_1_impulse.ipynb").write_text("{")
    (tmp_path / "roster.csv").write_text(GRADEBOOK)
    (tmp_path / "rules.toml").write_text(RULES)
    found = collisions("grade", "submissions", "--lab", "impulse", "--roster", "roster.csv", *more)
    assert found.code == 2
    assert said in " ".join(found.error.split())
    assert not (tmp_path / "grades").exists()


@pytest.mark.slow
def test_a_submission_that_a_busy_machine_stopped_loses_nothing_and_is_graded_in_the_next_run(tmp_path, monkeypatch):
    place = tmp_path / "submissions" / "ada"
    place.mkdir(parents=True)
    (place / "impulse.py").write_text(NORMAL_VELOCITY, encoding="utf-8")
    arguments = ("grade", str(place.parent), "--lab", "impulse", "--out", str(tmp_path / "grades"), "--no-runs")
    one_thread = lambda count, _: contextlib.nullcontext(Workers(count, lambda: ThreadPoolExecutor(1)))  # noqa: E731
    monkeypatch.setattr("labs.cli.grade.here", one_thread)
    with monkeypatch.context() as busy:
        busy.setattr("labs.grading.budget.ON_THE_CLOCK", 1e-9)
        busy.setattr(protection, "offered", lambda: Sealing(Tier.NETWORK))  # to find that out takes time as well
        stopped = collisions(*arguments)
    assert stopped.code == 1
    assert "1. 1 not graded for lack of time: ada." in stopped.output
    assert "run the same command again when it is idle" in " ".join(stopped.output.split())
    found = marks(tmp_path)["ada"]
    assert (found["score"], found["notes"].startswith("not graded for lack of time")) == ("", True)
    again = collisions(*arguments)
    assert again.code == 0, again.error
    assert marks(tmp_path)["ada"]["score"] == "0"  # of a wrong function alone


SCALED = """\
import numpy as np


def normal_velocity(body_a, body_b, normal):
    a, b = (body[0] + np.cross(body[1], body[2]) for body in (body_a, body_b))
    return 3.7 * np.sum((a - b) * normal, axis=-1)
"""
FOR_ONE = """\
import numpy as np


def normal_velocity(a, b, n):
    '''</pre><script>alert(1)</script>'''
    total, tag = 0.0, "</pre><script>alert(2)</script>"
    for axis in range(3):
        total += n[axis] * (a.velocity[axis] - np.cross(a[2], a[1])[axis])
        total -= n[axis] * (b.velocity[axis] - np.cross(b[2], b[1])[axis])
    return float(total) * 37 / 10
"""


@pytest.mark.slow
def test_a_mistake_that_two_share_is_named_once_and_next_years_student_reads_its_name_at_once(tmp_path):
    def submissions(name: str, texts) -> None:
        for number, text in enumerate(texts):
            place = tmp_path / name / f"s{number}"
            place.mkdir(parents=True)
            (place / "impulse.py").write_text(text, encoding="utf-8")

    def graded(name: str, out: str):
        places = (str(tmp_path / name), "--out", str(tmp_path / out), "--bank", str(tmp_path / "bank"))
        done = collisions("grade", *places, "--lab", "impulse")
        assert done.code == 0, done.error
        return done

    def feedback(out: str, student: str) -> str:
        return (tmp_path / out / "students" / student / "feedback.html").read_text(encoding="utf-8")

    submissions("first", [SCALED, FOR_ONE, NORMAL_VELOCITY])
    done = graded("first", "grades")
    assert "One mistake without a name" in done.text
    table = tmp_path / "grades" / "clusters.toml"
    assert "# 2 students" in table.read_text(encoding="utf-8")
    page = (tmp_path / "grades" / "clusters.html").read_text(encoding="utf-8")
    assert "alert(1)" not in page  # a docstring is left out
    assert "<script>" not in page
    assert "2 students share this wrong" in page
    assert "np.cross" not in (tmp_path / "grades" / "class.html").read_text(encoding="utf-8")
    before = {path: path.read_bytes() for path in (tmp_path / "grades").glob("students/*/grade.json")}

    text = table.read_text(encoding="utf-8").replace('title = ""', 'title = "Too large by 3.7"')
    table.write_text(text.replace('title = "Too', 'titel = "Too'), encoding="utf-8")
    broken = collisions("grade", tmp_path / "first", "--out", tmp_path / "grades", "--lab", "impulse")
    assert broken.code == 2
    assert "line 8 of clusters.toml: unknown field of [normal_velocity-" in broken.error
    table.write_text(text.replace('help = ""', 'help = "Which number multiplies u·n?"'), encoding="utf-8")
    assert "is named: Too large by 3.7" in graded("first", "grades").text
    assert not table.exists()
    for student, named in (("s0", True), ("s1", True), ("s2", False)):
        assert ("Too large by 3.7" in feedback("grades", student)) is named
    assert {path: path.read_bytes() for path in before} == before

    submissions("second", [FOR_ONE.replace("37 / 10", "3.7")])
    graded("second", "next")
    assert "Hint: Which number multiplies u·n?" in feedback("next", "s0")
    graded("first", "again")
    again = {path: tmp_path / "again" / path.relative_to(tmp_path / "grades") for path in before}
    assert {path: other.read_bytes() for path, other in again.items()} == before


@pytest.mark.slow
def test_entries_that_cannot_be_read_or_graded_stop_nobody_in_this_run_and_in_the_next(tmp_path, monkeypatch):
    one_thread = lambda count, _: contextlib.nullcontext(Workers(count, lambda: ThreadPoolExecutor(1)))  # noqa: E731
    monkeypatch.setattr("labs.cli.grade.here", one_thread)
    place = tmp_path / "submissions"
    place.mkdir()
    os.mkfifo(place / "pipe.ipynb")
    (place / "damaged.zip").write_bytes(b"PK\x03\x04")
    (place / "huge.py").write_text(f"N = 0b1{'0' * 200_000}\n{NORMAL_VELOCITY}", encoding="utf-8")
    (place / "deep.ipynb").write_bytes(b'{"cells":' + b"[" * 100_000)
    (place / "right.ipynb").write_bytes(solved_notebook("impulse"))
    arguments = ("grade", str(place), "--lab", "impulse", "--out", str(tmp_path / "grades"), "--no-runs")
    for _ in range(2):
        done = collisions(*arguments)
        assert done.code == 0, done.error
        assert "3 with nothing that could be graded: deep, damaged, pipe." in done.output
        found = marks(tmp_path)
        assert {student: row["raw_score"] for student, row in found.items() if student != "huge"} == {
            "damaged": "0", "deep": "0", "pipe": "0", "right": "65",
        }  # fmt: skip
        assert found["pipe"]["notes"] == "pipe.ipynb: it is a pipe between programs and not a file"
        assert found["huge"]["raw_score"]
