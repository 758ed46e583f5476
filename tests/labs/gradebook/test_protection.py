"""Where files are not protected: a class is refused, the switch is passed on, and everybody is told."""

from __future__ import annotations

import csv
import io
import shlex

import pytest
from program import collisions
from submissions import notebook

from labs.gradebook import grading, protection
from labs.gradebook.book import Book
from labs.gradebook.grading import Graded, Task, identity
from labs.gradebook.pages import class_page
from labs.gradebook.platforms import submitted
from labs.gradebook.roster import Student
from labs.gradebook.tables import Mark, plain_table
from labs.grading.judging.grade import SCHEMA, VERSION
from labs.grading.worker.sandbox import Sealing
from labs.grading.worker.tier import Tier
from reference.errors import InvalidInput

NEEDED = {"marks": {}, "tests": [], "functions": [], "points": 1.0}
ALONE = "ran without protection of files"


def of(tier: Tier) -> dict[str, object]:
    return {**NEEDED, "tier": tier.title}


@pytest.mark.parametrize("tier", Tier)
def test_a_class_is_refused_exactly_where_files_are_open(tier, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if tier >= Tier.FILES:
        protection.refuse_open_files(Sealing(tier), tmp_path / "handed in", "impulse", tmp_path / "grades")
        return
    with pytest.raises(InvalidInput) as refused:
        protection.refuse_open_files(Sealing(tier, ("no sandbox",)), tmp_path / "handed in", "impulse", tmp_path / "g")
    said = str(refused.value)
    assert "(no sandbox)" in said
    assert "--unsandboxed" in said
    command = next(line for line in said.splitlines() if line.startswith("  docker run "))
    assert shlex.split(command)[-1].endswith("&& collisions grade 'handed in' --lab impulse --out g")
    assert f"{tmp_path}:/course" in shlex.split(command)


def test_the_command_refuses_before_it_writes_anything_unless_it_is_told_to(tmp_path, monkeypatch):
    (tmp_path / "class").mkdir()
    (tmp_path / "class" / "ada.ipynb").write_bytes(notebook("pass"))
    monkeypatch.setattr(protection, "offered", lambda: Sealing(Tier.PROCESS, ("no sandbox on a Mac",)))
    tried: list[Task] = []

    def stop(book, found, every, *_):
        tried.extend(every)
        raise InvalidInput("enough")

    monkeypatch.setattr("labs.cli.grade._grade_all", stop)
    command = ("grade", str(tmp_path / "class"), "--lab", "impulse", "--out", str(tmp_path / "grades"))
    refused = collisions(*command)
    assert refused.code == InvalidInput.exit_code
    assert "no sandbox on a Mac" in " ".join(refused.error.split())
    assert not (tmp_path / "grades").exists()
    assert not tried
    assert "enough" in collisions(*command, "--unsandboxed").error
    assert [task.unsandboxed for task in tried] == [True]


def test_without_the_switch_no_worker_grades_where_files_are_open(monkeypatch):
    made = []
    monkeypatch.setattr(grading, "Grader", lambda limits, least: made.append(least))
    monkeypatch.setattr(grading.atexit, "register", lambda _: None)
    for unsandboxed in (False, True):
        with pytest.raises(AttributeError):  # it is no grader
            grading._grader.__wrapped__(unsandboxed)
    assert made == [Tier.FILES, Tier.PROCESS]


def test_a_platforms_container_passes_the_switch(tmp_path, monkeypatch):
    seen: list[Task] = []
    (tmp_path / "impulse.ipynb").write_bytes(notebook("def f(): pass"))
    monkeypatch.setattr(submitted, "grade_one", lambda task: seen.append(task) or Graded("", {}, {}))
    submitted.graded_folder(tmp_path, "impulse", "4711")
    assert [task.unsandboxed for task in seen] == [True]


def test_a_grade_without_protection_is_made_again_where_there_is_some(tmp_path):
    def task(unsandboxed: bool) -> Task:
        return Task("4711", "Ada", "impulse", "ada", "a.py", b"", "", 60.0, unsandboxed=unsandboxed)

    book = Book(tmp_path)
    content = {"schema": SCHEMA, "version": VERSION, "identity": identity(task(False))}
    book.keep(Graded("4711", {**content, **of(Tier.PROCESS)}, {}))
    assert [book.is_done(task(each)) for each in (False, True)] == [False, True]
    book.keep(Graded("4711", {**content, **of(Tier.NETWORK)}, {}))
    assert [book.is_done(task(each)) for each in (False, True)] == [True, True]


def test_the_protection_of_a_class_is_said_in_its_table_and_on_its_page():
    assert protection.in_words([]) == protection.in_words([{"unreadable": "it is empty"}]) == ""
    assert protection.in_words([of(Tier.NETWORK)] * 2) == "Every submission ran shut in: files and network sealed."
    some = [of(Tier.NETWORK), of(Tier.LIMITS), of(Tier.PROCESS), {"unreadable": "it is empty"}]
    assert f"2 of 3 submissions {ALONE}" in protection.in_words(some)
    marks = [Mark(Student(str(at)), "impulse", 1.0, content=each) for at, each in enumerate(some)]
    marks.append(Mark(Student("9"), "impulse", None))
    rows = list(csv.DictReader(io.StringIO(plain_table(marks))))
    assert [row["protection"] for row in rows] == [*(str(each.get("tier", "")) for each in some), ""]
    assert ALONE in class_page("impulse", marks, {})
    assert ALONE not in class_page("impulse", marks[:1], {})
