"""`collisions lab`: the notebooks, built from lessons and solutions, and the tree that is given to students."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from labs.building import guidance_gaps, lessons, notebooks
from labs.building.release import release as write_release
from labs.cli.console import errors, output
from labs.project_folders import ROOT, SOLVED_NOTEBOOKS, STUDENT_NOTEBOOKS
from reference import lecture
from reference.errors import InvalidInput

STALE = 1

app = typer.Typer(
    add_completion=False, no_args_is_help=True, help="Build the course notebooks, and the tree that students get."
)


@app.command("build")
def build(
    topic: Annotated[
        list[str] | None, typer.Argument(help="Which labs; all that have a lesson if none is named.")
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; fail if a notebook is not what would be written.")
    ] = False,
) -> None:
    """Build a student's notebook and a solved one from each lesson.

    For example:  collisions lab build detection
    """
    topics = [lecture.topic(name).name for name in topic or lessons.lessons()]
    if not topics:
        raise InvalidInput("there are no lessons: labs/lessons is empty")
    for gap in (gap for name in topics for gap in guidance_gaps.gaps(name)):
        errors.print(f"still to do: {gap}", markup=False, soft_wrap=True)
    stale = []
    for name in topics:
        made = {STUDENT_NOTEBOOKS / f"{name}.ipynb": notebooks.student(name)}
        made[SOLVED_NOTEBOOKS / f"{name}.ipynb"] = notebooks.solved(name)
        for path, notebook in made.items():
            if _is(path, notebooks.text(notebook)):
                continue
            stale.append(path)
            if not check:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(notebooks.text(notebook), encoding="utf-8")
    shown = [path.relative_to(ROOT).as_posix() for path in stale]
    if check and stale:
        errors.print(f"Not what its lesson and solutions make now: {', '.join(shown)}. Run: collisions lab build")
        raise typer.Exit(STALE)
    output.print("\n".join(f"wrote {name}" for name in shown) or f"{', '.join(topics)}: as they should be.")


@app.command("release")
def release(
    out: Annotated[
        Path, typer.Option(metavar="DIR", help="A new folder, or a file whose name ends in .zip.", show_default=False)
    ],
    through: Annotated[
        str | None, typer.Option(metavar="LAB", help="The last lab in it; all if none is named.", show_default=False)
    ] = None,
) -> None:
    """Write what a student gets: notebooks, engines' recordings, visible tests; answers of closed labs alone.

    For example:  collisions lab release --out collisions-lab.zip --through detection
    """
    labs = write_release(out, through)
    output.print(f"{out} holds the labs {', '.join(labs)}.", soft_wrap=True, markup=False)


def _is(path: Path, text: str) -> bool:
    return path.is_file() and path.read_text(encoding="utf-8") == text
