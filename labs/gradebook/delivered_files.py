"""The files of a submission as they were delivered: a file, a folder or a zip archive, and what could not be opened.

Threat: names, links and archives are hostile. Links are not followed, pipes and devices are not opened, nothing is
unpacked to the disk, and of an archive one file is read, up to the size that the grader reads anyway. An archive's list
of files is read only if it is short, and a file in it only if it is packed as every system packs it: the other methods
can make a gigabyte of a hundred bytes in one step, before anybody can stop them.
"""

from __future__ import annotations

import errno
import io
import stat
import struct
import sys
import zipfile
import zlib
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from itertools import islice
from pathlib import Path, PurePosixPath

from labs.grading.errors import UnreadableSubmission
from labs.grading.safe_text import cause_of, one_line
from labs.grading.submission.opening import is_notebook_or_python, opened

MOST_FILES, DEEPEST, MOST_ARCHIVES = 5000, 6, 20
"""So many files of one entry are looked at, in folders so deep and so many archives. A release through the impulse lab
has 841 files."""
LIST_LIMIT = 4 * 2**20
"""Bytes of the longest list of an archive's files: some thirty thousand as people name them, which takes a second."""
NOT_THEIRS = ("__MACOSX", ".ipynb_checkpoints", "__pycache__", ".git", ".venv")
_ENCRYPTED = 1
_DAMAGED = (zipfile.BadZipFile, zlib.error, struct.error, EOFError, NotImplementedError, RuntimeError, ValueError)
"""What `zipfile` raises about an archive that is not as it should be."""


@dataclass(frozen=True)
class DeliveredFile:
    """A file of a submission. name: where it is in its entry. size: in bytes, as its folder or archive says.

    read: gives so many of its first bytes. shut: why these cannot be had; empty for nearly every file.
    """

    name: str
    size: int
    read: Callable[[int], bytes] = field(repr=False, compare=False)
    shut: str = ""

    @property
    def path(self) -> PurePosixPath:
        """The name as a path."""
        return PurePosixPath(self.name)


@dataclass
class Delivered:
    """What is in an entry: its files, and in a line each what cannot be opened.

    unreadable_here: whether this machine does not let us read some of it, for which no student is to blame. archives:
    how many are in a folder.
    """

    files: list[DeliveredFile] = field(default_factory=list)
    troubles: list[str] = field(default_factory=list)
    unreadable_here: bool = False
    archives: int = 0

    def trouble(self, name: str, error: Exception) -> None:
        """Note that something cannot be opened, and why. name: empty for the entry itself."""
        self.unreadable_here |= _is_of_this_machine(error)
        self.troubles.append(f"{name or 'it'} cannot be opened: {_why(error)}")


def delivered(entry: Path, name: str) -> Delivered:
    """The ordinary files of an entry. name: what the student called it, if it is a file."""
    found = Delivered()
    try:
        mode = entry.lstat().st_mode
        if stat.S_ISDIR(mode):
            _list_folder(entry, found)
        elif said := _no_file(mode):
            found.troubles.append(f"it is {said}")
        elif entry.suffix.lower() == ".zip":
            _list_archive(entry, "", found)
        else:
            found.files.append(_plain_file(entry, name))
    except Exception as error:
        found.trouble("", error)
    return found


def shown(name: str) -> str:
    """A name of the file system as text: bytes that are no UTF-8 become escapes."""
    return name.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def is_hidden(name: str) -> bool:
    """Whether a file, or a folder that it is in, is no work of the student's own."""
    parts = [part for part in PurePosixPath(name).parts if part not in (".", "..")]
    return any(part.startswith(".") or part in NOT_THEIRS for part in parts)


def _is_of_this_machine(error: Exception) -> bool:
    """Whether the system refuses something. EINVAL is the archive's own fault: a place before the file's start."""
    return isinstance(error, OSError) and error.errno != errno.EINVAL


def _why(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    known = isinstance(error, (UnreadableSubmission, *_DAMAGED)) and str(error)
    return one_line(str(error)) if known else cause_of(error)


def _no_file(mode: int) -> str:
    """What something is that is neither a file nor a folder; empty for those."""
    if stat.S_ISLNK(mode):
        return "a link, which is not followed"
    if stat.S_ISFIFO(mode) or stat.S_ISSOCK(mode):
        return "a pipe between programs and not a file"
    return "" if stat.S_ISREG(mode) or stat.S_ISDIR(mode) else "a device and not a file"


def _slashes(name: str) -> str:
    """A name with slashes alone between its folders: PowerShell writes backslashes into an archive."""
    return name.replace("\\", "/")


def _plain_file(path: Path, name: str) -> DeliveredFile:
    return DeliveredFile(name, path.lstat().st_size, partial(_read_plain, path))


def _read_plain(path: Path, most: int) -> bytes:
    with open(opened(path), "rb") as file:
        return file.read(most)


def _list_folder(folder: Path, found: Delivered) -> None:
    waiting, left = deque([folder]), MOST_FILES
    while waiting and left:
        here = waiting.popleft()
        try:
            paths = sorted(path for path in here.iterdir() if not is_hidden(_slashes(path.name)))
        except OSError as error:
            found.trouble(_below(here, folder) if here != folder else "", error)
            continue
        for path in paths[:left]:
            left -= 1
            name = _below(path, folder)
            mode = path.lstat().st_mode
            if stat.S_ISDIR(mode):
                waiting.extend([path] * (len(PurePosixPath(name).parts) < DEEPEST))
            elif said := _no_file(mode):
                found.troubles.extend([f"{name} is {said}"] * is_notebook_or_python(name))
            elif name.lower().endswith(".zip"):
                _list_archive_in_folder(path, name, found)
            else:
                found.files.append(_plain_file(path, name))
    if not left:
        found.troubles.append(f"it holds more than {MOST_FILES} files, of which the others were not looked at")


def _below(path: Path, folder: Path) -> str:
    return shown(_slashes(path.relative_to(folder).as_posix()))


def _list_archive_in_folder(path: Path, name: str, found: Delivered) -> None:
    found.archives += 1
    if found.archives > MOST_ARCHIVES:
        if found.archives == MOST_ARCHIVES + 1:
            found.troubles.append(f"it holds more than {MOST_ARCHIVES} archives, of which the others were not opened")
        return
    try:
        _list_archive(path, f"{name}/", found)
    except (OSError, *_DAMAGED) as error:
        found.trouble(name, error)


def _list_archive(path: Path, below: str, found: Delivered) -> None:
    with _archive(path) as archive:
        infos = [info for info in archive.infolist() if not info.is_dir() and not is_hidden(_slashes(info.filename))]
    last = {_slashes(info.filename): info for info in islice(infos, MOST_FILES)}  # as in a folder that it unpacks to
    for inside, info in last.items():
        if not stat.S_ISLNK(info.external_attr >> 16):
            name = below + inside
            found.files.append(DeliveredFile(name, info.file_size, partial(_read_packed, path, info), _shut(info)))
    if len(infos) > MOST_FILES:
        found.troubles.append(f"{below or 'it'} holds more than {MOST_FILES} files; the others were not looked at")


def _shut(info: zipfile.ZipInfo) -> str:
    """Why a file of an archive is not read; empty if it is."""
    if info.flag_bits & _ENCRYPTED:
        return "is encrypted: ask for it without a password"
    if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        return f"is packed by method {info.compress_type}: ask for an ordinary zip archive, or for the file itself"
    return ""


def _read_packed(path: Path, info: zipfile.ZipInfo, most: int) -> bytes:
    """Read one file of an archive, and no more than so much: a header may lie about the size."""
    try:
        with _archive(path) as archive, archive.open(info) as file:
            return file.read(most)
    except (OSError, *_DAMAGED) as error:
        if _is_of_this_machine(error):
            raise
        raise UnreadableSubmission(f"it cannot be unpacked: {_why(error)}") from None


@contextmanager
def _archive(path: Path) -> Iterator[zipfile.ZipFile]:
    """An archive whose list of files is short enough to be read."""
    with _WithShortList(io.FileIO(opened(path))) as file, zipfile.ZipFile(file) as archive:
        file.at_once = sys.maxsize
        yield archive


class _WithShortList(io.BufferedReader):
    """A file that refuses to be read in long pieces; `zipfile` reads the list of files in one."""

    at_once = LIST_LIMIT

    def read(self, size: int | None = -1, /) -> bytes:
        """Read so many bytes."""
        if size is not None and size > self.at_once:
            raise zipfile.BadZipFile(f"its list of files has {size / 2**20:.0f} MB, more than {LIST_LIMIT / 2**20:.0f}")
        return super().read(size)
