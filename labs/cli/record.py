"""`collisions record`: run the catalogue in the engines that are installed, and keep what they measured."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from labs.cli import ending, jobs
from labs.cli.console import output
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue, find
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput, RunFailed
from reference.published import jobs as published_jobs
from reference.published import recorded as published_recordings
from reference.published.results import PublishedJob
from reference.recording import checksums, files
from reference.recording import making as recordings
from reference.running.availability import absent
from reference.running.cache import Cache
from reference.running.jobs import TIME_LIMIT, R
from reference.writable import folder_for

MOST_BYTES = 512 * 2**20
"""Of the cache while recording: a run of thousands must not push its own first results out."""


@dataclass(frozen=True)
class Machines:
    """Where runs happen. workers: runs at a time here. cluster: the address of a Dask cluster instead.

    seconds: how long each run may take.
    """

    workers: int | None
    cluster: str | None
    seconds: float


def record(
    scenario: jobs.Scenarios = None,
    engine: jobs.Engines = None,
    workers: jobs.Workers = None,
    cluster: jobs.Cluster = None,
    seconds: jobs.Seconds = TIME_LIMIT,
    fresh: jobs.Fresh = False,
    only_stale: Annotated[
        bool, typer.Option("--only-stale", help="Only what is missing, or of other scenarios or settings than now.")
    ] = False,
    out: Annotated[Path | None, typer.Option(help="Another folder than the lab's own.", show_default=False)] = None,
    published: Annotated[bool, typer.Option("--published", help="Other people's cases and no scenarios.")] = False,
) -> None:
    """Run scenarios in the engines that are here and keep numbers and poses, for machines on which they are missing.

    Where no scenario is named it takes all, and other people's cases as well.

    For example:  collisions record dropped-ball --engine pybullet
    """
    if scenario and published:
        raise InvalidInput(f"--published takes no scenarios, and {scenario[0]!r} is one; name one of the two")
    families, here = _families(scenario), _here(engine)
    folder = out or files.FOLDER
    cache = Cache(fresh=fresh, most_bytes=MOST_BYTES)
    with jobs.continuing(cache), folder_for("recordings", folder, "--out"):
        machines = Machines(workers, cluster, seconds)
        written = [] if published else _scenarios(families, here, only_stale, machines, cache, folder)
        if not scenario:
            written += _published(here, only_stale, machines, cache, folder)
    if written:
        _print_sizes(written)
        output.print(f"Checksum over all recordings there: {checksums.over_all(folder)}", soft_wrap=True, markup=False)
    else:
        output.print("All recordings are of today's scenarios and settings.")


def _here(engines: Sequence[str] | None) -> list[str]:
    """Those of the engines that can run here; prints which others cannot."""
    recorded = [name for name in engine_names() if load_engine(name).package is not None]
    wanted = list(dict.fromkeys(engines or recorded))
    if others := [name for name in wanted if name not in recorded]:
        raise InvalidInput(f"{others[0]!r} is not recorded; these engines are: {', '.join(recorded)}")
    here = [name for name in wanted if not absent(name)]
    for name in wanted:
        if name not in here:
            title = load_engine(name).title
            output.print(f"{title} is not installed here: its recordings stay as they are.", markup=False)
    if not here:
        raise typer.Exit(ending.COULD_NOT_COMPARE)
    return here


def _scenarios(
    families: Iterable[Family],
    engines: Sequence[str],
    only_stale: bool,
    machines: Machines,
    cache: Cache,
    folder: Path,
) -> list[Path]:
    """Record the lab's own scenarios; return the files."""
    wanted = [(family, name) for name in engines for family in families]
    if only_stale and not (wanted := _stale(wanted, folder)):
        return []
    planned = [job for family, name in wanted for job in recordings.jobs_of(family, name)]
    results = jobs.run(planned, machines.workers, cache, machines.cluster, machines.seconds)
    _check(results)
    return recordings.write(_in_order(results, planned), folder)


def _published(engines: Sequence[str], only_stale: bool, machines: Machines, cache: Cache, folder: Path) -> list[Path]:
    """Record other people's cases; return the files."""
    wanted = [name for name in engines if not only_stale or published_recordings.is_stale(name, folder)]
    planned = published_jobs.plan((), wanted) if wanted else []
    work = published_jobs.PUBLISHED
    several, where, seconds = machines.workers, machines.cluster, machines.seconds
    results = jobs.run_work(planned, work, several, cache, cluster=where, seconds=seconds) if planned else []
    return published_recordings.write(_in_order(results, planned), folder)


def _families(names: Sequence[str] | None) -> list[Family]:
    if named := [name for name in names or [] if "/" in name]:
        raise InvalidInput(f"{named[0]!r} is one case; a recording holds all cases of a scenario")
    return [find(name)[0] for name in dict.fromkeys(names or catalogue())]


def _stale(wanted: Iterable[tuple[Family, str]], folder: Path) -> list[tuple[Family, str]]:
    """The pairs that have to be recorded again, each printed with the reason."""
    found = []
    for family, engine in wanted:
        if why := recordings.why_stale(family, engine, folder):
            output.print(f"{family.name} in {load_engine(engine).title}: {why}", soft_wrap=True, markup=False)
            found.append((family, engine))
    return found


def _check(results: Iterable[JobResult]) -> None:
    """Refuse to keep runs that went wrong; a point or timestep of a grid that blows up is a valid result."""
    for result in results:
        for row in result.rows:
            blew_up = row.verdict is Verdict.CRASHED and _blew_up(result, row)
            if row.verdict in (*jobs.NO_ANSWER, Verdict.NOT_AVAILABLE) and not blew_up:
                raise RunFailed(f"{result.label}, {row.case}: {row.why}; nothing is recorded")


def _blew_up(result: JobResult, row: Row) -> bool:
    return (result.job.grid or bool(result.job.changes)) and row.case != ALL_CASES and not row.quantity


def _in_order(results: Iterable[R], planned: Sequence[Job | PublishedJob]) -> list[R]:
    """The results in the order of the plan, so that the same results make the same files."""
    place = {job: number for number, job in enumerate(planned)}
    return sorted(results, key=lambda result: place[result.job])


def _print_sizes(written: Sequence[Path]) -> None:
    """A line per scenario and a column per engine: kilobytes of numbers + poses."""
    engines = list(dict.fromkeys(path.parent.name for path in written))
    table = Table(box=None, header_style="bold", padding=(0, 2, 0, 0), pad_edge=False)
    table.add_column("kB of numbers + poses")
    for engine in engines:
        table.add_column(load_engine(engine).title, justify="right")
    for family in dict.fromkeys(path.stem for path in written):
        sizes = {engine: [_kilobytes(path) for path in written if _is(path, engine, family)] for engine in engines}
        table.add_row(family, *(" + ".join(f"{size:.0f}" for size in sizes[engine]) for engine in engines))
    output.print(table)
    size = sum(path.stat().st_size for path in written)
    output.print(f"{len(written)} files, {size / 1e6:.1f} MB, in {written[0].parents[1]}", soft_wrap=True, markup=False)


def _is(path: Path, engine: str, family: str) -> bool:
    return (path.parent.name, path.stem) == (engine, family)


def _kilobytes(path: Path) -> float:
    return path.stat().st_size / 1e3
