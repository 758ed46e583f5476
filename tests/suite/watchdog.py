"""A run of the tests ends by itself: when a worker process dies, and when a time limit has passed.

pytest-xdist replaces a worker that died. With `--dist loadfile` the new one gets a single file; it holds back the last
test it was given until it hears of another one, and if there is no other it waits for ever. Here the run ends instead
and names the test that was running. `--run-limit=SECONDS` limits the run as a whole, whatever it is waiting for.
"""

from __future__ import annotations

import _thread
import os
import signal
import threading
from typing import Any

import pytest

GRACE = 60.0  # s for the ordinary end of an interrupted run, with its summary; xdist gives its workers 10 s of them
_CRASHED = "???"  # instead of setup, call and teardown, in xdist's own report of a test in which a worker died
_EXIT_CODE = 124  # as of the program `timeout`


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option; the limit on a single test is pytest-timeout's."""
    group = parser.getgroup("watchdog")
    group.addoption("--run-limit", type=float, metavar="SECONDS", help="end the whole run after this time")


def pytest_configure(config: pytest.Config) -> None:
    """Watch from the process that leads the run; its workers are what is watched."""
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(_Watchdog(config.getoption("--run-limit")))


class _Watchdog:
    """Knows which tests are running, and ends the run."""

    def __init__(self, limit: float | None) -> None:
        self._limit = limit
        self._stderr = os.dup(2)  # during a test, 2 itself is a file that pytest may never show
        self._running: dict[str, None] = {}
        self._workers: list[Any] = []
        self._lost = ""
        self._over = False
        self._finished = threading.Event()

    def pytest_sessionstart(self) -> None:
        if self._limit is not None:
            if hasattr(signal, "SIGUSR1"):
                signal.signal(signal.SIGUSR1, signal.default_int_handler)
            threading.Thread(target=self._wait, args=(self._limit,), daemon=True).start()

    def _wait(self, limit: float) -> None:
        if self._finished.wait(limit):
            return
        self._over = True
        if hasattr(signal, "SIGUSR1"):
            # Unlike `interrupt_main`, a signal ends a system call. A shell makes SIGINT ineffective in the background.
            signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGUSR1)
        else:
            _thread.interrupt_main()
        if not self._finished.wait(GRACE):  # code that is not Python's may never notice an interrupt
            os.write(self._stderr, f"\n{self._message()}\n".encode())
            os._exit(_EXIT_CODE)

    def _message(self) -> str:
        running = "".join(f"\n  {test}" for test in self._running) or " none"
        return f"The run took longer than {self._limit:g} s and was ended. Tests that were running:{running}"

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        self._running[nodeid] = None

    def pytest_runtest_logfinish(self, nodeid: str) -> None:
        self._running.pop(nodeid, None)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodeready(self, node: Any) -> None:
        self._workers.append(node)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any, error: object) -> None:
        if error:
            self._lost = node.gateway.id
            if not self._running:
                self._give_up("before or after the tests")

    @pytest.hookimpl(trylast=True)
    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if self._lost:  # the next report is that of the test in which it died, unless it died between two tests
            self._give_up(f"in {report.nodeid}" if report.when == _CRASHED else "between two tests")

    def _give_up(self, when: str) -> None:
        for worker in self._workers:
            worker.shutdown()  # one that is idle ends now, any other is killed a little later
        pytest.exit(f"test worker {self._lost} died {when}", returncode=pytest.ExitCode.TESTS_FAILED)

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        self._finished.set()
        if self._over:
            session.exitstatus = _EXIT_CODE

    def pytest_unconfigure(self) -> None:
        os.close(self._stderr)

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        if self._over:
            terminalreporter.write_line(self._message(), red=True)
