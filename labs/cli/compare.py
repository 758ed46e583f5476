"""`collisions compare`: run scenarios in every implementation and print how they stand."""

from __future__ import annotations

from typing import Annotated

import typer

from labs.cli import jobs
from labs.cli.console import output
from reference.cache import Cache
from reference.report.summary import sections
from reference.report.terminal import print_comparison


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
    implementation: jobs.Implementations = "solutions",
    workers: jobs.Workers = None,
    fresh: jobs.Fresh = False,
    cases: Annotated[bool, typer.Option("--cases", help="Print every case with its numbers.")] = False,
) -> None:
    """Run scenarios in hand-written code, PyBullet, MuJoCo and DART, and compare them with theory.

    For example:  collisions compare dropped-ball --profile tuned --cases
    """
    planned = jobs.planned(scenario, engine, profile, implementation, timestep, assignments, parameters=at)
    results = jobs.run(planned, workers, Cache(fresh=fresh))
    print_comparison(output, sections(results), cases)
    raise typer.Exit(jobs.exit_code(results))
