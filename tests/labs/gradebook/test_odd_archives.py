"""Zip archives as other systems write them, damaged ones, and ones that are made to cost time and memory."""

from __future__ import annotations

import io
import resource
import struct
import time
import zipfile
from pathlib import Path

import pytest
from submissions import notebook

from labs.gradebook.arrivals import Missing, arrival, arrivals, content_of
from labs.gradebook.class_list import read_class, tasks
from labs.gradebook.class_run import Failures
from labs.gradebook.layouts import PLAIN, Owner

NOTEBOOK = notebook("def normal_velocity(n, u):\n    return n @ u\n")


def put(folder: Path, *names: str, content: bytes = NOTEBOOK) -> None:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def archive(*members: tuple[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    """A zip archive, with names as they are given."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as file:
        for name, content in members:
            info = zipfile.ZipInfo("x")
            info.filename = name
            file.writestr(info, content, method)
    return packed.getvalue()


def test_backslashes_in_an_archive_are_folders(tmp_path):
    stale = b"{}"
    for student, hidden in (("a", r".ipynb_checkpoints\impulse.ipynb"), ("b", r"lab\__MACOSX\impulse.ipynb"),
                            ("c", r"lab\.git\x\impulse.ipynb"), ("d", r"copy\impulse.ipynb")):  # fmt: skip
        put(tmp_path, f"{student}.zip", content=archive((hidden, stale), ("impulse.ipynb", NOTEBOOK)))
    put(tmp_path, r"e/lab\impulse.ipynb")
    put(tmp_path, r"e/.ipynb_checkpoints\impulse.ipynb", content=stale)
    there, missing = arrivals(tmp_path, "impulse")
    assert missing == []
    assert [content_of(each) for each in there] == [NOTEBOOK] * 5
    assert [bool(each.notes) for each in there] == [False, False, False, True, False]


def test_an_archive_in_a_students_folder_is_looked_into(tmp_path):
    put(tmp_path, "Ada_7_assignsubmission_file_/lab.zip", content=archive(("lab5/impulse.ipynb", NOTEBOOK)))
    put(tmp_path, "bob/one.zip", content=b"no archive")
    put(tmp_path, "bob/impulse.py")
    ada, bob = arrivals(tmp_path, "impulse")[0]
    assert (ada.file, content_of(ada)) == ("lab.zip/lab5/impulse.ipynb", NOTEBOOK)
    assert (bob.file, bob.notes) == ("impulse.py", ("one.zip cannot be opened: File is not a zip file",))


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_of_two_files_of_one_name_in_an_archive_the_later_one_counts_as_in_a_folder(tmp_path):
    put(tmp_path, "ada.zip", content=archive(("impulse.ipynb", b"{}"), ("lab.py", b""), ("impulse.ipynb", NOTEBOOK)))
    (ada,), _ = arrivals(tmp_path, "impulse")
    assert (content_of(ada), ada.notes) == (NOTEBOOK, ())


def _forged(count: int) -> bytes:
    """A list of so many files that are not there."""
    entry = struct.pack("<4s4B4HL2L5H2L", b"PK\x01\x02", 20, 0, 20, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0) + b"a"
    end = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, count & 0xFFFF, count & 0xFFFF, len(entry) * count, 0, 0)
    return entry * count + end


def _changed(at: bytes, offset: int, value: bytes) -> bytes:
    """An archive with other bytes somewhere behind the first place of a mark."""
    content = bytearray(archive(("lab/impulse.ipynb", NOTEBOOK)))
    place = content.find(at) + offset
    content[place : place + len(value)] = value
    return bytes(content)


_LISTED, _END = b"PK\x01\x02", b"PK\x05\x06"


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (_changed(_LISTED, 8, b"\x01"), "is encrypted"),
        (_changed(_LISTED, 8, b"\x41"), "is encrypted"),
        (archive(("impulse.ipynb", b"0" * 10**7), method=zipfile.ZIP_BZIP2), "is packed by method 12"),
        (archive(("impulse.ipynb", b"0" * 10**7), method=zipfile.ZIP_LZMA), "is packed by method 14"),
        (_changed(_LISTED, 24, struct.pack("<L", 3)), "cannot be unpacked: Bad CRC-32"),
        (_changed(_LISTED, 24, b"\xff\xff\xff\x7f"), "has 2048 MB, more than 64"),
        (_changed(b"PK\x03\x04", 60, b"\0\0\0"), "cannot be unpacked"),
        (_changed(_LISTED, 42, b"\xff\xff\xff\x0f"), "cannot be unpacked"),
        (_changed(_END, 16, b"\xff\xff\x0f\x00"), "Invalid argument"),
        (_changed(_END, 12, b"\xff\xff\xff\x0f"), "Bad offset for central directory"),
        (_forged(200_000), "its list of files has 9 MB, more than 4"),
        (archive(("impulse.zip", archive(("impulse.ipynb", NOTEBOOK)))), "only impulse.zip"),
        (archive(("impulse.ipynb", NOTEBOOK))[:-30], "File is not a zip file"),
        (b"", "File is not a zip file"),
        (b"Rar!\x1a\x07\x01\x00", "File is not a zip file"),
    ],
)
def test_an_archive_that_cannot_be_read_is_its_own_submissions_trouble(tmp_path, content, why):
    put(tmp_path, "ada.zip", content=content)
    put(tmp_path, "bob.ipynb")
    began = time.process_time()
    found = read_class(tmp_path, "impulse")
    failures = Failures()
    (task,) = tasks(found, "", 60.0, with_runs=False, failures=failures)
    assert (task.student, failures.said) == ("bob", {})
    assert why in found.unusable["ada"].why
    assert time.process_time() - began < 1.0


@pytest.mark.slow
def test_an_archive_is_listed_and_looked_into_within_its_budget(tmp_path):
    put(tmp_path, "ada.zip", content=_forged(80_000))
    began = time.process_time()
    assert isinstance(arrival(tmp_path / "ada.zip", Owner(PLAIN, "ada"), "impulse"), Missing)
    assert time.process_time() - began < 20.0  # it takes four on a slow machine; a million files are not listed
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss < 2**22
