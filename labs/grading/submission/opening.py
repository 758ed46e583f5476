"""Opens a submitted file, and reads so much of it as a submission may have.

Threat: the file is hostile data. It is opened without following a link, which could show the grader's own files in a
message, and without waiting for a pipe. Above 10 MB it is refused before a byte is parsed, unless it is a notebook that
is small without its outputs.
"""

from __future__ import annotations

import functools
import os
import stat
from pathlib import Path, PurePosixPath

from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.large_notebooks import LARGEST, without_outputs

FILE_LIMIT = 10 * 2**20
"""Bytes of the largest file."""
_OTHERS = {
    b"%PDF": "a PDF", b"PK\x03\x04": "a zip archive", b"\x1f\x8b": "a gzip archive", b"\x89PNG": "an image",
    b"\xff\xd8\xff": "an image", b"\x7fELF": "a program", b"<!doctype html": "a web page", b"<html": "a web page",
    b"Rar!": "a RAR archive", b"7z\xbc\xaf": "a 7z archive",
}  # fmt: skip


def is_notebook_or_python(name: str) -> bool:
    """Whether a file is called one, if perhaps with an ending behind it, as in `impulse.ipynb.json`."""
    return is_called_notebook(name) or is_called_python(name)


def is_called_notebook(name: str) -> bool:
    """Whether a file is called a notebook, if perhaps with an ending behind it."""
    return ".ipynb" in _endings(name)


def is_called_python(name: str) -> bool:
    """Whether a file is called a Python file and no notebook, if perhaps with an ending behind it."""
    return ".py" in _endings(name) and not is_called_notebook(name)


def _endings(name: str) -> list[str]:
    return [suffix.lower() for suffix in PurePosixPath(name).suffixes]


def starts_like_one(start: bytes, name: str) -> bool:
    """Whether a file that begins like this may be a notebook, or Python if its name says so."""
    text = start.removeprefix(b"\xef\xbb\xbf").lstrip()
    if text.startswith(b"{"):
        return any(key in text for key in (b'"cells"', b'"worksheets"', b'"nbformat"'))
    return is_called_python(name) and b"\0" not in text and not _other_kind(start)


def most_bytes(name: str) -> int:
    """The size of the largest file of a name that is read."""
    return LARGEST if is_called_notebook(name) else FILE_LIMIT


def opened(path: Path) -> int:
    """A descriptor of an ordinary file. It is opened without following a link, and without waiting for a pipe.

    Raises
    ------
    UnreadableSubmission
        If it is something else.
    OSError
        If the system does not let us read it.
    """
    if path.is_symlink():
        raise UnreadableSubmission("it is a symbolic link: hand in the file itself")
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    descriptor = os.open(path, flags)
    mode = os.fstat(descriptor).st_mode
    if not stat.S_ISREG(mode):
        os.close(descriptor)
        raise UnreadableSubmission(
            "it is a folder: name the notebook or .py file in it"
            if stat.S_ISDIR(mode)
            else "it is a device, not a file"
        )
    return descriptor


def bytes_of(path: Path) -> tuple[bytes, int]:
    """What is read of a file, and how many bytes it has; raises `UnreadableSubmission` if it is none to be read."""
    try:
        descriptor = opened(path)
    except FileNotFoundError:
        raise UnreadableSubmission("there is no file of this name here") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise UnreadableSubmission(f"it cannot be opened: {reason}") from None
    with open(descriptor, "rb") as file:
        status = os.fstat(descriptor)
        if status.st_size > FILE_LIMIT:
            return _large(path, status.st_size, status.st_mtime_ns), status.st_size
        raw = file.read(FILE_LIMIT)
    if not raw.strip():
        raise UnreadableSubmission("it is empty: was it saved?")
    if kind := _other_kind(raw):
        raise UnreadableSubmission(f"it is {kind}, whatever its name says: hand in a .ipynb or a .py file")
    return raw, len(raw)


def _other_kind(raw: bytes) -> str:
    """What a file is that is no text; empty if that is not known."""
    start = raw[:64].lstrip().lower()
    return next((kind for begins, kind in _OTHERS.items() if start.startswith(begins.lower())), "")


@functools.lru_cache(maxsize=1)
def _large(path: Path, size: int, _changed: int) -> bytes:
    """A large notebook without its outputs. It is kept for the next who asks: a grade reads its file several times."""
    with open(opened(path), "rb") as file:
        raw = file.read(LARGEST + 1) if size <= LARGEST and file.read(1) == b"{" else b""
    smaller = without_outputs(b"{" + raw) if 0 < len(raw) <= LARGEST else None
    if smaller is None or len(smaller) > FILE_LIMIT:
        most = f"at most {FILE_LIMIT / 2**20:.0f} are read besides outputs, and {LARGEST / 2**20:.0f} with them"
        raise UnreadableSubmission(f"it has {size / 2**20:.0f} MB, and {most}: clear the notebook's outputs")
    return smaller
