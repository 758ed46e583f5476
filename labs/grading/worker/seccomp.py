"""A filter of system calls: the calls that computing needs are allowed, and all others answer "not permitted".

Threat: sockets of every kind, processes and threads, signals to others, ptrace and process_vm_*, other processes'
limits, mounts, keys, bpf, perf, io_uring, namespaces, and everything that a later kernel adds. The filter lists the
allowed calls, so nobody has to think of a call for it to be denied. A denied call is an error and does not kill: Python
makes it a PermissionError with the student's own line. Files open for reading only, because before Linux 6.2 Landlock
lets a file be emptied that may be read. If Landlock is missing, the filter denies opening files as well; modules that
were imported before still work.
"""

from __future__ import annotations

import ctypes
import errno
import os
import struct
from functools import cache

from labs.grading.worker import system_calls

_CALLS = {  # name: its number on x86-64 and on 64-bit ARM, None where that machine has another call for it
    "read": (0, 63), "write": (1, 64), "close": (3, 57), "fstat": (5, 80), "poll": (7, None), "lseek": (8, 62),
    "mmap": (9, 222), "mprotect": (10, 226), "munmap": (11, 215), "brk": (12, 214), "rt_sigaction": (13, 134),
    "rt_sigprocmask": (14, 135), "rt_sigreturn": (15, 139), "pread64": (17, 67), "readv": (19, 65),
    "writev": (20, 66), "select": (23, None), "sched_yield": (24, 124), "mremap": (25, 216), "madvise": (28, 233),
    "dup": (32, 23), "dup2": (33, None), "nanosleep": (35, 101), "getpid": (39, 172), "exit": (60, 93),
    "uname": (63, 160), "getcwd": (79, 17), "gettimeofday": (96, 169), "getrusage": (98, 165), "times": (100, 153),
    "getuid": (102, 174), "getgid": (104, 176), "geteuid": (107, 175), "getegid": (108, 177), "getppid": (110, 173),
    "sigaltstack": (131, 132), "gettid": (186, 178), "time": (201, None), "futex": (202, 98),
    "sched_getaffinity": (204, 123), "getdents64": (217, 61), "restart_syscall": (219, 128),
    "clock_gettime": (228, 113), "clock_getres": (229, 114), "clock_nanosleep": (230, 115), "exit_group": (231, 94),
    "pselect6": (270, 72), "ppoll": (271, 73), "set_robust_list": (273, 99), "dup3": (292, 24), "getcpu": (309, 168),
    "getrandom": (318, 278), "membarrier": (324, 283), "rseq": (334, 293),
}  # fmt: skip
_OPEN = {"open": ((2, None), 24), "openat": ((257, 56), 32)}  # and where the flags stand in what a filter is shown
_NOT_FOR_READING = 0o1103  # write only, read and write, create, truncate
_FILES = {
    "stat": (4, None), "lstat": (6, None), "access": (21, None), "readlink": (89, None),
    "newfstatat": (262, 79), "readlinkat": (267, 78), "faccessat": (269, 48), "statx": (332, 291),
    "faccessat2": (439, 439),
}  # fmt: skip
_TERMINAL = (16, 29)  # ioctl: "not a terminal" is the true answer, and open() asks for it
_DESCRIPTOR = (72, 25)  # fcntl: it could also name another process as the one to be signalled
_DESCRIPTOR_COMMANDS = (1, 2, 3, 1030)  # read and set close-on-exec, read the mode, duplicate

_MACHINES = {"x86_64": (0, 0xC000003E), "aarch64": (1, 0xC00000B7)}
_LOAD, _JUMP_IF_EQUAL, _JUMP_IF_ANY, _RETURN = 0x20, 0x15, 0x45, 0x06
_NUMBER, _ARCHITECTURE, _SECOND_ARGUMENT = 0, 4, 24  # offsets of what a filter is shown
_ALLOW, _FAIL = 0x7FFF0000, 0x00050000


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p))


def available() -> bool:
    """Whether this kernel filters system calls, on a machine whose numbers are known here."""
    try:
        system_calls.prctl(system_calls.SET_SECCOMP, system_calls.SECCOMP_FILTER, 0)
    except OSError as error:
        return error.errno == errno.EFAULT and os.uname().machine in _MACHINES  # it looked for the program
    return False


@cache
def program(machine: str, files: bool) -> bytes:
    """The filter for a machine, with or without the calls that open files and look for them."""
    column, architecture = _MACHINES[machine]
    allowed = [numbers[column] for numbers in (_CALLS | _FILES if files else _CALLS).values()]
    lines = [
        _line(_LOAD, _ARCHITECTURE),
        _line(_JUMP_IF_EQUAL, architecture, 1, 0),
        _line(_RETURN, _FAIL | errno.EPERM),
    ]
    lines += [_line(_LOAD, _NUMBER)]
    for number in allowed:
        lines += _answered(number, _ALLOW) if number is not None else []
    for numbers, flags in _OPEN.values() if files else ():
        if (number := numbers[column]) is not None:
            lines += _for_reading(number, flags)
    lines += _answered(_TERMINAL[column], _FAIL | errno.ENOTTY)
    commands = [line for command in _DESCRIPTOR_COMMANDS for line in _answered(command, _ALLOW)]
    lines += [_line(_JUMP_IF_EQUAL, _DESCRIPTOR[column], 0, 1 + len(commands)), _line(_LOAD, _SECOND_ARGUMENT)]
    return b"".join([*lines, *commands, _line(_RETURN, _FAIL | errno.EPERM)])


@cache
def _machine() -> str:
    """What kind of machine this is; raises OSError where its system calls are not known here."""
    if (name := os.uname().machine) not in _MACHINES:
        raise OSError(errno.ENOSYS, f"no filter for {name}")
    return name


def restrict(files: bool) -> None:
    """Filter this process's calls from now on; raises OSError if the kernel refuses.

    The process must have given up new privileges before.
    """
    code = program(_machine(), files)
    wanted = _Program(len(code) // 8, code)
    system_calls.prctl(system_calls.SET_SECCOMP, system_calls.SECCOMP_FILTER, ctypes.byref(wanted))


def _for_reading(number: int, flags: int) -> list[bytes]:
    """Five lines: if the loaded number is this call, allow it if its flags ask for reading only, else deny it."""
    return [
        _line(_JUMP_IF_EQUAL, number, 0, 4),
        _line(_LOAD, flags),
        _line(_JUMP_IF_ANY, _NOT_FOR_READING, 0, 1),
        _line(_RETURN, _FAIL | errno.EPERM),
        _line(_RETURN, _ALLOW),
    ]


def _answered(value: int, answer: int) -> list[bytes]:
    """Two lines: if the loaded number equals the value, end with the answer."""
    return [_line(_JUMP_IF_EQUAL, value, 0, 1), _line(_RETURN, answer)]


def _line(code: int, value: int, if_true: int = 0, if_false: int = 0) -> bytes:
    return struct.pack("=HBBI", code, if_true, if_false, value)
