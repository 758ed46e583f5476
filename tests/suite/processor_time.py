"""Processor time of every test, with that of the processes it starts, summed per folder at the end of a run.

Wall-clock time depends on what else the machine is doing; processor time hardly does, so budgets are given in it. Each
test is charged with everything its process and that process's descendants have used since the test before it ended.
`--cpu-report=FILE` also writes the numbers of every single test. Called with such files, this module prints them side
by side:

    python tests/suite/processor_time.py test.json verify.json

Allowances are in the seconds of one machine. So each process that runs tests also times a small workload, at its
beginning and its end, beside whatever else runs then; what a run took is divided by how many times as long that takes
here as there.
"""

from __future__ import annotations

import json
import os
import statistics
import sys
import time
from collections import Counter
from collections.abc import Generator, Iterator
from pathlib import Path, PurePosixPath
from typing import Any

import pytest

_TEST = "processor_time"  # the property of a report that carries the seconds of its test to the controlling process
_COLLECTION = "collection_processor_time"
_SLOWNESS = "times_as_slow_as_the_machine_of_the_allowances"
_VERSION = 2


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options. Write `--cpu-report=FILE` with its sign: pytest reads a separate FILE as a test to run."""
    group = parser.getgroup("processor time")
    group.addoption("--cpu-report", type=Path, metavar="FILE", help="write processor time per test into a JSON file")
    group.addoption("--cpu-allowed", type=float, metavar="SECONDS", help="the processor time that a run may take")


def pytest_configure(config: pytest.Config) -> None:
    """Measure in every process of the run."""
    config.pluginmanager.register(_Measurement(config))


class _Measurement:
    """What one process of a run measures; the one that writes the summary also collects what the others measured."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        self._reading = 0.0
        self._collection = 0.0
        self._tests: Counter[str] = Counter()
        self._slowness: list[float] = []
        wanted = config.getoption("--cpu-report") or config.getoption("--cpu-allowed")
        runs_tests = hasattr(config, "workerinput") or not config.getoption("numprocesses", None)
        self._times_workload = bool(wanted and runs_tests)

    def pytest_sessionstart(self) -> None:
        self._time_workload()

    def _time_workload(self) -> None:
        if self._times_workload:
            from reference.pace import slowness  # noqa: PLC0415  # with NumPy, which few runs of these plugins need

            self._slowness.append(slowness())

    def pytest_collection_finish(self) -> None:
        self._collection = self._reading = used()

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_makereport(
        self, call: pytest.CallInfo[None]
    ) -> Generator[None, pytest.TestReport, pytest.TestReport]:
        report = yield
        if call.when == "teardown":  # the last of the three reports of a test
            before, self._reading = self._reading, used()
            # A killed process takes along the time of children that it has not waited for, so the sum may shrink.
            report.user_properties.append((_TEST, max(self._reading - before, 0.0)))
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.when == "teardown":
            self._tests[report.nodeid] += dict(report.user_properties).get(_TEST, 0.0)

    def pytest_sessionfinish(self) -> None:
        self._time_workload()
        if hasattr(self._config, "workeroutput"):
            self._config.workeroutput |= {_COLLECTION: self._collection, _SLOWNESS: self._slowness}

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        told = getattr(node, "workeroutput", {})
        self._collection += told.get(_COLLECTION, 0.0)
        self._slowness += told.get(_SLOWNESS, [])

    @pytest.hookimpl(trylast=True)  # hypothesis takes most of a second for its own summary
    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        report = self._report()
        if path := self._config.getoption("--cpu-report"):
            path.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
        if self._tests and self._config.get_verbosity() >= 0:
            terminalreporter.write_line(line_of(report))

    def _report(self) -> dict[str, Any]:
        folders: Counter[str] = Counter()
        for test, seconds in self._tests.items():
            folders[_folder(test)] += seconds
        of_tests = sum(self._tests.values()) + self._collection
        rest = max(used() - of_tests, 0.0)  # the workers have ended, so this includes how they started and stopped
        return {
            "version": _VERSION,
            "allowed": self._config.getoption("--cpu-allowed"),
            "total": of_tests + rest,
            "slowness": round(statistics.mean(self._slowness), 3) if self._slowness else None,
            "folders": dict(sorted(folders.items())) | {"collection": self._collection, "pytest itself": rest},
            "tests": {test: round(seconds, 4) for test, seconds in self._tests.most_common()},
        }


def _folder(test: str) -> str:
    """`tests/labs` for everything below that folder, `tests` for a file directly in it, `.` for one outside."""
    return "/".join(PurePosixPath(test.partition("::")[0]).parent.parts[:2]) or "."


def used() -> float:
    """Processor time of this process and of all that it has started, ended or not, s.

    Children that are still running are seen on Linux alone. Elsewhere they count when they have ended.
    """
    times = os.times()  # in hundredths of a second; ended children first, so that none can be counted twice
    ended = times.children_user + times.children_system
    return time.process_time() + ended + sum(_seconds(child) for child in _descendants("self"))


def _descendants(process: str) -> Iterator[str]:
    try:
        threads = os.listdir(f"/proc/{process}/task")
        lists = [Path(f"/proc/{process}/task/{thread}/children").read_text() for thread in threads]
    except OSError:  # it has just ended, or this is not Linux
        return
    for child in " ".join(lists).split():
        yield child
        yield from _descendants(child)


def _seconds(process: str) -> float:
    """What a process and those of its children that it has waited for have used."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")  # utime, stime, cutime, cstime


def line_of(report: dict[str, Any]) -> str:
    """The time of each folder, and of the run, in a line; last, in the seconds in which allowances are given."""
    folders = ", ".join(f"{folder} {seconds:.1f} s" for folder, seconds in report["folders"].items())
    line = f"processor time: {folders}; in all {report['total']:.1f} s"
    if not report["slowness"]:
        return line
    allowed = f" of {report['allowed']:g} s allowed" if report["allowed"] else ""
    here = f"This machine takes {report['slowness']:.2f} times as long as the one of the allowances"
    return f"{line}. {here}: {_comparable(report):.1f} s{allowed}."


def _comparable(report: dict[str, Any]) -> float:
    """What the run would have taken on the machine of the allowances, s."""
    return float(report["total"]) / (report["slowness"] or 1.0)


def table_of(reports: dict[str, dict[str, Any]]) -> str:
    """The same of several runs, a column each."""
    folders = dict.fromkeys(folder for report in reports.values() for folder in report["folders"])
    rows = [["processor time, s", *reports]]
    for folder in sorted(folders, key=lambda name: (not name.startswith("tests"), name)):
        rows.append([folder, *(f"{report['folders'].get(folder, 0.0):.1f}" for report in reports.values())])
    rows.append(["in all", *(f"{report['total']:.1f}" for report in reports.values())])
    if all(report["slowness"] for report in reports.values()):
        rows.append(["times as slow", *(f"{report['slowness']:.2f}" for report in reports.values())])
        rows.append(["comparable", *(f"{_comparable(report):.1f}" for report in reports.values())])
    allowed = [report["allowed"] for report in reports.values()]
    if any(allowed):
        rows.append(["allowed", *(f"{seconds:g}" if seconds else "" for seconds in allowed)])
    width = max(len(row[0]) for row in rows)
    return "\n".join(row[0].ljust(width) + "".join(cell.rjust(10) for cell in row[1:]) for row in rows)


if __name__ == "__main__":
    files = [Path(name) for name in sys.argv[1:]]
    print(table_of({file.stem: json.loads(file.read_text(encoding="utf-8")) for file in files}))
