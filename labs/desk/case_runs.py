"""Runs one case with the student's functions and in the engines: the request, its jobs, and their results."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, field, replace

from labs.desk.student_code import StudentCode
from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import find
from reference.comparison.results import Job, JobResult
from reference.engines import load_engine
from reference.engines.profiles import EXACT, TUNED
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
"""The options of every run besides the parameters of its scenario."""
HANDWRITTEN, YOURS, GIVEN = "handwritten", "yours", "given"
TIME_LIMIT = 30.0
"""Of one run, s; then an endless loop in a function is stopped and reported."""
Progress = Callable[[int, int, str], None]
"""How many runs are done, of how many, and which one was the last."""


def chosen_engines(engines: Sequence[str] | str | None) -> Sequence[str]:
    """The engines that were named, one or several; the usual ones if none was named."""
    return ENGINES if engines is None else [engines] if isinstance(engines, str) else engines


@dataclass(frozen=True)
class CaseRuns:
    """The runs of one case. results: the student's first, then the engines'. own: functions that the student wrote."""

    family: Family
    case: Case
    results: tuple[JobResult, ...]
    own: Collection[str] = ()

    @property
    def title(self) -> str:
        """What was run, as a heading: the case, or the parameters that were given instead of it."""
        moved = ", ".join(f"{name}={value:g}" for name, value in self.results[0].job.at)
        return f"{self.family.title}, {moved or self.case.name}"

    @property
    def section(self) -> Section:
        """The results as tables and figures take them."""
        return sections(self.results)[0]

    @property
    def lines(self) -> Sequence[Line]:
        """One for each implementation."""
        return self.section.lines

    def timestep(self, line: Line) -> float:
        """The timestep of one implementation, s."""
        job = line.result.job
        settings = load_engine(job.engine).settings(self.case.scenarios[0], job.profile)
        return settings.change(**dict(job.changes)).timestep

    @property
    def snapped(self) -> str:
        """What was moved to a recorded point, in words; empty if nothing was moved."""
        return next((result.job.snapped for result in self.results if result.job.snapped), "")

    @property
    def poses(self) -> dict[str, Poses]:
        """What a replay shows, by engine: the poses of every run that has them."""
        shown = [(result, track) for result in self.results for track in result.poses[:1]]
        return {result.job.engine: unpack(track, result.title, result.recording) for result, track in shown}

    def with_notes(self, reworded: Callable[[str], str]) -> CaseRuns:
        """The same runs with their notes reworded."""
        results = (
            replace(result, rows=tuple(replace(row, note=reworded(row.note)) for row in result.rows))
            for result in self.results
        )
        return replace(self, results=tuple(results))


@dataclass(frozen=True)
class Request:
    """What is to be run: a case, `family/case`, or a family at values of its parameters.

    profile: the method of the hand-written code; engines are tuned. timestep: s; None for each implementation's own.
    recorded: whether a recording of exactly this run takes the place of an engine, which is quicker. options: the names
    that a misspelt parameter may have been meant to be.
    """

    scenario: str
    engines: Sequence[str] = ENGINES
    profile: str = EXACT
    timestep: float | None = None
    at: Mapping[str, float] = field(default_factory=dict)
    recorded: bool = False
    options: Sequence[str] = OPTIONS


def run_case(request: Request, code: StudentCode, progress: Progress = lambda done, of, label: None) -> CaseRuns:
    """Run a case with the student's code and in the engines.

    If an engine has recordings only, all implementations run at the nearest recorded point. A run that needs none of
    the student's functions is titled given.

    Raises
    ------
    UnknownName, InvalidInput
        If there is no such scenario, engine, profile or parameter, or a value is out of range.
    """
    family, _ = find(request.scenario)
    jobs = _jobs(request, code.source)
    known = [_recorded(job) for job in jobs] if request.recorded else []
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
    runs = CaseRuns(family, case, tuple(_titled(found[job], code.functions) for job in jobs), code.functions)
    return runs.with_notes(code.located)


def _jobs(request: Request, implementation: str) -> list[Job]:
    """A job for the hand-written code and one for each engine, all at the same values."""
    family, case = find(request.scenario)
    movable = family.grid.names if family.grid else ()
    for name in request.at:
        if name not in movable:
            raise UnknownName(f"option, or parameter of {family.name},", name, (*request.options, *movable))
    if case is None and not request.at:
        case = family.case(family.curve.case)
    changes: dict[str, Option] = {} if request.timestep is None else {"timestep": request.timestep}
    cases = {family.name: (case.name,)} if case is not None else {}
    jobs: list[Job] = []
    for engine in (HANDWRITTEN, *request.engines):
        profile = request.profile if engine == HANDWRITTEN else TUNED
        jobs += plan([family], [engine], [profile], cases, implementation, changes, at=dict(request.at))
    return snapped([replace(job, with_poses=True, with_curve=True) for job in jobs])


def _recorded(job: Job) -> JobResult | None:
    """The recording of exactly this job, with its curve; None if there is none, or if it is stale."""
    result = recall(job) if job.engine != HANDWRITTEN else None
    whole = result and result.series and all(row.measured is not None for row in result.rows)
    return result if whole else None


def _titled(result: JobResult, own: Collection[str]) -> JobResult:
    """The hand-written run is titled yours, unless it ran without any of the student's functions."""
    if result.job.engine != HANDWRITTEN:
        return result
    ran = any(row.measured is not None for row in result.rows)
    foreign = ran and result.functions and not set(own) & set(result.functions)
    return replace(result, title=GIVEN if foreign else YOURS)
