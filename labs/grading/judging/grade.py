"""A grade: what a submission earned by test, function and topic, in one file that everything else is made from.

`grade.json` is written when no process of the submission is left. It is written to a temporary file that is renamed
last, and only its owner can read it. Points are whole numbers.
"""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from labs.grading.budget import Budget
from labs.grading.calling.remote import Grader, Limits
from labs.grading.diagnosis.findings import Unnamed
from labs.grading.diagnosis.output_names import output_names
from labs.grading.diagnosis.words import answered
from labs.grading.judging.blame import blame_of, lent_words
from labs.grading.judging.pytest_run import HIDDEN, VISIBLE, run, topics_of
from labs.grading.judging.score_sheet import Outcome, Sheet
from reference import lecture
from reference.errors import InvalidInput

SCHEMA, VERSION = "collisions-lab/grade", 1


@dataclass(frozen=True)
class Grade:
    """What a submission earned. topics: those that were tested. sheet: all outcomes, with the tier of isolation."""

    topics: tuple[str, ...]
    sheet: Sheet

    def content(self) -> dict[str, Any]:
        """The grade as plain data, as the file holds it."""
        sheet = self.sheet
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "submission": sheet.submission,
            "tier": sheet.tier,
            "missing": list(sheet.missing),
            "left_out": sheet.left_out,
            "complaints": [str(complaint) for complaint in sheet.complaints],
            **_points(sheet.outcomes),
            "topics": [{"name": name, **_points(self._about(name))} for name in self.topics],
            "functions": [self._function(name) for name in self._functions()],
            "tests": [_test(outcome) for outcome in sheet.outcomes],
        }

    def write(self, path: Path | str) -> None:
        """Write the file in one go: any reader sees either the old file or the new one."""
        write_private(Path(path), as_json(self.content()))

    def _about(self, topic: str) -> list[Outcome]:
        return [outcome for outcome in self.sheet.outcomes if _topic(outcome) == topic]

    def _functions(self) -> list[str]:
        return list(dict.fromkeys(outcome.function for outcome in self.sheet.outcomes if outcome.function))

    def _verdict(self, name: str) -> str:
        """What is known of a function. It is right if a test of it called it, and no test and no probe of it failed."""
        if all(outcome.passed for outcome in self.sheet.about(name)) and name not in self.sheet.suspects:
            return "one at a time" if name in self.sheet.case_by_case.functions else "right"
        return blame_of(self.sheet, name).verdict

    def _function(self, name: str) -> dict[str, Any]:
        blame, verdict = blame_of(self.sheet, name), self._verdict(name)
        own = blame.diagnosis and not self.sheet.wrong_uses(name, ("not tried", "one at a time"))
        found = blame.diagnosis.unnamed if blame.diagnosis and own else None
        return {
            "name": name,
            "topic": lecture.function(name).topic,
            **_points(outcome for outcome in self.sheet.outcomes if outcome.function == name),
            "verdict": verdict,
            "suspect": name in self.sheet.suspects,
            "mend_first": list(blame.mend_first),
            "mistakes": [known.id for known in blame.diagnosis.mistakes] if blame.diagnosis else [],
            "message": "\n".join([*lent_words(self.sheet, name), *blame.lines()]),
            **({"unnamed": _unnamed(found)} if found else {}),
        }


def as_json(content: Mapping[str, Any]) -> str:
    """The text of a file of plain data: equal content makes equal bytes."""
    return json.dumps(content, ensure_ascii=False, indent=1, allow_nan=False) + "\n"


def write_private(path: Path, text: str) -> None:
    """Write a file that its owner alone can read, in one go: any reader sees either the old file or the new one.

    Half a character, which a hostile notebook may hold, is written as its escape, which JSON reads as the same.
    """
    descriptor, name = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)  # of mode 0600
    try:
        with open(descriptor, "w", encoding="utf-8", errors="backslashreplace", newline="") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(name, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(name)
        raise


def grade(
    path: Path | str,
    topics: Collection[str] | None = None,
    folders: Iterable[str] = (VISIBLE, HIDDEN),
    grader: Grader | None = None,
    seconds: float | None = None,
) -> Grade:
    """Grade a file: the topics named, or those of which it defines a function.

    To grade many files, pass one grader for all of them, which saves starting one for each. seconds: how long grading
    may take in all; without it, the grader's limits say so. Tests that are not reached by then earn nothing.

    Raises
    ------
    UnreadableSubmission, InvalidInput, GraderFailed
        If the file cannot be read, if no topic is named and the file defines no function of any, or if the tests cannot
        be run.
    """
    limits = grader.limits if grader else Limits()
    budget = Budget(seconds if seconds is not None else limits.submission)
    wanted = tuple(topics) if topics is not None else topics_of(path)[1]
    if not wanted:
        raise InvalidInput(
            f"{Path(path).name} defines no function of the lab; name the topic that it is to be graded for"
        )
    return Grade(wanted, run(path, wanted, folders, grader, budget=budget))


def read_grade(path: Path | str) -> dict[str, Any]:
    """The content of a file; raises `InvalidInput` if it is not a grade, or of another version."""
    try:
        content: dict[str, Any] = json.loads(Path(path).read_text(encoding="utf-8"))
        found = content.get("schema"), content.get("version")
    except (ValueError, AttributeError):
        raise InvalidInput(f"{str(path)!r} is no grade") from None
    if found != (SCHEMA, VERSION):
        raise InvalidInput(f"{str(path)!r} is {found[0]} {found[1]}, not {SCHEMA} {VERSION}")
    return content


def _unnamed(found: Unnamed) -> dict[str, Any]:
    """What an unknown mistake gives: deviations and the function's own answer, neither inputs nor expected values."""
    example = found.example
    gives, _ = answered(example.answer, example.right, output_names(example.function))
    return {"numbers": list(found.numbers), "place": found.place, "gives": gives}


def _points(outcomes: Iterable[Outcome]) -> dict[str, int]:
    pairs = [(outcome.earned, outcome.points) for outcome in outcomes]
    return {"got": sum(got for got, _ in pairs), "possible": sum(possible for _, possible in pairs)}


def _topic(outcome: Outcome) -> str:
    return lecture.function(outcome.function).topic if outcome.function else ""


def _test(outcome: Outcome) -> dict[str, Any]:
    return {
        "name": outcome.test,
        "title": outcome.title,
        "function": outcome.function,
        "topic": _topic(outcome),
        "hidden": outcome.hidden,
        "passed": outcome.passed,
        "got": outcome.earned,
        "possible": outcome.points,
        "message": outcome.said,
        "rationale": outcome.rationale,
        "help": outcome.help,
        "parts": [
            {
                "reason": part.reason,
                "got": part.points if part.passed else 0,
                "possible": part.points,
                "message": part.said or "",
            }
            for part in outcome.parts
        ],
    }
