"""What a run leaves to a person, in a handful of lines: each says what it is, of whom, and which file to open.

Everything else that is odd about a submission is in the column `notes` of `grades.csv`, and needs nobody.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from labs.assessment.shares import CODE, SHARES
from labs.gradebook import written
from labs.gradebook.arrivals import EARLIER, Arrival
from labs.gradebook.class_grading import MARKS
from labs.gradebook.class_list import Class
from labs.gradebook.class_run import Failures
from labs.gradebook.deadlines import CALLED_LATE, NO_TIME, OTHER_DEADLINE
from labs.gradebook.mistakes import naming
from labs.gradebook.mistakes.clusters import Cluster
from labs.gradebook.tables import Mark
from labs.gradebook.written import is_code_alone
from labs.grading.safe_text import one_line

MOST_NAMED = 5
"""So many students are named in a line."""


def left_to_do(
    folder: Path, found: Class, every: Sequence[Mark], failures: Failures, shared: Sequence[Cluster]
) -> Iterator[str]:
    """A line for each kind of thing that a person has to look at."""
    notes = f"The notes in {folder / MARKS}"
    if failures.busy:
        yield (
            f"{_of(sorted(failures.busy), 'not graded for lack of time')}. This machine was too busy with other"
            " programs. No points are lost: run the same command again when it is idle."
        )
    if failed := [student for student in failures.said if student not in failures.busy]:
        yield f"{_of(failed, 'could not be graded')}. {notes} say why; run the command again."
    if failures.without_page:
        first = next(iter(failures.without_page.values()))
        yield f"{_of([*failures.without_page], 'without a page')}. Their marks count; the first page failed by {first}."
    if found.strangers:
        yield f"{_of([*found.strangers], 'not on the roster')}. Their marks are in {MARKS}, but in no file to upload."
    unread = [mark.student.id for mark in every if mark.content and "unreadable" in mark.content]
    if unread := [*unread, *(student for student in found.unusable if student not in failures.said)]:
        yield f"{_of(unread, 'with nothing that could be graded')}. {notes} say why; ask for another file."
    if found.strays:
        yield (
            f"{_of(found.strays, 'among the submissions that no student handed in')}. A file is a student's if its name"
            " is the student's number, or as the platform writes it."
        )
    if odd := [student for student, arrival in found.handed.items() if _is_odd(arrival)]:
        yield f"{_of(odd, 'with a doubt about what they handed in')}. {notes} say what was graded, and what was not."
    if alone := [mark.student.id for mark in every if is_code_alone(mark.content)]:
        yield (
            f"{_of(alone, 'who handed in a Python file')}. It has no written answers and reaches {SHARES[CODE]} of 100"
            " points at most, as their pages say. Ask for the notebook if you had set it."
        )
    if late := [mark.student.id for mark in every if mark.late.said == CALLED_LATE]:
        yield f"{_of(late, 'late, but the platform does not say by how much')}. Nothing is taken off."
    if unknown := [mark.student.id for mark in every if mark.late.said == NO_TIME]:
        yield (
            f"{_of(unknown, 'of whom nobody knows when they handed in')}. Nothing is taken off, although the rules set"
            " a deadline."
        )
    if other := [mark.student.id for mark in every if OTHER_DEADLINE in mark.notes]:
        yield (
            f"{_of(other, 'whose lateness Moodle counts from another deadline')}. The rules decide: if somebody has"
            " more time in Moodle, write it into [due.students] too."
        )
    if left := sum(mark.open > 0 for mark in every):
        place = folder / written.FOLDER
        yield (
            f"The written questions of {left} are to be marked: read the pages in {place}, fill in {written.POINTS}"
            " there and run this again."
        )
    if shared:
        several_of = f"{len(shared)} mistakes" if len(shared) > 1 else "One mistake"
        yield (
            f"{several_of} without a name: see {folder / naming.PAGE}, and write a name into {folder / naming.FILE} if"
            " you like."
        )


def _is_odd(arrival: Arrival) -> bool:
    return any(EARLIER not in note for note in arrival.notes)


def _of(students: Sequence[str], what: str) -> str:
    """How many students, what about them, and the first of them by number."""
    named = ", ".join(one_line(each, 60) for each in students[:MOST_NAMED])
    more = f" and {len(students) - MOST_NAMED} others" if len(students) > MOST_NAMED else ""
    return f"{len(students)} {what}: {named}{more}"
