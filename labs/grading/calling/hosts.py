"""The hosts of tests' processes: the nursery on Linux, elsewhere an interpreter for each test.

Threat: what a test's process could learn or damage on our side. We talk to the nursery on a socket of its own, which no
test's process holds. The nursery is started with no environment and no descriptor of ours. While it is open, other
processes of the same user cannot look into this one.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import weakref
from collections import deque
from collections.abc import Callable, Collection, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import IO

if sys.platform == "linux":
    import fcntl

from labs.grading.calling import worker_files
from labs.grading.calling.processes import LOST, Ended, Limits, Process
from labs.grading.errors import GraderFailed
from labs.grading.worker import landlock, seccomp, system_calls
from labs.grading.worker.folders import remove
from labs.grading.worker.sandbox import Plan, reached
from labs.grading.worker.tier import Tier

MEASURES = ("limits", "user", "death", "privileges", "landlock", "seccomp", "namespace")
"""The measures of the sandbox that can be left out, to see what the others are worth."""

_START = "import os, sys; sys.path[:0] = [os.path.abspath({1!r}){2}]; from labs.grading.worker import {0}; {0}.main()"
"""{0}: what runs. {1}: the folder of its code, seen from the current one (`worker_files`). {2}: NumPy's, if another."""
_SOCKET_SAYS = ", os.read(int(sys.argv[1]), 2**16).decode()"
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
_PATIENCE = 30.0  # s for the nursery, which nothing untrusted can keep waiting
_PIPE = 2**18  # bytes that a process's pipe holds: its text and code, so that we need not wait until it reads them
_UNHEARD = 32  # reports of ended processes that may wait in the nursery's socket, which holds some hundreds


class NurseryHost:
    """Has tests' processes forked by the nursery, and starts another nursery if that one dies."""

    def __init__(self, user: int, without: Collection[str] = ()) -> None:
        self._user, self._without = user, tuple(without)
        self._lock = threading.Lock()
        self._started = 0  # processes so far, in all nurseries; each has its own number
        self._dying: deque[Process] = deque()  # the nursery was told to end them, and has not reported that yet
        self._clear: Callable[[], object] = lambda: None
        calls = "seccomp" not in without and seccomp.available()
        files = "landlock" not in without and landlock.version() > 0
        self.most = reached("limits" not in without, files or calls, calls)
        _hide(self)
        try:
            self._open()
        except BaseException:
            self._clear()
            _show(self)
            raise

    def _open(self) -> None:
        """Start a nursery with code of its own: without the sandbox, tests may have changed that of the one before."""
        self._folder = tempfile.mkdtemp(prefix="grading-")
        self._clear = weakref.finalize(self, remove, self._folder)
        worker_files.lay_out(Path(self._folder, worker_files.CODE))
        self._forked: set[int] = set()  # numbers of this nursery's processes; all others died with an earlier nursery
        self._control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._control.settimeout(_PATIENCE)
        start = _START.format("nursery", worker_files.CODE, _SOCKET_SAYS)
        command = [worker_files.interpreter(), *worker_files.OPTIONS, start, str(theirs.fileno())]
        self._control.send(worker_files.PACKAGES.encode())
        self._control.send(json.dumps([self._without, self._user]).encode())
        self._said = tempfile.TemporaryFile()  # noqa: SIM115 - without a name, so that no test can replace it
        with theirs, _started(self._control, self._said):
            self._process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=self._said,
                pass_fds=[theirs.fileno()], env=dict.fromkeys(_THREADS, "1"), cwd=self._folder, start_new_session=True,
            )  # fmt: skip

    def start(self, limits: Limits) -> Process:
        """Have a process forked, without waiting for it; raises `GraderFailed` if no nursery answers."""
        with self._lock:
            if self._process.poll() is None:
                with contextlib.suppress(OSError):  # it is about to end
                    return self._start(limits)
            self._stop()
            self._open()
            try:
                return self._start(limits)
            except OSError:
                raise GraderFailed(f"the grader's nursery does not answer: {self._log()}") from None

    def _start(self, limits: Limits) -> Process:
        self._started += 1
        number = self._started
        folder = str(Path(self._folder, str(number)))
        plan = Plan(folder, self._user, limits.memory, int(limits.test) + 1, self._without)
        (their_requests, requests), (answers, their_answers) = os.pipe(), os.pipe()
        with contextlib.suppress(OSError):  # one user's pipes may hold so much and no more
            fcntl.fcntl(requests, fcntl.F_SETPIPE_SZ, _PIPE)
        try:
            self._ask({"start": number, "plan": asdict(plan)}, [their_requests, their_answers])
        except OSError:
            os.close(requests)
            os.close(answers)
            raise
        finally:
            os.close(their_requests)
            os.close(their_answers)
        self._forked.add(number)
        return Process(number, requests, answers, self)

    def end(self, process: Process) -> None:
        """Have the nursery kill the process and its descendants, without waiting for it."""
        with self._lock:
            if self._told_to_end(process):
                self._dying.append(process)
            else:
                process.outcome = LOST
            while len(self._dying) > _UNHEARD:
                self._hear()

    def _told_to_end(self, process: Process) -> bool:
        """Tell the nursery to end a process; False if that nursery is gone, and the process with it."""
        if process.number not in self._forked:
            return False
        try:
            self._ask({"end": process.number}, [])
        except OSError:
            return False
        return True

    def wait(self, process: Process | None = None) -> None:
        """Wait until nothing is left of the process, or of any that was ended."""
        with self._lock:
            while self._dying and (process is None or process.outcome is None):
                self._hear()

    def has_lost(self, process: Process) -> bool:
        """Whether the process died with its nursery, or is about to."""
        return process.number not in self._forked or self._process.poll() is not None

    def close(self) -> None:
        """Stop the nursery and what is left of its tests."""
        with self._lock:
            self._stop()
            _show(self)

    def _ask(self, request: dict[str, object], descriptors: list[int]) -> None:
        socket.send_fds(self._control, [json.dumps(request).encode()], descriptors)

    def _hear(self) -> None:
        """Read what the nursery reports of the next process that it ended: it keeps the order of the requests."""
        process = self._dying.popleft()
        try:
            said = json.loads(self._control.recv(2**16))
        except (OSError, ValueError):  # the nursery is gone, or stuck: later reports would answer no request
            self._process.kill()
            self._process.wait()
            for each in (process, *self._dying):
                each.outcome = LOST
            self._dying.clear()
        else:
            code = os.waitstatus_to_exitcode(said["status"])
            process.outcome = Ended(code, said["seconds"], said["memory"], said["strays"])

    def _log(self) -> str:
        log = os.pread(self._said.fileno(), 2**16, 0).decode(errors="replace")
        return log.strip()[-300:] or "it has ended"

    def _stop(self) -> None:
        while self._dying:
            self._hear()
        self._control.close()
        try:
            self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._said.close()
        self._clear()


class LoneHost:
    """Starts a fresh interpreter for each test, on systems without a sandbox, each in an empty folder of its own.

    Nothing keeps a submission from the code that it runs. So the code is copied again for each submission: whenever a
    process is to be started and no other runs.
    """

    most = Tier.PROCESS

    def __init__(self) -> None:
        self._clear: Callable[[], object] = lambda: None
        self._running: dict[int, tuple[subprocess.Popen[bytes], str]] = {}
        _hide(self)

    def _lay_out(self) -> None:
        self._clear()
        self._folder = worker_files.own_folder()
        self._clear = weakref.finalize(self, remove, self._folder)
        copied = worker_files.lay_out_with_numpy(self._folder / worker_files.CODE)
        code, numpy = os.path.join("..", worker_files.CODE), "" if copied else f", {worker_files.PACKAGES!r}"
        self._command = [worker_files.interpreter(), *worker_files.OPTIONS, _START.format("lone_process", code, numpy)]

    def start(self, limits: Limits) -> Process:
        """Start an interpreter; raises `GraderFailed` if that is impossible."""
        with _started():
            return self._start()

    def _start(self) -> Process:
        if not self._running:
            self._lay_out()
        place = tempfile.mkdtemp(dir=self._folder)
        kept = {name: os.environ[name] for name in ("SYSTEMROOT",) if name in os.environ}  # Windows needs it
        running = subprocess.Popen(
            self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=place,
            env=kept | dict.fromkeys(_THREADS, "1"), start_new_session=True, bufsize=0,
        )  # fmt: skip
        self._running[running.pid] = running, place
        assert running.stdin is not None
        assert running.stdout is not None
        pipes = [os.dup(stream.fileno()) for stream in (running.stdin, running.stdout)]
        running.stdin.close()
        running.stdout.close()
        return Process(running.pid, pipes[0], pipes[1], self)

    def end(self, process: Process) -> None:
        """Kill it, and on POSIX its session."""
        if process.outcome is None:
            process.outcome = Ended(self._kill(*self._running.pop(process.number)))

    def wait(self, process: Process | None = None) -> None:
        """Nothing to wait for: what is killed is waited for at once."""

    def has_lost(self, process: Process) -> bool:
        """Never: each has a life of its own."""
        return False

    def _kill(self, running: subprocess.Popen[bytes], place: str) -> int:
        with contextlib.suppress(OSError):
            if os.name == "posix":
                os.killpg(running.pid, signal.SIGKILL)
            running.kill()
        code = running.wait()
        remove(place)
        return code

    def close(self) -> None:
        """End what runs."""
        for running in self._running.values():
            self._kill(*running)
        self._clear()
        _show(self)


@contextlib.contextmanager
def _started(*opened: socket.socket | IO[bytes]) -> Iterator[None]:
    """Turn an interpreter that cannot be started into an error of the grader. opened: to be closed in that case."""
    try:
        yield
    except OSError as error:
        for each in opened:
            each.close()
        raise GraderFailed(
            f"the grader cannot start Python ({worker_files.interpreter()}): {error.strerror or error}"
        ) from None


_hiding: weakref.WeakSet[NurseryHost | LoneHost] = weakref.WeakSet()
"""The open hosts, if other processes of this user could look into this one before the first was opened."""


def _hide(host: NurseryHost | LoneHost) -> None:
    """Keep other processes of this user from looking into this one, until the last host is closed."""
    with contextlib.suppress(OSError, AttributeError):  # only Linux has it
        if _hiding or system_calls.prctl(system_calls.GET_DUMPABLE) == 1:
            system_calls.prctl(system_calls.SET_DUMPABLE, 0)
            _hiding.add(host)


def _show(host: NurseryHost | LoneHost) -> None:
    if host in _hiding:
        _hiding.remove(host)
        if not _hiding:
            system_calls.prctl(system_calls.SET_DUMPABLE, 1)
