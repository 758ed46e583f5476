"""The outcome of a test that pytest ran: its points, and the words that a student may read."""

from __future__ import annotations

import contextlib
import re
from dataclasses import replace

import pytest

from labs.grading.calling.remote import Remote
from labs.grading.diagnosis.findings import Diagnosis, Verdict
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.diagnosis.words import told
from labs.grading.errors import FunctionMissing, FunctionRaised, GraderFailed, OutOfTime, StudentError
from labs.grading.judging.blame import needed_functions
from labs.grading.judging.markers import is_hidden, marker
from labs.grading.judging.score_sheet import Cause, Outcome, Part, Sheet
from labs.grading.judging.suspects import suspects
from labs.grading.phrases import needed_function, without_explanation
from labs.grading.safe_text import plain
from labs.grading.submission.reading import Submission
from reference import lecture
from reference.errors import CollisionsError, NeedsFunction, UnknownName

NOTHING_COMPUTED = (ArithmeticError, IndexError, TypeError, ValueError, RuntimeWarning)
"""What goes wrong in a test that computes with an answer of an odd shape, or with numbers of an odd size."""
_LINES = 8  # of what a failed assertion says
_OBVIOUS = tuple(f"{name} = submission.{name}" for name in lecture.FUNCTIONS)  # as pytest adds it


def outcome_of(item: pytest.Item, passed: bool, error: BaseException | None, parts: tuple[Part, ...]) -> Outcome:
    """A test as the sheet holds it."""
    hidden = is_hidden(item)
    return Outcome(
        test=item.name,
        points=marker(item, "points", 1),
        passed=passed,
        hidden=hidden,
        said="" if passed or any(not part.passed for part in parts) else said(error, hidden),
        rationale=marker(item, "rationale", ""),
        help=marker(item, "help", ""),
        parts=parts,
        function=marker(item, "function", ""),
        cause=cause_of(error),
        through=through(error),
    )


def through(error: BaseException | None) -> tuple[str, ...]:
    """The submission's functions that an exception of it passed through."""
    return error.through if isinstance(error, FunctionRaised) else ()


def cause_of(error: BaseException | None) -> Cause:
    """Why a test or a part failed: for want of time, for want of a function, or for any other reason."""
    if isinstance(error, OutOfTime):
        return "time"
    in_a_run = isinstance(error, AssertionError) and needed_function(str(error))  # it reports errors in words
    return "missing" if in_a_run or isinstance(error, NeedsFunction) else ""


def said(error: BaseException | None, hidden: bool) -> str:
    """What a student may be told of a failure.

    A hidden test keeps its numbers secret, and also everything that the submission could put into a message.
    """
    if hidden and isinstance(error, StudentError):
        return f"the function {error.gist}"
    if hidden:  # a driver's message may hold numbers
        return "the answer is wrong"
    if isinstance(error, NOTHING_COMPUTED) and not isinstance(error, CollisionsError):
        return "the answer has a shape or a size with which the test can compute nothing"
    ours = not isinstance(error, StudentError)  # a submission may say what pytest says
    words = without_explanation(str(error)) if ours else str(error)
    lines = [line.strip() for line in plain(words, 1000).splitlines()]
    kept = [line for line in lines if line and not (ours and line.endswith(_OBVIOUS))][:_LINES]
    notes = [] if isinstance(error, FunctionMissing) else getattr(error, "__notes__", [])
    found = [*kept, *(f"for {example}" for note in notes if (example := _example(note)))]
    return "\n".join(found) or "the answer is wrong"


def _example(note: str) -> str:
    """The arguments of the smallest example that hypothesis found, as it notes them, one a line."""
    arguments = re.findall(r"^ {4}(\w+=.*?),?(?:  #.*)?$", plain(note, 1000), re.MULTILINE)
    return ", ".join(argument for argument in arguments if argument != "submission=submission")


def explain(sheet: Sheet, submission: Submission, remote: Remote) -> None:
    """Note what is wrong with each function that lost points, and which others pass their tests and are suspect.

    A function that ran out of time is not called again, since its probes would wait just as long. When the time of the
    whole submission is used up, no function is: one that failed before for a reason of its own stays wrong. So does one
    that is right for each single case of its probes, if it lost more than what several cases in one call cost.
    """
    for name in sheet.lost:
        sheet.borrows[name] = submission.borrows(name)
        if name in remote.slow:
            sheet.diagnoses[name] = Diagnosis(name, "too slow")
            continue
        with contextlib.suppress(UnknownName, GraderFailed), remote.fresh() as call:  # it has no probes, or no process
            sheet.diagnoses[name] = diagnose(name, call, submission.uses)
        if not remote.budget.left:  # some of the probes, or all of them, got no answer for want of time
            sheet.diagnoses[name] = Diagnosis(name, _without_probes(sheet, name, submission))
        found = sheet.diagnoses.get(name)
        if found and found.verdict == "one at a time" and "" in sheet.causes(name):
            sheet.diagnoses[name] = replace(found, verdict="wrong")
    suspected = (
        suspects([name for name in sheet.passed if name not in remote.slow], remote) if remote.budget.left else {}
    )
    sheet.suspects = suspected if remote.budget.left else {}  # a probe without an answer for want of time says nothing
    sheet.note_uses(submission.uses)


def _without_probes(sheet: Sheet, name: str, submission: Submission) -> Verdict:
    """What can be said of a function that lost points if there is no time for its probes."""
    causes, needed = sheet.causes(name), needed_functions(sheet, name)
    if name not in submission.functions or name in needed or causes == {"missing"}:
        return "unwritten"
    return "not tried" if causes <= {"missing", "time"} else "wrong"


def summary(terminal: pytest.TerminalReporter, sheet: Sheet) -> None:
    """Tell the person who ran pytest what is wrong with the file, what each lost test is about, and the points."""
    if not sheet.outcomes:
        return
    write = terminal.write_line
    terminal.write_sep("=", sheet.submission or "no submission")
    for complaint in sheet.complaints:
        write(str(complaint))
    for outcome in sheet.outcomes:
        if not outcome.passed:
            write("\n    ".join(line for lines in outcome.lines() for line in lines.splitlines()))
    for diagnosis in sheet.diagnoses.values():
        write(f"\n{told(diagnosis)}" if diagnosis.verdict != "unwritten" else told(diagnosis))
    for diagnosis in sheet.suspects.values():
        write(f"\nsuspect, though its tests pass: {told(diagnosis)}")
    write("")
    for reason, count in sheet.left_out.items():
        write(f"{count} test{'s' * (count != 1)} left out: {reason}")
    write(f"{sheet.earned} of {sheet.points} points ({sheet.tier or 'not run'})")
