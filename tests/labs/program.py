"""The program `collisions`, run within the test's own process."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from typer.testing import CliRunner

from labs.cli import app


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
