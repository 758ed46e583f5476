"""Making recordings: which runs they take, which of them are stale, and the files that keep what was measured."""

from __future__ import annotations

import datetime
import functools
import json
import platform
from collections.abc import Iterable, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row
from reference.engines import engine_names, load_engine
from reference.engines.base import Engine
from reference.errors import EngineNotInstalled, InvalidInput
from reference.recording.fingerprint import fingerprint
from reference.recording.reading import (
    FOLDER,
    SCHEMA,
    VERSION,
    Made,
    content_of,
    forget,
    keys_of,
    tracks_of,
)
from reference.scene.settings import Settings
from reference.viewer.tracks import Track, write_tracks

OTHER_VERSION = "recorded in version"
"""How the reason begins where nothing but the engine is another one."""
GRID_DIGITS = 11
"""Of a number at a point or timestep of a grid: no engine is judged as finely, and the files stay half as large."""


def jobs_of(family: Family, engine: str) -> list[Job]:
    """The runs that a recording takes: all cases in each profile with the studies, and the grid at each timestep.

    At the timesteps of the grid the family's own cases are run too; those that are points of it are among these.
    """
    grid = family.grid.cases if family.grid else ()
    others = [case for case in family.cases if case.name not in {point.name for point in grid}]
    found: list[Job] = []
    for profile in family.profiles(load_engine(engine)):
        whole = Job(family.name, engine, profile, with_poses=True)
        own = replace(whole, cases=tuple(case.name for case in others))
        moved = [replace(whole, grid=True)] if grid else []
        moved += [replace(own, changes=each) for each in _changes(family, others, engine, profile)]
        moved += [replace(whole, grid=True, changes=each) for each in _changes(family, grid, engine, profile)]
        found += [replace(whole, with_studies=True), *moved]
    return found


def _changes(family: Family, cases: Iterable[Case], engine: str, profile: str) -> list[tuple[tuple[str, float], ...]]:
    """The changes of settings that cases are run with: to each timestep of the grid that is not the profile's own."""
    own = {load_engine(engine).settings(case.scenarios[0], profile).timestep for case in cases}
    steps = family.grid.timesteps if family.grid and own else ()
    return [(("timestep", step),) for step in steps if own != {step}]


# Stale or not


def why_stale(family: Family, engine: str, folder: Path | None = None) -> str:
    """Why the recordings of a family in an engine are not of what is asked today; "" where they are.

    Not seen is a change in how an engine is driven: after one everything is recorded anew.
    """
    try:
        content, (tracks, _) = content_of(engine, family.name, folder), tracks_of(engine, family.name, folder)
    except InvalidInput as error:
        return str(error)
    if content is None:
        return "never recorded"
    own_of = functools.cache(load_engine(engine).settings)
    for job in jobs_of(family, engine):
        taken = content["profiles"].get(job.profile)
        if not taken or taken["quantities"] != [quantity.name for quantity in family.quantities]:
            return f"{job.profile} is not recorded, or with other quantities"
        for case in job.chosen(family):
            own = own_of(case.scenarios[0], job.profile)
            if why := _why_stale(case, job, own, taken["entries"], tracks):
                at = "".join(f" at a {name} of {value} s" for name, value in job.changes)
                return f"{job.profile}, {case.name}{at} {why}"
    made, here = Made(**content["made"]), version_here(load_engine(engine))
    return f"{OTHER_VERSION} {made.version}; here is {here}" if here not in ("", made.version) else ""


def _why_stale(
    case: Case, job: Job, own: Settings, entries: Mapping[str, Any], tracks: Mapping[tuple[str, str], Track]
) -> str:
    settings = own.change(**dict(job.changes))
    wanted, keys = fingerprint(case, settings), keys_of(case.name, own, settings)
    takes = [entries[key] for key in keys if key in entries]
    take = next((take for take in takes if take[0] == wanted), None)
    if take is None:
        return "has changed since it was recorded" if takes else "is not recorded"
    poses = [tracks[job.profile, key] for key in keys if (job.profile, key) in tracks]
    if len(take) < 3 and wanted not in [track.fingerprint for track in poses]:
        return "has no poses of today's scenario and settings"
    return ""


def version_here(engine: Engine) -> str:
    """An engine's version on this machine; "" where it is not installed."""
    try:
        return engine.version()
    except EngineNotInstalled:
        return ""


# Writing


def write(results: Iterable[JobResult], folder: Path | None = None, today: datetime.date | None = None) -> list[Path]:
    """Write what engines have just measured, two files an engine and family, and return the files.

    Every result is that of a whole run, one of `jobs_of`.

    Raises
    ------
    InvalidInput
        If a result is only a part of a run, one that did not run here, or of an engine that is none of the lab's.
    """
    found: dict[tuple[str, str], list[JobResult]] = {}
    for result in results:
        job = result.job
        if job.engine not in engine_names() or not _is_whole(job) or not result.version or result.recording:
            raise InvalidInput(f"{job} is no whole run of its own; only what an engine measured here is recorded")
        found.setdefault((job.engine, job.family), []).append(result)
    day, written = (today or datetime.date.today()).isoformat(), list[Path]()
    for (engine, family), own in found.items():
        made = Made(own[0].title, own[0].version, machine(), platform.python_version(), day)
        path = (folder or FOLDER) / engine / f"{family}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        written += _write(path, own, asdict(made))
    forget()
    return written


def _is_whole(job: Job) -> bool:
    """Whether a recording takes it, with studies or without."""
    planned = (replace(each, with_studies=False) for each in jobs_of(catalogue()[job.family], job.engine))
    return replace(job, with_studies=False, with_poses=True) in planned


def _write(path: Path, results: Iterable[JobResult], made: dict[str, str]) -> list[Path]:
    """The numbers and, where there are any, poses and curves of a family in an engine."""
    results = sorted(results, key=lambda result: (result.job.grid, bool(result.job.changes)))
    profiles = {result.job.profile: _profile(result) for result in results if not _is_moved(result.job)}
    tracks: dict[tuple[str, str], Track] = {}
    for result in results:
        entries = profiles[result.job.profile]["entries"]
        new = {key: take for key, take in _entries(result).items() if _known(key, take, entries) is None}
        entries |= new
        tracks |= {(track.profile, track.key): track for track in result.poses if track.key in new}
    content = {"schema": SCHEMA, "version": VERSION, "made": made, "profiles": profiles}
    path.write_text(lines(content) + "\n", encoding="utf-8")
    if not tracks:
        return [path]
    poses = path.with_suffix(".npz")
    write_tracks(poses, tracks.values(), made)
    return [path, poses]


def _is_moved(job: Job) -> bool:
    """Whether it is at another point or timestep than a family's cases are in a profile."""
    return job.grid or bool(job.changes)


def _known(key: str, take: list[Any], entries: Mapping[str, Any]) -> str | None:
    """The case that is the very same as a point of the grid, if there is one: it is not kept twice."""
    case = key.removesuffix(" @ own")
    return case if case in entries and entries[case][0] == take[0] else None


def lines(content: Mapping[str, Any], depth: int = 4) -> str:
    """JSON with a line for each entry down to some depth: a case that changes changes one line."""
    if depth == 0 or not isinstance(content, Mapping) or not content:
        return json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    entries = (f"{json.dumps(name, ensure_ascii=False)}: {lines(value, depth - 1)}" for name, value in content.items())
    return "{\n" + ",\n".join(entries) + "\n}"


def machine() -> str:
    """The system and processor that this runs on."""
    return f"{platform.system()} {platform.machine()}"


def _profile(result: JobResult) -> dict[str, Any]:
    return {
        "description": result.description,
        "settings": result.settings,
        "convergence": asdict(result.convergence) if result.convergence else None,
        "split": asdict(result.split) if result.split else None,
        "quantities": [quantity.name for quantity in catalogue()[result.job.family].quantities],
        "entries": {},
    }


def _entries(result: JobResult) -> dict[str, list[Any]]:
    """What was measured of each case: its fingerprint with the numbers, or with a verdict and the reason for it."""
    job, engine, rows = result.job, load_engine(result.job.engine), dict[str, list[Row]]()
    for row in result.rows:
        rows.setdefault(row.case, []).append(row)
    found = {}
    for case in job.chosen(catalogue()[job.family]):
        own = engine.settings(case.scenarios[0], job.profile)
        settings = own.change(**dict(job.changes))
        key = keys_of(case.name, own, settings)[-1 if job.grid else 0]
        found[key] = [fingerprint(case, settings), *_measured(rows[case.name], _is_moved(job))]
    return found


def _measured(rows: list[Row], short: bool) -> list[Any]:
    if not rows[0].quantity:
        return [str(rows[0].verdict), rows[0].note]
    return [[_number(row, short) for row in rows]]


def _number(row: Row, short: bool) -> Any:
    """The mean alone where it is all there is, or with its spread and the reason why there is none."""
    mean, spread = (_shortened(value) if short else value for value in (row.measured, row.spread))
    if mean is not None and spread is None:
        return mean
    return [mean, spread, row.note if mean is None else ""]


def _shortened(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{GRID_DIGITS}g}")
