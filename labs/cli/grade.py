"""`collisions grade`: a folder of submissions, graded with all tests into a folder of marks."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from labs.cli import ending
from labs.cli.console import errors, output
from labs.gradebook import protection, written
from labs.gradebook.book import STUDENTS, WORKING, Book
from labs.gradebook.class_grading import (
    MARKS,
    Marker,
    answers,
    marks,
    shared_mistakes,
    write_pages,
    write_tables,
)
from labs.gradebook.class_list import Class, read_class, tasks
from labs.gradebook.class_run import Failures, run
from labs.gradebook.deadlines import Deadlines, read_deadlines
from labs.gradebook.for_a_person import left_to_do
from labs.gradebook.grading import Graded, Task, refuse_other_versions, versions
from labs.gradebook.mistakes import naming
from labs.gradebook.mistakes.course_bank import COURSE_BANK, read_bank
from labs.gradebook.roster import Roster, read_roster
from labs.gradebook.upload import target
from labs.grading.budget import SECONDS
from labs.grading.safe_text import one_line
from labs.grading.worker.sandbox import Sealing
from labs.workers import Workers, here, on_cluster
from reference import lecture
from reference.errors import CannotWrite, InvalidInput
from reference.writable import folder_for, refused_in_words

MOST_LINES = 5
"""So many lines of one kind are printed: a person has to read them."""
MOST_LETTERS = 500
"""Of one line."""


def grade(
    folder: Annotated[
        Path, typer.Argument(metavar="FOLDER", help="What the platform's archive unpacks to.", show_default=False)
    ],
    lab: Annotated[str, typer.Option(metavar="LAB", help="Which lab.", show_default=False)],
    out: Annotated[Path, typer.Option(metavar="DIR", help="The folder of the grades.")] = Path("grades"),
    roster: Annotated[
        Path | None,
        typer.Option(metavar="CSV", help="Who is in the course: Canvas' or Moodle's file, or one of your own."),
    ] = None,
    column: Annotated[
        str,
        typer.Option(
            metavar="TITLE", help="The column of Canvas' gradebook, such as 'Lab 5 (88121)' or 88121; none for no file."
        ),
    ] = "",
    rules: Annotated[
        Path | None,
        typer.Option(metavar="TOML", help="Deadlines, what a late submission loses, and whom to ask about a mark."),
    ] = None,
    bank: Annotated[
        Path, typer.Option(metavar="DIR", help="The course's own bank: mistakes that you have named.")
    ] = COURSE_BANK,
    release: Annotated[
        str, typer.Option(metavar="NAME", help="What you call the release, to be kept with grades.")
    ] = "",
    seconds: Annotated[
        float, typer.Option(metavar="S", min=1e-3, max=1e6, help="How long each submission may compute and sleep.")
    ] = SECONDS,
    runs: Annotated[
        bool,
        typer.Option(help="Also run everybody's functions in the scenarios of the lab, beside the recorded engines."),
    ] = True,
    unsandboxed: Annotated[
        bool,
        typer.Option(
            protection.SWITCH, help="Grade even where a submission can read and write the files of this machine."
        ),
    ] = False,
    workers: Annotated[
        int | None, typer.Option("--jobs", "-j", min=1, help="Submissions at a time; by default one per processor.")
    ] = None,
    cluster: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Grade on a Dask cluster: tcp://host:8786, or local:4 to start one here."),
    ] = None,
) -> None:
    """Grade a class. A run that was stopped continues where it was; only what has changed is graded again.

    For example:  collisions grade submissions --lab impulse --roster canvas.csv --out grades
    """
    topic = lecture.topic(lab).name
    listed = read_roster(roster) if roster else Roster(())
    to = target(listed, topic, column)
    found = read_class(folder, topic, listed if roster else None)
    deadlines = read_deadlines(rules) if rules else Deadlines()
    nobody = _deadlines_of_nobody(deadlines, found)
    if nobody and roster:
        raise InvalidInput(nobody)
    if not (unsandboxed or cluster):
        protection.refuse_open_files(protection.offered(), folder, topic, out)
    failures, book = Failures(), Book(out)
    people = {*book.everybody(), *(student.id for student in found.students)}
    # What is wrong with a file of the instructor's is said before anything is graded.
    read_bank(bank), naming.read_waiting(out), written.read_tables(out, topic, people)
    machines = on_cluster(cluster) if cluster else here(workers or os.cpu_count() or 1, out / WORKING)
    home = folder_for("the grades", out, "--out", private=True)
    with _resumable(book, found), home, book.alone(), machines as graders:
        if cluster and not unsandboxed:
            protection.refuse_open_files(_offered_by(graders), folder, topic, out)
        gone = book.withdraw_others(found.handed, topic)
        every_task = tasks(found, release, seconds, runs, failures, unsandboxed)
        _grade_all(book, found, every_task, graders, failures)
        code_alone = sum(map(written.is_code_alone, map(book.grade_of, found.handed)))
        written.write_questions(out, topic, answers(found, book), code_alone)
        first, second = (table.given for table in written.read_tables(out, topic, people))
        with refused_in_words("the course's bank", bank, "--bank"):
            names, waiting, notes = naming.name_filled_in(out, read_bank(bank))
        marker = Marker(book, deadlines, failures, written.Codes(out), written.questions(topic), first, names)
        every = marks(found, marker)
        shared = shared_mistakes(every, marker, waiting)
        naming.write_waiting(out, shared, waiting, names)
        tables = write_tables(out, found, every, to)
        with _progress("Writing pages", len(every)) as advance:
            page = write_pages(book, found, every, marker, shared, advance)
    graded = sum(mark.content is not None for mark in every)
    count = "1 submission is" if graded == 1 else f"{graded} submissions are"
    _say(f"{count} graded, {len(failures.said)} could not be graded.")
    if said := protection.in_words(mark.content for mark in every if mark.content is not None):
        _say(said)
    _say_all([f"The grade of {student} is put away: nothing is handed in any more." for student in gone])
    _say_all([*notes, *names.notes(topic)])
    unused = written.marked_for_nobody(first, marker.codes, found.handed)
    todo = [*left_to_do(out, found, every, failures, shared), *filter(None, [unused, nobody])]
    _say("For a person to do:" if todo else "Nothing is left for a person to do.")
    for number, line in enumerate(todo, 1):
        _say(f"{number}. {one_line(line, MOST_LETTERS)}")
    if said := written.agreement(first, second):
        _say(said)
    _say(one_line(f"To upload: {tables[-1]}, {to.said}." if to else f"Marks: {out / MARKS}.", MOST_LETTERS))
    _say(f"If you are curious: {page} is about the class, and {out / STUDENTS} has a page for each student.")
    raise typer.Exit(ending.code_of(bool(failures.said)))


def _offered_by(graders: Workers) -> Sealing:
    """How far the workers of a cluster shut submissions in, as the first that answers says."""
    with graders.pool() as pool:
        return pool.submit(protection.offered).result()


def _deadlines_of_nobody(deadlines: Deadlines, found: Class) -> str:
    """That the rules name somebody whom nobody knows; empty if they do not."""
    who = deadlines.without_student(found.students)
    said = f"The rules give a deadline to {who}, but no student has this number; it is the course's own:"
    said += " SIS User ID in Canvas' file, ID number in Moodle's, student_id in yours."
    return said if who else ""


def _say_all(lines: Sequence[str]) -> None:
    for line in lines[:MOST_LINES]:
        _say(one_line(line))
    if len(lines) > MOST_LINES:
        _say(f"And {len(lines) - MOST_LINES} others like this one.")


@contextmanager
def _resumable(book: Book, found: Class) -> Iterator[None]:
    """Say after an interrupt, and where a file cannot be written, what is kept and how to continue."""
    try:
        yield
    except (KeyboardInterrupt, CannotWrite, OSError) as error:
        kept = sum(book.grade_of(student) is not None for student in found.handed)
        error.add_note(
            f"{kept} of {len(found.handed)} submissions have a grade, and all of these are kept. Run the same command"
            " again: it continues with the others, and then writes marks and pages."
        )
        raise


def _say(line: str) -> None:
    output.print(line, markup=False, soft_wrap=True)


def _grade_all(book: Book, found: Class, every: Iterator[Task], graders: Workers, failures: Failures) -> None:
    expected = versions(found.lab)
    with _progress("Grading", len(found.handed)) as advance:

        def todo() -> Iterator[Task]:
            for task in every:
                if book.is_done(task):
                    advance()
                else:
                    yield task

        def keep(graded: Graded) -> None:
            refuse_other_versions(expected, graded.content["identity"]["versions"], found.lab)
            book.keep(graded)
            advance()

        run(todo(), graders, keep, failures, lambda: errors.print("Stopping; what is being written is finished …"))


@contextmanager
def _progress(what: str, total: int) -> Iterator[Callable[[], None]]:
    """A bar with a name; what is yielded moves it on by one."""
    columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=errors, transient=True) as progress:
        bar = progress.add_task("", total=total)
        yield lambda: progress.advance(bar)
