"""How grading ends when nursery or grader are stopped or killed, and what a submission leaves for the next."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from labs.grading.calling.processes import LOST, Limits
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import GraderFailed, StudentError
from labs.grading.judging.grade import grade
from labs.grading.submission.reading import Submission
from labs.grading.worker import system_calls
from labs.grading.worker.tier import Tier

ROOT = Path(__file__).parents[3]
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the nursery needs Linux")


@pytest.mark.slow
def test_a_silent_nursery_is_killed_with_all_its_processes():
    with Grader(Limits(call=2.0)) as own:
        own.host._control.settimeout(0.5)  # type: ignore[attr-defined]
        remote = Remote(Submission("lab.py", "import os\ndef parent(): return os.getppid()"), own)
        with remote.fresh() as call:
            nursery = call("parent")
            os.kill(nursery, signal.SIGSTOP)
        assert call.ended is LOST
        with remote.fresh() as call:
            assert call("parent") != nursery
        remote.close()
        with pytest.raises(ProcessLookupError):
            os.kill(nursery, 0)


def test_a_fault_of_the_grader_costs_no_points(tmp_path):
    (tmp_path / "lab.py").write_text("def side_of_plane(separation, tolerance=0.0): return separation < -tolerance")
    with Grader(least=Tier.NETWORK, without=("limits",)) as lesser, pytest.raises(GraderFailed, match="below"):
        grade(tmp_path / "lab.py", None, ["visible"], lesser)


def test_a_nursery_that_is_killed_makes_no_grade(tmp_path):
    kills = "os.kill(os.getppid(), 9); time.sleep(4)"  # else it may answer before the nursery is gone
    (tmp_path / "lab.py").write_text(f"import os, time\ndef side_of_plane(separation, tolerance=0.0): {kills}")
    with Grader(without=("seccomp", "landlock", "user")) as open_grader, pytest.raises(GraderFailed, match="nursery"):
        grade(tmp_path / "lab.py", None, ["visible"], open_grader)


@pytest.mark.parametrize(
    "ending",
    [signal.SIGKILL, *(pytest.param(each, marks=pytest.mark.slow) for each in (signal.SIGTERM, signal.SIGINT))],
)
def test_a_grader_that_is_ended_leaves_nothing(ending, tmp_path):
    code = """
import os, signal, sys, time
from labs.grading.calling.remote import Remote
from labs.grading.submission.reading import Submission
signal.signal(signal.SIGINT, signal.default_int_handler)  # which a job in a shell's background inherits as ignored
with Remote(Submission("lab.py", "import os\\ndef pids(): return os.getpid(), os.getppid()")) as remote:
    for _ in range(20):
        with remote.fresh() as call:
            call("pids")  # of whose end the nursery tells a grader that is gone
    with remote.fresh() as call:
        print(*call("pids"), flush=True)
        time.sleep(60)
"""
    packages = os.pathsep.join([str(ROOT), *filter(None, sys.path)])
    environment = {**os.environ, "TMPDIR": str(tmp_path), "PYTHONPATH": packages}
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment
    ) as grader:
        assert grader.stdout is not None
        pids = [int(pid) for pid in grader.stdout.readline().split()]
        assert list(tmp_path.iterdir())
        grader.send_signal(ending)
    until = time.monotonic() + 10
    while time.monotonic() < until and (any(map(_is_there, pids)) or list(tmp_path.iterdir())):
        time.sleep(0.05)
    assert not any(map(_is_there, pids))
    assert list(tmp_path.iterdir()) == []


def _is_there(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_two_graders_hide_their_process_until_both_are_closed():
    before = system_calls.prctl(system_calls.GET_DUMPABLE)
    first, second = Grader(), Grader()
    first.close()
    first.close()
    assert system_calls.prctl(system_calls.GET_DUMPABLE) == 0
    second.close()
    assert system_calls.prctl(system_calls.GET_DUMPABLE) == before


def test_a_submission_finds_nothing_of_the_one_before():
    leaves = "import builtins, numpy as np\nbuiltins.left = np.left = 1\ndef f(): return hasattr(builtins, 'left')"
    finds = "import builtins, numpy as np\ndef f(): return hasattr(builtins, 'left') or hasattr(np, 'left')"
    with Grader() as own:
        for text, there in ((leaves, True), (finds, False), (leaves, True), (finds, False)):
            with Remote(Submission("lab.py", text), own) as remote, remote.fresh() as call:
                assert call("f") is there
                with contextlib.suppress(StudentError):
                    call("g")
