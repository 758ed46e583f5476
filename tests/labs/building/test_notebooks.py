"""Every notebook runs from top to bottom: solved with engines, and untouched, as a student gets it, without any."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from submissions import solved_notebook

from labs.building import lessons
from labs.building.release import release
from labs.grading.submission.reading import DRAFT

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
CELL_LIMIT = 240  # s; a cell takes a few seconds, and several times that beside other tests
TOPICS = lessons.lessons()
REFUSED = r"^lab\.\w+: "
"""How the line begins that a refused call prints."""


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """What a student gets, in a folder whose name has spaces."""
    folder = tmp_path_factory.mktemp("release") / "my course, 2. term"
    release(folder)
    return folder


@pytest.fixture
def without_engines(tmp_path, monkeypatch):
    """A kernel that finds no engine."""
    for name in ("pybullet", "mujoco", "dartpy"):
        (tmp_path / f"{name}.py").write_text("raise ImportError('not today')\n", encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))


def executed(path: Path, folder: Path):
    import nbformat  # noqa: PLC0415 - with all of Jupyter behind it, which only these slow tests need
    from nbclient import NotebookClient  # noqa: PLC0415

    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    client = NotebookClient(notebook, timeout=CELL_LIMIT, resources={"metadata": {"path": str(folder)}})
    client.execute()  # raises where a cell ends in an error
    return notebook


def printed(cells) -> str:
    return "\n".join(_texts(cells))


def _texts(cells) -> list[str]:
    outputs = [output for cell in cells if cell.cell_type == "code" for output in cell.outputs]
    return [output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs]


def of_the_student(cells) -> str:
    """What is printed, without tables of stock engines alone: these may be far from theory, as the lesson says."""
    return "\n".join(text for text in _texts(cells) if not re.match(r"\[replay: [^]]*, stock\]", text))


def without_drafts(cells):
    """The cells without those in which a first version of a function runs, which may be wrong on purpose."""
    tags = ["".join(cell.metadata.get("tags", [])) for cell in cells]
    drafts = [place for place, tag in enumerate(tags) if tag.startswith(DRAFT)]
    if not drafts:
        return cells
    return cells[: drafts[0]] + cells[tags.index(tags[drafts[0]].removeprefix(DRAFT)) :]


@pytest.mark.parametrize("topic", TOPICS)
def test_the_solved_notebook_passes_every_check(topic, tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")]))
    path = tmp_path / f"{topic}.ipynb"
    path.write_bytes(solved_notebook(topic))
    cells = executed(path, tmp_path).cells
    said = printed(cells)
    assert "✗" not in of_the_student(without_drafts(cells)).replace("✗ fail", "")
    assert "its results come from recordings" not in said
    assert not re.search(r"· \w+ +to do", said)
    assert not re.search(REFUSED, said, re.MULTILINE)
    # Where a lab's loops are in the lesson, its first runs beside engines come after their functions; those of the
    # world come after its drafts.
    if topic not in ("polyhedra", "sweeping", "meshes", "avoidance", "world"):
        assert "Your implementation waits for" in said
        assert "you predicted" in said  # beside what came
    assert "functions right. Hidden tests" in said
    assert "You predict" in said
    assert "Put your guess" not in said


@pytest.mark.parametrize("topic", TOPICS)
def test_a_notebook_of_untouched_stubs_runs_to_its_end(topic, course, without_engines):
    said = printed(executed(course / "labs" / "notebooks" / f"{topic}.ipynb", course / "labs" / "notebooks").cells)
    assert "to do" in said
    assert "✓ signed" not in said
    assert "its results come from recordings" in said
    assert not re.search(REFUSED, said, re.MULTILINE)
