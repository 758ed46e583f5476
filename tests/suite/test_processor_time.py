"""The last line of a run says what it took, here and on the machine of the allowances."""

from __future__ import annotations

import re

import pytest

BURNS = """
import subprocess, sys

def test_burns_half_a_second_in_a_child():
    subprocess.run([sys.executable, "-c", "import time\\nwhile time.process_time() < 0.5: pass"], check=True)
"""
LINE = r"processor time: (\d+) s\. This machine takes (\S+) times as long .* allowances: (\d+) s of 9 s allowed\."


@pytest.mark.slow
@pytest.mark.parametrize("processes", ["0", "2"])
def test_the_last_line_counts_children_and_the_pace_of_the_machine(run_pytest, processes):
    ended = run_pytest({"test_burns.py": BURNS}, "-n", processes, "--cpu-allowed=9")
    used, slowness, comparable = map(float, re.search(LINE, ended.stdout).groups())
    assert used >= 1  # half a second, an interpreter or two, and their imports
    assert comparable == pytest.approx(used / slowness, abs=1)
