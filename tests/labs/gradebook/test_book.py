"""Grades of a class in a folder: each once, whole or not at all, whatever stops the run."""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace

import pytest

from labs.gradebook import class_run
from labs.gradebook.book import Book
from labs.gradebook.class_run import Failures, run
from labs.gradebook.grading import Graded, Task, identity
from labs.grading.errors import GraderFailed, MachineBusy
from labs.grading.judging.grade import SCHEMA, VERSION, read_grade
from labs.workers import Workers
from reference.errors import InvalidInput

TASK = Task("4711", "Ada", "impulse", "ada", "impulse.ipynb", b"x = 1", "week 3", 60.0)


def graded(task: Task, points: float = 1.0) -> Graded:
    content = {"schema": SCHEMA, "version": VERSION, "identity": identity(task), "points": points}
    return Graded(task.student, content, {"seconds": 1.0})


@pytest.fixture
def book(tmp_path):
    return Book(tmp_path / "grades")


def test_a_grade_is_done_while_file_release_and_lab_stay_the_same(book):
    assert not book.is_done(TASK)
    book.keep(graded(TASK))
    assert book.is_done(TASK)
    for changed in (
        replace(TASK, content=b"x = 2"),
        replace(TASK, release="week 4"),
        replace(TASK, lab="detection"),
        replace(TASK, seconds=30.0),
        replace(TASK, student="4712"),
    ):
        assert not book.is_done(changed)


def test_grades_are_for_their_owner_alone_and_equal_byte_for_byte(book):
    book.keep(graded(TASK))
    path = book.place("4711") / "grade.json"
    first = path.read_bytes()
    assert path.stat().st_mode & 0o777 == 0o600
    assert path.parent.stat().st_mode & 0o777 == 0o700
    book.keep(graded(TASK))
    assert path.read_bytes() == first


@pytest.mark.parametrize("student", ["../../etc", "=cmd|x", "", ".", "a/b", "Zoë", "x" * 300, "a\nb", "nul\x00"])
def test_a_hostile_name_gets_a_folder_of_its_own_below_the_students(book, student):
    place = book.place(student)
    assert place.parent == book.folder / "students"
    assert place.name not in ("", ".", "..")
    assert place != book.place(student + " ")
    place.mkdir(parents=True)


def test_half_a_character_in_an_answer_stops_nobodys_grade(book):
    half = graded(TASK)
    half.content["answers"] = {"third-law": "half \ud800 of one"}
    book.keep(replace(half, code="# \ud800\n"))
    assert book.grade_of("4711")["answers"] == {"third-law": "half \ud800 of one"}


def test_half_a_grade_is_no_grade(book):
    book.keep(graded(TASK))
    path = book.place("4711") / "grade.json"
    path.write_text(path.read_text()[:20])
    assert book.grade_of("4711") is None
    assert not book.is_done(TASK)


def test_a_full_disk_leaves_the_last_good_grade(book, monkeypatch):
    book.keep(graded(TASK))

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        book.keep(graded(replace(TASK, content=b"x = 2"), 2.0))
    assert book.grade_of("4711")["points"] == 1.0
    assert sorted(each.name for each in book.place("4711").iterdir()) == ["grade.json", "measured.json"]


def test_the_grade_of_a_student_who_hands_in_nothing_any_more_is_put_away(book):
    for student in ("4711", "4712"):
        book.keep(graded(replace(TASK, student=student)))
    book.keep(graded(replace(TASK, student="4713", lab="detection")))
    assert book.withdraw_others(["4711"], "impulse") == ["4712"]
    assert read_grade(book.folder / "withdrawn" / "4712" / "grade.json")["points"] == 1.0
    assert book.grade_of("4711") is not None
    assert book.grade_of("4712") is None
    assert book.grade_of("4713") is not None


def test_two_graders_on_one_folder_do_not_meet(book):
    with book.alone(), pytest.raises(InvalidInput, match="somebody else is grading into"), book.alone():
        pass
    with book.alone():
        pass


UNEXPECTED = {
    "value": ValueError("Exceeds the limit (4300 digits) for integer string conversion"),
    "memory": MemoryError(),
    "deep": RecursionError("maximum recursion depth exceeded"),
    "exit": SystemExit(3),
    "two lines": OSError(5, "Input/output\nerror"),
}
"""What nobody expects of the grading of a submission, by the student's number."""


def _by_name(task: Task) -> Graded:
    """Instead of grading: dies, fails or grades, as the student's number says."""
    if task.student.startswith("dies"):
        os.kill(os.getpid(), signal.SIGKILL)
    if task.student.startswith("fails"):
        raise GraderFailed("no process could be started")
    if task.student.startswith("in line"):
        raise MachineBusy
    if task.student in UNEXPECTED:
        raise UNEXPECTED[task.student]
    while task.student.startswith("has no end"):
        time.sleep(0.1)
    return graded(task)


@pytest.fixture
def pool(monkeypatch):
    """Worker processes that do as the student's number says."""
    monkeypatch.setattr(class_run, "grade_one", _by_name)
    return lambda: ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("fork"))


def test_a_worker_that_dies_costs_its_own_submission_alone(book, pool):
    students = [f"{number}" for number in range(20)]
    students[7:7] = ["dies", "fails", "in line"]
    failures = Failures()
    run((replace(TASK, student=each) for each in students), Workers(2, pool), book.keep, failures)
    assert failures.said == {
        "dies": "it could not be graded: the process that graded it died twice",
        "fails": "no process could be started",
        "in line": str(MachineBusy()),
    }
    assert failures.busy == {"in line"}
    assert {each for each in students if book.grade_of(each)} == {*students} - failures.said.keys()


def test_what_the_grading_of_a_submission_raises_stops_no_other(book, pool):
    students = ["1", *UNEXPECTED, "2", "3"]
    failures = Failures()
    run((replace(TASK, student=each) for each in students), Workers(2, pool), book.keep, failures)
    assert failures.said == {
        "value": "it could not be graded: ValueError: Exceeds the limit (4300 digits) for integer string conversion",
        "memory": "it could not be graded: MemoryError",
        "deep": "it could not be graded: RecursionError: maximum recursion depth exceeded",
        "exit": "it could not be graded: SystemExit: 3",
        "two lines": "it could not be graded: OSError: [Errno 5] Input/output error",
    }
    assert not failures.busy
    assert {each for each in students if book.grade_of(each)} == {"1", "2", "3"}


def test_a_full_disk_stops_the_run_and_blames_no_submission(book, pool):
    def full(_):
        raise OSError(28, "No space left on device")

    failures = Failures()
    with pytest.raises(OSError, match="No space"):
        run([replace(TASK, student=each) for each in "123"], Workers(1, pool), full, failures)
    assert failures.said == {}


def test_a_grade_that_cannot_be_written_stops_no_other(book, pool):
    def keep(each):
        if each.student == "2":
            raise ValueError("Out of range float values are not JSON compliant")
        book.keep(each)

    failures = Failures()
    run([replace(TASK, student=each) for each in "123"], Workers(1, pool), keep, failures)
    assert failures.said.keys() == {"2"}
    assert "Out of range float values" in failures.said["2"]
    assert book.grade_of("3") is not None


@pytest.mark.slow
def test_a_submission_without_an_end_is_stopped_and_the_others_are_graded(book, pool, monkeypatch):
    monkeypatch.setattr(class_run, "_PATIENCE", 1.0)
    monkeypatch.setattr(class_run, "_LEAST_PATIENCE", 0.0)

    def stop():
        for process in multiprocessing.active_children():
            process.kill()

    students = ["1", "has no end", "2", "has no end either", "3", "4", "5"]
    failures = Failures()
    tasks = (replace(TASK, student=each, seconds=1.0) for each in students)
    run(tasks, Workers(2, pool, stop), book.keep, failures)
    assert failures.said.keys() == {"has no end", "has no end either"}
    assert set(failures.said.values()) == {"it could not be graded: it was stopped after 0 minutes"}
    assert {each for each in students if book.grade_of(each)} == {"1", "2", "3", "4", "5"}


def test_no_more_submissions_are_read_than_the_workers_can_soon_take(monkeypatch):
    read, kept = [], []
    monkeypatch.setattr(class_run, "grade_one", graded)

    def every():
        for number in range(50):
            read.append(number)
            assert len(read) - len(kept) <= 5
            yield replace(TASK, student=str(number))

    run(every(), Workers(2, lambda: ThreadPoolExecutor(2)), kept.append, Failures())
    assert len({each.student for each in kept}) == len(kept) == 50


def test_an_interruption_ends_the_run_and_keeps_what_was_graded(monkeypatch, book):
    monkeypatch.setattr(class_run, "grade_one", graded)

    def stop_after_three(each):
        book.keep(each)
        if len(list(book.folder.glob("students/*"))) == 3:
            raise KeyboardInterrupt

    tasks = [replace(TASK, student=str(number)) for number in range(20)]
    with pytest.raises(KeyboardInterrupt):
        run(iter(tasks), Workers(1, lambda: ThreadPoolExecutor(1)), stop_after_three, Failures())
    assert sum(book.is_done(each) for each in tasks) == 3
    for path in book.folder.glob("students/*/grade.json"):
        assert json.loads(path.read_text())["points"] == 1.0
