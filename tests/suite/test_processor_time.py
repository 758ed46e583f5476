"""Every test is charged with the processor time of its own process and of those that it starts."""

from __future__ import annotations

import json
import os
import sys

import pytest
from processor_time import line_of, table_of

TESTS = """
import atexit, subprocess, sys, time

BURN = "import time\\nwhile time.process_time() < 0.3: pass\\nprint('done', flush=True)\\n"

def test_idle():
    time.sleep(0.3)

def test_own():
    end = time.process_time() + 0.3
    while time.process_time() < end:
        pass

def test_child():
    subprocess.run([sys.executable, "-c", BURN], check=True)

def test_child_that_stays():
    child = subprocess.Popen([sys.executable, "-c", BURN + "input()"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    atexit.register(child.communicate)
    assert child.stdout.readline()

def test_after_it():
    pass
"""


@pytest.mark.skipif(sys.platform != "linux", reason="a child that is still running is seen on Linux alone")
@pytest.mark.parametrize("processes", ["0", pytest.param("2", marks=pytest.mark.slow)])
def test_every_test_is_charged_with_what_it_and_its_children_use(run_pytest, tmp_path, processes):
    before = os.times()
    run_pytest({"test_burns.py": TESTS}, "-n", processes, "--dist=loadfile", "--cpu-report=report.json")
    after = os.times()
    report = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    seconds = {test.partition("::")[2]: time for test, time in report["tests"].items()}
    for burning in ("test_own", "test_child", "test_child_that_stays"):
        assert 0.28 < seconds[burning] < 0.6  # two ticks of the clock less; an interpreter and the report more
    for idle in ("test_idle", "test_after_it"):
        assert seconds[idle] < 0.2
    theirs = after.children_user + after.children_system - before.children_user - before.children_system
    assert report["total"] == pytest.approx(theirs, abs=0.2)  # s: the end of the interpreter is missing
    assert report["total"] == pytest.approx(sum(report["folders"].values()))


@pytest.mark.parametrize("processes", ["0", pytest.param("2", marks=pytest.mark.slow)])
def test_the_machine_is_timed_where_tests_run(run_pytest, tmp_path, processes):
    ended = run_pytest({"test_idle.py": "def test_idle(): pass"}, "-n", processes, "--cpu-report=r.json")
    report = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    assert 0.05 < report["slowness"] < 50
    assert line_of(report) in ended.stdout


REPORT = {"folders": {"tests/labs": 80.25, "collection": 1.0}, "total": 81.25, "allowed": 300.0, "slowness": 2.5}


def test_the_line_names_each_folder_and_what_is_allowed():
    assert line_of(REPORT) == (
        "processor time: tests/labs 80.2 s, collection 1.0 s; in all 81.2 s."
        " This machine takes 2.50 times as long as the one of the allowances: 32.5 s of 300 s allowed."
    )
    assert line_of(REPORT | {"allowed": None}).endswith(": 32.5 s.")
    assert line_of(REPORT | {"allowed": None, "slowness": None}).endswith("in all 81.2 s")


def test_the_table_has_a_column_for_each_run():
    first = REPORT | {"folders": {"tests/labs": 80.0, "collection": 1.0}, "total": 81.0}
    second = {"folders": {"tests/reference": 500.0, "collection": 2.0}, "total": 502.0, "allowed": None, "slowness": 2}
    assert table_of({"test": first, "verify": second}).split("\n") == [
        "processor time, s      test    verify",
        "tests/labs             80.0       0.0",
        "tests/reference         0.0     500.0",
        "collection              1.0       2.0",
        "in all                 81.0     502.0",
        "times as slow          2.50      2.00",
        "comparable             32.4     251.0",
        "allowed                 300          ",
    ]
