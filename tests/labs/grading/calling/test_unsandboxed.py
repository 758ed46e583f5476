"""Without a sandbox: what a submission can change, the next one does not meet, and nobody is told of protection."""

from __future__ import annotations

import contextlib
import sys
import textwrap

import pytest
from stand_ins import LOADED, PATIENT, Scripted, calls_until_it_fails

from labs.grading.budget import Budget
from labs.grading.calling.calls import Call
from labs.grading.calling.patience import Patience
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import GraderFailed
from labs.grading.submission.reading import Submission
from labs.grading.worker.tier import Tier

PATCHES = """
import glob, os
def rewrite(name, old, new):
    for folder, *_ in os.walk("../code"):
        os.chmod(folder, 0o700)
    for path in glob.glob("../code/**/" + name, recursive=True):
        os.chmod(path, 0o600)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        assert old in text
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(old, new))
"""
CLAIM = PATCHES + 'rewrite("lone_process.py", "Sealing(Tier.PROCESS", "Sealing(max(Tier)")'
VANDALS = {
    "protection": CLAIM,
    "answers": PATCHES + 'rewrite("serving.py", "not callable(function)", "True")',
    "compiled code": """
        import glob
        for path in glob.glob("../code/labs/**/*.pyc", recursive=True):
            with open(path, "r+b") as file:
                file.seek(16)
                file.write(b"no code")
    """,
    "numpy": """
        import glob
        for path in glob.glob("../code/numpy/linalg/__init__.py"):
            with open(path, "a") as file:
                file.write("\\ndef norm(_): return 0.0\\n")
    """,
    "modules of its own": """
        for name in ("json", "ast", "sitecustomize", "usercustomize", "random"):
            for folder in ("", "../", "../code/"):
                with open(folder + name + ".py", "w") as file:
                    file.write("raise SystemExit(3)")
    """,
    "all folders": 'import shutil\nshutil.rmtree("..", ignore_errors=True)',
    "environment": """
        import os
        os.environ["PYTHONPATH"] = os.environ["PYTHONHOME"] = os.getcwd()
        os.chmod("..", 0)
    """,
}
RIGHT = """
import json, os, random, tempfile
import numpy as np
def norm(): return float(np.linalg.norm([3, 4]))
def kept():
    path = os.path.join(tempfile.gettempdir(), "kept")
    found = os.path.exists(path)
    open(path, "w").close()
    return found
"""


def sealing_of(claimed: int, arranged: Tier):
    """What is reported of a process that claims a tier where another was arranged."""
    process = Scripted(("sealed", claimed, [], [], 0, 0.0), LOADED)
    process.most = arranged
    call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)
    call.begin(process, Tier.PROCESS)
    return call.sealing


@pytest.mark.parametrize(
    ("arranged", "claimed"),
    [(Tier.PROCESS, Tier.NETWORK), (Tier.PROCESS, Tier.LIMITS), (Tier.LIMITS, Tier.FILES), (Tier.FILES, Tier.NETWORK)],
)
def test_a_process_that_claims_more_protection_than_was_arranged_is_not_believed(arranged, claimed):
    sealing = sealing_of(claimed, arranged)
    assert sealing.tier == arranged
    assert claimed.title in sealing.missing[-1]
    assert sealing_of(arranged, claimed).missing == ()


@pytest.mark.parametrize("claimed", [-1, 4, 10**30])
def test_a_tier_that_does_not_exist_is_refused(claimed):
    with pytest.raises(GraderFailed, match="how far it is shut in"):
        sealing_of(claimed, Tier.NETWORK)


@pytest.mark.slow
@pytest.mark.parametrize("vandal", VANDALS)
def test_what_a_submission_does_to_the_workers_code_does_not_reach_the_next_one(vandal):
    with Grader(PATIENT, sandboxed=False) as grader:
        with Remote(Submission("lab.py", textwrap.dedent(VANDALS[vandal])), grader) as remote:
            for _ in range(2):
                try:
                    with remote.fresh() as call:
                        assert call.sealing.tier == Tier.PROCESS
                except GraderFailed:  # it has harmed itself
                    pass
        for _ in range(2):
            with Remote(Submission("lab.py", RIGHT), grader) as remote, remote.fresh() as call:
                assert call("norm") == 5
                assert not call("kept")
                assert call.sealing.tier == Tier.PROCESS
                assert call.sealing.missing == (f"no sandbox on {sys.platform}: only a time limit",)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the nursery needs Linux")
def test_a_nursery_whose_code_was_changed_is_followed_by_one_with_code_of_its_own():
    text = """
    import mmap, os, signal
    def end():
        with open("../code/labs/grading/worker/sandbox.py", "r+b") as file:
            mapped = mmap.mmap(file.fileno(), 0)
            at = mapped.find(b"Tier.LIMITS if not files")
            if at >= 0:
                mapped[at:at + 11] = b"Tier(3)    "
                mapped.flush()
        os.kill(os.getppid(), signal.SIGKILL)
    def f(): return 1
    """
    with Grader(PATIENT, without=("landlock", "seccomp", "user")) as grader:
        remote = Remote(Submission("lab.py", textwrap.dedent(text)), grader)
        with remote.fresh() as call, pytest.raises(GraderFailed, match="nursery"):
            calls_until_it_fails(call, "end")
        with remote.fresh() as call:
            assert call("f") == 1
            assert call.sealing.tier == Tier.LIMITS
            assert not [line for line in call.sealing.missing if "claims" in line]
        remote.close()
