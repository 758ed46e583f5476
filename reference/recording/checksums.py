"""Checksums of recordings: one line for each file, so that a number that somebody changed later is noticed.

The lines are in `checksums.txt`, beside the folders of the engines, as the program `sha256sum` writes them. In that
folder `sha256sum --check checksums.txt` therefore gives the same answer as this module. `collisions record` writes the
lines of the files that it makes, and leaves the others as they are.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

from reference.errors import InvalidInput
from reference.writable import write_whole

CHECKSUMS = "checksums.txt"
_BETWEEN = "  "
"""What `sha256sum` writes between a checksum and the name of its file."""


def check(path: Path) -> None:
    """Refuse a recording, `FOLDER/ENGINE/FILE`, that is not as it was written. A file that does not exist passes.

    Raises
    ------
    InvalidInput
        If the bytes of the file have another checksum, or if no checksum of it was kept.
    """
    folder = path.parents[1]
    if why := _why_refused(path, kept(folder).get(_name(path, folder), "")):
        raise InvalidInput(f"the recording {str(path)!r} {why}")


def kept(folder: Path) -> dict[str, str]:
    """The checksums that a folder of recordings keeps, by the name of the file, as in `mujoco/cradle.json`."""
    path = folder / CHECKSUMS
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    parts = [line.partition(_BETWEEN) for line in lines]
    return {name: checksum for checksum, _, name in parts}


def changed(folder: Path) -> dict[str, str]:
    """What is wrong with the files of a folder of recordings, by name; empty where every file is as it was written."""
    known = kept(folder)
    found = {_name(path, folder): path for path in folder.glob("*/*") if path.is_file()}
    wrong = {name: _why_refused(path, known.get(name, "")) for name, path in sorted(found.items())}
    missing = {name: "is missing" for name in known if name not in found}
    return {name: why for name, why in wrong.items() if why} | missing


def renew(folder: Path, written: Iterable[Path]) -> None:
    """Keep the checksums of files that have just been written, and drop those of files that are no longer there.

    Where no file was written nothing is kept or dropped.
    """
    new = {_name(path, folder): _checksum(path) for path in written}
    if not new:
        return
    known = kept(folder) | new
    lines = [f"{known[name]}{_BETWEEN}{name}\n" for name in sorted(known) if (folder / name).exists()]
    write_whole(folder / CHECKSUMS, "".join(lines).encode())  # bytes: lines end in the same way on every system


def over_all(folder: Path) -> str:
    """One checksum over all recordings of a folder: that of `checksums.txt` itself."""
    return _checksum(folder / CHECKSUMS)


def _why_refused(path: Path, known: str) -> str:
    again = f"restore it, or make a new one: {_command(path)}"
    if not path.exists():
        return ""
    if not known:
        return f"has no checksum in {CHECKSUMS}; {again}"
    return "" if known == _checksum(path) else f"was changed since it was made; {again}"


def _command(path: Path) -> str:
    wish = "--published" if path.stem == "published" else path.stem
    return f"collisions record {wish} --engine {path.parent.name}"


def _checksum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _name(path: Path, folder: Path) -> str:
    return path.relative_to(folder).as_posix()
