"""A study of scenarios: which jobs it needs, one family × engine × profile each, and how one of them runs."""

from __future__ import annotations

import contextlib
import itertools
import logging
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.comparison.compare import compare_case
from reference.comparison.convergence import Errors, errors_against_timestep
from reference.comparison.curves import Series
from reference.comparison.error_split import Split, split
from reference.comparison.errors_by_settings import Question
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict, verdict_of
from reference.engines import load_engine
from reference.engines.base import Engine
from reference.engines.implementation import Implementation
from reference.engines.profiles import EXACT, WORLD, counterpart, counts
from reference.errors import CollisionsError, InvalidInput, UnknownName, as_failed_run, one_line
from reference.recording import reading
from reference.recording.reading import track_of
from reference.running.jobs import Work
from reference.scene.settings import Option, Settings
from reference.scene.survey import Survey
from reference.scene.trajectory import Trajectory
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

    Where no profiles are named, an engine runs in all that it has. An engine that has none of the named ones for these
    cases runs in the one that counts, the first of them if there are two. Where no cases are named, a family runs one
    case `at` the given parameters, or all of its own that the profile has; see `Family.cases_in`. If profiles are named
    as well, the world is no exception there.

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
    known += [EXACT] * (WORLD in known)  # the world stands in for it
    for profile in profiles if known else ():
        if profile not in known:
            raise UnknownName("profile", profile, dict.fromkeys(known), counterpart(profile))
    jobs = []
    for family in families:
        wanted = tuple(dict.fromkeys((cases or {}).get(family.name, ())))
        place = tuple(_place(family, at, wanted).items()) if at else ()
        chosen = [family.case(case) for case in wanted] or Job(family.name, "", "", at=place).chosen(family)
        for name, engine in loaded.items():
            has = list(dict.fromkeys(profile for case in chosen for profile in engine.profiles(case.scenarios[0])))
            own = [profile for profile in profiles or has if profile in has]
            for profile in own or list(filter(counts, has))[:1]:
                named = wanted
                if not (wanted or place or profile in profiles):
                    named = _only(family.cases_in(engine, profile), _able(engine, profile, chosen))
                _check(engine, profile, _able(engine, profile, chosen), changes)
                fixed = tuple(sorted(changes.items()))
                jobs.append(Job(family.name, name, profile, named, implementation, fixed, with_studies, place))
    return list(dict.fromkeys(jobs))


def _able(engine: Engine, profile: str, cases: Iterable[Case]) -> list[Case]:
    """The cases for which an engine has a profile."""
    return [case for case in cases if profile in engine.profiles(case.scenarios[0])]


def _only(usual: Sequence[Case], able: Sequence[Case]) -> tuple[str, ...]:
    """The names of the usual cases; none, which stands for all that can be run, if that is what they are."""
    return () if len(usual) == len(able) else tuple(case.name for case in usual)


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
    try:
        if engine.runs_together(engine.settings(scenarios[0], job.profile)):
            scenarios = [max(scenarios, key=lambda each: each.duration)]
        moving = sum(each.duration * sum(not body.immovable for body in each.bodies) for each in scenarios)
        return moving / engine.settings(scenarios[0], job.profile).change(**dict(job.changes)).timestep
    except Exception:
        return 0.0  # its own run will say what is wrong


def _without_answer(job: Job, error: CollisionsError, seconds: float) -> JobResult:
    """The result of a job that failed as a whole: one row that says why."""
    engine = load_engine(job.engine)
    row = Row(job.family, ALL_CASES, engine.name, job.profile, "", "", verdict_of(error), note=str(error))
    row = replace(row, **engine.versions())
    description = catalogue()[job.family].profiles(engine).get(job.profile, job.profile)
    return JobResult(job, engine.title, description, (row,), seconds=seconds)


def run_job(job: Job) -> JobResult:
    """Run a job here and now: every case, with the curve, the poses and the studies that the job asks for."""
    start, used = time.perf_counter(), time.process_time()
    family = catalogue()[job.family]
    implementation = Implementation(job.implementation)
    engine = load_engine(job.engine, implementation)
    version, has = engine.version(), family.profiles(engine)
    engine.module()  # raises where it cannot be imported, before any case is tried
    asked, rows = Question.of(family, engine), list[Row]()
    series, shown, tracks = None, "", list[Track]()
    cases = job.cases_in(family, engine)  # where no case has the profile, the first one says so
    told = {case.name: engine.settings(case.scenarios[0], job.profile).change(**dict(job.changes)) for case in cases}
    ran = _together(engine, cases, told)
    for case in cases:
        settings = told[case.name]
        found, trajectories = compare_case(family, case, engine, job.profile, settings, ran.get(case.name))
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
        tuple(replace(row, **engine.versions()) for row in rows),
        shown,
        version,
        series,
        convergence,
        error_split,
        poses=tuple(tracks),
        functions=tuple(sorted(implementation.asked)),
        seconds=time.perf_counter() - start,
        processor_seconds=time.process_time() - used,
    )


def _together(engine: Engine, cases: Sequence[Case], told: Mapping[str, Settings]) -> dict[str, list[Trajectory]]:
    """The trajectories of cases that an engine runs together, by case.

    Where one of them fails, each case is left to run by itself, so that only the one that fails has no numbers.
    """
    found: dict[str, list[Trajectory]] = {}
    for settings in dict.fromkeys(told.values()):
        alike = [case for case in cases if told[case.name] == settings]
        if len(alike) > 1 and engine.runs_together(settings):
            with contextlib.suppress(CollisionsError), as_failed_run():
                ran = iter(engine.run_many([each for case in alike for each in case.scenarios], settings))
                found |= {case.name: list(itertools.islice(ran, len(case.scenarios))) for case in alike}
    return found


def _studies(asked: Question, family: Family, job: Job) -> tuple[Errors | None, Split | None]:
    """Error against timestep, where there are steps; and the split of the error.

    It is split for unchanged settings of the profile that counts first. The world is studied where it is the
    only method, and where a recurrence says how its error depends on the timestep.
    """
    has = asked.engine.profiles(asked.case.scenarios[0])
    first = next(filter(counts, has))
    if job.profile == WORLD and (first != WORLD or family.predict is None):
        return None, None
    settings = asked.engine.settings(asked.case.scenarios[0], job.profile).change(**dict(job.changes))
    asks = isinstance(asked.case.scenarios[0], Survey)
    convergence = None if asks else errors_against_timestep(asked, settings, family.convergence.factors)
    if job.profile != first or job.changes:
        return convergence, None
    return convergence, split(asked, convergence.order if convergence else None)


def _case_by_case(job: Job) -> list[Job]:
    """A job for each case of a job, without studies; none of points of a grid, or of a case at given parameters."""
    if job.grid or job.at:
        return []
    family = catalogue()[job.family]
    cases = job.cases_in(family, load_engine(job.engine, Implementation(job.implementation)))
    return [replace(job, cases=(case.name,), with_studies=False) for case in cases]


def _joined(job: Job, found: list[JobResult]) -> JobResult:
    """One result of the results of single cases. Of a case without numbers the row names the case.

    A result of the whole job may be among them, which says how its process was lost. Where the job has studies, these
    are missing, and the row names the case that they are of: a process that crashed did so in one of them. Otherwise a
    job that was lost to load has all its numbers now.
    """
    family = catalogue()[job.family]
    ran = [each for each in found if each.version] or found
    plotted = next((each for each in ran if each.job.cases == (family.curve.case,)), ran[0])
    studied = family.convergence.case
    rows = list[Row]()
    for each in found:
        for row in each.rows:
            if row.case == ALL_CASES and each.job != job:
                row = replace(row, case=each.job.cases[0])
            elif row.case == ALL_CASES and job.with_studies:
                lost = row.verdict is Verdict.LOST
                where = "; its studies are missing" if lost else f" in a study of {studied}, not in a run of its own"
                row = replace(row, case=studied, note=f"{row.note}{where}")
            elif row.case == ALL_CASES and row.verdict is Verdict.LOST and each.job == job:
                continue
            rows.append(row)
    return replace(
        plotted,
        job=job,
        rows=tuple(rows),
        poses=tuple(track for each in found for track in each.poses),
        functions=tuple(sorted({name for each in found for name in each.functions})),
        seconds=sum(each.seconds for each in found),
        processor_seconds=sum(each.processor_seconds for each in found),
    )


SCENARIOS: Work[Job, JobResult] = Work(run_job, reading.recall, _without_answer, longest_first, _case_by_case, _joined)
"""The jobs of the lab's own catalogue."""
