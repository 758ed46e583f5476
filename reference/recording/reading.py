"""Recordings: what an engine measured where it was installed, for machines on which it is not.

Two files an engine and family, beside each other in `recordings/ENGINE`. `FAMILY.json` holds the measured numbers of
full runs, of the family's cases and of every point of its grid, and never a verdict: what theory says, and how near is
near enough, is worked out anew each time. `FAMILY.npz` holds the poses for a replay, and the curve that is plotted. A
fingerprint of the scenarios and the settings says what a number or a replay belongs to. Where either has changed since,
the recording is stale, and says so instead of answering. `reference.recording.making` writes all this.
"""

from __future__ import annotations

import contextlib
import functools
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.comparison import curves
from reference.comparison.compare import Number, judged
from reference.comparison.convergence import Errors
from reference.comparison.curves import Series
from reference.comparison.error_split import Share, Split
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.engines.base import Engine
from reference.errors import CollisionsError, InvalidInput, NotRecorded, listed
from reference.recording.fingerprint import fingerprint
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.viewer.poses import Poses, poses_of
from reference.viewer.tracks import Track, pack, read_tracks, unpack

SCHEMA, VERSION = "collisions-lab/recording", 3
FOLDER = Path(__file__).parent / "recordings"
MARK = "*"
"""Behind the title of an engine that did not run here."""


@dataclass(frozen=True)
class Made:
    """Where and when a recording was made."""

    engine: str
    version: str
    platform: str
    python: str
    date: str

    def __str__(self) -> str:
        where = f"Python {self.python}, {self.platform}"
        return f"{self.engine} {self.version} was recorded on {self.date} ({where}); it is not run here"


def keys_of(case: str, own: Settings, settings: Settings) -> tuple[str, ...]:
    """What entries a case may have, run with some settings by a profile that has its own: of the family, of its grid.

    A point of the grid has its timestep in its name.
    """
    return (case, f"{case} @ own") if settings == own else (f"{case} @ {settings.timestep:.6g} s",)


def track_of(job: Job, engine: Engine, case: Case, settings: Settings, trajectory: Trajectory) -> Track:
    """Poses and curve of a run, packed, with all that finds them again."""
    key = keys_of(case.name, engine.settings(case.scenarios[0], job.profile), settings)[-1 if job.grid else 0]
    track = pack(poses_of(trajectory), job.profile, key, fingerprint(case, settings))
    return replace(track, curve=curves.pack(Series.of(catalogue()[job.family], trajectory)))


def recall(job: Job, folder: Path | None = None) -> JobResult | None:
    """What an engine measured elsewhere, judged here and now; None where nothing of it was recorded.

    A case whose scenarios or settings are not those of the recording gets a row that says so, and no number.
    """
    content = content_of(job.engine, job.family, folder)
    taken = content["profiles"].get(job.profile) if content else None
    if not content or not taken:
        return None
    family, engine = catalogue()[job.family], load_engine(job.engine)
    rows = [row for case in job.chosen(family) for row in _rows(family, case, engine, job, taken)]
    moved = bool(job.changes or job.at or job.grid)
    studied = job.with_studies and not moved and _is_current(family.case(family.convergence.case), engine, job, taken)
    made = Made(**content["made"])
    return JobResult(
        job,
        f"{engine.title}{MARK}",
        taken["description"],
        tuple(rows),
        taken["settings"] if not moved else next((row.settings for row in rows), ""),
        made.version,
        _series(family, job, folder),
        Errors(**tuples(taken["convergence"])) if taken["convergence"] and studied else None,
        _split(taken["split"]) if taken["split"] and studied else None,
        recording=f"{MARK} {made}",
        poses=tuple(_poses(family, job, folder)) if job.with_poses else (),
    )


def _series(family: Family, job: Job, folder: Path | None) -> Series | None:
    """The curve of the case that the job plots; None where it plots none, or nothing of today's was recorded."""
    plotted = [case for case in job.chosen(family) if job.plots(family, case)]
    if not plotted:
        return None
    with contextlib.suppress(CollisionsError):  # the row says why
        return curves.unpack(_track(job, plotted[0], tracks_of(job.engine, job.family, folder)[0]).curve)
    return None


def _is_current(case: Case, engine: Engine, job: Job, taken: Mapping[str, Any]) -> bool:
    """Whether a case of the family was recorded with today's scenario and settings: what hangs on it is as it was."""
    with contextlib.suppress(CollisionsError):  # the row says why
        own = fingerprint(case, engine.settings(case.scenarios[0], job.profile))
        return bool(taken["entries"].get(case.name, [""])[0] == own)
    return False


def replay(job: Job, case: str, folder: Path | None = None) -> Poses:
    """The poses of one case of a job as they were recorded elsewhere.

    Raises
    ------
    NotRecorded
        If there are none, or they are of other scenarios or settings than today's.
    """
    family, engine = catalogue()[job.family], load_engine(job.engine)
    found = next((each for each in job.chosen(family) if each.name == case), None) or family.case(case)
    known, made = tracks_of(job.engine, job.family, folder)
    return unpack(_track(job, found, known), f"{engine.title}{MARK}", f"{MARK} {Made(**made)}")


def _track(job: Job, case: Case, known: Mapping[tuple[str, str], Track]) -> Track:
    """The recorded track of a case; `NotRecorded` where there is none of today's scenario and settings."""
    own = load_engine(job.engine).settings(case.scenarios[0], job.profile)
    settings = own.change(**dict(job.changes))
    tracks = [known[job.profile, key] for key in keys_of(case.name, own, settings) if (job.profile, key) in known]
    if not tracks:
        raise NotRecorded(f"{job}: no poses of {case.name} were recorded with these settings")
    for track in tracks:
        if track.fingerprint == fingerprint(case, settings):
            return track
    raise NotRecorded(f"{job}: the poses of {case.name} are stale; collisions record makes new ones")


def _poses(family: Family, job: Job, folder: Path | None) -> Iterator[Track]:
    """The tracks of those cases of a job that have one."""
    known, _ = tracks_of(job.engine, job.family, folder)
    for case in job.chosen(family):
        with contextlib.suppress(CollisionsError):  # the row says why
            yield _track(job, case, known)


def _rows(family: Family, case: Case, engine: Engine, job: Job, taken: Mapping[str, Any]) -> list[Row]:
    blank = Row(family.name, case.name, engine.name, job.profile, "", "", Verdict.NOT_AVAILABLE)
    try:
        own = engine.settings(case.scenarios[0], job.profile)
        settings = own.change(**dict(job.changes))
    except CollisionsError as error:
        return [replace(blank, note=str(error))]
    takes = [taken["entries"][key] for key in keys_of(case.name, own, settings) if key in taken["entries"]]
    take = next((take for take in takes if take[0] == fingerprint(case, settings)), None)
    if take is None:
        return [replace(blank, note=_why_not(case, engine, job, (own, settings), taken, bool(takes)))]
    if len(take) == 3:
        return [replace(blank, verdict=Verdict(take[1]), note=take[2])]
    numbers = dict(zip(taken["quantities"], map(_number, take[1]), strict=True))
    missing = [quantity.name for quantity in family.quantities if quantity.name not in numbers]
    if missing:
        why = f"its recording is stale: it has no {', '.join(missing)}; collisions record makes a new one"
        return [replace(blank, note=why)]
    method = engine.method(case.scenarios[0], settings)
    return judged(family, case, engine.name, job.profile, settings, method, numbers)


def _why_not(
    case: Case, engine: Engine, job: Job, settings: tuple[Settings, Settings], taken: Mapping[str, Any], known: bool
) -> str:
    """Why there is no number. settings: own ones and those asked for. known: whether there is one, a stale one."""
    absent, changes = f"{engine.title} is not installed here", dict(job.changes)
    if known and changes.keys() <= {"timestep"}:
        return "its recording is stale: scenario or settings have changed since; collisions record makes a new one"
    own, asked = settings
    steps = sorted({f"{1e3 * step:.3g}" for step in _timesteps(case.name, own, taken["entries"])}, key=float)
    if steps and changes.keys() == {"timestep"}:
        many = "timesteps" if len(steps) > 1 else "a timestep"
        return f"{absent}; it was recorded with {many} of {listed(steps)} ms, not of {1e3 * asked.timestep:.3g} ms"
    wish = ", ".join(f"{name}={value}" for name, value in (*job.at, *job.changes))
    return f"{absent}, and {f'with {wish} nothing was recorded' if wish else 'this case was never recorded'}"


def _timesteps(case: str, own: Settings, entries: Iterable[str]) -> Iterator[float]:
    """The timesteps, s, at which a case was recorded."""
    for entry in entries:
        name, _, at = entry.partition(" @ ")
        if name == case:
            yield float(at.removesuffix(" s")) if at not in ("", "own") else own.timestep


def _number(take: float | list[Any]) -> Number:
    return Number(*take) if isinstance(take, list) else Number(take)


def content_of(engine: str, family: str, folder: Path | None = None) -> dict[str, Any] | None:
    """What the file of recorded numbers holds; None where there is none, as for an engine of somebody's own.

    Raises
    ------
    InvalidInput
        If it is no recording, or one of another version.
    """
    return _content((folder or FOLDER) / engine / f"{family}.json") if engine in engine_names() else None


def tracks_of(
    engine: str, family: str, folder: Path | None = None
) -> tuple[dict[tuple[str, str], Track], dict[str, str]]:
    """The recorded poses by profile and entry, and where and when they were made; nothing where there are none."""
    return _tracks((folder or FOLDER) / engine / f"{family}.npz") if engine in engine_names() else ({}, {})


_tracks = functools.lru_cache(8)(read_tracks)


@functools.cache
def _content(path: Path) -> dict[str, Any] | None:
    return read(path, SCHEMA, VERSION)


def read(path: Path, schema: str, version: int) -> dict[str, Any] | None:
    """What a file of recorded numbers holds; None where there is none.

    Raises
    ------
    InvalidInput
        If it holds something else, or another version.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except ValueError as error:
        raise InvalidInput(f"{str(path)!r} is no recording: {error}") from None
    if not isinstance(content, dict) or (content.get("schema"), content.get("version")) != (schema, version):
        raise InvalidInput(f"{str(path)!r} is no recording of version {version}; collisions record makes a new one")
    return content


def forget() -> None:
    """Read the files anew when they are next asked for."""
    _content.cache_clear()
    _tracks.cache_clear()


def tuples(values: Mapping[str, Any]) -> dict[str, Any]:
    """The same values with tuples for lists, as they were before they went into a file."""
    return {name: tuple(value) if isinstance(value, list) else value for name, value in values.items()}


def _split(values: Mapping[str, Any]) -> Split:
    shares = tuple(Share(**share) for share in values["shares"])
    return Split(values["case"], values["quantity"], shares)
