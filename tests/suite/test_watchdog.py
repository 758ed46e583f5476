"""A run of pytest ends when a worker dies and when its time is over."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest

MAKEFILE = Path(__file__).parents[2] / "Makefile"
OPTIONS = re.search(r"-m pytest -n auto (.*)", MAKEFILE.read_text(encoding="utf-8"))[1].split()
"""With which `make test` spreads tests over processes."""
DEATHS = {
    "illegal instruction": "import os, signal\nos.kill(os.getpid(), signal.SIGILL)",
    "exit": "import os\nos._exit(3)",
    "segmentation fault": "import ctypes\nctypes.string_at(0)",
}


def indented(code: str) -> str:
    return "".join(f"    {line}\n" for line in code.splitlines())


@pytest.mark.parametrize(
    "death", ["illegal instruction", *(pytest.param(name, marks=pytest.mark.slow) for name in list(DEATHS)[1:])]
)
def test_a_worker_that_dies_ends_the_run_and_the_test_is_named(run_pytest, death):
    dying = f"def test_dies():\n{indented(DEATHS[death])}"
    files = {"test_dies.py": dying, "test_lives.py": "def test_lives():\n    pass\n"}
    ended = run_pytest(files, "-n", "2", *OPTIONS)
    assert ended.returncode == 1
    assert "test worker gw0 died in test_dies.py::test_dies" in ended.stdout.replace("gw1", "gw0")
    assert "FAILED test_dies.py::test_dies" in ended.stdout


@pytest.mark.slow
def test_a_worker_that_dies_ends_the_run_while_another_one_is_busy(run_pytest):
    sleeping = "import time, pytest\n@pytest.mark.parametrize('n', range(60))\ndef test_sleeps(n):\n    time.sleep(1)\n"
    files = {"test_dies.py": f"def test_dies():\n{indented(DEATHS['exit'])}", "test_sleeps.py": sleeping}
    began = time.monotonic()
    assert run_pytest(files, "-n", "2", *OPTIONS).returncode == 1
    assert time.monotonic() - began < 50  # half a minute for two interpreters on a busy machine; the test takes 60 s


@pytest.mark.slow
@pytest.mark.parametrize("when", ["in one", "in both"])
def test_a_worker_that_dies_before_the_tests_ends_the_run(run_pytest, when):
    names = ["gw1"] if when == "in one" else ["gw0", "gw1"]
    text = (
        f"import os\nif os.environ.get('PYTEST_XDIST_WORKER') in {names}:\n    os._exit(3)\ndef test_is_fine(): pass\n"
    )
    ended = run_pytest({"test_fine.py": text}, "-n", "2", *OPTIONS)
    assert ended.returncode == 1
    assert re.search("test worker gw[01] died before or after the tests", ended.stdout)


@pytest.mark.slow
@pytest.mark.parametrize("processes", ["0", "2"])
def test_a_run_ends_when_its_time_is_over_and_names_what_was_running(run_pytest, processes):
    text = "import time\ndef test_sleeps():\n    time.sleep(100)\n"
    ended = run_pytest({"test_sleeps.py": text}, "-n", processes, *OPTIONS, "--run-limit=10")
    assert ended.returncode == 124
    assert "The run took longer than 10 s and was ended. Tests that were running:" in ended.stdout
    assert "  test_sleeps.py::test_sleeps" in ended.stdout


@pytest.mark.slow
def test_a_run_ends_although_a_test_swallows_the_interrupt(run_pytest):
    text = """
import time, watchdog
watchdog.GRACE = 1

def test_never_ends():
    while True:
        try:
            time.sleep(100)
        except KeyboardInterrupt:
            pass
"""
    ended = run_pytest({"test_never_ends.py": text}, "-n", "0", "--run-limit=5")
    assert ended.returncode == 124
    assert "  test_never_ends.py::test_never_ends" in ended.stderr
