"""What everybody in a class gets, and the files and pages of the marks."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from labs.assessment.shares import CODE, QUESTIONS, SHARES
from labs.gradebook.book import Book
from labs.gradebook.class_list import Class
from labs.gradebook.class_run import Failures
from labs.gradebook.deadlines import Deadlines
from labs.gradebook.lateness import calling_late, lateness, not_there
from labs.gradebook.marking import Given, Key
from labs.gradebook.mistakes import naming
from labs.gradebook.mistakes.clusters import Cluster, clusters
from labs.gradebook.mistakes.course_bank import CourseBank
from labs.gradebook.mistakes.entries import Entry
from labs.gradebook.pages import class_page, clusters_page, student_page
from labs.gradebook.roster import Student
from labs.gradebook.runs_compared import compared, spreads
from labs.gradebook.tables import Mark, junit, plain_table
from labs.gradebook.upload import Target, filled
from labs.gradebook.written import Codes, Question, given_to, is_code_alone
from labs.grading.judging.grade import write_private
from labs.grading.safe_text import cause_of

FEEDBACK, CLASS, MARKS = "feedback.html", "class.html", "grades.csv"


@dataclass(frozen=True)
class Marker:
    """What the marks of a class are made of besides the submissions: grades, rules, and what people have written.

    given: points for answers. bank: names that the course gives to mistakes.
    """

    book: Book
    deadlines: Deadlines
    failures: Failures
    codes: Codes
    asked: tuple[Question, ...]
    given: Mapping[Key, Given]
    bank: CourseBank

    def questions(self, student: str, content: Mapping[str, Any]) -> float | None:
        """The share of the points of the questions that a student got; None while some are not marked."""
        got = given_to(student, self.codes, self.asked, self.given, content.get("answers", {}))
        return None if got is None else got / max(1, sum(question.points for question in self.asked))


def answers(found: Class, book: Book) -> dict[str, dict[str, str]]:
    """By student, what each question got."""
    grades = {student: book.grade_of(student) for student in found.handed}
    return {student: dict(content.get("answers", {})) for student, content in grades.items() if content}


def marks(found: Class, marker: Marker) -> list[Mark]:
    """What every student gets."""
    known = {student.id for student in found.roster.students}
    call_late = calling_late(found.handed.values())
    return [_mark(found, student, student.id in known, marker, call_late) for student in found.students]


def _mark(found: Class, student: Student, on_roster: bool, marker: Marker, call_late: Collection[str]) -> Mark:
    """What a student gets. call_late: the platforms that call some submission of the class late."""
    notes = [] if on_roster else ["not on the roster"]
    arrival, missing = found.handed.get(student.id), found.unusable.get(student.id)
    if arrival is None:
        if missing:
            points = None if missing.unreadable_here else 0.0
            return Mark(student, found.lab, points, notes=(*notes, f"{missing.entry}: {missing.why}"))
        return Mark(student, found.lab, None, notes=(*notes, not_there(student)))
    late, said = lateness(arrival, student, found.lab, marker.deadlines, call_late)
    notes += [*arrival.notes, *said]
    if student.id in marker.failures.said:
        return Mark(student, found.lab, None, late=late, notes=(*notes, marker.failures.said[student.id]))
    content = marker.book.grade_of(student.id)
    if content is None:
        return Mark(student, found.lab, None, late=late, notes=(*notes, "not graded yet"))
    content = marker.bank.joined(content)
    points, left = float(content["points"]), 0.0
    if "unreadable" in content:
        notes.append(str(content["unreadable"]))
    elif (share := marker.questions(student.id, content)) is None:
        left = SHARES[QUESTIONS]
    else:
        points += share * SHARES[QUESTIONS]
    if is_code_alone(content):
        notes.append(f"a Python file, which holds no written answers: {SHARES[CODE]} points at most")
    return Mark(student, found.lab, points, left, late, content, tuple(notes))


def shared_mistakes(every: Sequence[Mark], marker: Marker, waiting: Sequence[Entry]) -> list[Cluster]:
    """The mistakes without a name that several students share. waiting: what is still to be named from the last run."""
    contents = {mark.student.id: mark.content for mark in every if mark.content is not None}
    return clusters(contents, marker.book.code_of, waiting, [entry.id for entry in marker.bank.entries])


def write_pages(
    book: Book, found: Class, every: Sequence[Mark], marker: Marker, shared: Sequence[Cluster],
    done: Callable[[], None] = lambda: None,
) -> Path:  # fmt: skip
    """Write a page for each student who handed something in, and that of the class, and say where the latter is.

    shared: the mistakes without a name; a page of their own, for instructors, has what is not for the class. done: is
    called when the page of another student is written.
    """
    measured, ran = {}, []
    for mark in every:
        place, code = book.place(mark.student.id), marker.codes(mark.student.id)
        if mark.content is not None:
            given = {key: points for (key, each), points in marker.given.items() if each == code}
            runs = book.runs_of(mark.student.id) or []
            try:
                page = student_page(mark, marker.asked, given, compared(runs, found.lab), marker.deadlines)
            except Exception as error:  # the pages of the others do not depend on it
                marker.failures.without_page[mark.student.id] = cause_of(error)
            else:
                write_private(place / FEEDBACK, page)
            measured[code] = book.seconds(mark.student.id)
            ran.append(runs)
        done()
    of_class = book.folder / CLASS
    write_private(of_class, class_page(found.lab, every, measured, spreads(ran, found.lab), shared))
    write_private(book.folder / naming.PAGE, clusters_page(found.lab, shared))
    return of_class


def write_tables(folder: Path, found: Class, every: Sequence[Mark], to: Target | None) -> list[Path]:
    """Write the marks in each form, and say where: last the file for the platform, if there is a column for them."""
    texts = {MARKS: plain_table(every), "grades.xml": junit(every)}
    if to is not None:
        texts[f"{to.platform.lower()}.csv"] = filled(found.roster, every, to)
    for name, text in texts.items():
        write_private(folder / name, text)
    return [folder / name for name in texts]
