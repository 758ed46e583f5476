"""What the runner and the cache ask of a job and of its result, whichever catalogue these belong to."""

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

    def shared(self) -> Self:
        """The job without what its result does not depend on."""


class Row(Protocol):
    """One number of a result."""

    @property
    def verdict(self) -> Verdict:
        """How the number stands to what is expected of it."""


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
        """What it took where it ran, s."""
