"""The program `collisions`, run within the test's own process."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from typer.testing import CliRunner

from labs.cli import app

QUICK = ("ball-to-rest/e=0.5", "--engine", "handwritten")
"""Arguments for one case by hand in its three profiles, none of which takes long."""
EXACT = (*QUICK, "--profile", "exact")
SLIDE = "sliding-slab/μ=0.7,v=1"
"""The case with the quickest report: its studies of error against timestep take a fraction of a second."""
EVERYTHING = "".join(
    f"from solutions.{topic} import *\n" for topic in ("detection", "response", "forces", "friction", "impulse")
)
"""The solutions as homework, to which a test adds what is wrong or missing."""


@dataclass(frozen=True)
class Said:
    """What the program ended with and printed; `text` and `error` with their line breaks made spaces."""

    code: int
    output: str
    errors: str

    @property
    def text(self) -> str:
        return " ".join(self.output.split())

    @property
    def lines(self) -> list[str]:
        return [line.rstrip() for line in self.output.splitlines()]

    @property
    def error(self) -> str:
        return " ".join(re.sub("[│╭╮╰╯─]", " ", self.errors).split())


def collisions(*arguments: str | Path) -> Said:
    """Run the program within this process."""
    ended = CliRunner().invoke(app, list(map(str, arguments)))
    assert ended.exception is None or isinstance(ended.exception, SystemExit), ended.exception
    return Said(ended.exit_code, ended.stdout, ended.stderr)


def files_in(folder: Path) -> dict[str, bytes]:
    """The content of every file below a folder."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
