"""The desk of a notebook, with cells in the place of a kernel's."""

from __future__ import annotations

import pytest

from labs import notebook
from labs.desk import hand


@pytest.fixture
def cells():
    """What the kernel has run."""
    return []


@pytest.fixture
def lab(cells, monkeypatch, tmp_path):
    """A desk of the detection lab; `lab.shown` is what it has displayed."""
    monkeypatch.setattr(hand, "executed_cells", lambda: hand.without_mended(cells))
    monkeypatch.chdir(tmp_path)
    desk = notebook.Lab()
    desk.topic = "detection"
    shown = []
    monkeypatch.setattr(notebook, "_display", lambda *each: shown.extend(each))
    desk.shown = shown
    yield desk
    if desk._grader is not None:
        desk._grader.close()
