"""`lab.check()`: runs the visible tests on the functions in the executed cells, and reports in words."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from labs.desk import student_code
from labs.desk.nbgrader import run_of_nbgrader
from labs.grading.calling.remote import Grader
from labs.grading.errors import UnreadableSubmission
from labs.grading.feedback import report
from labs.grading.feedback.one_at_a_time import in_short
from labs.grading.feedback.tries import Tries
from labs.grading.judging import pytest_run
from labs.grading.judging.score_sheet import Sheet
from labs.grading.submission.reading import read
from reference import lecture
from reference.errors import InvalidInput


@dataclass(frozen=True)
class Checked:
    """What a check found. report: in words. credit: what nbgrader counts for its cell.

    A number is so many points, an error none, anything else all.
    """

    report: str
    credit: float | None = None


_COUNTED = "Tries are counted since this kernel started; the same code again is no new try."


def check(
    notebook: Path,
    topic: str,
    names: Sequence[str],
    grader: Grader,
    tries: Tries,
    paid: dict[str, str],
    hint: bool = False,
) -> Checked:
    """Run the visible tests of some functions, or of all functions that the student of this lab writes.

    tries: those that were made, which this check adds to. paid: of each topic, the function that lost a part because it
    is right for one case alone; this check keeps it up to date, so that a lab loses one such part however many checks
    there are. hint: whether to show the next level of help at once. For nbgrader, which checks each function once, all
    help is shown.

    Raises
    ------
    InvalidInput
        If there is nothing to check: a function is given, or there is no code yet.
    """
    topics = tuple(dict.fromkeys(lecture.function(name).topic for name in names)) or (topic,)
    earlier = {each: payer for each, payer in paid.items() if names and payer not in names}
    untested = [name for name in names if lecture.function(name).role != "written"]
    if untested:
        raise InvalidInput(f"{', '.join(untested)} is given, so there is nothing to check")
    try:
        sheet = pytest_run.run(notebook, topics, (pytest_run.VISIBLE,), grader, names, paid=earlier)
    except UnreadableSubmission as error:
        raise InvalidInput(f"nothing can be checked yet: {error}") from None
    # In a kernel a function is written by running its cell again and again, so a repeated definition is no mistake.
    sheet.complaints = [complaint for complaint in sheet.complaints if complaint.kind != "repeated"]
    nothing_odd = all(complaint.kind == "missing" for complaint in sheet.complaints)
    functions = [entry.name for name in topics for entry in report.tested(sheet, name)]
    faulty = [name for name in functions if _is_faulty(sheet, name)]
    _add(tries, notebook, faulty)
    if len(names) == 1 and nothing_odd and report.all_right(sheet):
        count = tries.count(names[0])
        right = (
            f"{report.RIGHT} {names[0]} is right{in_short(sheet, names[0], ' ')}{f' at try {count + 1}' * bool(count)}"
        )
        said = textwrap.fill(f"{right}, as far as this tries it: {report.HIDDEN}.", 80)
    elif run_of_nbgrader():
        said = _report(sheet, topics, None)
    else:
        said = _with_tries(sheet, topics, tries, names if hint else ()) + f"\n{_COUNTED}" * bool(faulty)
    for name in functions:
        if report.state(sheet, name) == report.RIGHT:
            tries.forget(name)
    paid.clear()
    paid.update(sheet.case_by_case.paid)
    if run_of_nbgrader() == "autograde":
        graded = _graded(notebook, topics, names, grader, earlier)
        paid.update(graded.case_by_case.paid)
        credit: float | None = float(graded.earned)
    else:
        credit = 0.0 if run_of_nbgrader() and not report.all_right(sheet) else None
    return Checked(student_code.with_kernel_numbers(said), credit)


def _with_tries(sheet: Sheet, topics: Sequence[str], tries: Tries, requests: Sequence[str]) -> str:
    """The report with as much help as there were tries. requests: functions that the next level is shown of as well."""
    before = _report(sheet, topics, tries)
    for name in requests:
        tries.request(name)
    said = _report(sheet, topics, tries)
    wrong = [name for name in requests if _is_faulty(sheet, name)]
    return said if said != before or not wrong else f"{said}\nThere is no further hint on {', '.join(wrong)}."


def _is_faulty(sheet: Sheet, name: str) -> bool:
    """Whether a function was run and is wrong or suspect."""
    return report.state(sheet, name) in (report.WRONG, report.SUSPECT) and name not in sheet.unread


def _report(sheet: Sheet, topics: Sequence[str], tries: Tries | None) -> str:
    return "\n".join(report.report(sheet, topics, tries)).strip("\n")


def _add(tries: Tries, notebook: Path, faulty: Sequence[str]) -> None:
    """Add a try at each function that is not right."""
    if faulty:
        submission = read(notebook, faulty, also=lecture.FUNCTIONS)
        for name in faulty:
            tries.add(name, submission.code_of(name))


def _graded(
    notebook: Path, topics: Sequence[str], names: Sequence[str], grader: Grader, paid: Mapping[str, str]
) -> Sheet:
    """The sheet of the visible tests, and of the hidden tests if this tree has them."""
    return pytest_run.run(notebook, topics, (pytest_run.VISIBLE, pytest_run.HIDDEN), grader, names, paid=paid)
