"""Options that name a file to write: refused early if it cannot be written, and written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

from reference.errors import InvalidInput


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
        try:
            with tempfile.TemporaryFile(dir=file.parent):
                pass
            if file.is_dir():
                raise IsADirectoryError(None, "Is a directory")
        except OSError as error:
            raise self._unwritable(file, error) from None

    def write(self, file: Path, content: bytes) -> None:
        """Write the whole file, or nothing."""
        unfinished = file.with_name(f".unfinished-{file.name}")
        try:
            unfinished.write_bytes(content)
            os.replace(unfinished, file)
        except OSError as error:
            unfinished.unlink(missing_ok=True)
            raise self._unwritable(file, error) from None

    def _unwritable(self, file: Path, error: OSError) -> InvalidInput:
        reason = f"{error.strerror}; choose another {self.name}"
        return InvalidInput(f"cannot write the {self.content} to {str(file)!r}: {reason}")


PLOT = FileOption("--plot", (".svg", ".png", ".pdf"), "picture that can be drawn", "plot")
PAGE = FileOption("--html", (".html", ".htm"), "page", "replay")
