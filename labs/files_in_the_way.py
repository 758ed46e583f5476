"""Finds files of the student that Python takes for something else of the same name, such as a `numpy.py` of their own.

In a notebook Python looks for every module in the notebook's own folder first.
"""

from __future__ import annotations

import sys
from importlib.machinery import PathFinder
from pathlib import Path

_NEEDED = frozenset((
    "numpy", "matplotlib", "reference", "rich", "platformdirs", "pytest", "hypothesis", "IPython", "ipywidgets",
    "mujoco", "pybullet", "dartpy",
))  # fmt: skip
"""Packages that the lab imports, its own and others."""


def files_in_the_way(folder: Path) -> list[str]:
    """The names of the files in a folder that are imported in the place of what Python or the lab needs."""
    known = (_NEEDED | sys.stdlib_module_names) - frozenset(sys.builtin_module_names)
    files = [file for file in sorted(folder.glob("*.py")) if file.stem in known]
    return [file.name for file in files if _origin(file.stem) == file.resolve()]


def warning(folder: Path) -> str:
    """What to do about the files of a folder that are in the way; empty if none is."""
    names = files_in_the_way(folder)
    if not names:
        return ""
    one = len(names) == 1
    taken = "is in the way: Python takes it for its own" if one else "are in the way: Python takes them for its own"
    return f"{', '.join(names)} in this folder {taken}. Rename {'it' if one else 'them'} and restart the kernel."


def _origin(name: str) -> Path | None:
    """The file that a module was loaded from, or would be."""
    loaded = sys.modules.get(name)
    spec = loaded.__spec__ if loaded else PathFinder.find_spec(name)
    return Path(spec.origin).resolve() if spec and spec.origin else None
