"""A study of scenarios: which jobs it needs, one family × engine × profile each, and how one of them runs."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterable, Mapping, Sequence

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.comparison.compare import compare_case
from reference.comparison.convergence import Errors, errors_against_timestep
from reference.comparison.curves import Series
from reference.comparison.error_split import Split, split
from reference.comparison.errors_by_settings import Question
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, verdict_of
from reference.engines import load_engine
from reference.engines.base import Engine
from reference.engines.implementation import Implementation
from reference.engines.profiles import counterpart, counts
from reference.errors import CollisionsError, InvalidInput, UnknownName, one_line
from reference.recording import reading
from reference.recording.reading import track_of
from reference.running.jobs import Work
from reference.scene.settings import Option
from reference.viewer.tracks import Track

_log = logging.getLogger(__name__)


def plan(
    families: Iterable[Family],
    engines: Sequence[str],
    profiles: Sequence[str] = (),
    cases: Mapping[str, tuple[str, ...]] | None = None,
    implementation: str = "solutions",
    changes: Mapping[str, Option] | None = None,
    with_studies: bool = False,
    at: Mapping[str, float] | None = None,
) -> list[Job]:
    """List the jobs that compare these families in these engines, each job once.

    Where no profiles are named, an engine runs in all that it has. An engine that has none of the named ones for a
    family runs in the one that counts. Where no cases are named, a family runs all of its own, or one case `at` the
    given parameters.

    Raises
    ------
    UnknownName
        If none of these engines has a requested profile for any of these families, an engine lacks a setting that is
        to be changed, or a family has no such case or parameter.
    InvalidInput
        If a case cannot be run with the changed settings, or a parameter is out of range.
    """
    families, changes = list(families), dict(changes or {})
    loaded = {name: load_engine(name, Implementation(implementation)) for name in engines}
    known = [profile for engine in loaded.values() for family in families for profile in family.profiles(engine)]
    for profile in profiles if known else ():
        if profile not in known:
            raise UnknownName("profile", profile, dict.fromkeys(known), counterpart(profile))
    jobs = []
    for family in families:
        wanted = tuple(dict.fromkeys((cases or {}).get(family.name, ())))
        place = tuple(_place(family, at, wanted).items()) if at else ()
        chosen = [family.case(case) for case in wanted] or Job(family.name, "", "", at=place).chosen(family)
        for name, engine in loaded.items():
            has = family.profiles(engine)
            own = [profile for profile in profiles or has if profile in has]
            for profile in own or filter(counts, has):
                _check(engine, profile, chosen, changes)
                fixed = tuple(sorted(changes.items()))
                jobs.append(Job(family.name, name, profile, wanted, implementation, fixed, with_studies, place))
    return list(dict.fromkeys(jobs))


def _place(family: Family, at: Mapping[str, float], cases: Sequence[str]) -> dict[str, float]:
    """All parameters of a family, with defaults for those that are not given."""
    if family.grid is None:
        others = ", ".join(each.name for each in catalogue().values() if each.grid is not None)
        raise InvalidInput(f"{family.name} has no parameters that can be moved; these have: {others}")
    if cases:
        raise InvalidInput(f"{family.name}/{cases[0]} is one case, and so is what parameters make; name one of the two")
    for name in at:
        if name not in family.grid.names:
            raise UnknownName(f"parameter of {family.name}", name, family.grid.names)
    return family.grid.full(at)


def _check(engine: Engine, profile: str, cases: Iterable[Case], changes: Mapping[str, Option]) -> None:
    """Refuse settings that cannot be used, before anything runs. Other errors of an engine appear in its own job."""
    for case in cases:
        try:
            settings = engine.settings(case.scenarios[0], profile).change(**changes)
            for scenario in case.scenarios:
                engine.check_settings(scenario, settings)
        except UnknownName as error:
            whose = f"{error.kind} of {engine.title}'s {profile} profile"
            raise UnknownName(whose, error.value, error.choices) from None
        except InvalidInput:
            raise
        except Exception as error:
            _log.warning("%s has no settings for %s: %s", engine.title, case.name, one_line(error))
            return


def longest_first(jobs: Iterable[Job]) -> list[Job]:
    """Jobs in the order in which to start them, so that no long one runs alone at the end while processors idle."""
    return sorted(jobs, key=_steps, reverse=True)


def _steps(job: Job) -> float:
    """Steps that a job takes times the bodies that move, roughly proportional to its duration."""
    engine, family = load_engine(job.engine), catalogue()[job.family]
    scenarios = [each for case in job.chosen(family) for each in case.scenarios]
    moving = sum(each.duration * sum(not body.immovable for body in each.bodies) for each in scenarios)
    try:
        return moving / engine.settings(scenarios[0], job.profile).change(**dict(job.changes)).timestep
    except Exception:
        return 0.0  # its own run will say what is wrong


def _without_answer(job: Job, error: CollisionsError, seconds: float) -> JobResult:
    """The result of a job that failed as a whole: one row that says why."""
    engine = load_engine(job.engine)
    row = Row(job.family, ALL_CASES, engine.name, job.profile, "", "", verdict_of(error), note=str(error))
    description = catalogue()[job.family].profiles(engine).get(job.profile, job.profile)
    return JobResult(job, engine.title, description, (row,), seconds=seconds)


def run_job(job: Job) -> JobResult:
    """Run a job here and now: every case, with the curve, the poses and the studies that the job asks for."""
    start = time.perf_counter()
    family = catalogue()[job.family]
    implementation = Implementation(job.implementation)
    engine = load_engine(job.engine, implementation)
    version, has = engine.version(), family.profiles(engine)
    engine.module()  # raises where it cannot be imported, before any case is tried
    asked, rows = Question.of(family, engine), list[Row]()
    series, shown, tracks = None, "", list[Track]()
    for case in job.chosen(family):
        settings = engine.settings(case.scenarios[0], job.profile).change(**dict(job.changes))
        found, trajectories = compare_case(family, case, engine, job.profile, settings)
        rows += found
        if case.name == family.curve.case or not shown:
            shown = settings.describe()
        if trajectories and job.plots(family, case):
            series = Series.of(family, trajectories[0])
        if trajectories and job.with_poses:
            tracks.append(track_of(job, engine, case, settings, trajectories[0]))
        if case == asked.case:
            asked.remember(settings, trajectories)
    convergence, error_split = _studies(asked, family, job) if job.with_studies else (None, None)
    return JobResult(
        job,
        engine.title,
        has[job.profile],
        tuple(rows),
        shown,
        version,
        series,
        convergence,
        error_split,
        poses=tuple(tracks),
        functions=tuple(sorted(implementation.asked)),
        seconds=time.perf_counter() - start,
    )


def _studies(asked: Question, family: Family, job: Job) -> tuple[Errors | None, Split | None]:
    """Error against timestep; and the split of the error, which exists for the unchanged settings that count alone."""
    settings = asked.engine.settings(asked.case.scenarios[0], job.profile).change(**dict(job.changes))
    convergence = errors_against_timestep(asked, settings, family.convergence.factors)
    if not counts(job.profile) or job.changes:
        return convergence, None
    return convergence, split(asked, convergence.order if convergence else None)


SCENARIOS: Work[Job, JobResult] = Work(run_job, reading.recall, _without_answer, longest_first)
"""The jobs of the lab's own catalogue."""
