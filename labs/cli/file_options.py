"""Options that name a file to write: refused early if it cannot be written, and written whole or not at all."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from reference.errors import InvalidInput
from reference.writable import check_file, refused_in_words


@dataclass(frozen=True)
class FileOption:
    """An option that names a file. kind: what a file with one of the suffixes is. content: what is written to it."""

    name: str
    suffixes: tuple[str, ...]
    kind: str
    content: str

    def check(self, file: Path) -> None:
        """Refuse, before anything runs, a file that cannot be written."""
        if file.suffix.lower() not in self.suffixes:
            endings = ", ".join(self.suffixes)
            raise InvalidInput(f"{self.name} {str(file)!r} is no {self.kind}; it ends in {endings}")
        check_file(self.content, file, self.name)

    def write(self, file: Path, content: bytes) -> None:
        """Write the whole file, or nothing."""
        unfinished = file.with_name(f".unfinished-{file.name}")
        with refused_in_words(self.content, file, self.name):
            try:
                unfinished.write_bytes(content)
                os.replace(unfinished, file)
            finally:
                unfinished.unlink(missing_ok=True)


PLOT = FileOption("--plot", (".svg", ".png", ".pdf"), "picture that can be drawn", "the plot")
PAGE = FileOption("--html", (".html", ".htm"), "page", "the replay")
