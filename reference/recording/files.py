"""The files of recordings, two for each engine and family: `recordings/ENGINE/FAMILY.json` and `FAMILY.npz`.

The first holds the measured numbers of full runs, of the family's cases and of every point of its grid. It never holds
a verdict: each number is judged again whenever it is read. The second holds the poses for a replay, and the curve that
is plotted. `reference.recording.checksums` notices a file that was changed after it was written.
"""

from __future__ import annotations

import datetime
import functools
import json
import platform
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput, listed
from reference.recording import checksums
from reference.viewer.tracks import Track, read_tracks
from reference.writable import write_whole

SCHEMA, VERSION = "collisions-lab/recording", 4
FOLDER = Path(__file__).parent / "recordings"
MARK = "*"
"""Behind the title of an engine that did not run here."""
NOT_RUN = "it is not run here"


@dataclass(frozen=True)
class Made:
    """Where and when a recording was made."""

    engine: str
    version: str
    platform: str
    python: str
    date: str

    @classmethod
    def here(cls, engine: str, version: str, today: datetime.date | None) -> Made:
        """Of a recording that is made on this machine; `today` is the day, if it is not the clock's."""
        where = f"{platform.system()} {platform.machine()}"
        day = (today or datetime.date.today()).isoformat()
        return cls(engine, version, where, platform.python_version(), day)

    def __str__(self) -> str:
        where = f"Python {self.python}, {self.platform}"
        return f"{self.engine} {self.version} was recorded on {self.date} ({where}); {NOT_RUN}"


def content_of(engine: str, family: str, folder: Path | None = None) -> dict[str, Any] | None:
    """What the file of recorded numbers holds; None where no such file exists, as for an engine file of one's own.

    Raises
    ------
    InvalidInput
        If it is no recording, or one of another version, or was changed since it was made.
    """
    return _content((folder or FOLDER) / engine / f"{family}.json") if engine in engine_names() else None


def never_recorded(family: str, engines: Iterable[str]) -> str:
    """What to do about a family that was never recorded in some of these engines; "" where each has recorded it.

    Hand-written code and somebody's own engine files are never recorded, and are not spoken of.
    """
    unrecorded = [
        name for name in engines if name in engine_names() and not (FOLDER / name / f"{family}.json").exists()
    ]
    missing = [engine.title for name in unrecorded if (engine := load_engine(name)).package]
    return f"{family} was never recorded in {listed(missing)}; collisions record {family} does it" if missing else ""


def tracks_of(
    engine: str, family: str, folder: Path | None = None
) -> tuple[dict[tuple[str, str], Track], dict[str, str]]:
    """The recorded poses by profile and entry, and where and when they were made; both empty where there are none.

    Raises
    ------
    InvalidInput
        As in `content_of`.
    """
    return _tracks((folder or FOLDER) / engine / f"{family}.npz") if engine in engine_names() else ({}, {})


@functools.lru_cache(8)
def _tracks(path: Path) -> tuple[dict[tuple[str, str], Track], dict[str, str]]:
    checksums.check(path)
    return read_tracks(path)


@functools.cache
def _content(path: Path) -> dict[str, Any] | None:
    return read_recording(path, SCHEMA, VERSION)


def forget() -> None:
    """Forget what was read, so that the next request reads the files again."""
    _content.cache_clear()
    _tracks.cache_clear()


def read_recording(path: Path, schema: str, version: int) -> dict[str, Any] | None:
    """What a file of a folder of recordings holds; None where there is no such file.

    Raises
    ------
    InvalidInput
        If it holds something else, or another version, or was changed since it was made.
    """
    checksums.check(path)
    return read_json(path, schema, version)


def read_json(path: Path, schema: str, version: int) -> dict[str, Any] | None:
    """What a file of numbers holds; None where there is no such file.

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


def write_json(path: Path, content: Mapping[str, Any], depth: int) -> None:
    """Write recorded numbers as JSON with a line for each entry down to some depth: a changed case changes one line."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, f"{_lines(content, depth)}\n".encode())


def _lines(content: Any, depth: int) -> str:
    if depth == 0 or not isinstance(content, Mapping) or not content:
        return json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    entries = (f"{json.dumps(name, ensure_ascii=False)}: {_lines(value, depth - 1)}" for name, value in content.items())
    return "{\n" + ",\n".join(entries) + "\n}"


def with_tuples(values: Mapping[str, Any]) -> dict[str, Any]:
    """The same values with tuples for lists, as they were before they went into a file."""
    return {name: tuple(value) if isinstance(value, list) else value for name, value in values.items()}
