"""Classroom 50 runs this in a student's repository: it installs what grading needs, and grades in a process of its own.

The folder that this lies in holds the lab as students get it. Nothing of the repository is imported: Python is told to
leave the current folder alone, and the submission is read as text.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE / "project"


def main() -> int:
    """Grade the repository in the current folder."""
    repository, lab = Path.cwd(), (HERE / "lab.txt").read_text(encoding="utf-8").strip()
    needed = ["-c", "constraints.txt", "-r", "requirements.txt"]
    subprocess.run([sys.executable, "-I", "-m", "pip", "install", "--quiet", *needed], cwd=PROJECT, check=True)
    command = [sys.executable, "-P", "-m", "labs.gradebook.platforms.classroom50", str(repository), lab]
    return subprocess.run(command, cwd=PROJECT, env={**os.environ, "PYTHONPATH": str(PROJECT)}).returncode


if __name__ == "__main__":
    sys.exit(main())
