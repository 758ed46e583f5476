"""Which installed distribution an engine's module comes from, and this project's version. PyBullet has two of them."""

from __future__ import annotations

import base64
import functools
import hashlib
import importlib.metadata
from collections.abc import Sequence
from importlib.metadata import Distribution, PackagePath
from pathlib import Path

_BINARIES = ".so", ".pyd"


def installed(names: Sequence[str], module: str) -> Distribution | None:
    """The distribution among these that is installed, in this order; None where none is.

    Where several are, they have written the same file, and the last one's is there: the one whose hash it has.
    """
    found = [each for name in names if (each := _known(name)) is not None]
    if len(found) > 1:
        found.sort(key=lambda each: not any(_is_there(file) for file in _binaries(each, module)))
    return found[0] if found else None


def lab_version() -> str:
    """The version of this project; empty where its tree was unpacked and not installed, as on Colab."""
    found = _known("collisions-lab")
    return found.version if found else ""


def _known(name: str) -> Distribution | None:
    try:
        return importlib.metadata.distribution(name)
    except importlib.metadata.PackageNotFoundError:
        return None


def _binaries(distribution: Distribution, module: str) -> list[PackagePath]:
    """The files of a distribution that are the module itself, as `pybullet.cpython-313-x86_64-linux-gnu.so` is."""
    files = distribution.files or []
    return [each for each in files if each.name.split(".")[0] == module and each.suffix in _BINARIES]


def _is_there(file: PackagePath) -> bool:
    """Whether a file still is what its distribution has installed."""
    return file.hash is not None and _digest(str(file.locate()), file.hash.mode) == file.hash.value


@functools.cache
def _digest(path: str, mode: str) -> str:
    """Of a file's content, as RECORD has it; empty if it cannot be read, or the kind of digest is not known."""
    if mode not in hashlib.algorithms_available:
        return ""
    try:
        content = Path(path).read_bytes()
    except OSError:
        return ""
    return base64.urlsafe_b64encode(hashlib.new(mode, content).digest()).rstrip(b"=").decode()
