"""`collisions sensitivity`: inject faults into every implementation, and print the smallest that a verdict notices."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from labs.cli import jobs
from labs.cli.console import output
from labs.cli.file_options import FileOption
from reference.catalogue.scenarios import catalogue, find
from reference.engines import engine_names
from reference.errors import InvalidInput
from reference.recording import sensitivity as kept
from reference.recording.files import write_json
from reference.report.sensitivity import print_sensitivity
from reference.running.cache import Cache
from reference.running.sensitivity import SENSITIVITY, SensitivityResult, plan

OUT = FileOption("--out", (".json",), "JSON file", "findings")


def sensitivity(
    scenario: Annotated[
        list[str] | None,
        typer.Argument(metavar="SCENARIO", help="A scenario; all if you name none.", show_default=False),
    ] = None,
    engine: jobs.Engines = None,
    workers: jobs.Workers = None,
    fresh: jobs.Fresh = False,
    out: Annotated[Path | None, typer.Option(help="A JSON file for what is found.", show_default=False)] = None,
    keep: Annotated[bool, typer.Option("--keep", help="Keep what is found for the report.")] = False,
) -> None:
    """Inject faults, such as a friction that is 0.1 % too large, and find the smallest that turns a verdict red.

    For example:  collisions sensitivity sliding-slab --engine pybullet
    """
    if one := next((name for name in scenario or () if "/" in name), None):
        raise InvalidInput(f"{one!r} is one case; faults are injected into a whole scenario")
    families = [find(name)[0].name for name in dict.fromkeys(scenario or catalogue())]
    planned = plan(families, engine or engine_names())
    if others := [job.engine for job in planned if job.engine not in engine_names()] if keep else []:
        raise InvalidInput(f"{others[0]!r} is no engine of the lab's own; only what these notice is kept")
    if out:
        OUT.check(out)
    results = jobs.run_work(planned, SENSITIVITY, workers, Cache(fresh=fresh))
    found = [result.sensitivity for result in results if result.sensitivity]
    print_sensitivity(output, found, map(_why_not, results))
    if out:
        write_json(out, kept.as_content(found), kept.LINES_DOWN_TO)
    if keep:
        kept.keep(found)
        output.print(f"Kept in {kept.FILE}", soft_wrap=True, markup=False)
    verdicts = [row.verdict for result in results for row in result.rows]
    raise typer.Exit(jobs.exit_code_of(verdicts, failed=False))


def _why_not(result: SensitivityResult) -> str:
    """Why a job has no finding."""
    return "" if result.sensitivity else f"{result.label}: {result.rows[0].why}"
