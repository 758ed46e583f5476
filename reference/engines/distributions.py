"""Which installed distribution an engine's module comes from, and this project's version. PyBullet has two of them."""

from __future__ import annotations

import base64
import functools
import hashlib
import importlib.metadata
import importlib.util
import tomllib
from collections.abc import Sequence
from importlib.metadata import Distribution, PackagePath
from pathlib import Path

from packaging.requirements import Requirement

UNKNOWN = "of unknown version"
"""The version of a module that is here without a distribution that says one."""
_BINARIES = ".so", ".pyd"
_PROJECT = "collisions-lab"
_TREE = Path(__file__).parents[2]


def installed(names: Sequence[str], module: str) -> Distribution | None:
    """The distribution among these that is installed, in this order; else any other that says it has the module.

    Where several are, they have written the same file, and the last one's is there: the one whose hash it has. None
    where the module was put there without one, as after a build by hand.
    """
    found = [each for name in names if (each := _known(name)) is not None]
    if not found:
        others = importlib.metadata.packages_distributions().get(module, [])
        found = [each for name in others if (each := _known(name)) is not None]
    if len(found) > 1:
        found.sort(key=lambda each: not any(_is_there(file) for file in _binaries(each, module)))
    return found[0] if found else None


def is_here(module: str) -> bool:
    """Whether a module can be found, without importing it: metadata may outlive it."""
    try:
        return importlib.util.find_spec(module) is not None
    except ValueError:  # it was put into sys.modules by hand
        return True


def offered(names: Sequence[str], extra: str) -> bool:
    """Whether an extra of this project has one of these for this machine; True where the project says nothing."""
    found = _known(_PROJECT)
    every = [each for each in map(Requirement, (found and found.requires) or []) if each.name in names]
    return not every or any(each.marker is None or each.marker.evaluate({"extra": extra}) for each in every)


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
        content = Path(path).read_bytes() if Path(path).is_file() else b""  # a pipe would never end
    except OSError:
        return ""
    return base64.urlsafe_b64encode(hashlib.new(mode, content).digest()).rstrip(b"=").decode()
