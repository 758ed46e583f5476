"""Places to write to, which are tried before anything runs and are refused in one line that says why."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Iterator
from pathlib import Path

from reference.errors import InvalidInput


@contextlib.contextmanager
def refused_in_words(content: str, path: Path, option: str) -> Iterator[None]:
    """Turn an error of the system into one line: what cannot be written, where, why, and which option to change.

    content: what is written, as in `the report`. option: the option that names the path.

    Raises
    ------
    InvalidInput
        If the system refuses what is done inside.
    """
    try:
        yield
    except OSError as error:
        why = f"{error.strerror}; choose another {option}"
        raise InvalidInput(f"cannot write {content} to {str(path)!r}: {why}") from None


def check_file(content: str, file: Path, option: str) -> None:
    """Refuse a file that cannot be written: it is a folder, or its own folder takes no files.

    Raises
    ------
    InvalidInput
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
    InvalidInput
        As in `refused_in_words`, before anything inside has run.
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


def _try(folder: Path) -> None:
    with tempfile.TemporaryFile(dir=folder):
        pass
