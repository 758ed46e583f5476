"""Processes of tests: how far they are shut in, when they end, and what they leave behind."""

from __future__ import annotations

import os
import signal
import statistics
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest
from stand_ins import PATIENT, calls_until_it_fails

from labs.grading.calling import worker_files
from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import (
    GraderFailed,
    OutOfTime,
    ProcessDied,
    StudentError,
)
from labs.grading.submission.reading import Submission
from labs.grading.worker import landlock, seccomp
from labs.grading.worker.folders import remove
from labs.grading.worker.tier import Tier
from labs.project_folders import ROOT

NORM = "import numpy as np\ndef f(): return np.linalg.norm([3, 4])"
linux = pytest.mark.skipif(sys.platform != "linux", reason="the nursery needs Linux")


@linux
def test_a_process_of_a_test_holds_nothing_of_the_grader(of):
    text = """
    import os, sys
    def modules(): return sorted({name.partition(".")[0] for name in sys.modules})
    def around(): return [os.getcwd(), dict(os.environ) == {}, sys.path, sys.argv[1:2]]
    """
    with of(text).fresh() as call:
        loaded = set(call("modules"))
        assert loaded.isdisjoint({"labs", "reference", "solutions", "tests", "pytest", "matplotlib", "site"})
        folder, bare, path, _ = call("around")
        assert bare
        assert not any("site-packages" in each for each in path)
        assert Path(folder).parent.name.startswith("grading-")
    assert call.ended is not None
    assert not Path(folder).exists()


@linux
@pytest.mark.parametrize(
    ("options", "tier", "words"),
    [
        ({}, Tier.NETWORK, ""),
        pytest.param({"without": ["landlock"]}, Tier.NETWORK, "no Landlock", marks=pytest.mark.slow),
        ({"without": ["seccomp"]}, Tier.FILES, "other processes of its user"),
        ({"without": ["landlock", "seccomp"]}, Tier.LIMITS, "what its user may open"),
        pytest.param({"without": ["limits"]}, Tier.PROCESS, "not limited", marks=pytest.mark.slow),
        ({"sandboxed": False}, Tier.PROCESS, "only a time limit"),
    ],
)
def test_a_result_names_the_tier_of_its_process_and_what_is_missing(options, tier, words):
    if not (landlock.version() and seccomp.available()):
        pytest.skip("this kernel has less to begin with")
    with Grader(PATIENT, **options) as lesser:
        with Remote(Submission("lab.py", "def f(): return 1"), lesser).fresh() as call:
            assert call("f") == 1
            assert call.sealing.tier == tier
            assert words in "; ".join(call.sealing.missing)
        lesser.least = Tier(min(tier + 1, Tier.NETWORK))
        if tier < Tier.NETWORK:
            with (
                pytest.raises(GraderFailed, match=rf"this machine offers '{tier.title}'"),
                Remote(Submission("lab.py", ""), lesser).fresh(),
            ):
                pass


TELLS = """
import gc, importlib.util, os, sys, traceback
def frames():
    frame, found = sys._getframe(), []
    while frame:
        found.append(frame.f_code.co_filename)
        frame = frame.f_back
    return found
def told():
    import numpy
    found = [sys.argv, sys.path, sys.executable, sys.prefix, sys.orig_argv, os.getcwd(), dict(os.environ), frames()]
    found += [getattr(each, "__file__", "") for each in sys.modules.values()]
    found += [each.__code__.co_filename for each in gc.get_objects() if type(each).__name__ == "function"]
    found += [vars(each) for each in gc.get_objects() if type(each).__name__ in ("FileFinder", "ModuleSpec")]
    for file in ("cmdline", "environ", "maps", "mountinfo"):
        try:
            found.append(open("/proc/self/" + file).read())
        except OSError:
            pass
    return [repr(each)[:100_000] for each in found if each]
def solved(): return importlib.util.find_spec("solutions") is not None or importlib.util.find_spec("labs") is not None
"""


@pytest.mark.parametrize(
    "options",
    [pytest.param({"sandboxed": False}, marks=pytest.mark.slow), {}],
    ids=["without a sandbox", "with what there is"],
)
def test_a_process_of_a_test_is_not_told_where_the_lab_is(options):
    with Grader(PATIENT, **options) as lesser, Remote(Submission("lab.py", TELLS), lesser).fresh() as call:
        assert not call("solved")
        places = call("told") if options else call("frames")  # a sandbox has NumPy at its own place, which is sealed
        assert not [each for each in places if str(ROOT) in each]


@pytest.mark.slow
def test_without_a_sandbox_a_file_that_a_test_leaves_is_not_in_the_way_of_the_next():
    text = """
    import os
    def f():
        for name in ("json", "ast", "numpy", "labs"):
            with open(name + ".py", "w") as file:
                file.write("raise SystemExit")
        return sorted(os.listdir())
    """
    submission = Submission("lab.py", textwrap.dedent(text))
    with Grader(PATIENT, sandboxed=False) as lesser, Remote(submission, lesser) as remote:
        for _ in range(2):
            with remote.fresh() as call:
                assert call("f") == ["ast.py", "json.py", "labs.py", "numpy.py"]


@pytest.mark.skipif(os.name != "posix", reason="elsewhere nobody can ask whether a process is there")
def test_the_copies_of_a_grader_that_was_killed_are_removed(monkeypatch, tmp_path):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    left, used, other = (tmp_path / f"grading-apart-{name}" for name in (f"{ended.pid}-x", f"{os.getpid()}-y", "z-z"))
    for each in (left, used, other):
        (each / "code").mkdir(parents=True)
        (each / "code").chmod(0o500)
    made = worker_files.own_folder()
    assert sorted(tmp_path.iterdir()) == sorted([made, used, other])
    remove(used)
    assert not used.exists()


@pytest.mark.slow
def test_numpy_that_cannot_be_copied_is_used_where_it_is(monkeypatch, tmp_path):
    monkeypatch.setattr(worker_files, "_UNUSED", lambda folder, names: ["linalg"])
    assert not worker_files.lay_out_with_numpy(tmp_path)
    assert [each.name for each in tmp_path.iterdir()] == ["labs"]
    with Grader(PATIENT, sandboxed=False) as lesser, Remote(Submission("lab.py", NORM), lesser).fresh() as call:
        assert call("f") == 5


@pytest.mark.slow
def test_without_the_nursery_a_hang_or_a_death_costs_one_test():
    text = "import os, time\ndef hang(): time.sleep(600)\ndef die(): os._exit(3)\ndef f(): return 1"
    with Grader(Limits(call=0.3), sandboxed=False) as lesser:
        remote = Remote(Submission("lab.py", text), lesser)
        for name, error in (("hang", OutOfTime), ("die", ProcessDied)):
            with remote.fresh() as call, pytest.raises(error):
                call(name)
        with remote.fresh() as call:
            assert call("f") == 1


@linux
def test_no_process_outlives_its_test_even_if_it_may_fork():
    text = """
    import os, time
    def detach():
        reading, writing = os.pipe()
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                os.write(writing, str(os.getpid()).encode())
                time.sleep(600)
            os._exit(0)
        return int(os.read(reading, 20))
    """
    with Grader(PATIENT, without=("limits", "seccomp")) as lesser:
        with Remote(Submission("lab.py", textwrap.dedent(text)), lesser).fresh() as call:
            stray = call("detach")
            os.kill(stray, 0)  # it is there
        assert call.ended is not None  # which waits for the end of all that it started
        with pytest.raises(ProcessLookupError):
            os.kill(stray, 0)
        assert call.ended.strays >= 1


@linux
@pytest.mark.slow
def test_a_grader_survives_its_nursery_but_a_nursery_not_its_grader():
    with Grader(PATIENT) as own:
        remote = Remote(Submission("lab.py", "import os\ndef parent(): return os.getppid()"), own)
        with remote.fresh() as call:
            nursery = call("parent")
            os.kill(nursery, signal.SIGKILL)
            with pytest.raises(GraderFailed, match="nursery"):  # no fault of the submission's
                calls_until_it_fails(call, "parent")
        with remote.fresh() as call:
            another = call("parent")
            time.sleep(0.2)  # the process for the next test has said that it is ready
            os.kill(another, signal.SIGKILL)
            with pytest.raises(GraderFailed, match="nursery"):
                calls_until_it_fails(call, "parent")
            time.sleep(0.2)  # it has ended as well
        with remote.fresh() as call:
            third = call("parent")
        assert len({nursery, another, third}) == 3
    with pytest.raises(ProcessLookupError):
        os.kill(third, 0)


@linux
def test_the_process_for_the_next_test_is_ready_and_knows_nothing(of):
    remote = of("import time\ntime.sleep(0.3)\nseen = []\ndef f(x):\n    seen.append(x)\n    return len(seen)")
    with remote.fresh() as call:
        assert call("f", 7) == 1
        time.sleep(0.5)
    began = time.perf_counter()
    with remote.fresh() as call:
        assert call("f", 8) == 1
    assert time.perf_counter() - began < 0.3, "it loads while the test before it runs"
    remote.close()


@linux
def test_tests_leave_no_file_descriptor_open(of):
    before = len(os.listdir("/proc/self/fd"))
    with of("def f(): return 1") as remote:
        for _ in range(5):
            with remote.fresh() as call:
                call("f")
    assert len(os.listdir("/proc/self/fd")) == before


@linux
@pytest.mark.slow
def test_closing_a_submission_ends_all_its_processes():
    text = "import os, time\ndef process(): return os.getpid()\ndef busy(): time.sleep(60)"
    with Grader(Limits(call=0.2)) as own:
        processes = []
        with Remote(Submission("lab.py", text), own) as remote:
            for _ in range(36):  # more than the host leaves unheard
                with remote.fresh() as call:
                    processes.append(call("process"))
                    if len(processes) > 34:
                        with pytest.raises(StudentError):
                            call("busy")
        for process in processes:
            with pytest.raises(ProcessLookupError):
                os.kill(process, 0)


@linux
def test_a_process_that_ends_during_foreseen_calls_costs_its_test_alone(of):
    text = "import os\ndef f(x): return os._exit(3) if x > 1 else x"
    remote = of(text)
    with remote.fresh() as call:
        several = [(float(x),) for x in range(4)]
        call.foresee("f", several)
        assert [call("f", *several[0]), call("f", *several[1])] == [0.0, 1.0]
        for arguments in several[2:]:
            with pytest.raises(StudentError, match="exit code 3"):
                call("f", *arguments)
        call.foresee("f", several)
    with remote.fresh() as call:
        assert call("f", 1.0) == 1.0


@linux
def test_a_test_costs_a_fraction_of_starting_python_with_numpy(of):
    remote = of("def f(): return 1")
    took = []
    for _ in range(9):
        began = time.perf_counter()
        with remote.fresh() as call:
            call("f")
        took.append(time.perf_counter() - began)
    began = time.perf_counter()
    subprocess.run([sys.executable, "-I", "-c", "import numpy"], check=True)
    # The fork, the sealing and a call take some 8 ms where the import takes 100; on a busy machine both grow alike.
    assert statistics.median(took) < (time.perf_counter() - began) / 3
    assert call.ended is not None
    assert call.ended.memory < 60e6  # bytes: an interpreter with NumPy, most of it shared with the nursery
