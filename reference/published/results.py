"""What a job of the second catalogue is, and what it gives back: plain data that pickles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from reference.published import Answer
from reference.published.judging import PublishedRow


@dataclass(frozen=True)
class PublishedJob:
    """One published case × engine."""

    case: str
    engine: str
    implementation: str = "solutions"

    def __str__(self) -> str:
        return f"{self.case} in {self.engine}"

    def shared(self) -> PublishedJob:
        """The job without what its result does not depend on: all of it counts."""
        return self


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
