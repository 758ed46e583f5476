"""What the commands share: which runs the options ask for, and running them with a progress bar."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import closing, contextmanager
from typing import Annotated, TypeVar

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from labs.cli import ending
from labs.cli.console import errors, output
from labs.correct_functions import package_of_correct_functions
from labs.desk.student_code import named_implementation
from labs.workers import on_cluster, what_runs_here
from reference import checks
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue, find
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Verdict
from reference.engines import engine_names
from reference.engines.implementation import Implementation
from reference.engines.profiles import TUNED, counts
from reference.errors import CannotWrite, InvalidInput, listed
from reference.published.theirs import published_cases
from reference.recording.files import never_recorded
from reference.report.overview import without_answer
from reference.running.cache import Cache
from reference.running.jobs import TIME_LIMIT, J, R, Work, recall, run_all
from reference.running.protocol import Result
from reference.running.snapping import snapped
from reference.running.study import SCENARIOS, plan
from reference.scene.settings import Option

V = TypeVar("V")

NO_ANSWER = (Verdict.CRASHED, Verdict.LOST)
_NO_NUMBER = (*NO_ANSWER, Verdict.NOT_AVAILABLE, Verdict.NEEDS, Verdict.CANNOT_EXPRESS, Verdict.NO_WORDS)
_MORE_TIME = (
    "A lost run has neither passed nor failed. Give each run more time with --seconds, or make fewer at a time with"
    " --jobs: the same command then makes those that are missing."
)

Scenarios = Annotated[
    list[str] | None,
    typer.Argument(metavar="SCENARIO", help="A scenario, or scenario/case; all if you name none.", show_default=False),
]
Engines = Annotated[
    list[str] | None,
    typer.Option("--engine", help="An engine, or the path of an engine file; repeat for several.", show_default=False),
]
Profiles = Annotated[
    list[str] | None,
    typer.Option(
        "--profile",
        help="exact, slide, step, … by hand; tuned, stock, … of an engine; repeat for several; all if you name none."
        " An implementation that has none of them runs exact or tuned.",
        show_default=False,
    ),
]
CORRECT = package_of_correct_functions() or "solutions"
"""The hand-written code that runs if none is named: the solutions, or what a student's tree has of them."""
Implementations = Annotated[
    str,
    typer.Option(
        callback=named_implementation, help="The hand-written code: a package, or a .py file's or notebook's path."
    ),
]
Workers = Annotated[
    int | None, typer.Option("--jobs", "-j", min=1, help="Runs at a time; by default one per processor.")
]
Cluster = Annotated[
    str | None,
    typer.Option(
        metavar="ADDRESS",
        help="Run on a Dask cluster: tcp://host:8786, or local:4 to start one here.",
        show_default=False,
    ),
]
Seconds = Annotated[
    float,
    typer.Option("--seconds", metavar="S", min=1e-3, max=1e6, help="How long each run may take; a longer one is lost."),
]
Fresh = Annotated[bool, typer.Option("--fresh", help="Run everything again, and keep the new results in the cache.")]


def planned(
    scenarios: Sequence[str] | None,
    engines: Sequence[str] | None,
    profiles: Sequence[str] | None = None,
    implementation: str = CORRECT,
    timestep: float | None = None,
    assignments: Sequence[str] | None = None,
    with_studies: bool = False,
    parameters: Sequence[str] | None = None,
) -> list[Job]:
    """List the jobs that a command line asks for, moved to a recorded point if an engine has only recordings."""
    families, cases = _chosen(scenarios or [])
    changes: dict[str, Option] = _each_once(_setting(text) for text in assignments or [])
    at = _each_once(_parameter(text) for text in parameters or [])
    if at and not scenarios:
        movable = ", ".join(family.name for family in families if family.grid is not None)
        raise InvalidInput(f"--at {parameters[0]!r} needs the scenario that it belongs to. Name one of: {movable}")  # type: ignore[index]
    if timestep is not None:
        changes = _each_once([*changes.items(), ("timestep", timestep)])
    engines = engines or engine_names()
    found = plan(families, engines, profiles or (), cases, implementation, changes, with_studies, at)
    for family in families:
        if words := never_recorded(family.name, engines):
            errors.print(f"Warning: {words}.", soft_wrap=True, markup=False)
    return snapped(found)


def _chosen(names: Sequence[str]) -> tuple[list[Family], dict[str, tuple[str, ...]]]:
    """The families of the given names, and the cases of those that are named with a case."""
    if not names:
        return list(catalogue().values()), {}
    wanted: dict[str, tuple[str, ...] | None] = {}
    for name in names:
        if name.upper() in published_cases():
            raise InvalidInput(f"{name} is other people's case, no scenario: collisions compare --published {name}")
        family, case = find(name)
        before = wanted.get(family.name, ())
        wanted[family.name] = None if case is None or before is None else (*before, case.name)
    families = [catalogue()[name] for name in wanted]
    return families, {name: tuple(dict.fromkeys(cases)) for name, cases in wanted.items() if cases}


def _each_once(assignments: Iterable[tuple[str, V]]) -> dict[str, V]:
    """Values by name; refuses two values of one name rather than guess which was meant."""
    found: dict[str, V] = {}
    for name, value in assignments:
        if name in found:
            raise InvalidInput(f"{name} is given twice, as {found[name]} and as {value}")
        found[name] = value
    return found


def _setting(text: str) -> tuple[str, Option]:
    """`name=value` of a setting; the settings themselves say what kind of value it takes."""
    return _assignment("--set", text, "contact_erp=0.2 with --engine pybullet")


def _parameter(text: str) -> tuple[str, float]:
    """`name=value` of a scenario's parameter."""
    name, value = _assignment("--at", text, "restitution=0.4")
    return name, checks.finite(name, value)  # type: ignore[arg-type]


def _assignment(option: str, text: str, example: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not name or not value:
        raise InvalidInput(f"{option} {text!r} is not of the form name=value, such as {option} {example}")
    return name.strip().replace(" ", "_").replace("-", "_"), value.strip()


def run(
    jobs: Sequence[Job],
    workers: int | None,
    cache: Cache | None = None,
    cluster: str | None = None,
    seconds: float = TIME_LIMIT,
) -> list[JobResult]:
    """Run scenarios, as `run_work` does."""
    return run_work(not_empty(jobs), SCENARIOS, workers, cache, cluster=cluster, seconds=seconds)


def not_empty(jobs: Sequence[Job]) -> Sequence[Job]:
    """The same jobs; `InvalidInput` where there are none."""
    if not jobs:
        raise InvalidInput("no engine has these profiles for these scenarios: there is nothing to run")
    return jobs


def at_a_time(workers: int | None) -> int:
    """How many runs there are at a time: one a processor if no number is given."""
    return workers or os.cpu_count() or 1


def run_work(
    jobs: Sequence[J],
    work: Work[J, R],
    workers: int | None,
    cache: Cache | None = None,
    had: Sequence[R] | None = None,
    cluster: str | None = None,
    seconds: float = TIME_LIMIT,
) -> list[R]:
    """Take from the cache what it has, run the rest in parallel behind a progress bar, and return the results.

    They come in the order of the jobs, whichever run was through first, so that a report has the same bytes each time.
    had: what the cache has, if somebody has looked already. cluster: the address of a Dask cluster, whose workers keep
    results in caches of their own. seconds: how long each run may take.
    """
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    results = list(recall(jobs, cache) if cache and had is None else had or ())
    known = {result.job for result in results}
    missing = work.in_order(job for job in jobs if job not in known)
    with (
        _executor(at_a_time(workers), cluster if missing else None) as (executor, count),
        Progress(*columns, console=errors, transient=True) as progress,
        closing(
            run_all(missing, work, executor, seconds, cache)
        ) as finished,  # an interrupt stops the runs, then the executor
    ):
        errors.print(f"{_counted(len(jobs), len(results))}, {count} at a time.")
        task = progress.add_task("running", total=len(jobs), completed=len(results))
        for result in finished:
            results.append(result)
            progress.update(task, advance=1, description=result.label)
    return sorted(results, key=lambda result: jobs.index(result.job))


@contextmanager
def _executor(workers: int, cluster: str | None) -> Iterator[tuple[Executor, int]]:
    """Who runs jobs, and how many of them at a time."""
    if cluster is None:
        with ThreadPoolExecutor(workers) as executor:
            yield executor, workers
    else:
        with on_cluster(cluster, what_runs_here) as found, found.pool() as executor:
            yield executor, found.count


def _counted(runs: int, cached: int) -> str:
    """How many runs there are, and how many of them the cache has."""
    return f"{runs} run{'s' if runs > 1 else ''}" + (f", {cached} of them from the cache" if cached else "")


@contextmanager
def continuing(cache: Cache) -> Iterator[None]:
    """Say of an interrupt, and of a file that cannot be written, whether the runs that have ended are kept."""
    try:
        yield
    except (KeyboardInterrupt, CannotWrite, OSError) as error:
        error.add_note(cache.promise)
        raise


def which_functions_ran(results: Sequence[JobResult]) -> str:
    """Of the functions in the files of the hand-written code, which were called and which were not; "" without files.

    Results of the cache and of recordings say so too: each knows what its own run called.
    """
    called = {name for result in results for name in result.functions}
    lost = any(row.verdict is Verdict.LOST for result in results for row in result.rows)
    these = "the runs that were not lost" if lost else "these runs"
    said = []
    for source in dict.fromkeys(result.job.implementation for result in results):
        for file, names in Implementation(source).own_functions().items():
            ran = [name for name in names if name in called]
            idle = [name for name in names if name not in called]
            words = [f"called {listed(ran)}" if ran else "called none", f"not {listed(idle)}" if idle else ""]
            said.append(f"Of the functions in {file} {these} {', and '.join(filter(None, words))}.")
    return " ".join(said)


def end(results: Sequence[Result]) -> int:
    """Print which runs crashed or were lost, and why; return the exit code."""
    for line in without_answer(results):
        output.print(line, markup=False, soft_wrap=True)
    if any(row.verdict is Verdict.LOST for result in results for row in result.rows):
        output.print(_MORE_TIME, soft_wrap=True)
    return exit_code(results)


def exit_code(results: Sequence[Result]) -> int:
    """0 if all is well; 1 if a verdict that counts failed; 3 if a run that counts is missing, or none gave a number.

    A verdict counts by the profile of its job. Other people's cases have none, and all of them count.
    """
    found = [(row.verdict, getattr(result.job, "profile", TUNED)) for result in results for row in result.rows]
    counted = {verdict for verdict, profile in found if counts(profile)}
    nothing = all(verdict in _NO_NUMBER for verdict, _ in found)
    return ending.code_of(Verdict.FAIL in counted, nothing or not counted.isdisjoint(NO_ANSWER))
