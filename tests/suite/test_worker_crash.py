"""A test that kills its process fails by name and ends the run: it can neither hang nor be overlooked."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

MAKEFILE = Path(__file__).parents[2] / "Makefile"
OPTIONS = re.search(r"-m pytest -n auto (.*)", MAKEFILE.read_text(encoding="utf-8"))[1].split()
"""With which `make test` spreads tests over processes."""


@pytest.mark.slow
@pytest.mark.parametrize("death", ["os.kill(os.getpid(), signal.SIGILL)", "os._exit(3)", "ctypes.string_at(0)"])
def test_a_worker_that_dies_ends_the_run_and_the_test_is_named(run_pytest, death):
    dying = f"import ctypes, os, signal\ndef test_dies():\n    {death}\n"
    ended = run_pytest({"test_dies.py": dying, "test_lives.py": "def test_lives(): pass\n"}, "-n", "2", *OPTIONS)
    assert ended.returncode == 1
    assert "FAILED test_dies.py::test_dies" in ended.stdout
