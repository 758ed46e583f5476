"""Work on a cluster: a real Dask scheduler and workers, as processes of their own."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest
from program import collisions

from labs.workers import on_cluster, refuse_others, what_runs_here
from reference.errors import InvalidInput

RIGHT = """\
import numpy as np


def normal_velocity(body_a, body_b, normal):
    v_a, w_a, r_a = (np.asarray(each, dtype=float) for each in body_a[:3])
    v_b, w_b, r_b = (np.asarray(each, dtype=float) for each in body_b[:3])
    return np.vecdot(v_a + np.cross(w_a, r_a) - v_b - np.cross(w_b, r_b), normal)
"""
WRONG = RIGHT.replace("- v_b", "+ v_b")


@pytest.mark.parametrize("address", ["localhost", "local:0", "local:", "http://here", "tcp:/"])
def test_what_is_no_address_is_refused(address):
    with (
        pytest.raises(InvalidInput, match=r"it is the address of a scheduler, tcp://host:8786, or local:4"),
        on_cluster(address),
    ):
        pass


@pytest.mark.parametrize(
    ("there", "said"),
    [
        ({"the lab": "2", "NumPy": "2.3"}, "has other code of the lab"),
        ({"the lab": "1", "NumPy": "2.2"}, "has NumPy 2.2, and this machine 2.3"),
        ({"the lab": "1"}, "has NumPy unknown, and this machine 2.3"),
    ],
)
def test_a_worker_that_would_get_other_numbers_is_refused(there, said):
    here = {"the lab": "1", "NumPy": "2.3"}
    refuse_others(here, {"tcp://a": here})
    with pytest.raises(InvalidInput, match=said):
        refuse_others(here, {"tcp://a": here, "tcp://b": there})


def test_what_numbers_depend_on_names_code_and_every_engine():
    assert list(what_runs_here()) == ["the lab", "Python", "NumPy", "PyBullet", "MuJoCo", "DART"]


def grades(folder) -> dict[str, bytes]:
    return {path.parent.name: path.read_bytes() for path in folder.glob("students/*/grade.json")}


def classroom(folder, count: int) -> None:
    folder.mkdir()
    for number in range(count):
        text = RIGHT if number % 3 else WRONG
        (folder / f"s{number:03}.py").write_text(f"{text}\n# {number}\n", encoding="utf-8")


@pytest.fixture
def cluster():
    """The address of a scheduler, and its two workers as processes."""
    pytest.importorskip("distributed")
    environment = os.environ | {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "3"}
    dask = [
        sys.executable,
        "-m",
        "distributed.cli.dask_scheduler",
        "--host",
        "127.0.0.1",
        "--port",
        "0",
        "--no-dashboard",
    ]
    scheduler = subprocess.Popen(dask, stderr=subprocess.PIPE, text=True, env=environment)
    address = ""
    for line in scheduler.stderr:
        if found := re.search(r"tcp://127\.0\.0\.1:\d+", line):
            address = found[0]
            break

    def worker() -> subprocess.Popen:
        command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny"]
        return subprocess.Popen([*command, "--no-dashboard"], stderr=subprocess.DEVNULL, env=environment)

    workers = [worker(), worker()]
    yield address, workers
    for process in (*workers, scheduler):
        process.kill()
        process.wait()
    scheduler.stderr.close()


@pytest.mark.weekly
def test_a_cluster_that_loses_a_worker_gives_the_grades_that_one_machine_gives(tmp_path, cluster):
    address, workers = cluster
    classroom(tmp_path / "class", 16)
    command = [sys.executable, "-m", "labs", "grade", str(tmp_path / "class"), "--lab", "impulse", "--cluster", address]
    running = subprocess.Popen(
        [*command, "--out", str(tmp_path / "far")], stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    while running.poll() is None and len(grades(tmp_path / "far")) < 3:
        time.sleep(0.05)
    workers[0].send_signal(signal.SIGKILL)
    while running.poll() is None and len(grades(tmp_path / "far")) < 6:
        time.sleep(0.05)
    running.kill()  # the command itself: what it has written stays
    running.communicate()
    before = grades(tmp_path / "far")
    assert 6 <= len(before) < 16
    assert all(json.loads(text)["identity"]["student"] == name for name, text in before.items())

    again = subprocess.run([*command, "--out", str(tmp_path / "far")], capture_output=True, text=True, check=False)
    assert again.returncode == 0, again.stdout + again.stderr
    here = collisions("grade", str(tmp_path / "class"), "--lab", "impulse", "--out", str(tmp_path / "near"))
    assert here.code == 0, here.error
    assert grades(tmp_path / "far") == grades(tmp_path / "near")
    assert before.items() <= grades(tmp_path / "far").items()
    assert len(grades(tmp_path / "near")) == 16


@pytest.mark.slow
def test_a_cluster_gives_the_report_and_the_grades_that_one_machine_gives(tmp_path, cluster):
    classroom(tmp_path / "class", 2)
    report = ("report", "--only", "dropped-ball", "--engine", "handwritten", "--fresh")
    for out, more in (("here", ()), ("there", ("--cluster", cluster[0]))):
        found = collisions(*report, "--out", str(tmp_path / out), *more)
        assert found.code == 0, found.error
        marks = ("--out", str(tmp_path / f"{out}-class"))
        found = collisions("grade", str(tmp_path / "class"), "--lab", "impulse", *marks, *more)
        assert found.code == 0, found.error
    here, there = (tmp_path / out / "rows.json" for out in ("here", "there"))
    assert here.read_bytes() == there.read_bytes()
    assert grades(tmp_path / "here-class") == grades(tmp_path / "there-class")
    assert len(grades(tmp_path / "here-class")) == 2
