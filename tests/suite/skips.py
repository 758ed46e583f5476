"""What may be skipped: with `--skips=FILE`, a run fails if it skips a test for a reason that is not in that file.

On the machine that checks every change, all engines and all packages to compare with are installed. A skip there means
that something is no longer tested.
"""

from __future__ import annotations

import fnmatch
from pathlib import Path

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option."""
    parser.addoption("--skips", type=Path, metavar="FILE", help="fail at a skip for a reason that is not in the file")


def pytest_configure(config: pytest.Config) -> None:
    """Listen in the process that leads the run."""
    path = config.getoption("--skips")
    if path and not hasattr(config, "workerinput"):
        lines = path.read_text(encoding="utf-8").splitlines()
        config.pluginmanager.register(_Skips([line for line in lines if line and not line.startswith("#")]))


class _Skips:
    """allowed: reasons, in which `*` stands for anything."""

    def __init__(self, allowed: list[str]) -> None:
        self._allowed, self._others = allowed, dict[str, str]()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self._look_at(report)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        self._look_at(report)

    def _look_at(self, report: pytest.TestReport | pytest.CollectReport) -> None:
        if report.skipped and not hasattr(report, "wasxfail"):
            reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
            reason = reason.removeprefix("Skipped: ")
            if not any(fnmatch.fnmatchcase(reason, each) for each in self._allowed):
                self._others.setdefault(reason, report.nodeid)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        fine = pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED
        if self._others and session.exitstatus in fine:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        for reason, test in self._others.items():
            terminalreporter.write_line(f"This skip is not in the list of skips: {reason}, in {test}", red=True)
