"""One case, asked of the student's functions and of the engines: jobs, their results, and what is said meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, replace

from reference.cache import Cache
from reference.compare import TUNED
from reference.errors import UnknownName
from reference.family import Case, Family
from reference.recording import recall
from reference.replay import Poses, unpack
from reference.report.summary import Line, Section, sections
from reference.results import Job, JobResult
from reference.running import run_all
from reference.scenarios import find
from reference.settings import Option
from reference.snapping import snapped
from reference.study import SCENARIOS, plan

ENGINES = ("pybullet", "mujoco")
OPTIONS = ("engines", "profile", "timestep")
"""What every run is told besides its parameters."""
HANDWRITTEN, YOURS, GIVEN = "handwritten", "yours", "given"
TIME_LIMIT = 30.0
"""Of one run, s: an endless loop in a function is told so after this."""
Progress = Callable[[int, int, str], None]
"""How many runs are done, of how many, and what has just come."""


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


def ask(
    scenario: str,
    implementation: str,
    engines: Sequence[str] = ENGINES,
    profile: str = TUNED,
    timestep: float | None = None,
    at: Mapping[str, float] | None = None,
    progress: Progress = lambda done, of, label: None,
    recorded: bool = False,
    own: Collection[str] = (),
    options: Sequence[str] = OPTIONS,
) -> Asked:
    """Run a case of the catalogue, `family/case`, or of a family at values of its parameters.

    profile: of the hand-written side; engines are tuned. recorded: whether engines answer from recordings where these
    have just what is asked, which is quicker. Where an engine has nothing but recordings, all are asked at the nearest
    recorded point. own: the functions that the student has written; a run of none of them is called given. options:
    what may be asked for besides parameters, for who misspells one.

    Raises
    ------
    UnknownName, InvalidInput
        If there is no such scenario, engine, profile or parameter, or a value is out of range.
    """
    family, case = find(scenario)
    movable = family.grid.names if family.grid else ()
    for name in at or {}:
        if name not in movable:
            raise UnknownName(f"option, or parameter of {family.name},", name, (*options, *movable))
    if case is None and not at:
        case = family.case(family.curve.case)
    changes: dict[str, Option] = {} if timestep is None else {"timestep": timestep}
    cases = {family.name: (case.name,)} if case is not None else {}
    jobs: list[Job] = []
    for engine in (HANDWRITTEN, *engines):
        wanted = profile if engine == HANDWRITTEN else TUNED
        jobs += plan([family], [engine], [wanted], cases, implementation, changes, at=dict(at or {}))
    jobs = snapped([replace(job, with_poses=True, with_curve=True) for job in jobs])
    known = [_recorded(job) for job in jobs] if recorded else []
    found = {result.job: result for result in known if result is not None}
    missing = [job for job in jobs if job not in found]
    with (
        ThreadPoolExecutor(len(jobs)) as executor,
        closing(run_all(missing, SCENARIOS, executor, TIME_LIMIT, Cache())) as finished,
    ):
        for result in finished:
            found[result.job] = result
            progress(len(found), len(jobs), result.title)
    (asked,) = jobs[0].chosen(family)
    return Asked(family, asked, tuple(_named(found[job], own) for job in jobs))


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
