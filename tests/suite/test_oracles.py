"""A package to compare with is tried before a test uses it."""

from __future__ import annotations

import importlib.util
import os

import numpy as np
import oracles
import pytest
from oracles import TRIALS, oracle


@pytest.fixture
def trial_of_numpy(monkeypatch, tmp_path):
    """Set what is called to try NumPy, and forget what was found afterwards."""
    monkeypatch.setenv("COLLISIONS_ORACLES", str(tmp_path))
    oracles.reason_to_skip.cache_clear()
    yield lambda code: monkeypatch.setitem(TRIALS, "numpy", code)
    oracles.reason_to_skip.cache_clear()


@pytest.mark.skipif(os.name != "posix", reason="signals are named on POSIX alone")
def test_a_package_that_crashes_is_skipped_with_its_version_and_the_signal(trial_of_numpy):
    trial_of_numpy("import os, signal\nos.kill(os.getpid(), signal.SIGILL)")
    with pytest.raises(pytest.skip.Exception, match=rf"^numpy {np.__version__} does not run .* ended by SIGILL$"):
        oracle("numpy.linalg")


def test_a_package_that_hangs_is_skipped(trial_of_numpy, monkeypatch):
    trial_of_numpy("import time\ntime.sleep(60)")
    monkeypatch.setattr(oracles, "LIMIT", 0.3)
    with pytest.raises(pytest.skip.Exception, match=r"had not ended after 0\.3 s$"):
        oracle("numpy")


def test_a_package_that_raises_an_exception_is_left_to_the_test(trial_of_numpy):
    trial_of_numpy("raise ValueError")
    assert oracle("numpy.linalg") is np.linalg


def test_a_package_is_tried_once_in_all_processes_of_a_run(trial_of_numpy):
    trial_of_numpy("")
    assert oracle("numpy") is np
    trial_of_numpy("import os\nos.abort()")
    oracles.reason_to_skip.cache_clear()  # as in another process
    assert oracle("numpy") is np


def test_a_package_that_is_not_installed_is_skipped():
    with pytest.raises(pytest.skip.Exception, match="could not import 'no_such_package'"):
        oracle("no_such_package")


@pytest.mark.slow
@pytest.mark.parametrize("package", TRIALS)
def test_every_trial_runs_to_its_end(package):
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
    if reason := oracles.reason_to_skip(package):
        pytest.skip(reason)
    assert oracles.exit_code_of_trial(package) == 0
