"""The nursery: a bare process, with the standard library and NumPy only, that forks one process for every test.

Threat: a process forked from one that has loaded the tests carries them in its memory. The nursery is started on its
own and never sees a test, a call, or even the submission: the grader opens a pair of pipes for every test, hands them
over, and talks to the test's process directly. Other processes cannot look into the nursery (it is not dumpable), and
it takes in every orphan below it (it is a subreaper). It reports that a test has ended only when no process of that
test is left, and no result is written before all these reports. When the grader is gone, the control socket ends, and
the nursery and all tests end with it.

The nursery also saves time: a fork takes milliseconds, while a fresh interpreter would load NumPy again for every test.
"""

from __future__ import annotations

import contextlib
import gc
import json
import os
import signal
import socket
import sys
import time
from typing import Any

import numpy as np

from labs.grading.worker import landlock, preloading, sandbox, seccomp, serving, system_calls
from labs.grading.worker.folders import remove

_PATIENCE = 5.0  # s for the processes of a test to be gone


def main() -> None:
    """Answer the grader on the socket whose number is the argument; it says first what to leave out, whom to become."""
    control = socket.socket(fileno=int(sys.argv[1]))
    without, user = json.loads(control.recv(2**16))
    rules = landlock.ruleset(preloading.prepare())
    held = _reach_modules(user, "user" not in without, rules is not None and "landlock" not in without)
    with contextlib.suppress(OSError):
        system_calls.prctl(system_calls.CHILD_SUBREAPER, 1)
    with contextlib.suppress(OSError):
        system_calls.prctl(system_calls.SET_DUMPABLE, 0)
    offline = ("seccomp" in without or not seccomp.available()) and "namespace" not in without and leave_network()
    gc.collect()
    gc.freeze()  # memory that is shared with the tests' processes stays shared
    Nursery(control, rules, held, offline).run()
    remove(os.getcwd())  # the grader does so, unless it was killed


def _reach_modules(user: int, becomes: bool, landlocked: bool) -> list[int]:
    """See to it that tests' processes have Python's modules; returns descriptors of folders that they need for that."""
    held: list[int] = []
    if landlocked and becomes and not preloading.files_open_to(user):
        held = preloading.hold_folders()
    if not landlocked or (becomes and not preloading.files_open_to(user)):
        preloading.prepare_for_closed_files()
    return held


def leave_network() -> bool:
    """Move into a network namespace of our own, which has no network; returns whether that worked."""
    for namespaces in (
        system_calls.NEW_NETWORK_NAMESPACE,
        system_calls.NEW_USER_NAMESPACE | system_calls.NEW_NETWORK_NAMESPACE,
    ):
        with contextlib.suppress(OSError):
            system_calls.unshare(namespaces)
            return True
    return False


class Nursery:
    """Forks and ends the tests' processes.

    control: the grader's socket. rules, offline: as in `seal`. held: the folders of modules that stay open.
    """

    def __init__(self, control: socket.socket, rules: int | None, held: list[int], offline: bool) -> None:
        self._control, self._rules, self._held, self._offline = control, rules, held, offline
        self._own_space = sandbox.address_space()  # a test's memory is the space that it takes beyond this
        self._processes: dict[int, int] = {}  # of every living test, by its number
        self._folders: dict[int, str] = {}

    def run(self) -> None:
        """Answer requests in turn until the grader hangs up, or until it is gone when an answer is sent."""
        with contextlib.suppress(ConnectionError):
            while self._answer():
                pass
        for test in list(self._processes):
            self._end(test)

    def _answer(self) -> bool:
        """Answer the next request; False if there are no more."""
        request, descriptors, _, _ = socket.recv_fds(self._control, 2**16, 2)
        if not request:
            return False
        wanted = json.loads(request)
        if "start" in wanted:
            self._start(wanted["start"], wanted["plan"], descriptors)
        else:
            self._control.send(json.dumps(self._end(wanted["end"])).encode())
        return True

    def _start(self, test: int, wanted: dict[str, Any], descriptors: list[int]) -> None:
        plan = sandbox.Plan(**wanted | {"memory": wanted["memory"] + self._own_space})
        os.mkdir(plan.folder, 0o555)
        parent = os.getpid()
        process = os.fork()
        if process == 0:
            self._become_test(plan, (descriptors[0], descriptors[1]), parent)
        for descriptor in descriptors:
            os.close(descriptor)
        self._processes[test], self._folders[test] = process, plan.folder

    def _become_test(self, plan: sandbox.Plan, pipes: tuple[int, int], parent: int) -> None:
        """Become the test, in the forked process; never returns."""
        try:
            os.setsid()
            np.random.seed()  # noqa: NPY002 - otherwise all processes would draw the same numbers, and drawn answers would seem steady
            serving.hush({*pipes, *self._held} if self._rules is None else {*pipes, *self._held, self._rules})
            sealing = sandbox.seal(plan, self._rules, self._offline, parent)
            if self._rules is not None:
                os.close(self._rules)
            serving.serve(*pipes, sealing)
        except BaseException:
            os._exit(serving.FAILED)
        finally:
            os._exit(0)

    def _end(self, test: int) -> dict[str, Any]:
        """Kill the test's process and every stray; returns how it ended and what it used."""
        process, folder = self._processes.pop(test), self._folders.pop(test)
        for kill in (os.killpg, os.kill):
            with contextlib.suppress(OSError):
                kill(process, signal.SIGKILL)
        _, status, used = os.wait4(process, 0)
        strays = self._kill_strays()
        remove(folder)
        seconds = used.ru_utime + used.ru_stime
        return {"status": status, "seconds": seconds, "memory": used.ru_maxrss * 1024, "strays": strays}

    def _kill_strays(self) -> int:
        """Kill all processes below this one that belong to no living test, such as orphans; returns how many."""
        killed: set[int] = set()
        until = time.monotonic() + _PATIENCE
        while strays := _children() - set(self._processes.values()):
            for process in strays:
                with contextlib.suppress(OSError):
                    os.kill(process, signal.SIGKILL)
                    killed.add(process)
                with contextlib.suppress(OSError):
                    os.waitpid(process, os.WNOHANG)
            if time.monotonic() > until:
                break
        return len(killed)


def _children() -> set[int]:
    """The processes directly below this one, as far as the system reports them."""
    try:
        with open(f"/proc/self/task/{os.getpid()}/children", encoding="ascii") as file:
            return {int(word) for word in file.read().split()}
    except OSError:  # a kernel without that file
        return {process for process in _processes() if _parent(process) == os.getpid()}


def _processes() -> list[int]:
    return [int(name) for name in os.listdir("/proc") if name.isdigit()] if os.path.isdir("/proc") else []


def _parent(process: int) -> int | None:
    with contextlib.suppress(OSError, ValueError), open(f"/proc/{process}/stat", "rb") as file:
        return int(file.read().rpartition(b")")[2].split()[1])
    return None
