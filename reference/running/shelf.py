"""A folder that keeps files of the lab's own: each is whole or missing, and what was used longest ago goes first.

Where the folder cannot be read or written everything is missing from it, and nothing fails.
"""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
import tempfile
import time
from pathlib import Path

import platformdirs

VARIABLE = "COLLISIONS_CACHE"
"""Environment variable that names another folder."""
MOST_BYTES = 64 * 2**20
"""How much the folder may hold; beyond that, the files that were used longest ago are removed."""
RESULT, FIGURE = ".result", ".figure"
"""Suffixes of a kept result of a run, and of a kept figure."""
_UNFINISHED = ".unfinished"
"""Suffix of a file that is being written."""
_ABANDONED = 3600.0
"""Age, s, from which an unfinished file was left behind by a process that is gone."""

_log = logging.getLogger(__name__)


def default_folder() -> Path:
    """The folder that `COLLISIONS_CACHE` names, or the user's own for caches."""
    return Path(os.environ.get(VARIABLE) or platformdirs.user_cache_dir("collisions-lab", appauthor=False))


class Shelf:
    """Files in a folder. fresh: take nothing from the folder, but keep new files. most_bytes: how much it may hold.

    refusal: why the system would not let the last file be written that is not kept; empty where all are kept.
    """

    def __init__(self, folder: Path | None = None, fresh: bool = False, most_bytes: int = MOST_BYTES) -> None:
        self.folder, self.fresh, self.most_bytes = folder or default_folder(), fresh, most_bytes
        self.refusal = ""

    def read(self, name: str) -> bytes | None:
        """The content of a file, which counts as used just now; None where there is none that can be read."""
        try:
            content = (self.folder / name).read_bytes()
            with contextlib.suppress(OSError):
                os.utime(self.folder / name)
        except FileNotFoundError:
            return None
        except OSError as error:
            _log.info("the cache cannot be read: %s", error)
            return None
        return content

    def keep(self, name: str, content: bytes) -> None:
        """Write a whole file or none, even if another process writes the same one, and make room for it."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._write(self.folder / name, content)
            self._make_room()
        except OSError as error:
            self.refusal = error.strerror or str(error)
            _log.info("%s: not kept, the cache cannot be written: %s", name, error)

    def _write(self, path: Path, content: bytes) -> None:
        handle, name = tempfile.mkstemp(_UNFINISHED, dir=self.folder)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            os.replace(name, path)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(name)
            raise

    def _make_room(self) -> None:
        """Remove the files used longest ago while there are too many, and what an interrupted write left."""
        files, now = [], time.time()
        for path in self.folder.iterdir():
            with contextlib.suppress(OSError):  # another process may have removed it
                status = path.stat()
                if path.suffix in (RESULT, FIGURE):
                    files.append((status.st_mtime, status.st_size, path))
                elif path.suffix == _UNFINISHED and now - status.st_mtime > _ABANDONED:
                    path.unlink()
        held = sum(size for _, size, _ in files)
        for _, size, path in sorted(files):
            if held <= self.most_bytes:
                return
            with contextlib.suppress(OSError):
                path.unlink()
            held -= size


def sealed(schema: str, body: bytes) -> bytes:
    """Bytes behind a schema and a checksum, by which a damaged file is noticed."""
    return schema.encode() + hashlib.sha256(body).digest() + body


def unsealed(schema: str, content: bytes) -> bytes | None:
    """The bytes in a file's content; None for a file that is damaged or of another schema."""
    header = schema.encode()
    digest, body = content[len(header) : len(header) + 32], content[len(header) + 32 :]
    return body if content.startswith(header) and hashlib.sha256(body).digest() == digest else None
