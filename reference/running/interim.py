"""What can be said of jobs before they have run: from the cache, from recordings, or that a run has not ended."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic

from reference.comparison.verdicts import Verdict
from reference.errors import InvalidInput, StillRunning
from reference.recording.files import NOT_RUN
from reference.running.availability import absent
from reference.running.cache import Cache, key_of_recorded
from reference.running.jobs import J, R, Work, each_isolated
from reference.running.sources import Texts

STILL = "running: the numbers come with the finished page"


@dataclass(frozen=True)
class _Recall(Generic[J, R]):
    """Reads the recording of a job; it pickles, so that a worker can do it."""

    work: Work[J, R]

    def __call__(self, job: J) -> R | None:
        try:
            return self.work.recorded(job)
        except InvalidInput:
            return None  # where the engine is missing, the run itself will say what is wrong


def before_the_runs(jobs: Sequence[J], work: Work[J, R], had: Sequence[R], cache: Cache, workers: int) -> list[R]:
    """A result for each job, now. had: those that the cache has.

    An engine that has runs to make is shown from its recordings in all its jobs, so that one engine is never shown as
    two. What has no recording either is said to be running.
    """
    known = {result.job: result for result in had}
    to_run = {job.engine for job in jobs if job not in known}
    recorded = _recorded([job for job in jobs if job.engine in to_run], work, cache, workers)
    here = {engine for engine in to_run if not absent(engine)}
    shown: list[R] = []
    for job in jobs:
        if job in recorded:
            shown.append(_of_today(recorded[job]) if job.engine in here else recorded[job])
        else:
            shown.append(known.get(job) or work.refused(job, StillRunning(STILL), 0.0))
    return shown


def _recorded(jobs: Sequence[J], work: Work[J, R], cache: Cache, workers: int) -> dict[J, R]:
    """What the recordings of these jobs give, where there are any; new results are kept in the cache."""
    texts = Texts()
    keys = {job: key for job in jobs if (key := key_of_recorded(job, texts)) is not None}
    found: dict[J, R] = {job: result for job in keys if (result := cache.get_recorded(job, texts)) is not None}
    missing = work.in_order(job for job in keys if job not in found)
    results, since = each_isolated(_Recall(work), missing, workers), Texts()
    for job, result in zip(missing, results, strict=True):
        if result is not None:
            cache.put(job, keys[job], result, since)
            found[job] = result
    return found


def _of_today(result: R) -> R:
    """A recorded result of an engine that is running here: what is not recorded of it is running, not missing."""
    rows = [
        replace(row, verdict=Verdict.RUNNING, note=STILL) if row.verdict is Verdict.NOT_AVAILABLE else row  # type: ignore[type-var]
        for row in result.rows
    ]
    words = result.recording.replace(NOT_RUN, "its runs here have not ended yet")
    changed: Any = result
    marked: R = replace(changed, rows=tuple(rows), recording=words)
    return marked
