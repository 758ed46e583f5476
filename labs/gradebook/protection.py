"""How far submissions were shut in while a class was graded, and what to do where nothing shuts them in.

Threat: on a system without a sandbox a submission runs with the rights of the person who grades. It can import the
solutions, read the hidden tests and other students' work, write files and open connections. So a class is refused
there, unless the instructor says that the machine itself is expendable, as a container is.
"""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from labs.grading.calling.remote import Grader, Remote
from labs.grading.submission.reading import Submission
from labs.grading.worker.sandbox import Sealing
from labs.grading.worker.tier import Tier
from labs.project_folders import ROOT
from reference.errors import InvalidInput

LEAST = Tier.FILES
"""The tier from which on the files of the machine are protected."""
SWITCH = "--unsandboxed"
_OPEN = {tier.title for tier in Tier if tier < LEAST}


def offered() -> Sealing:
    """How far this machine shuts submissions in."""
    with Grader() as grader, Remote(Submission("", ""), grader) as remote, remote.fresh() as call:
        assert call.sealing is not None
        return call.sealing


def refuse_open_files(sealing: Sealing, folder: Path, lab: str, out: Path) -> None:
    """Refuse to grade a class where a submission can open the files of the person who grades.

    Raises
    ------
    InvalidInput
        If this is such a machine; the message has a command that grades the same folder in a container.
    """
    if sealing.tier < LEAST:
        raise InvalidInput(
            f"this machine cannot keep submissions from your files ({'; '.join(sealing.missing)}). A submission could"
            " read the solutions, the hidden tests and other students' work, write files and open connections, so no"
            " class is graded here. Grade it in a container of Linux instead, with everything that the command reads"
            f" in the current folder:\n\n  {in_a_container(folder, lab, out)}\n\nAdd your other options within the"
            " quotes, at the end. If you trust every submission, or if this machine is a container that holds nothing"
            f" else, add {SWITCH}"
        )


def in_a_container(folder: Path, lab: str, out: Path) -> str:
    """A command that grades a folder in a container; Podman takes the same."""
    named = shlex.join(["collisions", "grade", _here(folder), "--lab", lab, "--out", _here(out)])
    installed = "pip install -q --root-user-action=ignore -c /lab/constraints.txt -e '/lab[grading]'"
    folders = f'-v "{ROOT}:/lab" -v "{Path.cwd()}:/course" -w /course'
    return f'docker run --rm -it {folders} python:3.12 sh -c "{installed} && {named}"'


def _here(path: Path) -> str:
    """A path as it is within the current folder, where it is in it."""
    whole = path.absolute()
    return (whole.relative_to(Path.cwd()) if whole.is_relative_to(Path.cwd()) else whole).as_posix()


def is_open(content: Mapping[str, Any]) -> bool:
    """Whether a grade was made where the submission could open files."""
    return content.get("tier") in _OPEN


def in_words(contents: Iterable[Mapping[str, Any]]) -> str:
    """How far the submissions of a class were shut in as they were graded, in a sentence or two; empty if none ran."""
    ran = [content for content in contents if content.get("tier")]
    tiers = Counter(str(content["tier"]) for content in ran)
    if not ran:
        return ""
    if not (unprotected := sum(map(is_open, ran))):
        return f"Every submission ran shut in: {' or '.join(sorted(tiers))}."
    return (
        f"{unprotected} of {len(ran)} submissions ran without protection of files: they could read the solutions, the"
        " hidden tests and other students' work, write files and open connections. Look at marks that surprise you."
    )
