"""Recordings: what an engine measured where it was installed, for machines on which it is not.

One file an engine and family, `recordings/ENGINE/FAMILY.json`. It holds the measured numbers of full runs, never a
verdict: what theory says, and how near is near enough, is worked out anew each time. A fingerprint of the scenarios and
the settings says what a number belongs to. Where either has changed since, the recording is stale, and says so instead
of answering.
"""

from __future__ import annotations

import datetime
import functools
import hashlib
import json
import platform
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Any

from reference.compare import Number, Row, Verdict, judged
from reference.engines import engine_names, load_engine
from reference.engines.base import Engine
from reference.errors import CollisionsError, InvalidInput
from reference.family import Case, Family
from reference.results import Errors, Job, JobResult, Series
from reference.scenarios import catalogue
from reference.settings import Settings
from reference.shares import Share, Split

SCHEMA, VERSION = "collisions-lab/recording", 1
FOLDER = Path(__file__).parent / "recordings"
MARK = "*"
"""Behind the title of an engine that did not run here."""
DIGITS = 16
"""Of a fingerprint; that two of some thousands agree by chance has odds of 10⁻¹²."""


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


def fingerprint(case: Case, settings: Settings) -> str:
    """A hash of all scenarios of a case and of the settings that they ran with."""
    known = [[_plain(scenario) for scenario in case.scenarios], _plain(settings)]
    return hashlib.sha256(json.dumps(known, sort_keys=True).encode()).hexdigest()[:DIGITS]


def _plain(value: Any) -> Any:
    """Dataclasses as dictionaries that also say of what kind they are. What may be left empty, and is, is left out."""
    if is_dataclass(value):
        every = ((field, getattr(value, field.name)) for field in fields(value))
        told = {field.name: _plain(own) for field, own in every if own != () or field.default != ()}
        return {"kind": type(value).__name__} | told
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, tuple) else value


# Writing


def write(results: Iterable[JobResult], folder: Path | None = None, today: datetime.date | None = None) -> list[Path]:
    """Write what engines have just measured, one file an engine and family, and return the files.

    Every result is that of a whole run: all cases of a family in one profile, with nothing changed.

    Raises
    ------
    InvalidInput
        If a result is only a part of a run, one that did not run here, or of an engine that is none of the lab's.
    """
    found: dict[tuple[str, str], list[JobResult]] = {}
    for result in results:
        job = result.job
        if job.engine not in engine_names() or job.cases or job.changes or not result.version or result.recording:
            raise InvalidInput(f"{job} is no whole run of its own; only what an engine measured here is recorded")
        found.setdefault((job.engine, job.family), []).append(result)
    day, written = (today or datetime.date.today()).isoformat(), []
    for (engine, family), own in found.items():
        made = Made(own[0].title, own[0].version, machine(), platform.python_version(), day)
        profiles = {result.job.profile: _profile(result) for result in own}
        content = {"schema": SCHEMA, "version": VERSION, "made": asdict(made), "profiles": profiles}
        path = (folder or FOLDER) / engine / f"{family}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(lines(content) + "\n", encoding="utf-8")
        written.append(path)
    _content.cache_clear()
    return written


def lines(content: Mapping[str, Any], depth: int = 4) -> str:
    """JSON with a line for each entry down to some depth: a case that changes changes one line."""
    if depth == 0 or not isinstance(content, Mapping) or not content:
        return json.dumps(content, ensure_ascii=False)
    entries = (f"{json.dumps(name, ensure_ascii=False)}: {lines(value, depth - 1)}" for name, value in content.items())
    return "{\n" + ",\n".join(entries) + "\n}"


def machine() -> str:
    """The system and processor that this runs on."""
    return f"{platform.system()} {platform.machine()}"


def _profile(result: JobResult) -> dict[str, Any]:
    family, engine = catalogue()[result.job.family], load_engine(result.job.engine)
    return {
        "description": result.description,
        "settings": result.settings,
        "cases": {case.name: _case(case, engine, result) for case in family.cases},
        "series": asdict(result.series) if result.series else None,
        "convergence": asdict(result.convergence) if result.convergence else None,
        "split": asdict(result.split) if result.split else None,
    }


def _case(case: Case, engine: Engine, result: JobResult) -> dict[str, Any]:
    rows = [row for row in result.rows if row.case == case.name]
    settings = engine.settings(case.scenarios[0], result.job.profile)
    return {
        "fingerprint": fingerprint(case, settings),
        "numbers": {
            row.quantity: [row.measured, row.spread, "" if row.measured is not None else row.note]
            for row in rows
            if row.quantity
        },
        "refused": next(([row.verdict, row.note] for row in rows if not row.quantity), None),
    }


# Reading


def recall(job: Job, folder: Path | None = None) -> JobResult | None:
    """What an engine measured elsewhere, judged here and now; None where nothing of it was recorded.

    A case whose scenarios or settings are not those of the recording gets a row that says so, and no number.
    """
    if job.engine not in engine_names():  # an engine file: nobody has recorded it
        return None
    content = _content((folder or FOLDER) / job.engine / f"{job.family}.json")
    taken = content["profiles"].get(job.profile) if content else None
    if not content or not taken:
        return None
    family, engine = catalogue()[job.family], load_engine(job.engine)
    rows = [
        row
        for case in family.cases
        if not job.cases or case.name in job.cases
        for row in _rows(family, case, engine, job, taken["cases"].get(case.name))
    ]
    whole = job.with_studies and not job.changes
    made = Made(**content["made"])
    return JobResult(
        job,
        f"{engine.title}{MARK}",
        taken["description"],
        tuple(rows),
        taken["settings"] if not job.changes else "",
        made.version,
        Series(**_tuples(taken["series"])) if taken["series"] and not job.changes else None,
        Errors(**_tuples(taken["convergence"])) if taken["convergence"] and whole else None,
        _split(taken["split"]) if taken["split"] and whole else None,
        recording=f"{MARK} {made}",
    )


def _rows(family: Family, case: Case, engine: Engine, job: Job, take: Mapping[str, Any] | None) -> list[Row]:
    blank = Row(family.name, case.name, engine.name, job.profile, "", "", Verdict.NOT_AVAILABLE)
    try:
        settings = engine.settings(case.scenarios[0], job.profile).change(**dict(job.changes))
    except CollisionsError as error:
        return [replace(blank, note=str(error))]
    if take is None:
        return [replace(blank, note=f"{engine.title} is not installed here, and this case was never recorded")]
    if take["fingerprint"] != fingerprint(case, settings):
        if job.changes:
            changed = ", ".join(f"{name}={value}" for name, value in job.changes)
            why = f"{engine.title} is not installed here, and with {changed} nothing was recorded"
        else:
            why = "its recording is stale: scenario or settings have changed since; collisions record makes a new one"
        return [replace(blank, note=why)]
    if take["refused"]:
        verdict, note = take["refused"]
        return [replace(blank, verdict=Verdict(verdict), note=note)]
    numbers = {name: Number(*number) for name, number in take["numbers"].items()}
    missing = [quantity.name for quantity in family.quantities if quantity.name not in numbers]
    if missing:
        why = f"its recording is stale: it has no {', '.join(missing)}; collisions record makes a new one"
        return [replace(blank, note=why)]
    method = engine.method(case.scenarios[0], settings)
    return judged(family, case, engine.name, job.profile, settings, method, numbers)


@functools.cache
def _content(path: Path) -> dict[str, Any] | None:
    """What a file of recordings holds; None where there is none.

    Raises
    ------
    InvalidInput
        If it is no recording, or one of another version.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except ValueError as error:
        raise InvalidInput(f"{str(path)!r} is no recording: {error}") from None
    if not isinstance(content, dict) or content.get("schema") != SCHEMA or content.get("version") != VERSION:
        raise InvalidInput(f"{str(path)!r} is no recording of version {VERSION}; collisions record makes a new one")
    return content


def _tuples(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name: tuple(value) if isinstance(value, list) else value for name, value in values.items()}


def _split(values: Mapping[str, Any]) -> Split:
    shares = tuple(Share(**share) for share in values["shares"])
    return Split(values["case"], values["quantity"], shares)
