"""Loads the modules of Python and NumPy that a submission needs, before a test's process is shut in.

A test's process may be unable to open Python's own files. Without Landlock, the filter of system calls denies opening
any file. And a grader that root has started, with an interpreter in root's home, becomes a user who cannot enter that
folder. There a submission has only the modules that are loaded already. Some of them nobody imports by name: Python
itself loads `unicodedata` to compile an identifier such as ε, and NumPy loads many of its modules when they are first
used. So the nursery, which can still open everything, loads these modules beforehand.

A right answer must never lose points because of the machine. If a submission imports a module that is there, but was
not loaded, its process says so before it runs any of the text, and nothing is graded.
"""

from __future__ import annotations

import ast
import contextlib
import importlib
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
    "traceback", "tracemalloc", "types", "unittest", "uuid", "weakref", "zlib",
    "encodings.ascii", "encodings.cp1252", "encodings.idna", "encodings.latin_1", "encodings.utf_16",
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
    sys.path[:] = [path for path in sys.path if path not in sys.argv[1:3]]
    for name in [name for name in sys.modules if name.partition(".")[0] == "labs"]:
        del sys.modules[name]
    library = sysconfig.get_path("stdlib")
    other = {"site-packages", "dist-packages"}  # other packages that are installed there, perhaps this project
    found = [os.path.join(library, name) for name in os.listdir(library) if name not in other]
    return [*found, *(os.path.join(packages, name) for name in ("numpy", "numpy.libs"))]


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
    for module in pkgutil.iter_modules([library, os.path.join(library, "lib-dynload")]):
        yield module.name
        if module.ispkg:
            within = pkgutil.iter_modules([os.path.join(library, module.name)])
            yield from (f"{module.name}.{part.name}" for part in within)


def _parts_of_numpy() -> Iterator[str]:
    """NumPy's modules: it loads some of them only when a function needs them."""
    for package in ("numpy", "numpy._core", "numpy.lib", "numpy.linalg", "numpy.ma", "numpy.polynomial"):
        with contextlib.suppress(ImportError):
            for module in pkgutil.iter_modules(importlib.import_module(package).__path__):
                if module.name not in _UNWANTED and not module.name.endswith("_tests"):
                    yield f"{package}.{module.name}"


def files_open_to(user: int) -> bool:
    """Whether that user can open the files of Python and NumPy; only root can become another user and need to ask.

    It is tried, in a process that becomes this user, because folders on the way and lists of access may deny it.
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
