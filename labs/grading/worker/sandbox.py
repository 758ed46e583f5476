"""Shuts a test's process in before it sees the submission, as far as the system allows, and reports how far that is.

Each measure answers a threat that the others leave open:

- limits: endless loops (processor time), memory, full disks (no byte may be written to a file), fork bombs and
  threads left running (no further process or thread), core dumps of what is in memory;
- another user, if started as root: root is exempt from the limit on processes, and may read every file;
- no new privileges: a set-user-id program would undo all of it;
- Landlock and the filter of system calls: files, network, signals, other processes; see these modules;
- an empty current folder, no environment, and no descriptor except the two of this test and, if its user cannot
  reach Python's modules otherwise, those of their folders, in which Landlock lets it read the modules alone;
- a death signal: the process ends with the nursery, however that ended.

Any step may fail on some system. Then the tier is lower, and a line says what is missing. The process cannot switch off
any of these measures.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Collection
from dataclasses import dataclass

from labs.grading.worker import landlock, seccomp, system_calls
from labs.grading.worker.tier import Tier

if sys.platform == "linux":
    import resource

_DESCRIPTORS = 64
_SPARE_SECONDS = 2  # of processor time beyond the grader's own limit, which then speaks first and says more


@dataclass(frozen=True)
class Plan:
    """What a process is allowed.

    folder: its current one. user: the id that it gets if it is root. memory: bytes of address space. seconds: of
    processor time. without: measures to leave out, as on a system that lacks them.
    """

    folder: str
    user: int
    memory: int
    seconds: int
    without: Collection[str] = ()


@dataclass(frozen=True)
class Sealing:
    """How far a process is shut in, with a line for each measure that is missing.

    lacking: modules that the submission imports, and that this process can neither open nor has loaded.
    """

    tier: Tier
    missing: tuple[str, ...] = ()
    lacking: tuple[str, ...] = ()


def seal(plan: Plan, rules: int | None, offline: bool, parent: int) -> Sealing:
    """Shut in the process that calls this, for good.

    rules: of Landlock, what may be read. offline: whether it is in a network namespace without a network. parent: the
    nursery, with which it ends.
    """
    os.chdir(plan.folder)
    os.environ.clear()
    missing: list[str] = []

    def took(measure: str, step: Callable[[], object], otherwise: str) -> bool:
        try:
            if measure not in plan.without:
                step()
                return True
        except (OSError, ValueError, AttributeError):
            pass
        missing.append(otherwise)
        return False

    limited = took("limits", lambda: _limit(plan), "memory, time and processes are not limited")
    if os.geteuid() == 0:
        took("user", lambda: become(plan.user), "it runs as root")
    took("death", lambda: _end_with(parent), "it may outlive the nursery")
    took("privileges", lambda: system_calls.prctl(system_calls.NO_NEW_PRIVILEGES, 1), "set-user-id programs work")
    paths = took("landlock", lambda: landlock.restrict(rules), "no Landlock in this kernel")
    calls = took("seccomp", lambda: seccomp.restrict(files=paths), "no filter of system calls in this kernel")
    if not os.access(os.__file__, os.R_OK):
        missing.append("Python's own files cannot be opened: there are only the modules that were loaded before")
    if not (paths or calls):
        missing.append("what its user may open is open to it")
    if not calls:
        missing.append("other processes of its user, and sockets that lie in files, are within its reach")
    if not (calls or offline):
        missing.append("so is the network")
    return Sealing(reached(limited, paths or calls, calls), tuple(missing))


def reached(limited: bool, files: bool, network: bool) -> Tier:
    """The tier of a process that has certain measures."""
    if not limited:
        return Tier.PROCESS
    return Tier.LIMITS if not files else Tier.NETWORK if network else Tier.FILES


def _limit(plan: Plan) -> None:
    kinds = {
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_CPU: plan.seconds + _SPARE_SECONDS,
        resource.RLIMIT_AS: plan.memory,
        resource.RLIMIT_FSIZE: 0,
        resource.RLIMIT_NOFILE: _DESCRIPTORS,
        resource.RLIMIT_MEMLOCK: 0,
        resource.RLIMIT_MSGQUEUE: 0,
        resource.RLIMIT_NPROC: 0,
    }
    for kind, limit in kinds.items():
        hard = resource.getrlimit(kind)[1]
        allowed = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
        resource.setrlimit(kind, (allowed, allowed))
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # so that writing a file is an OSError with a line


def address_space() -> int:
    """Bytes of address space in use; if the system does not report it, more than NumPy has been seen to take."""
    try:
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[0]) * resource.getpagesize()
    except OSError:
        return 2**29


def become(user: int) -> None:
    """Make this process, which is root's, that user's for good."""
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)


def _end_with(parent: int) -> None:
    system_calls.prctl(system_calls.PARENT_DEATH_SIGNAL, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)
