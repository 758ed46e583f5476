"""Landlock: this process can open the files that it was given and no others, no matter which user it runs as.

Threat: reading the tests, the gradebook, /proc of the grader, other students' work; filling the disk; rewriting
results. Paths are opened before, as they may be where the dropped user cannot go. They are granted for reading only, so
that the process can write nowhere, not even in its own folder. TCP (from version 4 of the kernel's interface), abstract
sockets and signals to outside (from version 6) are denied as well. Landlock never covers UDP, and does not hide whether
a path exists. The filter of system calls covers both.
"""

from __future__ import annotations

import ctypes
import errno
import os
import stat
from collections.abc import Sequence

from labs.grading.worker import system_calls

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446  # the same numbers on every machine
_VERSION_OF_INTERFACE = 1
_PATH_BENEATH = 1

_EXECUTE, _READ_FILE, _READ_FOLDER = 1 << 0, 1 << 2, 1 << 3
_FILE_RIGHTS = {1: 13, 2: 14, 3: 15, 5: 16}  # version of the interface: how many kinds of access it knows
_TCP = 0b11  # bind and connect
_SCOPES = 0b11  # abstract sockets and signals


class _Ruleset(ctypes.Structure):
    _fields_ = (("files", ctypes.c_uint64), ("network", ctypes.c_uint64), ("scopes", ctypes.c_uint64))


class _PathBeneath(ctypes.Structure):
    _pack_ = 1
    _layout_ = "ms"
    _fields_ = (("allowed", ctypes.c_uint64), ("parent", ctypes.c_int32))


def version() -> int:
    """The version of the kernel's interface, or 0 if Landlock is missing or switched off."""
    try:
        return system_calls.syscall(_CREATE_RULESET, None, 0, _VERSION_OF_INTERFACE)
    except OSError:
        return 0


def ruleset(paths: Sequence[str]) -> int | None:
    """A descriptor of rules that allow reading those of the files and folders that exist; None without Landlock.

    It is made once, because opening the paths takes time, and every test's process gets the same rules.
    """
    known = version()
    if not known:
        return None
    files = (1 << max(count for since, count in _FILE_RIGHTS.items() if since <= known)) - 1
    rules = _Ruleset(files, _TCP if known >= 4 else 0, _SCOPES if known >= 6 else 0)
    size = 8 if known < 4 else 16 if known < 6 else 24
    made = system_calls.syscall(_CREATE_RULESET, ctypes.byref(rules), size, 0)
    for path in paths:
        if os.path.exists(path):
            _allow(made, path)
    return made


def restrict(rules: int | None) -> None:
    """Deny this process all files except those that the rules name; raises OSError if that is impossible.

    The process must have given up new privileges before.
    """
    if rules is None:
        raise OSError(errno.ENOSYS, os.strerror(errno.ENOSYS))
    system_calls.syscall(_RESTRICT_SELF, rules, 0)


def _allow(rules: int, path: str) -> None:
    descriptor = os.open(path, os.O_PATH | os.O_CLOEXEC)
    try:
        folder = stat.S_ISDIR(os.fstat(descriptor).st_mode)
        rule = _PathBeneath(_READ_FILE | _EXECUTE | (_READ_FOLDER if folder else 0), descriptor)
        system_calls.syscall(_ADD_RULE, rules, _PATH_BENEATH, ctypes.byref(rule), 0)
    finally:
        os.close(descriptor)
