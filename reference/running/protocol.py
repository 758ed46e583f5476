"""What the runner and the cache need of a job and of its result, so that they know neither catalogue."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, Self

from reference.comparison.verdicts import Verdict


class Job(Protocol):
    """One run to be made: a frozen dataclass of plain data, which pickles and hashes."""

    @property
    def engine(self) -> str:
        """The name of an engine, or the path of a `.py` file that defines one."""

    @property
    def implementation(self) -> str:
        """Where the hand-written code comes from: a package, or the path of a `.py` file."""

    def without_remarks(self) -> Self:
        """The job without remarks on it, which its result does not depend on."""


class Row(Protocol):
    """One number of a result."""

    @property
    def case(self) -> str:
        """The case that it belongs to, or that it speaks of a whole run."""

    @property
    def verdict(self) -> Verdict:
        """The verdict on the number."""

    @property
    def note(self) -> str:
        """Why there is no number, or why it deviates."""


class Result(Protocol):
    """What a job gives back: a frozen dataclass of plain data."""

    @property
    def job(self) -> Any:
        """The job that it is the result of."""

    @property
    def label(self) -> str:
        """What a progress bar says of it."""

    @property
    def rows(self) -> Sequence[Row]:
        """Its numbers, each with a verdict."""

    @property
    def recording(self) -> str:
        """Where and when it was measured, if not here."""

    @property
    def seconds(self) -> float:
        """How long it took where it ran, s."""
