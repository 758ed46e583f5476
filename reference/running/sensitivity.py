"""Injected faults as jobs, one family × engine × profile each, which run as those of a study do."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from reference.catalogue.scenarios import catalogue
from reference.comparison import sensitivity
from reference.comparison.results import Job
from reference.comparison.sensitivity import Sensitivity
from reference.comparison.verdicts import ALL_CASES, Row, verdict_of
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.engines.profiles import STOCK, WORLD, counts
from reference.errors import CollisionsError
from reference.running.jobs import Work
from reference.running.study import longest_first

LONG_IN_THE_WORLD = (
    "ball-to-rest", "sliding-slab", "incline", "critical-incline", "two-frictions", "tipping-box",
    "break-away", "slab-at-30-degrees", "creep", "friction-oscillator",
)  # fmt: skip
"""Families whose faults are not tried in the hand-written world: it would take one to ten minutes each.

They follow the recurrence that the world has in all other families, where faults are tried. Nor are those tried that
have no recurrence: what theory's tolerance lets pass is known of the engines.
"""


@dataclass(frozen=True)
class SensitivityJob:
    """All faults in one family × engine × profile."""

    family: str
    engine: str
    profile: str
    implementation: str = "solutions"

    def __str__(self) -> str:
        return f"faults of {self.family} in {self.engine}, {self.profile}"

    def without_remarks(self) -> SensitivityJob:
        """The job itself: nobody remarks on it."""
        return self


@dataclass(frozen=True)
class SensitivityResult:
    """What the faults of a job turned red. rows: without any fault, or one that says why there are none.

    sensitivity: None where there is no number to spoil. recording, seconds, cached: as in `JobResult`.
    """

    job: SensitivityJob
    title: str
    rows: tuple[Row, ...]
    sensitivity: Sensitivity | None = None
    recording: str = ""
    seconds: float = field(default=0.0, compare=False)
    cached: bool = field(default=False, compare=False)

    @property
    def label(self) -> str:
        """What a progress bar says of it."""
        return f"{self.job.family}, {self.title}, {self.job.profile}"


def plan(families: Sequence[str], engines: Sequence[str]) -> list[SensitivityJob]:
    """List the jobs: profiles that count, and those others whose method has a recurrence; none that is stock."""
    found = []
    for name in families:
        family = catalogue()[name]
        scenario = sensitivity.chosen(family)[0].scenarios[0]
        for engine in engines:
            loaded = load_engine(engine)
            for profile in family.profiles(loaded):
                if profile == STOCK:
                    continue  # what a user gets who sets nothing counts nowhere
                if profile == WORLD and (family.predict is None or name in LONG_IN_THE_WORLD):
                    continue
                if counts(profile) or loaded.method(scenario, loaded.settings(scenario, profile)).rule:
                    found.append(SensitivityJob(name, engine, profile))
    return list(dict.fromkeys(found))


def run_job(job: SensitivityJob) -> SensitivityResult:
    """Inject the faults here and now."""
    start = time.perf_counter()
    engine = load_engine(job.engine, Implementation(job.implementation))
    engine.version(), engine.module()  # raises where it is missing, before any case is tried
    found, rows = sensitivity.sensitivity(catalogue()[job.family], engine, job.profile)
    return SensitivityResult(job, engine.title, rows, found, seconds=time.perf_counter() - start)


def _refused(job: SensitivityJob, error: CollisionsError, seconds: float) -> SensitivityResult:
    engine = load_engine(job.engine)
    row = Row(job.family, ALL_CASES, engine.name, job.profile, "", "", verdict_of(error), note=str(error))
    return SensitivityResult(job, engine.title, (row,), seconds=seconds)


def _not_recorded(_: SensitivityJob) -> None:
    """A fault cannot be injected into a recording."""


def _longest_first(jobs: Iterable[SensitivityJob]) -> list[SensitivityJob]:
    studies = {}
    for job in jobs:
        cases = tuple(case.name for case in sensitivity.chosen(catalogue()[job.family]))
        studies[Job(job.family, job.engine, job.profile, cases)] = job
    return [studies[job] for job in longest_first(studies)]


SENSITIVITY: Work[SensitivityJob, SensitivityResult] = Work(run_job, _not_recorded, _refused, _longest_first)
"""The jobs of `collisions sensitivity`."""
