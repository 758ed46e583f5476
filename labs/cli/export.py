"""`collisions export`: the autograder of a lab for another platform, or marks for nbgrader's gradebook."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from labs.building import lessons
from labs.building.archives import lay_out, pack
from labs.cli.console import output
from labs.gradebook.mistakes.course_bank import COURSE_BANK, read_bank
from labs.gradebook.platforms import bundles
from labs.gradebook.platforms.bundles import IMAGE, Bundle
from labs.grading.judging import pytest_run
from labs.grading.judging.grade import write_private
from reference import lecture
from reference.errors import InvalidInput, UnknownName
from reference.writable import check_file, new_folder_for, refused_in_words

PLATFORMS = ("gradescope", "classroom50", "nbgrader", "prairielearn")
_CONTENT, _OPTION = "the export", "--out"


def export(
    platform: Annotated[
        str, typer.Argument(metavar="PLATFORM", help=f"Which one: {', '.join(PLATFORMS)}.", show_default=False)
    ],
    lab: Annotated[str, typer.Option(metavar="LAB", help="Which lab.", show_default=False)],
    out: Annotated[
        Path,
        typer.Option(
            metavar="PATH", help="A file that ends in .zip for gradescope, a new folder for others.", show_default=False
        ),
    ],
    grades: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="For nbgrader: the folder that collisions grade has written.", show_default=False
        ),
    ] = None,
    bank: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="For nbgrader: the course's own bank, course-bank if you name none.", show_default=False
        ),
    ] = None,
    image: Annotated[
        str | None,
        typer.Option(metavar="NAME", help=f"For prairielearn: the image to grade in, {IMAGE} if you name none."),
    ] = None,
) -> None:
    """Write what another platform needs to grade a lab with our tests, or to show our marks.

    For example:  collisions export gradescope --lab impulse --out gradescope.zip
    """
    if platform not in PLATFORMS:
        raise UnknownName("platform", platform, PLATFORMS)
    _only_for("--grades", grades, platform, "nbgrader")
    _only_for("--bank", bank, platform, "nbgrader")
    _only_for("--image", image, platform, "prairielearn")
    name = lecture.topic(lab).name
    if name not in (ready := [each for each in pytest_run.tested() if each in lessons.lessons()]):
        raise InvalidInput(f"{name} cannot be graded yet; choose one of {', '.join(ready)}")
    if platform == "gradescope":
        _archive(out, name)
    elif platform == "classroom50":
        _folder(out, lambda: bundles.classroom50(name))
    elif platform == "prairielearn":
        _folder(out, lambda: bundles.prairielearn(name, image or IMAGE))
    elif grades is not None:
        _folder(out, lambda: bundles.nbgrader(grades, name, read_bank(bank or COURSE_BANK)), private=True)
    else:
        raise InvalidInput("nbgrader takes marks: name the folder that collisions grade has written with --grades")
    output.print(f"{out} is what {platform} needs for the lab {name}.", soft_wrap=True, markup=False)


def _only_for(option: str, value: object, platform: str, wanted: str) -> None:
    if value is not None and platform != wanted:
        raise InvalidInput(f"{option} is for {wanted} alone, not for {platform}")


def _archive(out: Path, lab: str) -> None:
    if out.suffix.lower() != ".zip":
        raise InvalidInput(f"{_OPTION} {str(out)!r} is no archive; for gradescope it ends in .zip")
    check_file(_CONTENT, out, _OPTION)
    bundle = bundles.gradescope(lab)
    with refused_in_words(_CONTENT, out, _OPTION):
        pack(out, bundle.files, bundle.executable)


def _folder(out: Path, made: Callable[[], Bundle], private: bool = False) -> None:
    """Write a bundle into a new folder. private: it has marks of students, which nobody else may read."""
    with new_folder_for(_CONTENT, out, _OPTION):
        bundle = made()
        if private:
            out.chmod(0o700)
            for name, content in bundle.files.items():
                write_private(out / name, content.decode("utf-8"))
        else:
            lay_out(out, bundle.files, bundle.executable)
