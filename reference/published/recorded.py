"""Recordings of published cases: what an engine said of them where it was installed, judged anew each time.

One file an engine, `recordings/ENGINE/published.json`. It holds an engine's answers, with what its method is known to
allow, never a verdict. A fingerprint of the case's set-up says what an answer belongs to; where that has changed since,
the recording is stale, and says so instead of answering.
"""

from __future__ import annotations

import datetime
import platform
from collections.abc import Iterable, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from reference.comparison.verdicts import Verdict
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput
from reference.published.answers import Answer
from reference.published.case import Figure, Published
from reference.published.judging import judged
from reference.published.results import PublishedJob, PublishedResult, PublishedRow
from reference.published.theirs import published, published_cases
from reference.recording.fingerprint import hashed
from reference.recording.making import lines, machine, version_here
from reference.recording.reading import FOLDER, MARK, Made, read, tuples

SCHEMA, VERSION = "collisions-lab/published-recording", 1
FILE = "published.json"


def fingerprint(case: Published) -> str:
    """A hash of the case's set-up."""
    return hashed(case.setup)


def write(
    results: Iterable[PublishedResult], folder: Path | None = None, today: datetime.date | None = None
) -> list[Path]:
    """Write what engines have just said of all published cases, one file an engine, and return the files.

    Raises
    ------
    InvalidInput
        If an engine is none of the lab's, did not run here, crashed, or was asked only some of the cases.
    """
    found: dict[str, list[PublishedResult]] = {}
    for result in results:
        if result.job.engine not in engine_names() or result.recording:
            raise InvalidInput(f"{result.job} did not run in an engine of the lab's own; only that is recorded")
        found.setdefault(result.job.engine, []).append(result)
    day, written = (today or datetime.date.today()).isoformat(), []
    for name, own in found.items():
        version = next((result.version for result in own if result.version), "")
        made = Made(load_engine(name).title, version, machine(), platform.python_version(), day)
        cases = {result.job.case: _entry(result) for result in own}
        content = {"schema": SCHEMA, "version": VERSION, "made": asdict(made), "cases": cases}
        path = (folder or FOLDER) / name / FILE
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(lines(content, 3) + "\n", encoding="utf-8")
        written.append(path)
    return written


def _entry(result: PublishedResult) -> dict[str, Any]:
    whole = next((row for row in result.rows if not row.figure), None)
    if whole is not None and whole.verdict in (Verdict.CRASHED, Verdict.NOT_AVAILABLE):
        raise InvalidInput(f"{result.job}: {whole.verdict}: {whole.note}; nothing is recorded")
    return {
        "fingerprint": fingerprint(published(result.job.case)),
        "answers": {name: asdict(answer) for name, answer in result.answers.items()},
        "refused": [whole.verdict, whole.note] if whole is not None else None,
    }


def recall(job: PublishedJob, folder: Path | None = None) -> PublishedResult | None:
    """What an engine said elsewhere, judged here and now; None where nothing of it was recorded.

    A case whose set-up is not that of the recording gets a row that says so, and no number.
    """
    if job.engine not in engine_names():  # an engine file: nobody has recorded it
        return None
    content = read((folder or FOLDER) / job.engine / FILE, SCHEMA, VERSION)
    if content is None:
        return None
    made, case = Made(**content["made"]), published(job.case)
    rows, answers = _rows(case, job.engine, content["cases"].get(case.name))
    title = f"{load_engine(job.engine).title}{MARK}"
    return PublishedResult(job, title, rows, made.version, answers, f"{MARK} {made}")


def is_stale(engine: str, folder: Path | None = None) -> bool:
    """Whether an engine's recording is missing or unreadable, of another version, set-up or figures than now."""
    try:
        found = [recall(PublishedJob(name, engine), folder) for name in published_cases()]
    except InvalidInput:
        return True
    here = version_here(load_engine(engine))
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
    answers = {name: Answer(**tuples(answer)) for name, answer in entry["answers"].items()}
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
