"""Recordings of published cases: an engine's answers from a machine where it was installed, judged here and now.

There is one file for each engine, `recordings/ENGINE/published.json`. It holds the engine's answers with the tolerances
of its method, and never a verdict. A fingerprint of the case's set-up says which case an answer belongs to. Where that
has changed since, the recording is stale, and a row says so instead of a number.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from reference.comparison.verdicts import Verdict
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput, RunFailed
from reference.published.answers import Answer
from reference.published.case import Figure, Published
from reference.published.judging import judged
from reference.published.results import PublishedJob, PublishedResult, PublishedRow
from reference.published.theirs import published, published_cases
from reference.recording import checksums
from reference.recording.files import FOLDER, MARK, Made, read_recording, with_tuples, write_json
from reference.recording.fingerprint import hashed

SCHEMA, VERSION = "collisions-lab/published-recording", 1
FILE = "published.json"
_LINES_DOWN_TO = 3
"""Depth of the file down to which each entry has a line of its own: that of the parts of a case."""


def fingerprint(case: Published) -> str:
    """A hash of the case's set-up."""
    return hashed(case.setup)


def write(
    results: Iterable[PublishedResult], folder: Path | None = None, today: datetime.date | None = None
) -> list[Path]:
    """Write the answers that engines have just given to published cases, one file for each engine; return the files.

    Raises
    ------
    InvalidInput
        If an engine is not the lab's own, did not run here, or crashed.
    """
    found: dict[str, list[PublishedResult]] = {}
    for result in results:
        if result.job.engine not in engine_names() or result.recording:
            raise InvalidInput(f"{result.job} did not run in an engine of the lab's own; only that is recorded")
        found.setdefault(result.job.engine, []).append(result)
    written = []
    for name, own in found.items():
        version = next((result.version for result in own if result.version), "")
        made = Made.here(load_engine(name).title, version, today)
        cases = {result.job.case: _entry(result) for result in own}
        content = {"schema": SCHEMA, "version": VERSION, "made": asdict(made), "cases": cases}
        path = (folder or FOLDER) / name / FILE
        write_json(path, content, _LINES_DOWN_TO)
        written.append(path)
    checksums.renew(folder or FOLDER, written)
    return written


def _entry(result: PublishedResult) -> dict[str, Any]:
    whole = next((row for row in result.rows if not row.figure), None)
    if whole is not None and whole.verdict in (Verdict.CRASHED, Verdict.LOST, Verdict.NOT_AVAILABLE):
        raise RunFailed(f"{result.job}: {whole.verdict}: {whole.note}; nothing is recorded")
    return {
        "fingerprint": fingerprint(published(result.job.case)),
        "answers": {name: asdict(answer) for name, answer in result.answers.items()},
        "refused": [whole.verdict, whole.note] if whole is not None else None,
    }


def recall(job: PublishedJob, folder: Path | None = None) -> PublishedResult | None:
    """The result that an engine gave elsewhere, judged here and now; None where nothing of it was recorded.

    A case whose set-up is not that of the recording gets a row that says so, and no number.
    """
    if job.engine not in engine_names():  # an engine file, which nobody has recorded
        return None
    content = read_recording((folder or FOLDER) / job.engine / FILE, SCHEMA, VERSION)
    if content is None:
        return None
    made, case = Made(**content["made"]), published(job.case)
    rows, answers = _rows(case, job.engine, content["cases"].get(case.name))
    rows = tuple(
        row
        if row.verdict is Verdict.NOT_AVAILABLE
        else replace(row, engine_version=made.version, recorded_on=made.date)
        for row in rows
    )
    title = f"{load_engine(job.engine).title}{MARK}"
    return PublishedResult(job, title, rows, made.version, answers, f"{MARK} {made}")


def is_stale(engine: str, folder: Path | None = None) -> bool:
    """Whether an engine's recording is missing or unreadable, of another version, set-up or figures than now."""
    try:
        found = [recall(PublishedJob(name, engine), folder) for name in published_cases()]
    except InvalidInput:
        return True
    here = load_engine(engine).versions()["engine_version"]
    made = {each.version for each in found if each is not None}
    missing = any(each is None or each.rows[0].verdict is Verdict.NOT_AVAILABLE for each in found)
    return missing or bool(here and made != {here})


def _rows(
    case: Published, engine: str, entry: Mapping[str, Any] | None
) -> tuple[tuple[PublishedRow, ...], dict[str, Answer]]:
    blank = PublishedRow(case.name, engine, "", 0, Verdict.NOT_AVAILABLE)
    if entry is None:
        return (replace(blank, note="the engine is not installed here, and this case was never recorded"),), {}
    if entry["fingerprint"] != fingerprint(case):
        why = "its recording is stale: the set-up has changed since; collisions record makes a new one"
        return (replace(blank, note=why),), {}
    if entry["refused"]:
        verdict, note = entry["refused"]
        return (replace(blank, verdict=Verdict(verdict), note=note),), {}
    answers = {name: Answer(**with_tuples(answer)) for name, answer in entry["answers"].items()}
    if not _fits(case, answers):
        why = "its recording is stale: other figures are asked since; collisions record makes a new one"
        return (replace(blank, note=why),), {}
    return judged(case, engine, answers), answers


def _fits(case: Published, answers: Mapping[str, Answer]) -> bool:
    """Whether there is an answer to every figure, with as many numbers as were published."""

    def count(figure: Figure) -> int:
        return len(figure) if isinstance(figure, tuple) else 0

    asked = answers.keys() == case.expected.keys()
    values = {name: answer.value for name, answer in answers.items() if answer.value is not None}
    return asked and all(count(value) == count(case.expected[name]) for name, value in values.items())
