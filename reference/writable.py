"""Places to write to, which are tried before anything runs and are refused in one line that says why."""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from reference.errors import CannotWrite, InvalidInput

_NO_FAULT_OF_THE_PATH = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EMFILE, errno.ENFILE, errno.ENOMEM)
"""What goes wrong with any path: the disk or somebody's share of it is full, it fails, or there is a limit on files."""


@contextlib.contextmanager
def refused_in_words(content: str, path: Path, option: str) -> Iterator[None]:
    """Turn an error of the system into one line: what cannot be written, where, why, and which option to change.

    content: what is written, as in `the report`. option: the option that names the path.

    Raises
    ------
    InvalidInput
        If the system refuses what is done inside because of the path.
    CannotWrite
        If it refuses because the disk is full, or fails.
    """
    try:
        yield
    except OSError as error:
        if not _is_about(error, path):
            raise
        said = f"cannot write {content} to {str(path)!r}: {reason_of(error)}"
        if error.errno in _NO_FAULT_OF_THE_PATH or isinstance(error, shutil.Error):
            raise CannotWrite(said) from None
        raise InvalidInput(f"{said}; choose another {option}") from None


def reason_of(error: OSError) -> str:
    """Why the system refuses; of a folder that could not be copied, why not the first of its files."""
    if isinstance(error, shutil.Error) and error.args and isinstance(error.args[0], list):
        *_, reason = error.args[0][0]
        return str(reason)
    return error.strerror or str(error)


def _is_about(error: OSError, path: Path) -> bool:
    """Whether an error may be about a path: it names no file, a file there, or a folder above."""
    wanted = Path(os.path.abspath(path))
    folder = wanted if os.path.isdir(wanted) else wanted.parent
    files = [Path(os.path.abspath(os.fsdecode(name))) for name in (error.filename, error.filename2) if name is not None]
    return not files or any(file.is_relative_to(folder) or wanted.is_relative_to(file) for file in files)


def write_whole(path: Path, content: bytes) -> None:
    """Write a whole file or none, so that an earlier one is not lost where a new one cannot be written."""
    target = Path(os.path.realpath(path))  # a link stays a link
    unfinished = target.with_name(f".unfinished-{os.getpid()}")
    try:
        unfinished.write_bytes(content)
        os.replace(unfinished, target)
    finally:
        unfinished.unlink(missing_ok=True)


def check_file(content: str, file: Path, option: str) -> None:
    """Refuse a file that cannot be written: it is a folder, or its own folder takes no files.

    Raises
    ------
    InvalidInput, CannotWrite
        As in `refused_in_words`.
    """
    with refused_in_words(content, file, option):
        _try(file.parent)
        if file.is_dir():
            raise IsADirectoryError(None, "Is a directory")


@contextlib.contextmanager
def folder_for(content: str, folder: Path, option: str, private: bool = False) -> Iterator[None]:
    """Make a folder, and the folders above it, for what is written inside; remove the new ones that are still empty.

    private: whether its owner alone may look into it, if it is new.

    Raises
    ------
    InvalidInput, CannotWrite
        As in `refused_in_words`, before anything inside has run, and for every error of the system inside.
    """
    new: list[Path] = []
    try:
        with refused_in_words(content, folder, option):
            new += [each for each in (folder, *folder.parents) if not each.exists()]
            folder.mkdir(mode=0o700 if private else 0o777, parents=True, exist_ok=True)
            _try(folder)
            yield
    finally:
        for each in new:
            with contextlib.suppress(OSError):
                each.rmdir()  # succeeds only where it is empty


@contextlib.contextmanager
def new_folder_for(content: str, folder: Path, option: str) -> Iterator[None]:
    """As `folder_for`, for a folder that is new or empty, and is empty again where what is inside does not succeed."""
    with folder_for(content, folder, option):
        if any(folder.iterdir()):
            raise InvalidInput(f"{str(folder)!r} is there already and not empty: name a new folder")
        try:
            yield
        except BaseException:
            for each in folder.iterdir():
                shutil.rmtree(each) if each.is_dir() else each.unlink()
            raise


def _try(folder: Path) -> None:
    with tempfile.TemporaryFile(dir=folder):
        pass
