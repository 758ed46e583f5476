"""Reading recordings: what an engine measured where it was installed, judged here for machines on which it is missing.

What theory says, and how near is near enough, is worked out each time. A fingerprint of the scenarios and the settings
says which run a number or a replay belongs to. Where either has changed since, the recording is stale, and a row says
so instead of a number. `reference.recording.making` makes the recordings.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.comparison import curves
from reference.comparison.compare import judged
from reference.comparison.convergence import Errors
from reference.comparison.curves import Series
from reference.comparison.error_split import Share, Split
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine
from reference.engines.base import Engine
from reference.engines.implementation import Implementation
from reference.engines.steering import functions_of
from reference.errors import CollisionsError, NotRecorded, listed
from reference.recording.entries import Entry, case_of, name_of, names_of, rounded, timestep_of
from reference.recording.files import MARK, Made, content_of, tracks_of, with_tuples
from reference.recording.fingerprint import fingerprint
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.viewer.poses import Poses, poses_of
from reference.viewer.tracks import Track, pack, unpack

OWN_STEERING = "it was recorded with the lab's own steering, and this code steers by itself; to see that, it has to run"
"""Why a recording does not answer for a student's rules."""


def track_of(job: Job, engine: Engine, case: Case, settings: Settings, trajectory: Trajectory) -> Track:
    """Poses and curve of a run, packed, with the entry and the fingerprint by which they are found again."""
    name = name_of(case.name, engine.settings(case.scenarios[0], job.profile), settings, job.grid)
    track = pack(poses_of(trajectory), job.profile, name, fingerprint(case, settings))
    return replace(track, curve=curves.pack(Series.of(catalogue()[job.family], trajectory)))


def recall(job: Job, folder: Path | None = None) -> JobResult | None:
    """The result that an engine gave elsewhere, judged here and now; None where nothing of it was recorded.

    A case whose scenarios or settings are not those of the recording gets a row that says so, and no number.

    Raises
    ------
    InvalidInput
        If a file of the recording cannot be read, or was changed since it was made.
    """
    content = content_of(job.engine, job.family, folder)
    taken = content["profiles"].get(job.profile) if content else None
    if not content or not taken:
        return None
    family, engine = catalogue()[job.family], load_engine(job.engine)
    made = Made(**content["made"])
    if _steers_by_itself(family, job):
        return _steered_by_others(job, family, taken["description"])
    rows = [row for case in job.cases_in(family, engine) for row in _rows(family, case, engine, job, taken)]
    rows = [
        row
        if row.verdict is Verdict.NOT_AVAILABLE
        else replace(row, engine_version=made.version, recorded_on=made.date)
        for row in rows
    ]
    moved = bool(job.changes or job.at or job.grid)
    studied = job.with_studies and not moved and _is_current(family.case(family.convergence.case), engine, job, taken)
    return JobResult(
        job,
        f"{engine.title}{MARK}",
        taken["description"],
        tuple(rows),
        taken["settings"] if not moved else next((row.settings for row in rows), ""),
        made.version,
        _series(family, job, folder),
        Errors(**with_tuples(taken["convergence"])) if taken["convergence"] and studied else None,
        _split(taken["split"]) if taken["split"] and studied else None,
        recording=f"{MARK} {made}",
        poses=tuple(_poses(family, job, folder)) if job.with_poses else (),
    )


def _steers_by_itself(family: Family, job: Job) -> bool:
    """Whether code that is not the lab's own may steer the bodies of a family."""
    names = functions_of(scenario for case in family.cases for scenario in case.scenarios)
    return bool(names) and not Implementation(job.implementation).takes_ours(names)


def _steered_by_others(job: Job, family: Family, description: str) -> JobResult:
    """No number: what was recorded is the motion that another implementation steered."""
    engine = load_engine(job.engine)
    blank = Row(job.family, "", engine.name, job.profile, "", "", Verdict.NOT_AVAILABLE, note=OWN_STEERING)
    rows = tuple(replace(blank, case=case.name) for case in job.chosen(family))
    return JobResult(job, f"{engine.title}{MARK}", description, rows)


def _series(family: Family, job: Job, folder: Path | None) -> Series | None:
    """The curve of the case that the job plots; None where it plots none, or nothing of today's was recorded."""
    plotted = [case for case in job.cases_in(family, load_engine(job.engine)) if job.plots(family, case)]
    if not plotted:
        return None
    known, _ = tracks_of(job.engine, job.family, folder)
    with contextlib.suppress(CollisionsError):  # the row says why
        return curves.unpack(_track(job, plotted[0], known).curve)
    return None


def _is_current(case: Case, engine: Engine, job: Job, taken: Mapping[str, Any]) -> bool:
    """Whether a case of the family was recorded with today's scenario and settings, and so its studies still hold."""
    with contextlib.suppress(CollisionsError):  # the row says why
        own = fingerprint(case, engine.settings(case.scenarios[0], job.profile))
        kept = taken["entries"].get(case.name)
        return kept is not None and Entry.read(kept).fingerprint == own
    return False


def replay(job: Job, case: str, folder: Path | None = None) -> Poses:
    """The poses of one case of a job as they were recorded elsewhere.

    Raises
    ------
    NotRecorded
        If there are none, they are of other scenarios or settings than today's, or the job has other steering.
    """
    family, engine = catalogue()[job.family], load_engine(job.engine)
    if _steers_by_itself(family, job):
        raise NotRecorded(f"{job}: {OWN_STEERING}")
    found = next((each for each in job.chosen(family) if each.name == case), None) or family.case(case)
    known, made = tracks_of(job.engine, job.family, folder)
    return unpack(_track(job, found, known), f"{engine.title}{MARK}", f"{MARK} {Made(**made)}")


def _track(job: Job, case: Case, known: Mapping[tuple[str, str], Track]) -> Track:
    """The recorded track of a case; `NotRecorded` where no track is of today's scenario and settings."""
    own = load_engine(job.engine).settings(case.scenarios[0], job.profile)
    settings = own.change(**dict(job.changes))
    tracks = [known[job.profile, key] for key in names_of(case.name, own, settings) if (job.profile, key) in known]
    if not tracks:
        raise NotRecorded(f"{job}: no poses of {case.name} were recorded with these settings")
    for track in tracks:
        if track.fingerprint == fingerprint(case, settings):
            return track
    raise NotRecorded(f"{job}: the poses of {case.name} are stale; collisions record makes new ones")


def _poses(family: Family, job: Job, folder: Path | None) -> Iterator[Track]:
    """The tracks of those cases of a job that have one."""
    known, _ = tracks_of(job.engine, job.family, folder)
    for case in job.cases_in(family, load_engine(job.engine)):
        with contextlib.suppress(CollisionsError):  # the row says why
            yield _track(job, case, known)


def _rows(family: Family, case: Case, engine: Engine, job: Job, taken: Mapping[str, Any]) -> list[Row]:
    blank = Row(family.name, case.name, engine.name, job.profile, "", "", Verdict.NOT_AVAILABLE)
    try:
        own = engine.settings(case.scenarios[0], job.profile)
        settings = own.change(**dict(job.changes))
    except CollisionsError as error:
        return [replace(blank, note=str(error))]
    kept = taken["entries"]
    entries = {name: Entry.read(kept[name]) for name in names_of(case.name, own, settings) if name in kept}
    current = fingerprint(case, settings)
    name = next((name for name, entry in entries.items() if entry.fingerprint == current), None)
    if name is None:
        return [replace(blank, note=_why_not(case, engine, job, own, settings, taken, is_stale=bool(entries)))]
    entry = entries[name]
    if entry.verdict is not None:
        return [replace(blank, verdict=entry.verdict, note=entry.note)]
    kept_numbers = (replace(number, rounded=rounded(name)) for number in entry.numbers)
    numbers = dict(zip(taken["quantities"], kept_numbers, strict=True))
    missing = [quantity.name for quantity in family.quantities if quantity.name not in numbers]
    if missing:
        why = f"its recording is stale: it has no {', '.join(missing)}; collisions record makes a new one"
        return [replace(blank, note=why)]
    method = engine.method(case.scenarios[0], settings)
    return judged(family, case, engine.name, job.profile, settings, method, numbers, with_evidence=True)


def _why_not(
    case: Case,
    engine: Engine,
    job: Job,
    own: Settings,
    settings: Settings,
    taken: Mapping[str, Any],
    is_stale: bool,
) -> str:
    """Why there is no number. own, settings: the profile's settings, and the job's. is_stale: whether an old one is."""
    absent, changes = f"{engine.title} is not installed here", dict(job.changes)
    if is_stale and changes.keys() <= {"timestep"}:
        return "its recording is stale: scenario or settings have changed since; collisions record makes a new one"
    steps = sorted({f"{1e3 * step:.3g}" for step in _timesteps(case.name, own, taken["entries"])}, key=float)
    if steps and changes.keys() == {"timestep"}:
        many = "timesteps" if len(steps) > 1 else "a timestep"
        asked = f"{1e3 * settings.timestep:.3g} ms"
        return f"{absent}; it was recorded with {many} of {listed(steps)} ms, not of {asked}"
    wish = ", ".join(f"{name}={value}" for name, value in (*job.at, *job.changes))
    return f"{absent}, and {f'with {wish} nothing was recorded' if wish else 'this case was never recorded'}"


def _timesteps(case: str, own: Settings, names: Iterable[str]) -> Iterator[float]:
    """The timesteps, s, at which a case was recorded."""
    return (timestep_of(name) or own.timestep for name in names if case_of(name) == case)


def _split(values: Mapping[str, Any]) -> Split:
    shares = tuple(Share(**share) for share in values["shares"])
    return Split(values["case"], values["quantity"], shares)
