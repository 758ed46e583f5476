"""What a submission can use where its process cannot open Python's own files, and what is said where it cannot."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from labs.grading.calling import worker_files
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import GraderFailed
from labs.grading.judging.grade import grade
from labs.grading.submission.reading import Submission

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere files stay open")
ROOT = Path(__file__).parents[4]
GREEK = "def rebound_velocity(u, ε):\n    return -ε * u if u < 0 else u\n"
RIGHT = {
    "a Greek letter": GREEK,
    "a letter by its name": "def rebound_velocity(u, e): return -e * u if '\\N{GREEK SMALL LETTER EPSILON}' else 0",
    "all of NumPy": "from numpy import *\ndef rebound_velocity(u, e): return float(where(u < 0, -e * u, u))",
    "a part of NumPy that is loaded late": (
        "import numpy as np\ndef rebound_velocity(u, e):\n    np.testing.assert_allclose(u, u)\n"
        "    return float(np.ma.array([-e * u]).sum())"
    ),
    "the library": (
        "import decimal, string, textwrap\nimport xml.etree.ElementTree as tree\nfrom unittest import mock\n"
        "def rebound_velocity(u, e):\n    tree.Element('a'), mock.call, decimal, string, textwrap\n    return -e * u"
    ),
    "a part of the library that is loaded late": (
        "import datetime\ndef rebound_velocity(u, e):\n"
        "    return -e * u * (datetime.datetime.strptime('2020', '%Y').year == 2020)"
    ),
}


@pytest.fixture(scope="module")
def closed() -> Iterator[Grader]:
    """A grader whose processes cannot open any file, as on a kernel without Landlock."""
    with Grader(without=("landlock",)) as found:
        yield found


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_answer_is_right_where_no_file_can_be_opened(name, closed):
    with Remote(Submission("lab.py", RIGHT[name]), closed) as remote, remote.fresh() as call:
        assert call("rebound_velocity", -2.0, 0.5) == 1.0


@pytest.mark.skipif(os.geteuid() != 0, reason="only root becomes another user")
def test_another_user_has_the_whole_library_and_no_other_file_of_its_folders(grader):
    text = (
        "import importlib, os\ndef rebound_velocity(u, e):\n    importlib.import_module('zoneinfo')\n    found = []\n"
        "    for n in range(12):\n        for path in ('site-packages', '..', '../../../../..'):\n"
        "            try:\n                found += os.listdir(f'/proc/self/fd/{n}/{path}')\n"
        "            except OSError:\n                pass\n    return len(found)\n"
    )
    with Remote(Submission("lab.py", text), grader) as remote, remote.fresh() as call:
        assert call("rebound_velocity", -2.0, 0.5) == 0


def test_a_greek_letter_earns_its_points_from_root_and_from_an_ordinary_user(grader, tmp_path):
    text = (
        "import numpy as np\ndef edge_edge_normal(α, β, a, b):\n    ν = np.cross(α, β)\n"
        "    ν = ν / np.linalg.norm(ν, axis=-1, keepdims=True)\n"
        "    return np.where(np.sum(ν * (a - b), axis=-1)[..., None] < 0, -ν, ν)\n"
    )
    (tmp_path / "lab.py").write_text(text, encoding="utf-8")
    found = grade(tmp_path / "lab.py", ["impulse"], ["visible", "hidden"], grader).content()
    points = {each["name"]: (each["got"], each["possible"]) for each in found["functions"]}
    assert points["edge_edge_normal"][0] == points["edge_edge_normal"][1] > 0


def test_a_module_that_cannot_be_loaded_is_an_error_and_no_mark(closed, tmp_path):
    (tmp_path / "lab.py").write_text(f"import mailbox\n{GREEK}".replace("return", "mailbox; return"), encoding="utf-8")
    with pytest.raises(GraderFailed, match=r"cannot open Python's own files in .* imports mailbox, which"):
        grade(tmp_path / "lab.py", ["impulse"], ["visible"], closed)


def test_a_module_that_does_not_exist_is_the_submissions_own_error(closed):
    text = "def rebound_velocity(u, e):\n    import mailbax\n    return 0.0"
    with (
        Remote(Submission("lab.py", text), closed) as remote,
        remote.fresh() as call,
        pytest.raises(Exception, match="No module named 'mailbax'"),
    ):
        call("rebound_velocity", -2.0, 0.5)


def test_missing_seals_are_in_the_grade(closed, tmp_path):
    (tmp_path / "lab.py").write_text(GREEK, encoding="utf-8")
    found = grade(tmp_path / "lab.py", ["impulse"], ["visible"], closed).content()
    assert "no Landlock in this kernel" in found["missing"]


def test_an_interpreter_that_cannot_be_started_is_an_error_of_the_grader(monkeypatch, tmp_path):
    monkeypatch.setattr(worker_files, "interpreter", lambda: str(tmp_path / "python"))
    with pytest.raises(GraderFailed, match="the grader cannot start Python"):
        Grader()


@pytest.mark.slow
@pytest.mark.skipif(os.geteuid() != 0, reason="only root becomes another user")
@pytest.mark.parametrize("kind", ["copied", "linked"])
def test_an_interpreter_in_a_folder_of_roots_own_grades_alike(kind, tmp_path):
    """In a folder that the tests' user cannot enter, copied or as a link, without a home."""
    folder = tmp_path / "home"
    folder.mkdir(mode=0o700)
    options = ["--copies"] if kind == "copied" else ["--symlinks"]
    subprocess.run([sys.executable, "-m", "venv", *options, "--without-pip", str(folder / "env")], check=True)
    code = f"""
from labs.grading.calling.remote import Remote
from labs.grading.submission.reading import Submission
for text in {list(RIGHT.values())!r}:
    with Remote(Submission("lab.py", text)) as remote, remote.fresh() as call:
        assert call("rebound_velocity", -2.0, 0.5) == 1.0, text
"""
    environment = {"PYTHONPATH": os.pathsep.join([str(ROOT), *filter(None, sys.path)])}
    subprocess.run([str(folder / "env" / "bin" / "python"), "-c", code], check=True, env=environment, cwd=ROOT)
