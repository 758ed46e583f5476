"""What a job is, and what it gives back: plain data that pickles."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.comparison.convergence import Errors
from reference.comparison.curves import Series
from reference.comparison.error_split import Split
from reference.comparison.verdicts import Row
from reference.engines.base import Engine
from reference.errors import InvalidInput
from reference.scene.settings import Option
from reference.viewer.tracks import Track


@dataclass(frozen=True)
class Job:
    """One family × engine × profile.

    cases: names, all when empty. changes: settings to change, by name. with_studies: whether the error against timestep
    is measured, and split. at: values of the family's parameters, for one case there instead of the family's own cases.
    grid: whether the cases are all points of the family's grid instead. with_poses: whether the result has poses for a
    replay. with_curve: whether the curve is that of the job's one case, and not that of the family's plotted case.
    snapped: a remark that says what was moved to a recorded point; the result does not depend on it.
    """

    family: str
    engine: str
    profile: str
    cases: tuple[str, ...] = ()
    implementation: str = "solutions"
    changes: tuple[tuple[str, Option], ...] = ()
    with_studies: bool = False
    at: tuple[tuple[str, float], ...] = ()
    grid: bool = False
    with_poses: bool = False
    with_curve: bool = False
    snapped: str = ""

    def __str__(self) -> str:
        at = "".join(f", {name} {value:g}" for name, value in self.at)
        return f"{self.family}{at}{' on its grid' if self.grid else ''} in {self.engine}, {self.profile}"

    def without_remarks(self) -> Job:
        """The job without remarks on it, which its result does not depend on."""
        return replace(self, snapped="")

    def chosen(self, family: Family) -> tuple[Case, ...]:
        """The cases of its family that it runs.

        Raises
        ------
        UnknownName, InvalidInput
            If the family has no such parameter, or no such value of it.
        """
        if not (self.at or self.grid):
            return tuple(case for case in family.cases if not self.cases or case.name in self.cases)
        if family.grid is None:
            raise InvalidInput(f"{family.name} has no parameters that can be moved")
        return (family.grid.case(**dict(self.at)),) if self.at else family.grid.cases

    def cases_in(self, family: Family, engine: Engine) -> tuple[Case, ...]:
        """Those of the chosen cases for which the engine has the profile; all, if it has it for none."""
        chosen = self.chosen(family)
        return tuple(case for case in chosen if self.profile in engine.profiles(case.scenarios[0])) or chosen

    def plots(self, family: Family, case: Case) -> bool:
        """Whether the result has the curve of this case."""
        return not self.grid and (bool(self.at) or self.with_curve or case.name == family.curve.case)


@dataclass(frozen=True)
class JobResult:
    """All that a job gives back; plain data.

    title: of the engine. description: of the profile. settings: those of the plotted case, in words. recording: where
    and when it was measured, if not here. poses: of each case's first scenario, where the job asks for them. functions:
    the hand-written functions that it called. seconds: how long it took where it ran, and processor_seconds: of how
    much processor time. cached: whether it ran earlier, and the cache had its result.
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
    poses: tuple[Track, ...] = ()
    functions: tuple[str, ...] = field(default=(), compare=False)
    seconds: float = field(default=0.0, compare=False)
    processor_seconds: float = field(default=0.0, compare=False)
    cached: bool = field(default=False, compare=False)

    @property
    def label(self) -> str:
        """What a progress bar says of it."""
        return f"{self.job.family}, {self.title}, {self.job.profile}"
