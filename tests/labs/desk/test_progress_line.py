"""The line that says what is being done: it comes, it goes, and whatever happens to it hurts nothing else."""

from __future__ import annotations

import threading
import time

import pytest

from labs.desk import progress_line
from labs.desk.progress_line import Progress
from labs.grading.judging import pytest_run

RIGHT = """import numpy as np

def signed_distance(point, normal, offset):
    return (np.vecdot(point, normal) + offset) / np.linalg.norm(normal, axis=-1)
"""


class Lines:
    """A line that remembers. broken: it cannot be shown, as where a kernel warns and warnings are errors."""

    def __init__(self, broken: bool = False) -> None:
        self.said: list[str] = []
        self.broken = broken

    def write(self, text: str) -> None:
        self.said.append(text)
        if self.broken and text:
            raise DeprecationWarning("utcnow")


@pytest.fixture
def line(monkeypatch):
    """Put a line where a terminal's would be, and speak soon."""
    monkeypatch.setattr(progress_line, "_AFTER", 0.02)
    monkeypatch.setattr(progress_line, "_EVERY", 0.02)

    def put(broken: bool = False) -> Lines:
        lines = Lines(broken)
        monkeypatch.setattr(progress_line, "_TerminalLine", lambda: lines)
        return lines

    return put


def spoken(lines: Lines, count: int) -> None:
    end = time.monotonic() + 10
    while len(lines.said) < count:
        assert time.monotonic() < end
        time.sleep(0.01)


def test_the_progress_line_counts_runs_and_disappears_at_the_end(line):
    lines = line()
    with Progress("running", 3) as told:
        spoken(lines, 1)
        told.done(2, 3, "MuJoCo")
        spoken(lines, len(lines.said) + 2)
    assert lines.said[0].startswith("running: 0 of 3")
    assert lines.said[-2].startswith("running: 2 of 3, MuJoCo")
    assert lines.said[-1] == ""


def test_a_progress_line_that_cannot_be_shown_stops_nothing(line, monkeypatch):
    lost = []
    monkeypatch.setattr(threading, "excepthook", lost.append)
    lines = line(broken=True)
    with Progress("running"):
        spoken(lines, 2)
    assert lost == []


def test_a_failing_thread_of_the_kernel_costs_no_mark(monkeypatch, tmp_path):
    monkeypatch.setattr(threading, "excepthook", lambda _: None)
    (tmp_path / "lab.py").write_text(RIGHT, encoding="utf-8")
    over = threading.Event()

    def stumble() -> None:
        raise DeprecationWarning("utcnow")

    def others() -> None:
        while not over.wait(0.02):
            threading.Thread(target=stumble).start()

    beside = threading.Thread(target=others)
    beside.start()
    try:
        sheet = pytest_run.run(tmp_path / "lab.py", ["detection"], [pytest_run.VISIBLE], functions=["signed_distance"])
    finally:
        over.set()
        beside.join()
    assert [outcome.passed for outcome in sheet.outcomes] == [True]
