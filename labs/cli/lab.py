"""`collisions lab`: the notebooks, built from lessons and solutions, and the tree that is given to students."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from labs.assessment import oral as oral_kit
from labs.assessment.seeded import in_words
from labs.assessment.shares import SHARES
from labs.building import course_page, guidance_gaps, instructor_page, lessons, marking, notebooks, seeded_questions
from labs.building.release import release as write_release
from labs.cli import ending
from labs.cli.console import errors, output
from labs.project_folders import COURSE_PAGE, INSTRUCTOR_PAGES, ROOT, SOLVED_NOTEBOOKS, STUDENT_NOTEBOOKS
from reference import lecture
from reference.errors import InvalidInput
from reference.writable import write_whole

app = typer.Typer(
    add_completion=False, no_args_is_help=True, help="Build the course notebooks, and the tree that students get."
)


@app.command("build")
def build(
    topic: Annotated[
        list[str] | None, typer.Argument(help="Which labs; all that have a lesson if you name none.")
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; fail if a notebook is not what would be written.")
    ] = False,
) -> None:
    """Build a student's notebook, a solved one and an instructor's page from each lesson, and the page of the course.

    For example:  collisions lab build detection
    """
    topics = [lecture.topic(name).name for name in topic or lessons.lessons()]
    if not topics:
        raise InvalidInput("there are no lessons: labs/lessons is empty")
    for gap in (gap for name in topics for gap in guidance_gaps.gaps(name)):
        errors.print(f"still to do: {gap}", markup=False, soft_wrap=True)
    made: dict[Path, str] = {}
    for name in topics:
        made |= {
            STUDENT_NOTEBOOKS / f"{name}.ipynb": notebooks.text(notebooks.student(name)),
            SOLVED_NOTEBOOKS / f"{name}.ipynb": notebooks.text(notebooks.solved(name)),
            INSTRUCTOR_PAGES / f"{name}.md": instructor_page.page(name),
        }
    made[COURSE_PAGE] = course_page.page()
    stale = [path for path, text in made.items() if not _is(path, text)]
    for path in stale if not check else ():
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, made[path].encode())
    shown = [path.relative_to(ROOT).as_posix() for path in stale]
    if check and stale:
        errors.print(
            f"Differs from what its lesson and solutions produce: {', '.join(shown)}. Run: collisions lab build"
        )
        raise typer.Exit(ending.NOT_RIGHT)
    output.print("\n".join(f"wrote {name}" for name in shown) or f"{', '.join(topics)}: up to date.")


@app.command("release")
def release(
    out: Annotated[
        Path, typer.Option(metavar="DIR", help="A new folder, or a file whose name ends in .zip.", show_default=False)
    ],
    through: Annotated[
        str | None,
        typer.Option(metavar="LAB", help="The last lab in it; those before it are closed.", show_default=False),
    ] = None,
    only: Annotated[
        list[str] | None,
        typer.Option(
            metavar="LAB",
            help="One lab, with what its runs need; repeat for several. All by default.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Write what a student gets: notebooks, engines' recordings, visible tests; answers of closed labs alone.

    For example:  collisions lab release --out collisions-lab.zip --only detection --only impulse --through detection
    """
    labs = write_release(out, through, only or ())
    output.print(f"{out} holds the labs {', '.join(labs)}.", soft_wrap=True, markup=False)


@app.command("marks")
def marks(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A student's notebook.", show_default=False)],
    topic: Annotated[str, typer.Option("--lab", metavar="LAB", help="Which lab.", show_default=False)],
    questions: Annotated[
        float | None,
        typer.Option(metavar="POINTS", help="What you gave for the written questions.", show_default=False),
    ] = None,
) -> None:
    """Say what a notebook reached in each kind of work, as points of a hundred.

    For example:  collisions lab marks ada.ipynb --lab impulse --questions 14
    """
    found = marking.marked(file, topic, questions)
    for kind, count in found.counts.items():
        points = found.points(kind)
        reached = "to be marked by you" if count.reached is None else f"{count.reached:g} of {count.possible:g}"
        given = "" if points is None else f"{points:.1f}"
        output.print(f"{kind:18} {reached:>20} {given:>6} of {SHARES[kind]}", markup=False)
    missing = f", and {found.open} to be given for the written questions (--questions)" if found.open else ""
    output.print(f"{found.total:.1f} of 100{missing}", markup=False)


@app.command("numbers")
def numbers(
    topic: Annotated[str, typer.Argument(metavar="LAB", help="Which lab.", show_default=False)],
    student: Annotated[
        list[str],
        typer.Option(metavar="NAME", help="A student's name or number; repeat for several.", show_default=False),
    ],
) -> None:
    """Print the numbers that students have in the questions of a lab, and what follows from them.

    For example:  collisions lab numbers impulse --student 1234
    """
    for name in student:
        for question in seeded_questions.questions(lecture.topic(topic).name, name):
            results = "; ".join(f"{key} = {value:.4g}" for key, value in question.results.items())
            said = f"{name}, {question.key}: {in_words(question.numbers)}" + f"; {results}" * bool(results)
            output.print(said, markup=False, soft_wrap=True)


@app.command("oral")
def oral(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A student's notebook.", show_default=False)],
    topic: Annotated[str, typer.Option("--lab", metavar="LAB", help="Which lab.", show_default=False)],
) -> None:
    """Make three oral questions from a student's own functions, each with what a good answer holds.

    For example:  collisions lab oral ada.ipynb --lab impulse
    """
    name = lecture.topic(topic).name
    output.print(oral_kit.text(oral_kit.kit(file, name), file.name), markup=False, soft_wrap=True)


def _is(path: Path, text: str) -> bool:
    return path.is_file() and path.read_text(encoding="utf-8") == text
