"""The lab outside its checkout: an installed wheel, and a student's release that was unzipped in another folder."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from labs.building.release import NAME, release
from labs.project_folders import ROOT

pytestmark = pytest.mark.slow

SUBMISSION = """import numpy as np


def normal_velocity(body_a, body_b, normal):
    p, q = (body[0] + np.cross(body[1], body[2]) for body in (body_a, body_b))
    return np.vecdot(p - q, normal)
"""
CALL = """
import labs
from labs.grading.calling.remote import Remote
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.submission.reading import read
from reference.recording.reading import content_of

print(labs.__file__)
with Remote(read("lab.py", ["normal_velocity"])) as remote, remote.fresh() as call:
    print(diagnose("normal_velocity", call).verdict)
print(content_of("mujoco", "dropped-ball") is not None)
"""
NOTEBOOK = """
from IPython.core.interactiveshell import InteractiveShell

shell = InteractiveShell.instance()
for cell in ("from labs import lab\\nlab.begin('impulse')", open("lab.py").read(), "lab.check('normal_velocity')"):
    shell.run_cell(cell, store_history=True)
"""


def python(folder: Path, place: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Python in some place with the packages of a folder, which come before those of the checkout."""
    environment = {**os.environ, "PYTHONPATH": str(folder), "XDG_CACHE_HOME": str(place / "cache")}
    command = [sys.executable, "-P", *arguments]
    return subprocess.run(command, cwd=place, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture
def place(tmp_path) -> Path:
    """A folder with a submission."""
    folder = tmp_path / "place"
    folder.mkdir()
    (folder / "lab.py").write_text(SUBMISSION, encoding="utf-8")
    return folder


def test_an_installed_wheel_compares_and_says_that_it_has_no_tests(place, tmp_path):
    build = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--quiet", "--wheel-dir", str(tmp_path), str(ROOT)]
    built = subprocess.run(build, capture_output=True, text=True, check=False)
    if built.returncode:
        pytest.skip(f"pip cannot build a wheel here: {built.stderr[-200:]}")
    installed = tmp_path / "site-packages"
    zipfile.ZipFile(next(tmp_path.glob("*.whl"))).extractall(installed)

    compared = python(installed, place, "-m", "labs", "compare", "dropped-ball", "--engine", "handwritten", "--fresh")
    assert compared.returncode == 0, compared.stderr
    said = " ".join(compared.stdout.split())
    assert re.search(r"Of (\d+) checks that count, \1 came out as predicted and near theory and none failed", said)
    called = python(installed, place, "-c", CALL)
    assert called.stdout.split() == [str(installed / "labs" / "__init__.py"), "right", "True"], called.stderr
    checked = python(installed, place, "-m", "labs", "check", "lab.py")
    assert checked.returncode == 3
    assert "without its folder tests/autograder" in " ".join(checked.stderr.split())


def test_an_unzipped_release_checks_a_submission_and_a_notebooks_cell(place, tmp_path):
    release(tmp_path / "release.zip")
    zipfile.ZipFile(tmp_path / "release.zip").extractall(tmp_path)
    unzipped = tmp_path / NAME
    assert not (unzipped / "solutions").exists()

    checked = python(unzipped, place, "-m", "labs", "check", "lab.py")
    assert checked.returncode == 1, checked.stderr  # 7 other functions are not written
    assert "✓ normal_velocity" in checked.stdout
    assert "1 of 8 functions right" in checked.stdout
    in_notebook = python(unzipped, place, "-c", NOTEBOOK)
    assert "✓ normal_velocity is right, as far as this tries it" in in_notebook.stdout, in_notebook.stderr
