"""A class whose grading is stopped by Ctrl-C, a kill or an edited test: nothing is left behind, and nothing is lost."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from program import collisions

from labs.cli import grade as command
from labs.gradebook import grading
from labs.gradebook.book import Book
from labs.project_folders import ROOT
from labs.workers import here
from reference.errors import InvalidInput

ENOUGH = 200.0  # s: two Pythons with NumPy start in two, and took 50 with a twentieth of a processor
PROMPTLY = 60.0  # s: on a busy machine; an idle one takes less than one, and without an end it would be for ever
SCRIPT = """
import os, signal, sys, tempfile, time
from dataclasses import replace
from pathlib import Path
from labs.gradebook import class_run
from labs.gradebook.book import Book
from labs.gradebook.class_run import Failures, run
from labs.gradebook.grading import Graded, Task, identity
from labs.grading.judging.grade import SCHEMA, VERSION
from labs.workers import here

signal.signal(signal.SIGINT, signal.default_int_handler)  # which a job in a shell's background inherits as ignored
place = Path({place!r})
TASK = Task("", "", "impulse", "", "impulse.py", b"", "", 60.0)

def work(task):
    tempfile.mkdtemp()
    (place / f"{{os.getpid()}}.{{task.student}}").touch()
    while task.student == "long":
        time.sleep(1)
    content = {{"schema": SCHEMA, "version": VERSION, "identity": identity(task)}}
    return Graded(task.student, content, {{}})

if __name__ == "__main__":
    class_run.grade_one = work
    with here(2, place / "working") as workers:
        tasks = [replace(TASK, student=each) for each in ("quick", "long", "long")]
        try:
            run(iter(tasks), workers, Book(place / "grades").keep, Failures(), lambda: print("Stopping", flush=True))
        except KeyboardInterrupt:
            sys.exit(130)
"""
pytestmark = pytest.mark.skipif(os.name != "posix", reason="a class is graded on Linux or a Mac")


def _workers(place: Path, student: str) -> set[int]:
    return {int(each.stem) for each in place.glob(f"*.{student}")}


def _is_there(process: int) -> bool:
    state = subprocess.run(["ps", "-o", "stat=", "-p", str(process)], capture_output=True, text=True, check=False)
    return bool(state.stdout.strip()) and not state.stdout.strip().startswith("Z")


def _wait(until: float, holds) -> bool:
    end = time.monotonic() + until
    while not holds() and time.monotonic() < end:
        time.sleep(0.02)
    return bool(holds())


@contextmanager
def running(place: Path) -> Iterator[subprocess.Popen[str]]:
    """A run of a class of which one submission is graded, and two workers grade one that takes for ever."""
    script = place / "script.py"
    script.write_text(SCRIPT.format(place=str(place)))
    packages = os.pathsep.join([str(ROOT), *filter(None, sys.path)])
    environment = {**os.environ, "PYTHONPATH": packages}
    program = subprocess.Popen(
        [sys.executable, script], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True,
    )  # fmt: skip
    try:
        assert _wait(ENOUGH, lambda: len(_workers(place, "long")) == 2 and Book(place / "grades").grade_of("quick"))
        yield program
    finally:
        program.kill()
        program.communicate()


@pytest.mark.slow
def test_workers_end_with_a_command_that_is_killed_and_the_next_run_clears_up(tmp_path):
    with running(tmp_path) as program:
        program.kill()
        program.wait()
        assert _wait(PROMPTLY, lambda: not any(map(_is_there, _workers(tmp_path, "long"))))
    assert any((tmp_path / "working").iterdir()), "what the workers had in hand lies there, and not in /tmp"
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "working" / "link").symlink_to(elsewhere, target_is_directory=True)
    (elsewhere / "kept").touch()
    with here(1, tmp_path / "working"):
        assert not any((tmp_path / "working").iterdir())
    assert (elsewhere / "kept").exists()
    assert not (tmp_path / "working").exists()


@pytest.mark.slow
def test_an_interrupt_stops_a_class_at_once_and_keeps_what_is_finished(tmp_path):
    with running(tmp_path) as program:
        began = time.monotonic()
        os.killpg(program.pid, signal.SIGINT)  # as a terminal does: to the command and to all its workers
        said, errors = program.communicate(timeout=ENOUGH)
        assert time.monotonic() - began < PROMPTLY
    assert (program.returncode, said, errors) == (130, "Stopping\n", "")
    assert not any(map(_is_there, _workers(tmp_path, "long")))
    assert Book(tmp_path / "grades").grade_of("quick")
    assert not (tmp_path / "working").exists()


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (KeyboardInterrupt(), 130, "Interrupted."),
        (OSError(errno.ENOSPC, "No space left on device"), 3, "Error: cannot write the grades to "),
    ],
    ids=["interrupt", "full disk"],
)
def test_a_class_that_is_broken_off_says_how_to_continue(error, code, line, tmp_path, monkeypatch):
    (tmp_path / "submissions" / "ada").mkdir(parents=True)
    (tmp_path / "submissions" / "ada" / "impulse.py").write_text("x = 1\n")

    def interrupted(every, graders, keep, failures, stopping):
        stopping()
        raise error

    monkeypatch.setattr(command, "run", interrupted)
    done = collisions("grade", str(tmp_path / "submissions"), "--lab", "impulse", "--out", str(tmp_path / "grades"))
    assert (done.code, line in done.error) == (code, True)
    assert "Stopping; what is being written is finished …" in done.error
    assert "0 of 1 submissions have a grade, and all of these are kept. Run the same command again" in done.error


BEFORE = {"collisions-lab": "1", "python": "3.11", "numpy": "2.4", "tests": "a" * 64, "known mistakes": "b" * 64}


@pytest.mark.parametrize(
    ("now", "worker", "words"),
    [
        ({"tests": "c"}, {"tests": "c"}, r"^the tests of impulse were changed while the class was being graded"),
        ({"tests": "c", "known mistakes": "d"}, {"tests": "c"}, r"^the tests and the known mistakes of impulse were"),
        ({}, {"numpy": "2.3"}, r"^a worker has other versions than this machine: numpy 2.3. Install the same"),
        ({}, {"tests": "c" * 64}, r"^a worker has other versions than this machine: the tests cccccccccccc."),
    ],
)
def test_a_grade_of_other_versions_is_refused_and_the_reason_named(now, worker, words, monkeypatch):
    monkeypatch.setattr(grading, "versions", lambda lab: BEFORE | now)
    grading.refuse_other_versions(BEFORE, BEFORE, "impulse")
    with pytest.raises(InvalidInput, match=words) as refused:
        grading.refuse_other_versions(BEFORE, BEFORE | worker, "impulse")
    assert "run the same command again" in str(refused.value)
