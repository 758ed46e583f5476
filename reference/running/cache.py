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
import pickle
import platform
from enum import Enum
from typing import Any

import numpy as np

from reference.catalogue.scenarios import catalogue
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.errors import CollisionsError
from reference.recording import checksums, files
from reference.running import sources
from reference.running.protocol import Job, Result
from reference.running.shelf import RESULT, Shelf, sealed, unsealed
from reference.running.sources import Texts

SCHEMA = "collisions-lab result 1\n"
_INCOMPLETE = (Verdict.CRASHED, Verdict.LOST, Verdict.NOT_AVAILABLE)
"""A result with one of these verdicts is not kept: the next run may give a number."""

_log = logging.getLogger(__name__)


class Cache(Shelf):
    """Results of jobs in a folder. Where the folder cannot be read or written, everything is a miss and nothing fails.

    fresh: take nothing from the folder, but keep new results there. most_bytes: how much it may hold.
    """

    def get(self, job: Job, texts: Texts | None = None) -> Any:
        """The result of this job if it ran before under the same key; None otherwise.

        texts: what was read of the code before, and is not to be read again.
        """
        return None if self.fresh else self._found(job, key_of(job, texts=texts))

    def get_recorded(self, job: Job, texts: Texts | None = None) -> Any:
        """What the recording of this job gave before, with the same code and the same recording; None otherwise."""
        return None if self.fresh else self._found(job, key_of_recorded(job, texts))

    def put(self, job: Job, key: str | None, result: Result, texts: Texts | None = None) -> None:
        """Keep a complete result under the key that its worker had, if it is still the job's, or its recording's.

        texts: what has been read of the code since the job ran, and is not to be read again.
        """
        if key is None or any(row.verdict in _INCOMPLETE for row in result.rows):
            return
        if key == (key_of_recorded(job, texts) if result.recording else key_of(job, texts=texts)):
            kept: Any = result  # of any kind, with a job of its own kind
            self.keep(f"{key}{RESULT}", _packed(dataclasses.replace(kept, job=_identity(job))))

    @property
    def promise(self) -> str:
        """What is said to somebody whose command ended early: whether the runs that it made are kept."""
        if self.refusal:
            return (
                f"The runs that have ended are not kept, as the cache in {self.folder} takes no file: {self.refusal}."
            )
        how = "The same command without --fresh" if self.fresh else "The same command"
        return f"The runs that have ended are kept. {how} makes those that are missing."

    def _found(self, job: Job, key: str | None) -> Any:
        content = self.read(f"{key}{RESULT}") if key else None
        result = _unpacked(content) if content is not None else None
        if result is None:
            return None
        if result.job != _identity(job):
            _log.info("%s: what the cache holds is no result of it", job)
            return None
        _log.info("%s: from the cache, where it took %.1f s", job, result.seconds)
        return dataclasses.replace(result, job=job, cached=True)


def key_of(job: Job, once: bool = False, texts: Texts | None = None) -> str | None:
    """A hash of everything that a job's result depends on; None where it is unknown, as for a missing engine.

    once: read each package once in a process, for a worker, which imports it once and never again. texts: what was read
    of the code before, and is not to be read again.
    """
    texts = sources.IMPORTED if once else texts or Texts()
    try:
        engine = load_engine(job.engine)
        code = {"reference": sources.digest("reference", texts)}
        if job.engine.endswith(".py"):
            code["engine"] = sources.digest(job.engine, texts)
        if _reads_hand_written(job):
            parts = Implementation(job.implementation).sources
            code["implementation"] = " ".join(sources.digest(part, texts) for part in parts)
        return key([SCHEMA, dataclasses.asdict(_identity(job)), engine.version(), code])
    except (CollisionsError, OSError) as error:
        _log.info("%s: without cache: %s", job, error)
        return None


def key_of_recorded(job: Job, texts: Texts | None = None) -> str | None:
    """A hash of everything that a job's recording gives depends on; None where the engine has no recordings."""
    known = texts or Texts()
    recorded = known.data(files.FOLDER / job.engine)
    if not recorded:
        return None
    code, sums = [sources.digest("reference", known)], checksums.kept(files.FOLDER)
    if _is_steered(job):  # the prediction by which the recording is judged runs the rule; a student's copy may lack it
        with contextlib.suppress(CollisionsError, OSError):
            code += [sources.digest(part, known) for part in Implementation(job.implementation).sources]
    return key([SCHEMA, "recorded", dataclasses.asdict(_identity(job)), recorded, sums, code])


def key(known: list[Any]) -> str:
    """A hash of what is known to make a result, and of the versions and the machine that make it."""
    return hashlib.sha256(json.dumps([*known, _surroundings()], sort_keys=True).encode()).hexdigest()


def _surroundings() -> dict[str, str]:
    return {
        "numpy": np.__version__,
        "python": platform.python_version(),
        "implementation": platform.python_implementation(),
        "platform": platform.platform(),
        "machine": platform.machine(),
    }


def _reads_hand_written(job: Job) -> bool:
    """Whether hand-written code may take part: an engine of ours that wraps a package asks it for steering alone."""
    return job.engine.endswith(".py") or load_engine(job.engine).package is None or _is_steered(job)


def _is_steered(job: Job) -> bool:
    """Whether hand-written rules steer bodies in the family of a job; a published case has no family."""
    family = catalogue().get(getattr(job, "family", ""))
    return family is not None and family.steered


def _identity(job: Job) -> Any:
    """The job as far as its result depends on it: a student's own code must not cost new runs of PyBullet."""
    identity: Any = job.without_remarks()
    return identity if _reads_hand_written(job) else dataclasses.replace(identity, implementation="")


def _packed(result: Result) -> bytes:
    return sealed(SCHEMA, pickle.dumps(result, protocol=5))


def _unpacked(content: bytes) -> Any:
    """The result in a file's bytes; None for a file that is damaged, of another version or no result at all."""
    body = unsealed(SCHEMA, content)
    if body is None:
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
