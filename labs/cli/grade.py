"""`collisions grade`: a folder of submissions, graded with all tests into a folder of marks."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from labs.cli.console import errors, output
from labs.gradebook import written
from labs.gradebook.book import STUDENTS, WORKING, Book, Failures, run
from labs.gradebook.class_grading import (
    Class,
    Marker,
    answers,
    marks,
    read_class,
    shared_mistakes,
    tasks,
    write_pages,
    write_tables,
)
from labs.gradebook.deadlines import Deadlines, read_deadlines
from labs.gradebook.grading import Graded, Task, refuse_other_versions, versions
from labs.gradebook.mistakes import naming
from labs.gradebook.mistakes.course_bank import COURSE_BANK, read_bank
from labs.gradebook.roster import read_roster
from labs.grading.budget import SECONDS
from labs.grading.safe_text import one_line
from labs.workers import Workers, here, on_cluster
from reference import lecture
from reference.writable import folder_for, refused_in_words

FAILED = 1


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
    rules: Annotated[
        Path | None, typer.Option(metavar="TOML", help="Deadlines, and what a late submission loses.")
    ] = None,
    bank: Annotated[
        Path, typer.Option(metavar="DIR", help="The course's own bank: mistakes that you have named.")
    ] = COURSE_BANK,
    release: Annotated[
        str, typer.Option(metavar="NAME", help="What you call the release, to be kept with grades.")
    ] = "",
    seconds: Annotated[
        float, typer.Option(metavar="S", help="How long each submission may compute and sleep.")
    ] = SECONDS,
    runs: Annotated[
        bool,
        typer.Option(help="Also run everybody's functions in the scenarios of the lab, beside the recorded engines."),
    ] = True,
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
    found = read_class(folder, topic, read_roster(roster) if roster else None)
    deadlines = read_deadlines(rules) if rules else Deadlines()
    failures, book = Failures(), Book(out)
    read_bank(bank), naming.read_waiting(out)  # what is wrong with them is said before anything is graded
    machines = on_cluster(cluster) if cluster else here(workers or os.cpu_count() or 1, out / WORKING)
    with _resumable(book, found), folder_for("the grades", out, "--out"), book.alone(), machines as graders:
        gone = book.withdraw_others(found.handed, topic)
        _grade_all(book, found, tasks(found, release, seconds, runs), graders, failures)
        written.write_questions(out, topic, answers(found, book))
        asked, place = written.questions(topic), out / written.FOLDER
        first, second = (written.read_points(place / name, asked) for name in (written.POINTS, written.SECOND))
        with refused_in_words("the course's bank", bank, "--bank"):
            names, waiting, notes = naming.name_filled_in(out, read_bank(bank))
        marker = Marker(book, deadlines, failures, written.Codes(out), asked, first, names)
        every = marks(found, marker)
        shared = shared_mistakes(every, marker, waiting)
        naming.write_waiting(out, shared, waiting, names)
        tables, page = write_tables(out, found, every), write_pages(book, found, every, marker, shared)
    graded = sum(mark.content is not None for mark in every)
    _say(f"{graded} submissions are graded, {len(failures.said)} could not be graded.")
    if busy := len(failures.busy):
        them = "One submission was" if busy == 1 else f"{busy} submissions were"
        _say(
            f"{them} not graded for lack of time, because this machine was too busy with other programs. No points are"
            " lost: run the same command again when it is idle."
        )
    for student in gone:
        _say(f"The grade of {one_line(student)} is put away: nothing is handed in any more.")
    for mark in every:
        if mark.notes:
            _say(one_line(f"{mark.student.id}: {'; '.join(mark.notes)}"))
    for note in (*notes, *names.notes(topic)):
        _say(one_line(note))
    if shared:
        several = f"{len(shared)} mistakes" if len(shared) > 1 else "One mistake"
        _say(f"{several} without a name: see {out / naming.PAGE}, and write a name into {out / naming.FILE}.")
    if left := sum(mark.open > 0 for mark in every):
        _say(f"The written questions of {left} are to be marked: fill in {place / written.POINTS} and run this again.")
    if said := written.agreement(first, second):
        _say(said)
    _say(f"Marks: {', '.join(str(path) for path in tables)}")
    _say(f"The class: {page}; each student's page is in {out / STUDENTS}.")
    raise typer.Exit(FAILED if failures.said else 0)


@contextmanager
def _resumable(book: Book, found: Class) -> Iterator[None]:
    """Say after Ctrl-C what is kept, and how to continue."""
    try:
        yield
    except KeyboardInterrupt:
        kept = sum(book.grade_of(student) is not None for student in found.handed)
        _say(
            f"Stopped. {kept} of {len(found.handed)} submissions have a grade, and all of these are kept. Run the same"
            " command again: it continues with the others, and then writes marks and pages."
        )
        raise


def _say(line: str) -> None:
    output.print(line, markup=False, soft_wrap=True)


def _grade_all(book: Book, found: Class, every: Iterator[Task], graders: Workers, failures: Failures) -> None:
    expected = versions(found.lab)
    columns = (TextColumn("Grading"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=errors, transient=True) as progress:
        bar = progress.add_task("", total=len(found.handed))

        def todo() -> Iterator[Task]:
            for task in every:
                if book.is_done(task):
                    progress.advance(bar)
                else:
                    yield task

        def keep(graded: Graded) -> None:
            refuse_other_versions(expected, graded.content["identity"]["versions"], found.lab)
            book.keep(graded)
            progress.advance(bar)

        run(todo(), graders, keep, failures, lambda: errors.print("Stopping; what is being written is finished …"))
