"""Results of demonstrations that nobody ran: every quantity has the number that a test wants."""

from __future__ import annotations

import pytest

from labs.cli import show
from labs.demonstrations.catalogue import DEMONSTRATIONS
from labs.demonstrations.demonstration import Demonstration
from labs.demonstrations.outcomes import Outcome
from reference.catalogue.scenarios import catalogue
from reference.comparison.curves import Series
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine

EVERY = pytest.mark.parametrize("demonstration", DEMONSTRATIONS, ids=[one.name for one in DEMONSTRATIONS])
MISSING = "is not there; to get it: pip install it"


def planned(demonstration: Demonstration) -> list[Job]:
    """The runs of a demonstration in all of its engines."""
    return show._planned(demonstration, None, "solutions")


def made(job: Job, number: float) -> JobResult:
    """A result that nobody ran: every quantity has this number, and theory says 1."""
    family = catalogue()[job.family]
    rows = tuple(
        Row(job.family, case, job.engine, job.profile, one.name, one.unit, Verdict.PASS, number, expected=1.0)
        for case in job.cases
        for one in family.quantities
    )
    times = tuple(place / 10 for place in range(11))
    series = Series(times, tuple(number * time for time in times)) if family.curve.case in job.cases else None
    return JobResult(job, load_engine(job.engine).title, "", rows, series=series)


def absent(job: Job) -> JobResult:
    """The result of an engine that is not installed."""
    row = Row(job.family, "all", job.engine, job.profile, "", "", Verdict.NOT_AVAILABLE, note=f"{job.engine} {MISSING}")
    return JobResult(job, load_engine(job.engine).title, "", (row,))


def seen_of(demonstration: Demonstration, *missing: str) -> Outcome:
    """What a demonstration shows where every number is 0.5 and some engines are missing."""
    results = [absent(job) if job.engine in missing else made(job, 0.5) for job in planned(demonstration)]
    return Outcome(demonstration, tuple(results))
