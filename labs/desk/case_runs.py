"""One case, asked of the student's functions and of the engines: jobs, their results, and what is said meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, field, replace

from labs.desk.student_code import Hand
from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import find
from reference.comparison.results import Job, JobResult
from reference.engines.profiles import TUNED
from reference.errors import UnknownName
from reference.recording.reading import recall
from reference.report.sections import Line, Section, sections
from reference.running.cache import Cache
from reference.running.jobs import run_all
from reference.running.snapping import snapped
from reference.running.study import SCENARIOS, plan
from reference.scene.settings import Option
from reference.viewer.poses import Poses
from reference.viewer.tracks import unpack

ENGINES = ("pybullet", "mujoco")
OPTIONS = ("engines", "profile", "timestep")
"""What every run is told besides its parameters."""
HANDWRITTEN, YOURS, GIVEN = "handwritten", "yours", "given"
TIME_LIMIT = 30.0
"""Of one run, s: an endless loop in a function is told so after this."""
Progress = Callable[[int, int, str], None]
"""How many runs are done, of how many, and what has just come."""


def named(engines: Sequence[str] | str | None) -> Sequence[str]:
    """The engines that are named, one or several; the usual ones where nothing is said."""
    return ENGINES if engines is None else [engines] if isinstance(engines, str) else engines


@dataclass(frozen=True)
class Asked:
    """What came of one case. results: the student's first, then the engines'."""

    family: Family
    case: Case
    results: tuple[JobResult, ...]

    @property
    def title(self) -> str:
        """What was asked, as a heading: the case, or the parameters that stand in its place."""
        at = self.results[0].job.at
        moved = ", ".join(f"{name}={value:g}" for name, value in at)
        return f"{self.family.title}, {moved or self.case.name}"

    @property
    def section(self) -> Section:
        """The results as tables and figures take them."""
        return sections(self.results)[0]

    @property
    def lines(self) -> Sequence[Line]:
        """One for each implementation."""
        return self.section.lines

    @property
    def snapped(self) -> str:
        """What was moved to a recorded point, in words; empty where nothing was."""
        return next((result.job.snapped for result in self.results if result.job.snapped), "")

    @property
    def poses(self) -> dict[str, Poses]:
        """What a replay shows, by engine: of every run that has poses."""
        shown = [(result, track) for result in self.results for track in result.poses[:1]]
        return {result.job.engine: unpack(track, result.title, result.recording) for result, track in shown}

    def told(self, words: Callable[[str], str]) -> Asked:
        """The same with its notes in other words."""
        results = (
            replace(result, rows=tuple(replace(row, note=words(row.note)) for row in result.rows))
            for result in self.results
        )
        return replace(self, results=tuple(results))


@dataclass(frozen=True)
class Wanted:
    """What is to be run: a case, `family/case`, or a family at values of its parameters.

    profile: of the hand-written side; engines are tuned. timestep: s, each one's own if there is none. recorded:
    whether engines answer from recordings where these have just what is asked, which is quicker. options: what may be
    asked for besides parameters, for who misspells one.
    """

    scenario: str
    engines: Sequence[str] = ENGINES
    profile: str = TUNED
    timestep: float | None = None
    at: Mapping[str, float] = field(default_factory=dict)
    recorded: bool = False
    options: Sequence[str] = OPTIONS


def ask(wanted: Wanted, hand: Hand, progress: Progress = lambda done, of, label: None) -> Asked:
    """Run it with the functions of a hand and in the engines.

    Where an engine has nothing but recordings, all are asked at the nearest recorded point. A run that asks for none of
    the student's functions is called given.

    Raises
    ------
    UnknownName, InvalidInput
        If there is no such scenario, engine, profile or parameter, or a value is out of range.
    """
    family, _ = find(wanted.scenario)
    jobs = _jobs(wanted, hand.source)
    known = [_recorded(job) for job in jobs] if wanted.recorded else []
    found = {result.job: result for result in known if result is not None}
    missing = [job for job in jobs if job not in found]
    with (
        ThreadPoolExecutor(len(jobs)) as executor,
        closing(run_all(missing, SCENARIOS, executor, TIME_LIMIT, Cache())) as finished,
    ):
        for result in finished:
            found[result.job] = result
            progress(len(found), len(jobs), result.title)
    (case,) = jobs[0].chosen(family)
    return Asked(family, case, tuple(_named(found[job], hand.functions) for job in jobs)).told(hand.located)


def _jobs(wanted: Wanted, implementation: str) -> list[Job]:
    """A job for the hand-written side and one for each engine, all at one point."""
    family, case = find(wanted.scenario)
    movable = family.grid.names if family.grid else ()
    for name in wanted.at:
        if name not in movable:
            raise UnknownName(f"option, or parameter of {family.name},", name, (*wanted.options, *movable))
    if case is None and not wanted.at:
        case = family.case(family.curve.case)
    changes: dict[str, Option] = {} if wanted.timestep is None else {"timestep": wanted.timestep}
    cases = {family.name: (case.name,)} if case is not None else {}
    jobs: list[Job] = []
    for engine in (HANDWRITTEN, *wanted.engines):
        profile = wanted.profile if engine == HANDWRITTEN else TUNED
        jobs += plan([family], [engine], [profile], cases, implementation, changes, at=dict(wanted.at))
    return snapped([replace(job, with_poses=True, with_curve=True) for job in jobs])


def _recorded(job: Job) -> JobResult | None:
    """What was recorded of just this job, with its curve; None where that is nothing, or stale."""
    result = recall(job) if job.engine != HANDWRITTEN else None
    whole = result and result.series and all(row.measured is not None for row in result.rows)
    return result if whole else None


def _named(result: JobResult, own: Collection[str]) -> JobResult:
    """The hand-written side is the student's, unless it ran without asking for any of the student's functions."""
    if result.job.engine != HANDWRITTEN:
        return result
    ran = any(row.measured is not None for row in result.rows)
    foreign = ran and result.functions and not set(own) & set(result.functions)
    return replace(result, title=GIVEN if foreign else YOURS)
