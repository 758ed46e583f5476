"""Loads the modules of Python and NumPy that a submission needs, before a test's process is shut in.

A test's process may be unable to open Python's own files, for one of two reasons.

A grader that root has started, with an interpreter in root's home, becomes a user who cannot enter that folder. So the
nursery opens the folders of modules beforehand, and Python looks for modules through these descriptors: a user who may
read a folder, but not those on the way to it, can read it so. Landlock still denies everything else in them.

Without Landlock, the filter of system calls denies opening any file. Then a submission has only the modules that are
loaded already. Some of them nobody imports by name: Python itself loads `unicodedata` to compile an identifier such as
ε, and NumPy loads many of its modules when they are first used. So the nursery loads what any solution might need.

A right answer must never lose points because of the machine. If a submission imports a module of the library that is
there, but was not loaded, its process says so before it runs any of the text, and nothing is graded.
"""

from __future__ import annotations

import ast
import contextlib
import importlib
import importlib.util
import os
import pkgutil
import sys
import sysconfig
import unicodedata
import warnings
from collections.abc import Iterator

import numpy as np

from labs.grading.worker import sandbox

_USUAL = (
    "array", "bisect", "cmath", "copy", "dataclasses", "datetime", "enum", "fractions", "heapq", "itertools", "numbers",
    "operator", "random", "statistics", "typing", "numpy.fft", "numpy.linalg", "numpy.random", "numpy.typing",
)  # fmt: skip
"""What solutions import. The nursery loads it once, so that no test's process has to."""
_CLOSED = (
    "abc", "argparse", "ast", "atexit", "base64", "binascii", "calendar", "codecs", "collections.abc", "colorsys",
    "concurrent.futures", "contextlib", "contextvars", "csv", "ctypes", "decimal", "difflib", "dis", "errno", "fcntl",
    "fnmatch", "functools", "gc", "getopt", "glob", "graphlib", "gzip", "hashlib", "importlib.util", "inspect", "io",
    "json", "keyword", "linecache", "locale", "logging", "math", "mmap", "numpy.matlib", "pathlib", "pickle",
    "platform", "pprint", "queue", "re", "secrets", "select", "shlex", "shutil", "signal", "socket", "string", "struct",
    "subprocess", "symtable", "sysconfig", "tempfile", "textwrap", "threading", "time", "timeit", "tokenize",
    "traceback", "tracemalloc", "types", "unittest", "uuid", "weakref", "zlib", "_strptime", "asyncio",
    "concurrent.futures.process", "concurrent.futures.thread", "doctest", "unittest.mock", "xml.dom.minidom",
    "xml.etree.ElementTree", "encodings.ascii", "encodings.cp1252", "encodings.idna", "encodings.latin_1",
    "encodings.utf_16",
)  # fmt: skip
"""What else to load if a test's process cannot open Python's files: modules that a lab's solution might import."""
_UNWANTED = {"tests", "conftest", "f2py", "distutils", "cversions", "testing", "_pyinstaller"}
"""Parts of NumPy that build and test NumPy itself; they are loaded only if NumPy names them as one of its own."""

_there: frozenset[str] = frozenset()
"""The modules of Python's library that are installed; filled in only where a test's process cannot open them."""


def prepare() -> list[str]:
    """Load what solutions import, and forget where our own modules are; returns the paths that tests may read."""
    sys.dont_write_bytecode = True
    for name in _USUAL:
        importlib.import_module(name)
    packages = os.path.dirname(os.path.dirname(os.path.abspath(np.__file__)))
    ours = os.path.abspath(os.path.join(__file__, *[os.pardir] * 4))
    sys.path[:] = [path for path in sys.path if path not in (ours, packages)]
    for name in [name for name in sys.modules if name.partition(".")[0] == "labs"]:
        del sys.modules[name]
    library = sysconfig.get_path("stdlib")
    other = {"site-packages", "dist-packages"}  # other packages that are installed there, perhaps this project
    found = [os.path.join(library, name) for name in os.listdir(library) if name not in other]
    return [*found, *(os.path.join(packages, name) for name in ("numpy", "numpy.libs"))]


def hold_folders() -> list[int]:
    """Have Python look for modules through open descriptors, which are returned; processes forked later keep them."""
    held: list[int] = []
    through: dict[str, str] = {}
    packages = os.path.dirname(os.path.dirname(os.path.abspath(np.__file__)))
    for folder in filter(os.path.isdir, dict.fromkeys([*sys.path, packages])):
        held.append(os.open(folder, os.O_PATH | os.O_DIRECTORY))
        through[folder] = f"/proc/self/fd/{held[-1]}"
    sys.path[:] = [through.get(folder, folder) for folder in sys.path]
    for module in list(sys.modules.values()):
        if file := getattr(module, "__file__", None):
            module.__file__ = _moved(file, through)
        if isinstance(inner := getattr(module, "__path__", None), list):
            inner[:] = [_moved(path, through) for path in inner]
    importlib.invalidate_caches()
    importlib.util.find_spec("a_module_that_is_nowhere")  # lists each folder, which a test's process may not
    return held


def _moved(path: str, through: dict[str, str]) -> str:
    """The path below the longest of some folders, by the folder's other name."""
    for folder in sorted(through, key=len, reverse=True):
        if path.startswith(folder + os.sep):
            return through[folder] + path[len(folder) :]
    return path


def prepare_for_closed_files() -> None:
    """Load what any solution might import, as a test's process cannot load it later."""
    global _there
    _there = frozenset(_installed())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about parts of NumPy that are about to go
        for name in (*_CLOSED, *_parts_of_numpy()):
            with contextlib.suppress(ImportError):  # another version of Python or NumPy
                importlib.import_module(name)
        for name in np.__all__:  # `from numpy import *` takes them all
            with contextlib.suppress(AttributeError, ImportError):
                getattr(np, name)


def _installed() -> Iterator[str]:
    """The names of the library's modules, and of those within its packages."""
    library = sysconfig.get_path("stdlib")
    waiting = [("", [library, os.path.join(library, "lib-dynload")])]
    while waiting:
        package, folders = waiting.pop()
        for module in pkgutil.iter_modules(folders):
            yield package + module.name
            if module.ispkg:
                waiting.append((f"{package}{module.name}.", [os.path.join(folders[0], module.name)]))


def _parts_of_numpy() -> Iterator[str]:
    """NumPy's modules: it loads some of them only when a function needs them."""
    for package in ("numpy", "numpy._core", "numpy.lib", "numpy.linalg", "numpy.ma", "numpy.polynomial"):
        with contextlib.suppress(ImportError):
            for module in pkgutil.iter_modules(importlib.import_module(package).__path__):
                if module.name not in _UNWANTED and not module.name.endswith("_tests"):
                    yield f"{package}.{module.name}"


def files_open_to(user: int) -> bool:
    """Whether that user can open the files of Python and NumPy; only root can become another user and need to ask.

    It is tried, in a process that becomes this user, because folders on the way and lists of access may deny it, or
    there may be no `/proc` for descriptors.
    """
    if os.geteuid() != 0:
        return True
    files = [file for file in (os.__file__, np.__file__, getattr(unicodedata, "__file__", None)) if file]
    process = os.fork()
    if process == 0:
        readable = False
        with contextlib.suppress(OSError):
            sandbox.become(user)
            readable = all(os.access(file, os.R_OK) for file in files)
        os._exit(0 if readable else 1)
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == 0


def lacking(source: str) -> list[str]:
    """The modules that a source imports and that are installed, but neither loaded nor open to this process."""
    try:
        compile("ε = 1", "identifier", "exec")
    except ImportError as error:
        return [str(error)]
    if not _there or "import" not in source or os.access(os.__file__, os.R_OK):
        return []
    with contextlib.suppress(SyntaxError, ValueError, RecursionError, MemoryError):
        return sorted((_there & set(_imported(source))) - sys.modules.keys())
    return []


def _imported(source: str) -> Iterator[str]:
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)  # a module, or what is in it
