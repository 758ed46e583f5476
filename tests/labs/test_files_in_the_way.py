"""A student's file that Python takes for a package of the same name is named, and cannot stop the program."""

from __future__ import annotations

import os
import subprocess
import sys

from labs import correct_functions
from labs.files_in_the_way import files_in_the_way, warning


def test_a_file_is_in_the_way_if_python_would_load_it(tmp_path, monkeypatch):
    for name in ("antigravity", "numpy", "detection"):  # never loaded here, loaded from elsewhere, nobody's
        (tmp_path / f"{name}.py").write_text("")
    assert files_in_the_way(tmp_path) == []
    monkeypatch.syspath_prepend(tmp_path)
    assert files_in_the_way(tmp_path) == ["antigravity.py"]
    assert warning(tmp_path).startswith("antigravity.py in this folder is in the way: Python takes it for its own.")


def test_the_program_runs_beside_files_with_the_names_of_packages(tmp_path):
    for name in ("numpy", "random", "reference", "typing", "rich"):
        (tmp_path / f"{name}.py").write_text(f"raise SystemExit('the {name} of the student')")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    command = [sys.executable, "-m", "labs", "--version"]
    ran = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert ran.stdout.startswith("collisions-lab "), ran.stderr[-500:]


def test_a_file_named_solutions_is_no_package_of_right_answers(tmp_path, monkeypatch):
    (tmp_path / "solutions_of_mine.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(correct_functions, "OURS", ("solutions_of_mine",))
    assert correct_functions.package_of_correct_functions() == ""
