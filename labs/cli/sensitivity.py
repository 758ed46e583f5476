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
from reference.recording.files import json_bytes
from reference.report.sensitivity import print_sensitivity
from reference.running.cache import Cache
from reference.running.jobs import TIME_LIMIT
from reference.running.sensitivity import SENSITIVITY, SensitivityResult, plan
from reference.writable import refused_in_words

OUT = FileOption("--out", (".json",), "JSON file", "findings")


def sensitivity(
    scenario: Annotated[
        list[str] | None,
        typer.Argument(metavar="SCENARIO", help="A scenario; all if you name none.", show_default=False),
    ] = None,
    engine: jobs.Engines = None,
    workers: jobs.Workers = None,
    seconds: jobs.Seconds = TIME_LIMIT,
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
    cache = Cache(fresh=fresh)
    with jobs.continuing(cache):
        results = jobs.run_work(planned, SENSITIVITY, workers, cache, seconds=seconds)
        found = [result.sensitivity for result in results if result.sensitivity]
        print_sensitivity(output, found, map(_why_not, results))
        if out:
            OUT.write(out, json_bytes(kept.as_content(found), kept.LINES_DOWN_TO))
        if keep:
            with refused_in_words("findings", kept.FILE, "checkout"):
                kept.keep(found)
            output.print(f"Kept in {kept.FILE}", soft_wrap=True, markup=False)
    raise typer.Exit(jobs.end(results, judged=False))


def _why_not(result: SensitivityResult) -> str:
    """Why a job has no finding; empty for one that crashed or was lost, which the last lines say."""
    row = result.rows[0]
    return "" if result.sensitivity or row.verdict in jobs.NO_ANSWER else f"{result.label}: {row.why}"
