"""What the tests of the suite itself share: small runs of pytest that may crash."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

HERE = Path(__file__).parent


@pytest.fixture
def run_pytest(tmp_path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run pytest on files that are given by name and text, with the plugins of this folder and nothing else of ours."""

    def run(files: dict[str, str], *options: str) -> subprocess.CompletedProcess[str]:
        for name, text in files.items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        (tmp_path / "conftest.py").write_text('pytest_plugins = ["processor_time", "skips"]\n', encoding="utf-8")
        (tmp_path / "pytest.ini").write_text(f'[pytest]\npythonpath = "{HERE.as_posix()}"\n', encoding="utf-8")
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
        environment["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"  # hypothesis alone takes most of a second
        command = [sys.executable, "-m", "pytest", "-p", "xdist", *options]
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False, timeout=120
        )

    return run
