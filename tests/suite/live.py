"""The live runs of a whole report, made once before `make verify` and read by every test that needs one.

    python tests/suite/live.py    runs what is missing; `make live` and `make verify` call it

A result is looked up by the job and by a hash of the sources that made it, as in the lab's own cache. If the sources
have changed since, there is no such result, and a test that asks for it fails: it never reads a stale number. With
`COLLISIONS_LIVE=here` in the environment nothing is read, and each test makes the runs that it asks for. So the study
of faults in the lab's own code, tests/faults, never meets a number from before the fault.
"""

from __future__ import annotations

import functools
import os
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from labs.cli import jobs
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.errors import EngineNotInstalled
from reference.pace import slowness
from reference.published import jobs as published_jobs
from reference.published.results import PublishedJob, PublishedResult
from reference.running.cache import Cache
from reference.running.isolate import stop_workers
from reference.running.protocol import Job as AnyJob
from reference.running.sources import Texts
from reference.running.study import SCENARIOS, plan, run_job

FOLDER = Path(__file__).parents[2] / ".live"
"""Beside the tests, and not in git."""
SLOWNESS = FOLDER / "slowness"
"""How many times as long the machine took as that of the allowances, when the runs were made."""
_TEXTS = Texts()
"""What this process has read of the sources: they do not change while it runs."""


@functools.cache
def planned() -> dict[tuple[str, str, str], Job]:
    """Each job of the whole report by family, engine and profile."""
    found = plan(catalogue().values(), engine_names(), with_studies=True)
    return {(job.family, job.engine, job.profile): replace(job, with_poses=True) for job in found}


def cache() -> Cache:
    """The results of the live runs."""
    return Cache(FOLDER)


def result(family: str, engine: str, profile: str) -> JobResult:
    """What a family gave in an engine: all of its cases, with error against timestep, its split and poses."""
    found: JobResult = _read(planned()[family, engine, profile])
    return found


def rows(family: str, engine: str, profile: str) -> tuple[Row, ...]:
    """The numbers of these cases."""
    return result(family, engine, profile).rows


def published(job: PublishedJob) -> PublishedResult:
    """What a published case gave in an engine."""
    found: PublishedResult = _read(job)
    return found


def _read(job: AnyJob) -> object:
    """The result of a job of the report. A test that asks for an engine that is not installed is skipped."""
    try:
        load_engine(job.engine).module()
    except EngineNotInstalled as error:
        pytest.skip(str(error))
    found = kept(job)
    if found is None:
        pytest.fail(f"{job} was not run with the sources as they are now; `make live` does it")
    return found


@functools.cache
def kept(job: AnyJob) -> Any:
    """The result of a job of the report, None if it was not run with the sources as they are now."""
    if os.environ.get("COLLISIONS_LIVE") == "here":
        return published_jobs.run_job(job) if isinstance(job, PublishedJob) else run_job(job)
    return cache().get(job, _TEXTS) if FOLDER.exists() else None


def make() -> int:
    """Run every job of a whole report that has not run with these sources, and say what that took.

    Returns 1, and says why, if a run gave no usable answer: such a result is not kept.
    """
    began, before = time.monotonic(), os.times()
    results = [
        *jobs.run_work(list(planned().values()), SCENARIOS, None, cache()),
        *jobs.run_work(published_jobs.plan((), engine_names()), published_jobs.PUBLISHED, None, cache()),
    ]
    stop_workers()  # their processor time is known when they have ended
    used, here = sum(os.times()[:4]) - sum(before[:4]), slowness()
    if not all(result.cached for result in results):
        SLOWNESS.write_text(f"{here:.3f}", encoding="utf-8")
    print(
        f"The live runs took {time.monotonic() - began:.0f} s and {used:.0f} s of processor time. This machine takes"
        f" {here:.2f} times as long as the one of the allowances."
    )
    lost = [
        (result.job, row) for result in results for row in result.rows if row.verdict in (Verdict.CRASHED, Verdict.LOST)
    ]
    for job, row in lost:
        print(f"{job}, {row.case}: {row.note}")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(make())
