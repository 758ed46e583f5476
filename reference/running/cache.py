"""Results kept on disk, so that a job that ran with the very same code, engine and settings need not run again.

A result is found by a key: a hash of everything that it depends on. A changed line of code, another version of an
engine or another machine gives another key, and so a miss. `--fresh` runs everything again.

The key does not see files that hand-written code reads as it runs, nor modules that it imports by a name put together
at run time.
"""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import importlib
import io
import json
import logging
import os
import pickle
import platform
import tempfile
import time
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np
import platformdirs

from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.errors import CollisionsError
from reference.running import sources
from reference.running.protocol import Job, Result

SCHEMA = "collisions-lab result 1\n"
VARIABLE = "COLLISIONS_CACHE"
"""Environment variable that names another folder."""
MOST_BYTES = 64 * 2**20
"""How much the folder may hold; beyond that, the results that were used longest ago are removed."""
_KEPT, _UNFINISHED = ".result", ".unfinished"
"""Suffixes of a kept result and of a file that is being written."""
_ABANDONED = 3600.0
"""Age, s, from which an unfinished file was left behind by a process that is gone."""
_INCOMPLETE = (Verdict.CRASHED, Verdict.NOT_AVAILABLE)
"""A result with one of these verdicts is not kept: the next run may give a number."""

_log = logging.getLogger(__name__)


def default_folder() -> Path:
    """The folder that `COLLISIONS_CACHE` names, or the user's own for caches."""
    return Path(os.environ.get(VARIABLE) or platformdirs.user_cache_dir("collisions-lab", appauthor=False))


class Cache:
    """Results of jobs in a folder. Where the folder cannot be read or written, everything is a miss and nothing fails.

    fresh: take nothing from the folder, but keep new results there. most_bytes: how much it may hold.
    """

    def __init__(self, folder: Path | None = None, fresh: bool = False, most_bytes: int = MOST_BYTES) -> None:
        self.folder, self.fresh, self.most_bytes = folder or default_folder(), fresh, most_bytes

    def get(self, job: Job) -> Any:
        """The result of this job if it ran before under the same key; None otherwise."""
        key = None if self.fresh else key_of(job)
        if key is None:
            return None
        try:
            content = self._file(key).read_bytes()
            with contextlib.suppress(OSError):
                os.utime(self._file(key))  # used just now
        except FileNotFoundError:
            return None
        except OSError as error:
            _log.info("the cache cannot be read: %s", error)
            return None
        result = _unpacked(content)
        if result is None or result.job != _identity(job):
            _log.info("%s: what the cache holds is no result of it", job)
            return None
        _log.info("%s: from the cache, where it took %.1f s", job, result.seconds)
        return dataclasses.replace(result, job=job, cached=True)

    def put(self, job: Job, key: str | None, result: Result) -> None:
        """Keep a complete result that ran here under the key that its worker had, if it is still the job's."""
        if key is None or result.recording or any(row.verdict in _INCOMPLETE for row in result.rows):
            return
        if key != key_of(job):
            return
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            kept: Any = result  # of any kind, with a job of its own kind
            self._write(self._file(key), _packed(dataclasses.replace(kept, job=_identity(job))))
            self._make_room()
        except OSError as error:
            _log.info("%s: not kept, the cache cannot be written: %s", job, error)

    def _file(self, key: str) -> Path:
        return self.folder / f"{key}{_KEPT}"

    def _write(self, path: Path, content: bytes) -> None:
        """Write a whole file or none, even if another process writes the same one."""
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
        """Remove the results used longest ago while there are too many, and files that an interrupted write left."""
        files, now = [], time.time()
        for path in self.folder.iterdir():
            with contextlib.suppress(OSError):  # another process may have removed it
                status = path.stat()
                if path.suffix == _KEPT:
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


def key_of(job: Job, once: bool = False) -> str | None:
    """A hash of everything that a job's result depends on; None where it is unknown, as for a missing engine.

    once: read each package once in a process, for a worker, which imports it once and never again.
    """
    try:
        engine = load_engine(job.engine)
        code = {"reference": sources.digest("reference", once)}
        if job.engine.endswith(".py"):
            code["engine"] = sources.digest(job.engine, once)
        if _reads_hand_written(job):
            parts = Implementation(job.implementation).sources
            code["implementation"] = " ".join(sources.digest(part, once) for part in parts)
        known = [SCHEMA, dataclasses.asdict(_identity(job)), engine.version(), _surroundings(), code]
    except (CollisionsError, OSError) as error:
        _log.info("%s: without cache: %s", job, error)
        return None
    return hashlib.sha256(json.dumps(known, sort_keys=True).encode()).hexdigest()


def _surroundings() -> dict[str, str]:
    return {
        "numpy": np.__version__,
        "python": platform.python_version(),
        "implementation": platform.python_implementation(),
        "platform": platform.platform(),
        "machine": platform.machine(),
    }


def _reads_hand_written(job: Job) -> bool:
    """Whether hand-written code may take part: an engine of ours that wraps a package runs nothing else."""
    return job.engine.endswith(".py") or load_engine(job.engine).package is None


def _identity(job: Job) -> Any:
    """The job as far as its result depends on it: a student's own code must not cost new runs of PyBullet."""
    identity: Any = job.without_remarks()
    return identity if _reads_hand_written(job) else dataclasses.replace(identity, implementation="")


def _packed(result: Result) -> bytes:
    body = pickle.dumps(result, protocol=5)
    return SCHEMA.encode() + hashlib.sha256(body).digest() + body


def _unpacked(content: bytes) -> Any:
    """The result in a file's bytes; None for a file that is damaged, of another version or no result at all."""
    header = SCHEMA.encode()
    digest, body = content[len(header) : len(header) + 32], content[len(header) + 32 :]
    if not content.startswith(header) or hashlib.sha256(body).digest() != digest:
        return None
    try:
        found: Any = _OwnData(io.BytesIO(body)).load()
    except Exception as error:
        _log.info("a file of the cache cannot be read: %s", error)
        return None
    return found if hasattr(found, "job") and hasattr(found, "rows") else None


class _OwnData(pickle.Unpickler):
    """Reads the lab's own plain data and nothing else, so that no code runs whatever a file in the folder holds."""

    def find_class(self, module: str, name: str) -> Any:
        found = None
        if module.startswith("reference.") and "." not in name:
            found = getattr(importlib.import_module(module), name, None)
        ours = isinstance(found, type) and found.__module__ == module
        if not (ours and (dataclasses.is_dataclass(found) or issubclass(found, Enum))):  # type: ignore[arg-type]
            raise pickle.UnpicklingError(f"{module}.{name} is no data of the lab")
        return found
