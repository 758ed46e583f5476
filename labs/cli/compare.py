"""`collisions compare`: run scenarios in every implementation and print how they compare."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from labs.cli import jobs
from labs.cli.console import output
from reference.engines import engine_names
from reference.errors import InvalidInput
from reference.published import jobs as published_jobs
from reference.report.against import differences
from reference.report.published.tables import PublishedTables
from reference.report.published.terminal import print_published
from reference.report.row_files import read_rows
from reference.report.sections import sections
from reference.report.terminal import print_comparison
from reference.running.cache import Cache
from reference.running.jobs import TIME_LIMIT
from reference.running.protocol import Result


def compare(
    scenario: jobs.Scenarios = None,
    engine: jobs.Engines = None,
    profile: jobs.Profiles = None,
    timestep: Annotated[float | None, typer.Option(help="Timestep in s, instead of the profile's own.")] = None,
    assignments: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Another setting, in the engine's words.", show_default=False),
    ] = None,
    at: Annotated[
        list[str] | None,
        typer.Option(
            "--at", metavar="NAME=VALUE", help="A scenario's parameter instead of its cases.", show_default=False
        ),
    ] = None,
    implementation: jobs.Implementations = jobs.CORRECT,
    workers: jobs.Workers = None,
    seconds: jobs.Seconds = TIME_LIMIT,
    fresh: jobs.Fresh = False,
    against: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The rows.json of a report; say what differs from it.", show_default=False),
    ] = None,
    cases: Annotated[bool, typer.Option("--cases", help="Print every case with its numbers.")] = False,
    published: Annotated[
        bool, typer.Option("--published", help="Other people's cases instead: all, or those named, such as P15.")
    ] = False,
) -> None:
    """Run scenarios in hand-written code, PyBullet, MuJoCo and DART, and compare them with theory.

    For example:  collisions compare dropped-ball --profile tuned --cases
    """
    results: Sequence[Result]
    cache = Cache(fresh=fresh)
    if published:
        _refuse(profile=profile, timestep=timestep, set=assignments, at=at, against=against)
        others = published_jobs.plan(scenario or (), engine or engine_names(), implementation)
        with jobs.continuing(cache):
            results = found = jobs.run_work(others, published_jobs.PUBLISHED, workers, cache, seconds=seconds)
        print_published(output, PublishedTables.of(found), cases)
    else:
        earlier = read_rows(against) if against else []
        planned = jobs.planned(scenario, engine, profile, implementation, timestep, assignments, parameters=at)
        with jobs.continuing(cache):
            results = compared = jobs.run(planned, workers, cache, seconds=seconds)
        print_comparison(output, sections(compared), cases, jobs.which_functions_ran(compared))
        rows = [row for result in compared for row in result.rows]
        for line in differences(rows, earlier) if against else ():
            output.print(line, markup=False, soft_wrap=True)
    raise typer.Exit(jobs.end(results))


def _refuse(**given: object) -> None:
    """Refuse options that published cases have no use for: each is set up as it was published."""
    for name, value in given.items():
        if value is not None and value != []:
            raise InvalidInput(f"--{name} does not go with --published: these cases are run as they were published")
