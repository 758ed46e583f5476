"""`collisions compare`: run scenarios in every implementation and print how they compare."""

from __future__ import annotations

from typing import Annotated

import typer

from labs.cli import jobs
from labs.cli.console import output
from reference.engines import engine_names
from reference.errors import InvalidInput
from reference.published import jobs as published_jobs
from reference.report.published.tables import PublishedTables
from reference.report.published.terminal import print_published
from reference.report.sections import sections
from reference.report.terminal import print_comparison
from reference.running.cache import Cache


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
    fresh: jobs.Fresh = False,
    cases: Annotated[bool, typer.Option("--cases", help="Print every case with its numbers.")] = False,
    published: Annotated[
        bool, typer.Option("--published", help="Other people's cases instead: all, or those named, such as P15.")
    ] = False,
) -> None:
    """Run scenarios in hand-written code, PyBullet, MuJoCo and DART, and compare them with theory.

    For example:  collisions compare dropped-ball --profile tuned --cases
    """
    if published:
        _refuse(profile=profile, timestep=timestep, set=assignments, at=at)
        raise typer.Exit(_published(scenario, engine, implementation, workers, fresh, cases))
    planned = jobs.planned(scenario, engine, profile, implementation, timestep, assignments, parameters=at)
    results = jobs.run(planned, workers, Cache(fresh=fresh))
    print_comparison(output, sections(results), cases)
    raise typer.Exit(jobs.exit_code(results))


def _refuse(**given: object) -> None:
    """Refuse options that published cases have no use for: each is set up as it was published."""
    for name, value in given.items():
        if value is not None and value != []:
            raise InvalidInput(f"--{name} does not go with --published: these cases are run as they were published")


def _published(
    names: list[str] | None,
    engines: list[str] | None,
    implementation: str,
    workers: int | None,
    fresh: bool,
    cases: bool,
) -> int:
    planned = published_jobs.plan(names or (), engines or engine_names(), implementation)
    results = jobs.run_work(planned, published_jobs.PUBLISHED, workers, Cache(fresh=fresh))
    print_published(output, PublishedTables.of(results), cases)
    return jobs.published_exit_code(results)
