"""The files of a report: the page, its rows as JSON and CSV, timings and provenance apart, and the figures.

`rows.json`, `rows.csv`, the figures and the page hold nothing but what was compared: the same code on the same machine
writes the same bytes. How long it took, and what came from the cache, is in `timings.json`; when and on what it ran, in
`provenance.json`.
"""

from __future__ import annotations

import contextlib
import csv
import datetime
import importlib.metadata
import io
import json
import os
import platform
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, TypeVar

from reference.comparison.results import JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine
from reference.errors import InvalidInput
from reference.published.results import PublishedResult, PublishedRow
from reference.report import figures, page, published_page
from reference.report.published_figures import oblique_impacts
from reference.report.published_summary import PublishedTables
from reference.report.replays import replay_of
from reference.report.summary import Section, sections

ROWS, TIMINGS, PROVENANCE = "collisions-lab/rows", "collisions-lab/timings", "collisions-lab/provenance"
PUBLISHED = "collisions-lab/published"
SCHEMA_VERSION = 1
R = TypeVar("R", Row, PublishedRow)
STUDY_CAPTION = (
    "Error against timestep; the order is the slope of a straight line through a method's points. An error that is"
    " rounding lies on the lower edge, whatever its size. Where an error changes its sign on the way, or does not go"
    " away with the timestep, the slope is no order."
)
PAGE, PUBLISHED_PAGE = "index.html", "published.html"


@contextlib.contextmanager
def staged(out: Path) -> Iterator[Path]:
    """Give a folder to write a report into; when all went well, move its files to `out`, the page last.

    A file there is replaced in one go, by a whole one or not at all, and nothing else in `out` is touched. The folder
    stands in `out` itself, so that an unwritable place is found before anything runs. Folders that are new are taken
    away again if nothing came of it.

    Raises
    ------
    InvalidInput
        If `out` is no folder or cannot be written.
    """
    with _writable(out):
        new = [folder for folder in (out, *out.parents) if not folder.exists()]
        out.mkdir(parents=True, exist_ok=True)
        stage = Path(tempfile.mkdtemp(prefix=".unfinished-", dir=out))
    try:
        yield stage
        with _writable(out):
            _move(stage, out)
    finally:
        shutil.rmtree(stage, ignore_errors=True)
        with contextlib.suppress(OSError):
            for folder in new:
                folder.rmdir()  # goes only when it is empty


@contextlib.contextmanager
def _writable(out: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise InvalidInput(f"cannot write the report to {str(out)!r}: {error.strerror}; choose another --out") from None


def _move(stage: Path, out: Path) -> None:
    written = sorted(path.relative_to(stage) for path in stage.rglob("*") if path.is_file())
    for name in sorted(written, key=lambda name: name == Path(PAGE)):
        (out / name).parent.mkdir(exist_ok=True)
        os.replace(stage / name, out / name)


def write(results: Iterable[JobResult], folder: Path, published: Iterable[PublishedResult] = ()) -> None:
    """Write all files of a report into a folder; those of published cases only where there are any."""
    others = list(published)
    found = sections(results)
    ordered = [line.result for section in found for line in section.lines]
    drawn = {section.family.name: _figures(section) for section in found}
    (folder / "figures").mkdir()
    for pictures in drawn.values():
        for name, svg, _ in pictures:
            _write(folder / "figures" / f"{name}.svg", svg)
    versions = engine_versions(ordered)
    in_page = {name: [(svg, caption) for _, svg, caption in pictures] for name, pictures in drawn.items()}
    _write(folder / "rows.json", rows_json(ordered))
    _write(folder / "rows.csv", rows_csv(ordered))
    _write(folder / "timings.json", _json(TIMINGS, {"seconds": [_timing(result) for result in ordered]}))
    _write(folder / "provenance.json", _json(PROVENANCE, provenance(versions)))
    address = PUBLISHED_PAGE if others else ""
    replays = {section.family.name: clip for section in found if (clip := replay_of(section)) is not None}
    _write(folder / PAGE, page.render(found, in_page, _compared(ordered), _platform(), address, replays))
    if others:
        _write_published(others, folder)


def _write_published(results: Sequence[PublishedResult], folder: Path) -> None:
    """The page of published cases and their rows."""
    tables = PublishedTables.of(results)
    impacts = next((line for line in tables.lines if line.case.name == "P11"), None)
    pictures = oblique_impacts(impacts) if impacts else []
    for name, svg, _ in pictures:
        _write(folder / "figures" / f"{name}.svg", svg)
    drawn = {"P11": [(svg, caption) for _, svg, caption in pictures]}
    _write(folder / "published.json", _json(PUBLISHED, {"rows": [asdict(row) for row in tables.rows]}))
    ordered = [cell.result for name in tables.engines for line in tables.lines if (cell := line.cells.get(name))]
    _write(folder / PUBLISHED_PAGE, published_page.render(tables, drawn, _compared(ordered), _platform(), PAGE))


def read_published(path: Path) -> list[PublishedRow]:
    """Read the rows of a `published.json`; errors as in `read_rows`."""
    return _rows_of(path, PUBLISHED, PublishedRow)


def rows_json(results: Iterable[JobResult]) -> str:
    """The rows and the convergence studies as JSON."""
    results = list(results)
    studies = [_of(result) | asdict(result.convergence) for result in results if result.convergence is not None]
    splits = [_of(result) | asdict(result.split) for result in results if result.split is not None]
    rows = [asdict(row) for result in results for row in result.rows]
    return _json(ROWS, {"rows": rows, "convergence": studies, "splits": splits})


def read_rows(path: Path) -> list[Row]:
    """Read the rows of a `rows.json`.

    Raises
    ------
    InvalidInput
        If the file is not one, or of another version.
    """
    return _rows_of(path, ROWS, Row)


def _rows_of(path: Path, schema: str, kind: type[R]) -> list[R]:
    content = _read(path, schema)
    try:
        return [kind(**entry | {"verdict": Verdict(entry["verdict"])}) for entry in content["rows"]]
    except (KeyError, TypeError, ValueError) as error:
        raise InvalidInput(f"{path} holds a row that cannot be read: {error}") from None


def rows_csv(results: Iterable[JobResult]) -> str:
    """The rows as CSV, with the error beside what it is made of."""
    names = [entry.name for entry in fields(Row)]
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow([*names, "error", "relative_error"])
    for result in results:
        for row in result.rows:
            table.writerow([*(getattr(row, name) for name in names), row.error, row.relative_error])
    return text.getvalue()


def engine_versions(results: Iterable[JobResult]) -> dict[str, str]:
    """Version of each engine that ran, by title."""
    return {result.title: result.version for result in results if result.version}


def provenance(versions: Mapping[str, str]) -> dict[str, Any]:
    """When, on what and with which versions a report was made."""
    packages = {name: importlib.metadata.version(name) for name in ("numpy", "matplotlib")}
    return {
        "made": datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds"),
        "engines": dict(versions),
        "packages": packages,
        "python": platform.python_version(),
        "platform": platform.platform(),
        "processors": os.cpu_count(),
        "seed": None,  # nothing is drawn at random
    }


def _figures(section: Section) -> list[tuple[str, str, str]]:
    """Name, SVG and caption of the family's figures."""
    family = section.family
    pictures = [
        (f"{family.name}-trajectories", figures.trajectories(section), f"{family.curve.title}: all implementations."),
        (f"{family.name}-convergence", figures.convergence(section), STUDY_CAPTION),
    ]
    return [picture for picture in pictures if picture[1]]


def _of(result: JobResult) -> dict[str, Any]:
    return {"family": result.job.family, "engine": result.job.engine, "profile": result.job.profile}


def _timing(result: JobResult) -> dict[str, Any]:
    return _of(result) | {"seconds": round(result.seconds, 3), "cached": result.cached}


def _compared(results: Iterable[JobResult] | Iterable[PublishedResult]) -> list[str]:
    """What ran, as a reader would say it: an engine with its version, our own code without."""
    ran = {result.title: (load_engine(result.job.engine), result.version) for result in results if result.version}
    return [
        f"{title} {version}".strip() if engine.package else f"{title} code" for title, (engine, version) in ran.items()
    ]


def _platform() -> str:
    own = importlib.metadata.version("collisions-lab")
    return f"Collisions Lab {own}, Python {platform.python_version()} on {platform.system()} {platform.machine()}"


def _json(schema: str, content: Mapping[str, Any]) -> str:
    whole = {"schema": schema, "version": SCHEMA_VERSION, **content}
    return json.dumps(whole, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _read(path: Path, schema: str) -> dict[str, Any]:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InvalidInput(f"cannot read {str(path)!r}: {error.strerror}") from None
    except ValueError as error:
        raise InvalidInput(f"{str(path)!r} is not JSON: {error}") from None
    found = (content.get("schema"), content.get("version")) if isinstance(content, dict) else (None, None)
    if found != (schema, SCHEMA_VERSION):
        said = f"{found[0]} version {found[1]}"
        raise InvalidInput(f"{str(path)!r} is {said}; this program reads {schema} version {SCHEMA_VERSION}")
    assert isinstance(content, dict)
    return content


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")
