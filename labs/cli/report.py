"""`collisions report`: run the catalogue, with error against timestep, and write a page that explains it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Annotated, Generic

import typer

from labs.cli import jobs
from labs.cli.console import errors, output
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Verdict
from reference.engines import engine_names
from reference.published import jobs as published_jobs
from reference.published.results import PublishedJob, PublishedResult
from reference.report import files
from reference.report.overview import verdict_line
from reference.report.published.tables import PublishedTables
from reference.report.staging import PAGE, staged
from reference.running.cache import Cache
from reference.running.interim import before_the_runs
from reference.running.jobs import TIME_LIMIT, J, R, Work, recall
from reference.running.study import SCENARIOS


def report(
    out: Annotated[Path, typer.Option(help="Folder to write to.")] = Path("report"),
    only: Annotated[
        list[str] | None, typer.Option("--only", help="A scenario; repeat for several.", show_default=False)
    ] = None,
    engine: jobs.Engines = None,
    implementation: jobs.Implementations = jobs.CORRECT,
    workers: jobs.Workers = None,
    cluster: jobs.Cluster = None,
    seconds: jobs.Seconds = TIME_LIMIT,
    fresh: jobs.Fresh = False,
) -> None:
    """Run the whole catalogue and write one page, with JSON, CSV and figures beside it."""
    asked = jobs.planned(only, engine, implementation=implementation, with_studies=True)
    planned = [replace(job, with_poses=True) for job in jobs.not_empty(asked)]
    others = [] if only else published_jobs.plan((), engine or engine_names(), implementation)
    cache, at_a_time = Cache(fresh=fresh), jobs.at_a_time(workers)
    with staged(out):  # a place that cannot be written is refused before anything is read or run
        scenarios = Part(planned, SCENARIOS, cache, at_a_time, cluster, seconds)
        published = Part(others, published_jobs.PUBLISHED, cache, at_a_time, cluster, seconds)
    with jobs.continuing(cache):
        first = _first_page(scenarios, published, out)
        try:
            results, cases = scenarios.run(), published.run()
            with staged(out) as folder:
                files.write(results, folder, cases, cache, at_a_time)
        except BaseException as error:
            if first:
                error.add_note(f"The report is not finished. {out / PAGE} is still the first page, {first}.")
            raise
    if words := jobs.which_functions_ran(results):
        output.print(words, markup=False)
    output.print(verdict_line([row for result in results for row in result.rows]))
    if cases:
        output.print(PublishedTables.of(cases).sentence)
    code = jobs.end([*results, *cases])
    output.print(f"Open {out / PAGE} in a browser.", soft_wrap=True, markup=False)
    raise typer.Exit(code)


class Part(Generic[J, R]):
    """The jobs of one catalogue in a report. had: the results that the cache has."""

    def __init__(
        self,
        planned: Sequence[J],
        work: Work[J, R],
        cache: Cache,
        at_a_time: int,
        cluster: str | None,
        seconds: float,
    ) -> None:
        self.planned, self.work, self.cache, self.at_a_time = planned, work, cache, at_a_time
        self.cluster, self.seconds = cluster, seconds
        self.had: list[R] = recall(planned, cache)

    @property
    def to_run(self) -> int:
        """How many jobs the cache has no result of."""
        return len(self.planned) - len(self.had)

    def before_the_runs(self) -> list[R]:
        """What can be said of each job now."""
        return before_the_runs(self.planned, self.work, self.had, self.cache, self.at_a_time)

    def run(self) -> list[R]:
        """The results of all jobs, when those that are missing have run."""
        if not self.planned:
            return []
        return jobs.run_work(self.planned, self.work, self.at_a_time, self.cache, self.had, self.cluster, self.seconds)


def _first_page(scenarios: Part[Job, JobResult], published: Part[PublishedJob, PublishedResult], out: Path) -> str:
    """Write a page of what is known before the runs, if anything is; return where its numbers are from, or nothing."""
    to_run = scenarios.to_run + published.to_run
    if not to_run:
        return ""
    results, cases = scenarios.before_the_runs(), published.before_the_runs()
    verdicts = {row.verdict for result in results for row in result.rows}
    if verdicts | {row.verdict for case in cases for row in case.rows} == {Verdict.RUNNING}:
        return ""
    recorded = any([result.recording for result in results] + [case.recording for case in cases])
    origin = f"written from {'recordings' if recorded else 'earlier results'} at {datetime.now():%H:%M on %Y-%m-%d}"
    words = (
        f"This is a first page, {origin}, when {to_run} live run{'s' if to_run > 1 else ''} began. What is marked"
        " “running” has no number yet. The finished page replaces this one: reload it when the terminal says that the"
        " report is there. If the runs are stopped before that, this page stays."
    )
    with staged(out) as folder:
        files.write(results, folder, cases, scenarios.cache, scenarios.at_a_time, words)
    said = f"A first page, {origin}, is there: open {out / PAGE} in a browser. The finished page replaces it later."
    errors.print(said, soft_wrap=True, markup=False, highlight=False)
    return origin
