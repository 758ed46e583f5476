"""Comparing like with like: where one engine has only recordings, all jobs move to the nearest recorded point.

The recordings of an engine that is not installed here hold the points of its grid alone. To run the other engines at a
value in between would compare answers to two questions. So the question is moved for all of them, and the jobs say so.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Sequence
from dataclasses import replace

from reference import checks
from reference.catalogue.grid import nearest
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.engines import load_engine
from reference.errors import InvalidInput, listed
from reference.recording.files import content_of
from reference.running.availability import absent


def snapped(jobs: Sequence[Job]) -> list[Job]:
    """The same jobs, those of a family moved to a recorded point if one of their engines has only recordings."""
    missing = {name: absent(name) for name in {job.engine for job in jobs if _movable(job)}}
    found: list[Job] = []
    for job in jobs:
        own = [other for other in jobs if other.family == job.family and _movable(other) and missing[other.engine]]
        engines = [other.engine for other in own if _is_recorded(other)]
        found.append(moved(job, dict.fromkeys(engines)) if engines and _movable(job) else job)
    return list(dict.fromkeys(found))


def moved(job: Job, recorded: Iterable[str]) -> Job:
    """A job at the nearest point of its family's grid, because these engines are shown from recordings."""
    grid, changes = catalogue()[job.family].grid, dict(job.changes)
    assert grid is not None
    timestep = checks.positive("timestep", changes["timestep"]) if "timestep" in changes else None  # type: ignore[arg-type]
    point = nearest(grid, dict(job.at), timestep)
    if not point.moved:
        return job
    if point.timestep is not None:
        changes["timestep"] = point.timestep
    titles = [load_engine(name).title for name in recorded]
    are = "are" if len(titles) > 1 else "is"
    words = f"{job.family}: {point.moved} for all, since {listed(titles)} {are} shown from recordings"
    at = tuple(point.at.items()) if job.at else ()
    return replace(job, at=at, changes=tuple(sorted(changes.items())), snapped=words)


def _is_recorded(job: Job) -> bool:
    """Whether an engine has a recording of a family that can be used; if it cannot, the job's own row will say why."""
    with contextlib.suppress(InvalidInput):
        return bool(content_of(job.engine, job.family))
    return False


def _movable(job: Job) -> bool:
    """Whether a recording could answer a job if it were moved: it sets parameters or the timestep, nothing else."""
    names = {name for name, _ in job.changes}
    return catalogue()[job.family].grid is not None and bool(job.at or names) and names <= {"timestep"}
