"""A folder to write a report into, so that the report appears as a whole or not at all."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from reference.writable import check_file, folder_for

CONTENT, OPTION = "the report", "--out"
PAGE = "index.html"
"""The file that is moved last, since it speaks of all the others."""


@contextlib.contextmanager
def staged(out: Path) -> Iterator[Path]:
    """Give a folder to write a report into; when all went well, move its files to `out`, the page last.

    Each file in `out` is replaced at once, by a whole one or not at all, and nothing else there is touched. The folder
    lies in `out` itself, so that a place that cannot be written is found before anything runs. New folders are removed
    again if nothing was written.

    Raises
    ------
    InvalidInput, CannotWrite
        If `out` is no folder or cannot be written; if its page is a folder; if the disk is full.
    """
    with folder_for(CONTENT, out, OPTION):
        check_file(CONTENT, out / PAGE, OPTION)
        stage = Path(tempfile.mkdtemp(prefix=".unfinished-", dir=out))
        try:
            yield stage
            _move(stage, out)
        finally:
            shutil.rmtree(stage, ignore_errors=True)


def _move(stage: Path, out: Path) -> None:
    written = sorted(path.relative_to(stage) for path in stage.rglob("*") if path.is_file())
    for name in sorted(written, key=lambda name: name == Path(PAGE)):
        (out / name).parent.mkdir(exist_ok=True)
        os.replace(stage / name, out / name)
