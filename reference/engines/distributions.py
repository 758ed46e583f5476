"""Which installed distribution an engine's module comes from, and this project's version. PyBullet has two of them."""

from __future__ import annotations

import base64
import functools
import hashlib
import importlib.metadata
import tomllib
from collections.abc import Sequence
from importlib.metadata import Distribution, PackagePath
from pathlib import Path

_BINARIES = ".so", ".pyd"
_PROJECT = "collisions-lab"
_TREE = Path(__file__).parents[2]


def installed(names: Sequence[str], module: str) -> Distribution | None:
    """The distribution among these that is installed, in this order; None where none is.

    Where several are, they have written the same file, and the last one's is there: the one whose hash it has.
    """
    found = [each for name in names if (each := _known(name)) is not None]
    if len(found) > 1:
        found.sort(key=lambda each: not any(_is_there(file) for file in _binaries(each, module)))
    return found[0] if found else None


def lab_version() -> str:
    """The version of this project: what its tree says, unpacked as on Colab or in place; else what is installed."""
    if (says := _of_tree(_TREE)) is not None:
        return says
    found = _known(_PROJECT)
    return found.version if found else ""


@functools.cache
def _of_tree(root: Path) -> str | None:
    """The version in a tree's `pyproject.toml`; None where there is none of this project, as in a wheel."""
    try:
        project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    except (OSError, tomllib.TOMLDecodeError, KeyError):
        return None
    return str(project["version"]) if project.get("name") == _PROJECT else None


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
