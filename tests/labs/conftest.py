"""The desk of a notebook, with cells in the place of a kernel's."""

from __future__ import annotations

import pytest

from labs import notebook
from labs.desk import student_code
from reference.engines import engine_names, load_engine
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


@pytest.fixture
def no_engine(tmp_path_factory, monkeypatch):
    """None can be imported, neither here nor in a worker."""

    def forget() -> None:
        stop_workers()  # those that are idle have imported them already
        absent.cache_clear()

    folder = tmp_path_factory.mktemp("blocked")
    for package in filter(None, (load_engine(name).package for name in engine_names())):
        (folder / f"{package}.py").write_text("raise ImportError('not today')\n", encoding="utf-8")
    monkeypatch.syspath_prepend(str(folder))
    forget()
    yield
    forget()
