"""`collisions record`: run the catalogue in the engines that are here, and keep what they measured."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer

from labs.cli import jobs
from labs.cli.console import output
from reference import recording
from reference.cache import Cache
from reference.compare import Verdict
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput
from reference.published import recorded, running
from reference.recording import MARK


def record(
    scenario: jobs.Scenarios = None,
    engine: jobs.Engines = None,
    workers: jobs.Workers = None,
    fresh: jobs.Fresh = False,
    out: Annotated[Path | None, typer.Option(help="Another folder than the lab's own.", show_default=False)] = None,
    published: Annotated[bool, typer.Option("--published", help="Other people's cases instead.")] = False,
) -> None:
    """Run scenarios in PyBullet and MuJoCo and keep what they measured, for machines on which they cannot be installed.

    For example:  collisions record dropped-ball --engine pybullet
    """
    if not scenario:
        _record_published(engine, workers, fresh, out)
    if published:
        return
    if named := [name for name in scenario or [] if "/" in name]:
        raise InvalidInput(f"{named[0]!r} is one case; a recording holds all cases of a scenario")
    others = [name for name in engine_names() if load_engine(name).package is not None]
    results = jobs.run(jobs.planned(scenario, engine or others, with_studies=True), workers, Cache(fresh=fresh))
    measured = [result for result in results if result.version and not result.recording]
    _say_missing(result.title for result in results if result not in measured)
    if not measured:
        raise typer.Exit(jobs.COULD_NOT_COMPARE)
    if crashed := [row for result in measured for row in result.rows if row.verdict is Verdict.CRASHED]:
        raise InvalidInput(
            f"{crashed[0].family} crashed in {crashed[0].engine}: {crashed[0].note}; nothing is recorded"
        )
    written = recording.write(measured, out)
    size = sum(path.stat().st_size for path in written)
    output.print(f"{len(written)} files, {size / 1e6:.1f} MB, in {written[0].parents[1]}", soft_wrap=True, markup=False)


def _say_missing(titles: Iterable[str]) -> None:
    for title in dict.fromkeys(title.rstrip(MARK) for title in titles):
        output.print(f"{title} is not installed here: its recordings stay as they are.", markup=False)


def _record_published(engines: list[str] | None, workers: int | None, fresh: bool, out: Path | None) -> None:
    """The same for the published cases."""
    others = [name for name in engine_names() if load_engine(name).package is not None]
    results = jobs.run_work(running.plan((), engines or others), running.PUBLISHED, workers, Cache(fresh=fresh))
    here = {result.job.engine for result in results if result.version and not result.recording}
    measured = [result for result in results if result.job.engine in here]
    _say_missing(result.title for result in results if result not in measured)
    if not measured:
        raise typer.Exit(jobs.COULD_NOT_COMPARE)
    for path in recorded.write(measured, out):
        output.print(str(path), soft_wrap=True, markup=False)
