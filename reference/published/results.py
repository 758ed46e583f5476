"""What a job of the second catalogue is, and what it gives back: plain data that pickles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from reference.comparison.verdicts import Verdict
from reference.published.answers import Answer


@dataclass(frozen=True)
class PublishedJob:
    """One published case × engine."""

    case: str
    engine: str
    implementation: str = "solutions"

    def __str__(self) -> str:
        return f"{self.case} in {self.engine}"

    def without_remarks(self) -> PublishedJob:
        """The job itself: nobody remarks on it."""
        return self


@dataclass(frozen=True)
class PublishedRow:
    """One published number and what one implementation gives for it.

    figure: its name; empty in a row that speaks of the whole case. place: in a figure with several numbers, from 1;
    else 0. expected: as published. tolerance, reason: how near is near enough, and why. shift: how much the
    implementation's method changes the number. note: why it deviates, or why there is no number. engine_version,
    adapter_version, recorded_on: as in `Row`.
    """

    case: str
    engine: str
    figure: str
    place: int
    verdict: Verdict
    measured: float | None = None
    expected: float | None = None
    tolerance: float | None = None
    reason: str = ""
    shift: float = 0.0
    note: str = ""
    engine_version: str = field(default="", compare=False)
    adapter_version: str = field(default="", compare=False)
    recorded_on: str = field(default="", compare=False)

    @property
    def difference(self) -> float | None:
        """Ours minus theirs; None where either is missing."""
        return None if self.measured is None or self.expected is None else self.measured - self.expected


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
