"""Options that name a file to write: refused early if it cannot be written, and written whole or not at all."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from reference.errors import InvalidInput
from reference.writable import check_file, refused_in_words, write_whole


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
        with refused_in_words(self.content, file, self.name):
            write_whole(file, content)


PLOT = FileOption("--plot", (".svg", ".png", ".pdf"), "picture that can be drawn", "the plot")
PAGE = FileOption("--html", (".html", ".htm"), "page", "the replay")
