"""Published cases as jobs, one case × engine each, which run as those of the lab's own catalogue do."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.errors import CollisionsError
from reference.published import recorded
from reference.published.judging import compare_published, refusal
from reference.published.results import PublishedJob, PublishedResult
from reference.published.theirs import published, published_cases
from reference.running.jobs import Work


def plan(names: Sequence[str], engines: Sequence[str], implementation: str = "solutions") -> list[PublishedJob]:
    """List the jobs that run these cases, or all if no case is named, in these engines; each job once.

    Raises
    ------
    UnknownName
        If there is no such case or engine.
    """
    known = published_cases()
    cases = [published(name.upper() if name.upper() in known else name).name for name in names] or list(known)
    for engine in engines:
        load_engine(engine)
    return list(dict.fromkeys(PublishedJob(case, engine, implementation) for case in cases for engine in engines))


def run_job(job: PublishedJob) -> PublishedResult:
    """Run a job here and now."""
    start = time.perf_counter()
    engine = load_engine(job.engine, Implementation(job.implementation))
    rows, answers = compare_published(published(job.case), engine)
    version = engine.version() if any(row.measured is not None for row in rows) else ""
    rows = tuple(replace(row, **engine.versions()) for row in rows)
    return PublishedResult(job, engine.title, rows, version, answers, seconds=time.perf_counter() - start)


def _refused(job: PublishedJob, error: CollisionsError, seconds: float) -> PublishedResult:
    engine = load_engine(job.engine)
    row = replace(refusal(published(job.case), engine.name, error), **engine.versions())
    return PublishedResult(job, engine.title, (row,), seconds=seconds)


PUBLISHED: Work[PublishedJob, PublishedResult] = Work(run_job, recorded.recall, _refused, list)
"""The jobs of the second catalogue."""
