"""The processor time of a run, in its last line: here, and in the seconds in which allowances are given.

Wall-clock time depends on what else the machine is doing; processor time hardly does. Each process that runs tests also
times a small workload, at its beginning and its end, beside everything else that runs then. What a run took is divided
by how many times as long that workload takes here as on the machine of the allowances.
"""

from __future__ import annotations

import os
import statistics
from typing import Any

import pytest

_SLOWNESS = "slowness"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option."""
    parser.addoption("--cpu-allowed", type=float, metavar="SECONDS", help="say what the run took, and of how much")


def pytest_configure(config: pytest.Config) -> None:
    """Measure where it is asked for, in every process of the run."""
    if config.getoption("--cpu-allowed"):
        config.pluginmanager.register(_Measurement(config))


class _Measurement:
    def __init__(self, config: pytest.Config) -> None:
        self._config, self._slowness = config, list[float]()
        self._runs_tests = hasattr(config, "workerinput") or not config.getoption("numprocesses", None)

    def pytest_sessionstart(self) -> None:
        self._time_workload()

    def _time_workload(self) -> None:
        if self._runs_tests:
            from reference.pace import slowness  # noqa: PLC0415  # with NumPy, which a run that shows help does without

            self._slowness.append(slowness())

    def pytest_sessionfinish(self) -> None:
        self._time_workload()
        if hasattr(self._config, "workeroutput"):
            self._config.workeroutput[_SLOWNESS] = self._slowness

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        self._slowness += getattr(node, "workeroutput", {}).get(_SLOWNESS, [])

    @pytest.hookimpl(trylast=True)
    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        used = sum(os.times()[:4])  # the workers have ended, and with them all that they started
        if self._slowness:
            slowness, allowed = statistics.mean(self._slowness), self._config.getoption("--cpu-allowed")
            terminalreporter.write_line(
                f"processor time: {used:.0f} s. This machine takes {slowness:.2f} times as long as the one of the"
                f" allowances: {used / slowness:.0f} s of {allowed:g} s allowed."
            )
