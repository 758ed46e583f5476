"""The folder of a worker's interpreter, with a copy of the code that it runs, so that it learns no place of ours.

Threat: where files are not sealed, a submission that knows where the lab lies imports the solutions and reads hidden
tests. So the worker begins in a folder beside copies, and neither its arguments nor its environment,
modules, frames or tracebacks name another place. A submission can still search the disk: this hides, and seals nothing.
A submission can also change the copies, so each submission gets copies of its own.
"""

from __future__ import annotations

import compileall
import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import labs.grading.worker
from labs.grading.worker.folders import remove
from labs.project_folders import AUTOGRADER, ROOT

OPTIONS = ("-I", "-S", "-B", "-X", "utf8", "-c")
"""Of a worker's interpreter: nothing of the user's settings, and no packages but those that it is told of."""
PACKAGES = str(Path(np.__file__).parents[1])
"""Where NumPy lies."""
CODE = "code"
"""The name of the folder with the copies. No submission runs in it, so that none of its files is taken for a module."""
_PREFIX = "grading-apart-"
_PACKAGE = Path(*labs.grading.worker.__name__.split("."))
_NUMPY = Path(np.__file__).parent
_BESIDE_NUMPY = (f"{_NUMPY.name}.libs", f"{_NUMPY.name}.dylibs")
"""Folders of libraries that NumPy's own modules look for beside it, under the names that its wheels give them."""
_UNUSED = shutil.ignore_patterns("tests", "f2py", "distutils", "include", "*.pyi", "*.a", "_pyinstaller")


def lay_out(folder: Path) -> None:
    """Copy the worker's own code into a folder, as the package that it is."""
    shutil.copytree(Path(labs.grading.worker.__file__).parent, folder / _PACKAGE)
    for package in list(_PACKAGE.parents)[:-1]:
        (folder / package / "__init__.py").touch()


def is_anything_to_hide() -> bool:
    """Whether this copy of the lab has what a submission must not see: a student's has neither of them."""
    return (ROOT / "solutions").is_dir() or (AUTOGRADER / "hidden").is_dir()


def lay_out_with_numpy(folder: Path) -> bool:
    """Copy NumPy as well, whose place may tell where the lab is installed, for the interpreters of one submission.

    Returns False without a copy where nothing is to be hidden, or where a copy does not work: some builds of NumPy need
    libraries near their own place.
    """
    lay_out(folder)
    compileall.compile_dir(folder, quiet=2)
    if not is_anything_to_hide():
        return False
    beside = [_NUMPY.parent / name for name in _BESIDE_NUMPY if (_NUMPY.parent / name).is_dir()]
    for each in (_NUMPY, *beside):
        shutil.copytree(each, folder / each.name, ignore=_UNUSED)
    command = [
        interpreter(),
        *OPTIONS,
        "import os, sys; sys.path[:0] = [os.getcwd()]; import numpy.linalg, numpy.random",
    ]
    works = subprocess.run(command, cwd=folder, capture_output=True).returncode == 0
    for each in () if works else (_NUMPY, *beside):
        remove(folder / each.name)
    return works


def interpreter() -> str:
    """The interpreter from which the environment of this one was made, whose own place may be the lab's folder."""
    base = str(getattr(sys, "_base_executable", ""))
    return base if os.path.isfile(base) else sys.executable


def own_folder() -> Path:
    """A folder that does not lie with the grades, where this process may keep its own temporary files.

    What others left there that were killed is removed: a copy of NumPy is large.
    """
    places = [os.environ.get(name, "") for name in ("TMPDIR", "TEMP", "TMP")]
    place = next((each for each in (*places, "/tmp") if os.path.isdir(each) and os.access(each, os.W_OK)), None)
    made = Path(tempfile.mkdtemp(prefix=f"{_PREFIX}{os.getpid()}-", dir=place))
    for other in made.parent.glob(f"{_PREFIX}*-*"):
        with contextlib.suppress(OSError):  # somebody else removes it as well
            ours = other.lstat().st_uid == made.stat().st_uid  # a folder of another user may hold traps
            if ours and not _is_alive(other.name.removeprefix(_PREFIX).partition("-")[0]):
                remove(other)
    return made


def _is_alive(number: str) -> bool:
    """Whether there is a process of that number, as far as the system says."""
    if os.name != "posix" or not number.isdecimal():
        return True
    try:
        os.kill(int(number), 0)
    except (ProcessLookupError, OverflowError):
        return False
    except OSError:
        return True
    return True
