"""Linux system calls that Python does not offer, through the C library."""

from __future__ import annotations

import ctypes
import os
from functools import cache

SET_DUMPABLE, GET_DUMPABLE = 4, 3
PARENT_DEATH_SIGNAL = 1
SET_SECCOMP, SECCOMP_FILTER = 22, 2
CHILD_SUBREAPER = 36
NO_NEW_PRIVILEGES = 38
"""Options of prctl."""
NEW_USER_NAMESPACE, NEW_NETWORK_NAMESPACE = 0x10000000, 0x40000000
"""Flags of unshare."""


@cache
def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None, use_errno=True)


def prctl(option: int, value: object = 0, address: object = 0) -> int:
    """Set or read an attribute of this process; raises OSError where the kernel refuses."""
    unsigned = ctypes.c_ulong
    third = address if not isinstance(address, int) else unsigned(address)
    return _checked(_libc().prctl(option, unsigned(value), third, unsigned(0), unsigned(0)))  # type: ignore[arg-type]


def syscall(number: int, *arguments: object) -> int:
    """Make a system call by its number; integers are passed as longs. Raises OSError where the kernel refuses."""
    passed = [ctypes.c_long(each) if isinstance(each, int) else each for each in arguments]
    return _checked(_libc().syscall(ctypes.c_long(number), *passed))


def unshare(namespaces: int) -> None:
    """Leave the namespaces; raises OSError where the kernel refuses."""
    _checked(_libc().unshare(ctypes.c_int(namespaces)))


def _checked(answer: int) -> int:
    if answer < 0:
        code = ctypes.get_errno()
        raise OSError(code, os.strerror(code))
    return answer
