"""The rows of a comparison as JSON and CSV, and reading them back."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, TypeVar

from reference.comparison.pairs import Pair
from reference.comparison.results import JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.errors import InvalidInput
from reference.published.results import PublishedRow
from reference.recording.files import with_tuples
from reference.report.agreement import as_content
from reference.report.sensitivity import kept

ROWS, PUBLISHED = "collisions-lab/rows", "collisions-lab/published"
VERSIONS = {ROWS: 3, PUBLISHED: 3}
"""Of the schemas of rows. Since version 3 each row has its `engine_version` and `adapter_version`, recorded or not,
and says whether it is `evidence`."""
R = TypeVar("R", Row, PublishedRow)


def rows_json(results: Iterable[JobResult], pairs: Iterable[Pair] = (), unfinished: str = "") -> str:
    """The rows, who agrees with whom, errors against timestep and their splits, and the smallest faults, as JSON.

    pairs: every two of their numbers that are compared. unfinished: what is said while runs have not ended; empty
    once all rows are there.
    """
    results = list(results)
    studies = [run_of(result) | asdict(result.convergence) for result in results if result.convergence is not None]
    splits = [run_of(result) | asdict(result.split) for result in results if result.split is not None]
    rows = [asdict(row) for result in results for row in result.rows]
    families = {result.job.family for result in results}
    noticed = {family: found for family, found in kept().items() if family in families}
    content = {"rows": rows, "agreement": as_content(pairs), "convergence": studies, "splits": splits}
    content = _remark(unfinished) | content
    return as_json(ROWS, content | {"sensitivity": noticed})


def published_json(rows: Iterable[PublishedRow], unfinished: str = "") -> str:
    """The rows of published cases as JSON; unfinished as in `rows_json`."""
    return as_json(PUBLISHED, _remark(unfinished) | {"rows": [asdict(row) for row in rows]})


def _remark(unfinished: str) -> dict[str, Any]:
    return {"unfinished": unfinished} if unfinished else {}


def rows_csv(results: Iterable[JobResult]) -> str:
    """The rows as CSV, with the error beside the numbers that it is the difference of."""
    names = [entry.name for entry in fields(Row)]
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow([*names, "error", "relative_error"])
    for result in results:
        for row in result.rows:
            table.writerow([*(getattr(row, name) for name in names), row.error, row.relative_error])
    return text.getvalue()


def run_of(result: JobResult) -> dict[str, Any]:
    """The entries that name the run of a result."""
    return {"family": result.job.family, "engine": result.job.engine, "profile": result.job.profile}


def as_json(schema: str, content: Mapping[str, Any]) -> str:
    """Any content of a report as JSON, with its schema and the schema's version."""
    whole = {"schema": schema, "version": VERSIONS.get(schema, 1), **content}
    return json.dumps(whole, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def read_rows(path: Path) -> list[Row]:
    """Read the rows of a `rows.json`.

    Raises
    ------
    InvalidInput
        If the file is not one, or of another version.
    """
    return _rows_of(path, ROWS, Row)


def read_published(path: Path) -> list[PublishedRow]:
    """Read the rows of a `published.json`; errors as in `read_rows`."""
    return _rows_of(path, PUBLISHED, PublishedRow)


def _rows_of(path: Path, schema: str, kind: type[R]) -> list[R]:
    content = _read(path, schema)
    try:
        return [kind(**with_tuples(entry) | {"verdict": Verdict(entry["verdict"])}) for entry in content["rows"]]
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise InvalidInput(f"{path} holds a row that cannot be read: {error}") from None


def _read(path: Path, schema: str) -> dict[str, Any]:
    try:
        if path.exists() and not path.is_file():  # a device may have no end
            raise OSError(None, "not a regular file")
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InvalidInput(f"cannot read {str(path)!r}: {error.strerror}") from None
    except ValueError as error:
        raise InvalidInput(f"{str(path)!r} is not JSON: {error}") from None
    found = (content.get("schema"), content.get("version")) if isinstance(content, dict) else (None, None)
    if found != (schema, VERSIONS[schema]):
        said = f"{found[0]} version {found[1]}"
        raise InvalidInput(f"{str(path)!r} is {said}; this program reads {schema} version {VERSIONS[schema]}")
    assert isinstance(content, dict)
    return content
