"""Making recordings: which runs they take, which of them are stale, and writing what was measured."""

from __future__ import annotations

import datetime
import functools
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
from reference.errors import InvalidInput
from reference.recording import checksums
from reference.recording.entries import GRID_DIGITS, Entry, name_as_own_case, name_of, names_of
from reference.recording.files import FOLDER, SCHEMA, VERSION, Made, content_of, forget, tracks_of, write_json
from reference.recording.fingerprint import fingerprint
from reference.scene.settings import Settings
from reference.viewer.tracks import Track, write_tracks

OTHER_VERSION = "recorded in version"
"""How the reason begins where only the engine's version differs."""
_LINES_DOWN_TO = 4
"""Depth of a file down to which each entry has a line of its own: that of a case."""


def jobs_of(family: Family, engine: str) -> list[Job]:
    """The runs that a recording takes: all cases in each profile with the studies, and the grid at each timestep.

    At the timesteps of the grid the family's own cases run too; those of them that are points of the grid run with it.
    """
    grid = family.grid.cases if family.grid else ()
    others = [case for case in family.cases if case.name not in {point.name for point in grid}]
    found: list[Job] = []
    for profile in family.profiles(load_engine(engine)):
        whole = Job(family.name, engine, profile, with_poses=True)
        beside = [case for case in others if profile in load_engine(engine).profiles(case.scenarios[0])]
        own = replace(whole, cases=tuple(case.name for case in beside))
        moved = [replace(whole, grid=True)] if grid else []
        moved += [replace(own, changes=each) for each in _changes(family, beside, engine, profile)]
        moved += [replace(whole, grid=True, changes=each) for each in _changes(family, grid, engine, profile)]
        found += [replace(whole, with_studies=True), *moved]
    return found


def _changes(family: Family, cases: Iterable[Case], engine: str, profile: str) -> list[tuple[tuple[str, float], ...]]:
    """The changed settings of some cases: each timestep of the grid that is not the profile's own."""
    own = {load_engine(engine).settings(case.scenarios[0], profile).timestep for case in cases}
    steps = family.grid.timesteps if family.grid and own else ()
    return [(("timestep", step),) for step in steps if own != {step}]


# Stale or not


def why_stale(family: Family, engine: str, folder: Path | None = None) -> str:
    """Why the recordings of a family in an engine are not those of today's scenarios and settings; "" where they are.

    A change in how an engine is driven is not seen here: after such a change everything must be recorded again.
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
        for case in job.cases_in(family, load_engine(engine)):
            own = own_of(case.scenarios[0], job.profile)
            if why := _why_stale(case, job, own, taken["entries"], tracks):
                at = "".join(f" at a {name} of {value} s" for name, value in job.changes)
                return f"{job.profile}, {case.name}{at} {why}"
    made, here = Made(**content["made"]), load_engine(engine).versions()["engine_version"]
    return f"{OTHER_VERSION} {made.version}; here is {here}" if here not in ("", made.version) else ""


def _why_stale(
    case: Case, job: Job, own: Settings, entries: Mapping[str, Any], tracks: Mapping[tuple[str, str], Track]
) -> str:
    settings = own.change(**dict(job.changes))
    wanted, names = fingerprint(case, settings), names_of(case.name, own, settings)
    recorded = [Entry.read(entries[name]) for name in names if name in entries]
    entry = next((entry for entry in recorded if entry.fingerprint == wanted), None)
    if entry is None:
        return "has changed since it was recorded" if recorded else "is not recorded"
    poses = [tracks[job.profile, name] for name in names if (job.profile, name) in tracks]
    if entry.verdict is None and wanted not in [track.fingerprint for track in poses]:
        return "has no poses of today's scenario and settings"
    return ""


# Writing


def write(results: Iterable[JobResult], folder: Path | None = None, today: datetime.date | None = None) -> list[Path]:
    """Write what engines have just measured, two files for each engine and family, and return the files.

    Every result is that of a whole run, one of `jobs_of`.

    Raises
    ------
    InvalidInput
        If a result is only a part of a run, did not run here, or comes from an engine that is not the lab's own.
    """
    found: dict[tuple[str, str], list[JobResult]] = {}
    for result in results:
        job = result.job
        if job.engine not in engine_names() or not _is_whole(job) or not result.version or result.recording:
            raise InvalidInput(f"{job} is no whole run of its own; only what an engine measured here is recorded")
        found.setdefault((job.engine, job.family), []).append(result)
    written = list[Path]()
    for (engine, family), own in found.items():
        made = Made.here(own[0].title, own[0].version, today)
        written += _write((folder or FOLDER) / engine / f"{family}.json", own, asdict(made))
    checksums.renew(folder or FOLDER, written)
    forget()
    return written


def _is_whole(job: Job) -> bool:
    """Whether a recording takes the job, with studies or without."""
    planned = (replace(each, with_studies=False) for each in jobs_of(catalogue()[job.family], job.engine))
    return replace(job, with_studies=False, with_poses=True) in planned


def _write(path: Path, results: Iterable[JobResult], made: dict[str, str]) -> list[Path]:
    """The numbers and, where there are any, poses and curves of a family in an engine."""
    results = sorted(results, key=lambda result: (result.job.grid, bool(result.job.changes)))
    profiles = {result.job.profile: _profile(result) for result in results if not _is_moved(result.job)}
    tracks: dict[tuple[str, str], Track] = {}
    for result in results:
        kept = profiles[result.job.profile]["entries"]
        new = {name: entry.as_json() for name, entry in _entries(result).items() if not _is_kept(name, entry, kept)}
        kept |= new
        tracks |= {(track.profile, track.key): track for track in result.poses if track.key in new}
    content = {"schema": SCHEMA, "version": VERSION, "made": made, "profiles": profiles}
    write_json(path, content, _LINES_DOWN_TO)
    poses = path.with_suffix(".npz")
    if not tracks:
        poses.unlink(missing_ok=True)  # of runs that are refused now
        return [path]
    write_tracks(poses, tracks.values(), made)
    return [path, poses]


def _is_moved(job: Job) -> bool:
    """Whether the job runs at points of the grid or at another timestep, unlike the family's own cases."""
    return job.grid or bool(job.changes)


def _is_kept(name: str, entry: Entry, kept: Mapping[str, Any]) -> bool:
    """Whether the same run is kept already: a point of the grid may be one of the family's own cases."""
    same = kept.get(name_as_own_case(name))
    return same is not None and Entry.read(same).fingerprint == entry.fingerprint


def _profile(result: JobResult) -> dict[str, Any]:
    return {
        "description": result.description,
        "settings": result.settings,
        "convergence": asdict(result.convergence) if result.convergence else None,
        "split": asdict(result.split) if result.split else None,
        "quantities": [quantity.name for quantity in catalogue()[result.job.family].quantities],
        "entries": {},
    }


def _entries(result: JobResult) -> dict[str, Entry]:
    """What was measured of each case, by the name of its entry."""
    job, engine, rows = result.job, load_engine(result.job.engine), dict[str, list[Row]]()
    for row in result.rows:
        rows.setdefault(row.case, []).append(row)
    digits, found = GRID_DIGITS if _is_moved(job) else None, dict[str, Entry]()
    for case in job.cases_in(catalogue()[job.family], engine):
        own = engine.settings(case.scenarios[0], job.profile)
        settings = own.change(**dict(job.changes))
        name = name_of(case.name, own, settings, job.grid)
        found[name] = Entry.of(fingerprint(case, settings), rows[case.name], digits)
    return found
