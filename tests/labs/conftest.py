"""What tests of the labs share: the desk of a notebook, a grader, one worker, and a machine without engines."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from labs import notebook
from labs.desk import student_code
from labs.grading.calling.remote import Grader
from labs.grading.judging import pytest_run
from reference.engines import distributions, engine_names, load_engine
from reference.running.availability import absent
from reference.running.isolate import stop_workers


@pytest.fixture
def cells():
    """What the kernel has run."""
    return []


@pytest.fixture
def lab(cells, monkeypatch, tmp_path):
    """A desk of the detection lab; `lab.shown` is what it has displayed."""
    monkeypatch.setattr(student_code, "executed_cells", lambda: student_code.without_corrected(cells))
    monkeypatch.chdir(tmp_path)
    desk = notebook.Lab()
    desk.topic = "detection"
    shown = []
    monkeypatch.setattr(notebook, "_display", lambda *each: shown.extend(each))
    desk.shown = shown
    yield desk
    if desk._grader is not None:
        desk._grader.close()


@pytest.fixture(scope="session")
def grader() -> Iterator[Grader]:
    """A grader that all tests of a worker share: starting one takes longer than most checks."""
    with Grader() as found:
        yield found


@pytest.fixture
def one_grader(grader, monkeypatch) -> None:
    """Let whatever is checked or graded during a test use the shared grader, which stays open."""
    monkeypatch.setattr(pytest_run, "Grader", lambda: contextlib.nullcontext(grader))


@pytest.fixture
def one_worker(monkeypatch) -> None:
    """Let one worker process do all runs: a second one takes longer to start than the runs of a test take."""
    monkeypatch.setattr(os, "cpu_count", lambda: 1)


@contextlib.contextmanager
def engines_missing(folder: Path) -> Iterator[None]:
    """Let none be imported, neither here nor in a worker, nor its version be known here."""
    packages = [package for name in engine_names() if (package := load_engine(name).package)]

    def forget() -> None:
        stop_workers()  # those that are idle have imported them already
        absent.cache_clear()

    for package in packages:
        (folder / f"{package}.py").write_text(f"raise ModuleNotFoundError('not today', name={package!r})\n", "utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(folder))
        patch.setattr(distributions, "is_here", lambda module: False)
        forget()
        yield
    forget()


@pytest.fixture
def no_engine(tmp_path_factory):
    """No engine can be imported during this test."""
    with engines_missing(tmp_path_factory.mktemp("blocked")):
        yield


@pytest.fixture(scope="module")
def no_engine_here(tmp_path_factory):
    """No engine can be imported during any test of this file, all of which share their workers."""
    with engines_missing(tmp_path_factory.mktemp("blocked")):
        yield
