"""Files that are given away: as an archive or as a folder, the same bytes whenever the same files are written."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Collection, Mapping
from pathlib import Path

from reference.writable import write_whole

_DATE = (1980, 1, 1, 0, 0, 0)
"""The date of all files in an archive, so that the same files make the same bytes on every day."""


def pack(out: Path, files: Mapping[str, bytes], executable: Collection[str] = ()) -> None:
    """Write a whole archive of files, by their names in it, or none. executable: those that can be run."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in sorted(files.items()):
            entry = zipfile.ZipInfo(name, _DATE)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, _mode(name, executable) << 16
            archive.writestr(entry, content)
    write_whole(out, packed.getvalue())


def lay_out(folder: Path, files: Mapping[str, bytes], executable: Collection[str] = ()) -> None:
    """Write files into a folder, by their names in it. executable: those that can be run."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        path.chmod(_mode(name, executable))


def files_below(folder: Path) -> dict[str, bytes]:
    """The files of a folder, by their names in it."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def _mode(name: str, executable: Collection[str]) -> int:
    return 0o755 if name in executable else 0o644
