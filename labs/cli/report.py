"""`collisions report`: run the catalogue, with error against timestep, and write a page that explains it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from labs.cli import jobs
from labs.cli.console import output
from reference.engines import engine_names
from reference.published import jobs as published_jobs
from reference.published.results import PublishedResult
from reference.report import files
from reference.report.overview import verdict_line
from reference.report.published.tables import PublishedTables
from reference.report.staging import PAGE, staged
from reference.running.cache import Cache


def report(
    out: Annotated[Path, typer.Option(help="Folder to write to.")] = Path("report"),
    only: Annotated[
        list[str] | None, typer.Option("--only", help="A scenario; repeat for several.", show_default=False)
    ] = None,
    engine: jobs.Engines = None,
    implementation: jobs.Implementations = "solutions",
    workers: jobs.Workers = None,
    fresh: jobs.Fresh = False,
) -> None:
    """Run the whole catalogue and write one page, with JSON, CSV and figures beside it."""
    asked = jobs.planned(only, engine, implementation=implementation, with_studies=True)
    planned = [replace(job, with_poses=True) for job in asked]
    with staged(out) as folder:
        results = jobs.run(planned, workers, Cache(fresh=fresh))
        others = [] if only else _published(engine, implementation, workers, fresh)
        files.write(results, folder, others)
    output.print(verdict_line([row for result in results for row in result.rows]))
    if others:
        output.print(PublishedTables.of(others).sentence)
    output.print(f"Open {out / PAGE} in a browser.", soft_wrap=True, markup=False)
    raise typer.Exit(jobs.exit_code(results) or (jobs.published_exit_code(others) if others else 0))


def _published(
    engines: list[str] | None, implementation: str, workers: int | None, fresh: bool
) -> list[PublishedResult]:
    """Other people's cases, in the same engines."""
    planned = published_jobs.plan((), engines or engine_names(), implementation)
    return jobs.run_work(planned, published_jobs.PUBLISHED, workers, Cache(fresh=fresh))
