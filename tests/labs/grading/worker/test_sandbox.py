"""The two halves of the sandbox by themselves: the filter of system calls, read by a small interpreter; Landlock."""

from __future__ import annotations

import errno
import json
import os
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from labs.grading.worker import landlock, seccomp

ALLOWED, FAILED = 0x7FFF0000, 0x00050000
X86, ARM = ("x86_64", 0xC000003E), ("aarch64", 0xC00000B7)
# What an attack needs, by its numbers on x86-64 and on 64-bit ARM (None: that machine does not have it).
DENIED = {
    "socket": (41, 198), "connect": (42, 203), "sendmsg": (46, 211), "clone": (56, 220), "fork": (57, None),
    "vfork": (58, None), "execve": (59, 221), "kill": (62, 129), "chmod": (90, None), "ptrace": (101, 117),
    "setuid": (105, 146), "setsid": (112, 157), "prctl": (157, 167), "setrlimit": (160, 164), "mount": (165, 40),
    "tkill": (200, 130), "tgkill": (234, 131), "keyctl": (250, 219), "unshare": (272, 97),
    "perf_event_open": (298, 241),
    "prlimit64": (302, 261), "process_vm_readv": (310, 270), "process_vm_writev": (311, 271), "seccomp": (317, 277),
    "memfd_create": (319, 279), "bpf": (321, 280), "execveat": (322, 281), "userfaultfd": (323, 282),
    "pidfd_send_signal": (424, 424), "io_uring_setup": (425, 425), "clone3": (435, 435), "pidfd_getfd": (438, 438),
    "shmget": (29, 194), "mq_open": (240, 180), "setitimer": (38, 103), "sched_setaffinity": (203, 122),
    "symlink": (88, None), "mkdir": (83, None), "unlink": (87, None), "ftruncate": (77, 46), "utimensat": (280, 88),
}  # fmt: skip
NEEDED = {"read": (0, 63), "write": (1, 64), "mmap": (9, 222), "futex": (202, 98), "exit_group": (231, 94)}
OPENING = {"open": (2, None), "openat": (257, 56), "stat": (4, None), "newfstatat": (262, 79)}


def judged(program: bytes, architecture: int, number: int, argument: int = 0, third: int = 0) -> int:
    """What a filter answers to a system call whose second and third arguments are given."""
    shown = struct.pack("=IIQQQQ", number, architecture, 0, 0, argument, third)
    at = loaded = 0
    while True:
        code, if_true, if_false, value = struct.unpack_from("=HBBI", program, 8 * at)
        at += 1
        if code == 0x06:
            return value
        if code == 0x20:
            loaded = struct.unpack_from("=I", shown, value)[0]
        else:
            assert code in (0x15, 0x45)
            at += if_true if (loaded == value if code == 0x15 else loaded & value) else if_false


@pytest.mark.parametrize("machine", [X86, ARM], ids=["x86-64", "ARM"])
@pytest.mark.parametrize("files", [True, False])
def test_the_filter_allows_computing_and_nothing_that_reaches_out(machine, files):
    name, architecture = machine
    column, program = [X86, ARM].index(machine), seccomp.program(name, files)
    for group, answer in ((NEEDED, ALLOWED), (DENIED, FAILED | errno.EPERM)):
        for call, numbers in group.items():
            if (number := numbers[column]) is not None:
                assert judged(program, architecture, number) == answer, call
    for call, numbers in OPENING.items():
        if (number := numbers[column]) is not None:
            assert (judged(program, architecture, number) == ALLOWED) is files, call


@pytest.mark.parametrize("machine", [X86, ARM], ids=["x86-64", "ARM"])
def test_the_filter_denies_every_system_call_that_is_not_listed(machine):
    name, architecture = machine
    program = seccomp.program(name, files=True)
    allowed = [number for number in range(1200) if judged(program, architecture, number) == ALLOWED]
    assert len(allowed) < 70
    assert max(allowed) < 440
    assert judged(program, architecture, 0x40000000) != ALLOWED  # the same calls under their x32 numbers
    for other in (X86[1], ARM[1], 0x40000003):  # and those of another machine, which this one may understand too
        if other != architecture:
            assert judged(program, other, 0) == FAILED | errno.EPERM


@pytest.mark.parametrize("machine", [X86, ARM], ids=["x86-64", "ARM"])
def test_files_open_only_for_reading(machine):
    name, architecture = machine
    program = seccomp.program(name, files=True)
    opened = {X86: (257, 2), ARM: (56,)}[machine]
    for number in opened:
        for flags in (os.O_WRONLY, os.O_RDWR, os.O_TRUNC, os.O_CREAT, os.O_RDONLY, os.O_CLOEXEC | os.O_DIRECTORY):
            given = {"argument": flags} if number == 2 else {"third": flags}
            allowed = judged(program, architecture, number, **given) == ALLOWED
            assert allowed is not bool(flags & (os.O_WRONLY | os.O_RDWR | os.O_TRUNC | os.O_CREAT)), flags


@pytest.mark.parametrize("machine", [X86, ARM], ids=["x86-64", "ARM"])
def test_a_descriptor_can_be_queried_but_cannot_send_signals(machine):
    name, architecture = machine
    number, program = (72, 25)[[X86, ARM].index(machine)], seccomp.program(name, files=True)
    assert [judged(program, architecture, number, command) == ALLOWED for command in range(12)] == [
        command in (1, 2, 3) for command in range(12)
    ]


@pytest.mark.skipif(
    not (sys.platform == "linux" and seccomp.available() and landlock.version()), reason="this kernel has less"
)
def test_a_readable_file_cannot_be_emptied_under_an_old_landlock(tmp_path):
    (tmp_path / "module.py").write_text("1")
    code = """
import os, sys
from labs.grading.worker import landlock, seccomp, system_calls
landlock.version = lambda: min(version, 2)
version = int(system_calls.syscall(444, None, 0, 1))
system_calls.prctl(system_calls.NO_NEW_PRIVILEGES, 1)
landlock.restrict(landlock.ruleset([sys.argv[1]]))
if sys.argv[2] == "filter":
    seccomp.restrict(files=True)
try:
    os.open(sys.argv[1] + "/module.py", os.O_RDONLY | os.O_TRUNC)
except PermissionError:
    pass
print(len(open(sys.argv[1] + "/module.py").read()))
"""
    left = []
    for filtered in ("filter", "no filter"):
        command = [sys.executable, "-c", code, str(tmp_path), filtered]
        ran = subprocess.run(command, capture_output=True, text=True, check=True, cwd=Path(__file__).parents[4])
        left.append(int(ran.stdout))
    assert left == [1, 0]  # without the filter it is lost: the test would notice


@pytest.mark.skipif(sys.platform != "linux" or not landlock.version(), reason="no Landlock in this kernel")
def test_every_version_of_landlock_seals_files(tmp_path):
    (tmp_path / "readable").mkdir()
    (tmp_path / "readable" / "file").write_text("1")
    (tmp_path / "secret").write_text("2")
    code = """
import json, os, sys
from labs.grading.worker import landlock, system_calls
folder, known, told = sys.argv[1], landlock.version(), {}
for version in range(1, known + 1):
    if os.fork() == 0:
        landlock.version = lambda: version
        system_calls.prctl(system_calls.NO_NEW_PRIVILEGES, 1)
        landlock.restrict(landlock.ruleset([folder + "/readable", folder + "/missing"]))
        done = []
        for path, mode in (("readable/file", "r"), ("secret", "r"), ("secret", "w"), ("readable/new", "w")):
            try:
                open(os.path.join(folder, path), mode).close()
                done.append(True)
            except PermissionError:
                done.append(False)
        os._exit(sum(bit << place for place, bit in enumerate(done)))
    told[version] = os.waitstatus_to_exitcode(os.wait()[1])
print(json.dumps(told))
"""
    ran = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path)],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(__file__).parents[4],
    )
    told = json.loads(ran.stdout)
    assert len(told) == landlock.version()
    assert set(told.values()) == {0b0001}  # reading what is granted, and nothing else
    assert (tmp_path / "secret").read_text() == "2"
