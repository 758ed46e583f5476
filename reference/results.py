"""What a job is, and what it gives back: plain data that pickles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from reference.compare import Row
from reference.published import Answer
from reference.published.judging import PublishedRow
from reference.settings import Option
from reference.shares import Split


@dataclass(frozen=True)
class Job:
    """One family × engine × profile. cases: names, all when empty. changes: settings to change, by name."""

    family: str
    engine: str
    profile: str
    cases: tuple[str, ...] = ()
    implementation: str = "solutions"
    changes: tuple[tuple[str, Option], ...] = ()
    with_studies: bool = False

    def __str__(self) -> str:
        return f"{self.family} in {self.engine}, {self.profile}"


@dataclass(frozen=True)
class Series:
    """A plotted curve: times in s, values in the unit of the family's curve."""

    times: tuple[float, ...]
    values: tuple[float, ...]


@dataclass(frozen=True)
class Errors:
    """Error against timestep. order: slope of the log–log line, None where every error is rounding."""

    timesteps: tuple[float, ...]
    errors: tuple[float, ...]
    order: float | None


@dataclass(frozen=True)
class JobResult:
    """All that a job gives back; plain data.

    seconds: what it took where it ran. cached: whether that was earlier, and the cache had it. recording: where and
    when it was measured, if not here.
    """

    job: Job
    title: str
    description: str
    rows: tuple[Row, ...]
    settings: str = ""
    version: str = ""
    series: Series | None = None
    convergence: Errors | None = None
    split: Split | None = None
    recording: str = ""
    seconds: float = field(default=0.0, compare=False)
    cached: bool = field(default=False, compare=False)

    @property
    def label(self) -> str:
        """What a progress bar says of it."""
        return f"{self.job.family}, {self.title}, {self.job.profile}"


@dataclass(frozen=True)
class PublishedJob:
    """One published case × engine."""

    case: str
    engine: str
    implementation: str = "solutions"

    def __str__(self) -> str:
        return f"{self.case} in {self.engine}"


@dataclass(frozen=True)
class PublishedResult:
    """What a published case gave in one engine; plain data.

    answers: what the rows were judged from. version, recording, seconds, cached: as in `JobResult`.
    """

    job: PublishedJob
    title: str
    rows: tuple[PublishedRow, ...]
    version: str = ""
    answers: Mapping[str, Answer] = field(default_factory=dict)
    recording: str = ""
    seconds: float = field(default=0.0, compare=False)
    cached: bool = field(default=False, compare=False)

    @property
    def label(self) -> str:
        """What a progress bar says of it."""
        return f"{self.job.case}, {self.title}"
