"""Which hand-written code runs, said by data: a package name or a file's path, loaded only where it runs."""

from __future__ import annotations
import __future__

import ast
import functools
import importlib
import importlib.util
import operator
import re
import sys
import traceback
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from importlib.machinery import PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any, TypeGuard

import numpy as np

from reference import lecture
from reference.errors import InvalidInput, NeedsFunction, RunFailed, one_line

SOLUTIONS = "solutions"
OURS = ("labs.given", SOLUTIONS)
"""Packages with correct functions. A student's tree has the first, with some of them, an instructor's the second."""


@dataclass(frozen=True)
class Implementation:
    """Hand-written code by name.

    source: an importable package with one module a topic (`"solutions"`), or the path of a `.py` file that holds the
    functions side by side, as a student hands it in; or several of these, `lab.py | labs.given`: what the first does
    not define comes from the next. A string can be pickled. asked: the names of the functions that a run has used, also
    those of a file that its other functions call.
    """

    source: str = "solutions"
    asked: set[str] = field(default_factory=set, compare=False, repr=False, kw_only=True)

    @property
    def sources(self) -> tuple[str, ...]:
        """Each of the packages and files, in the order in which they are searched."""
        return tuple(part.strip() for part in self.source.split("|"))

    def wherever(self) -> Implementation:
        """The same code, also for who is in another folder: the paths of files are absolute."""
        return Implementation(
            " | ".join(
                str(Path(source).absolute()) if Path(source).suffix == ".py" else source for source in self.sources
            )
        )

    def check(self) -> None:
        """Refuse sources that cannot be loaded, and run none of their code.

        Raises
        ------
        InvalidInput
            If a source is neither a package nor a `.py` file, or if Python cannot read the file.
        """
        for source in self.sources:
            if Path(source).suffix == ".py":
                _check_file(Path(source))
            elif not _is_package(source):
                raise _no_implementation(source)

    def takes_ours(self, names: Iterable[str]) -> bool:
        """Whether functions of these names come from the lab's own packages.

        No code is run to find out. A file that mentions one of the names, or imports `*`, may define it, and counts as
        if it did; so does any package that is not the lab's. A file that hides the name is believed: this decides what
        is shown, and no mark depends on it.
        """
        ours = False
        mention = re.compile(r"\b(?:" + "|".join(map(re.escape, names)) + r")\b|import\s*\*")
        for source in self.sources:
            if source == SOLUTIONS:
                return True  # it has every function, so that nothing after it is asked
            if source in OURS:
                ours = True
                continue
            path = Path(source)
            if path.suffix != ".py" or not path.is_file():
                return False
            if mention.search(path.read_text(encoding="utf-8", errors="replace")):
                return False
        return ours

    def own_functions(self) -> dict[str, tuple[str, ...]]:
        """By file, the public functions that it defines itself; none of packages. No code is run to find out."""
        paths = [Path(source) for source in self.sources if Path(source).suffix == ".py"]
        return {
            path.name: tuple(each.name for each in ast.parse(path.read_bytes()).body if _is_public(each))
            for path in paths
        }

    def first_defined(self, names: Sequence[str]) -> str:
        """The first of these names that the first source defines which defines any; the last name if none does."""
        for source in self.sources:
            for name in names:
                if callable(getattr(_module(source, lecture.function(name).topic), name, None)):
                    return name
        return names[-1]

    def function(self, name: str) -> Callable[..., Any]:
        """Return the function of that name; where it is not written yet, raise `NeedsFunction` that says what to do."""
        entry = lecture.function(name)
        modules = (_module(source, entry.topic) for source in self.sources)
        found = next((each for module in modules if callable(each := getattr(module, name, None))), None)
        if found is None:
            raise _needs(name)

        @functools.wraps(found)
        def call(*arguments: Any, **named: Any) -> Any:
            self.asked.add(name)
            _CALLED.append(self.asked)
            try:
                answer = found(*arguments, **named)
            except NotImplementedError as error:
                raise _needs(_unwritten(error) or name) from None
            finally:
                _CALLED.pop()
            if answer is None:
                raise RunFailed(f"{name} returned nothing: is a return missing?")
            return _in_arrays(answer)

        return call


def _needs(name: str) -> NeedsFunction:
    entry = lecture.function(name)
    read = ", which is not for students to write" if entry.role == "read" else ""
    return NeedsFunction(f"needs {name} ({entry.topic}, step {entry.first_step}){read}")


def _unwritten(error: NotImplementedError) -> str:
    """The function that says that it is not written: the called one, or one that it calls; empty if it is no other."""
    *_, (innermost, _) = traceback.walk_tb(error.__traceback__)
    name = innermost.f_code.co_name
    return name if name in lecture.FUNCTIONS else ""


def _in_arrays(answer: Any) -> Any:
    """Lists of numbers as arrays, because a check takes them as well; anything else as it is."""
    if type(answer) is tuple:
        return tuple(_in_arrays(part) for part in answer)
    if isinstance(answer, list):
        try:
            found = np.asarray(answer)
        except ValueError:  # rows of unequal length
            return answer
        return found if found.dtype.kind in "biuf" else answer
    return answer


def _module(source: str, topic: str) -> ModuleType | None:
    """Return the module that holds a topic's functions, or None if it has none."""
    path = Path(source)
    if path.suffix == ".py":
        return _load_file(path)
    name = f"{source}.{topic}"
    try:
        if all(part.isidentifier() for part in source.split(".")):
            return importlib.import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name == name:
            return None
        if not f"{source}.".startswith(f"{missing.name}."):
            raise  # something that the implementation itself imports
    raise _no_implementation(source)


def _no_implementation(source: str) -> InvalidInput:
    choices = "a package such as 'solutions', or the path of a .py file"
    return InvalidInput(f"no implementation {source!r}; give {choices}")


def _is_package(source: str) -> bool:
    """Whether Python would find a package of that name; it is not imported, and neither is a package that holds it."""
    first, *others = source.split(".")
    if not all(part.isidentifier() for part in (first, *others)) or first == "__main__":
        return False
    found, name = importlib.util.find_spec(first), first
    for part in others:
        inside, name = found and found.submodule_search_locations, f"{name}.{part}"
        found = PathFinder.find_spec(name, inside) if inside else None
    return found is not None


def _check_file(path: Path) -> None:
    """Refuse a file that does not exist, cannot be opened, or is not Python."""
    if not path.is_file():
        raise _no_file(path)
    try:
        with warnings.catch_warnings(action="ignore"):  # they come again where the file runs
            compile(path.read_bytes(), path, "exec")
    except OSError as error:
        raise InvalidInput(f"cannot read the implementation {str(path)!r}: {error.strerror}") from None
    except (SyntaxError, ValueError) as error:
        line = f", line {error.lineno}" if isinstance(error, SyntaxError) and error.lineno else ""
        raise InvalidInput(f"cannot read the implementation {str(path)!r}{line}: {one_line(error)}") from None


def _no_file(path: Path) -> InvalidInput:
    why = "it is a folder" if path.is_dir() else "there is no such file"
    return InvalidInput(f"no implementation {str(path)!r}: {why}")


_DEFINES_NOTHING = (ast.Expr, ast.For, ast.While, ast.If, ast.With, ast.Match)
_FILES: dict[tuple[Path, bytes], ModuleType] = {}
_CALLED: list[set[str]] = []
"""Who listens to the functions of files that are called now, the innermost last: the `asked` of an implementation."""


_LISTENER = "__called__"
"""Under which name the functions of a file find `_note`."""


def _note(name: str) -> None:
    """Note that a function of a file runs."""
    if _CALLED:
        _CALLED[-1].add(name)


def _is_public(statement: ast.stmt) -> TypeGuard[ast.FunctionDef]:
    return isinstance(statement, ast.FunctionDef) and not statement.name.startswith("_")


def _noting(statement: ast.stmt) -> ast.stmt:
    """The statement; a public function notes its own name first of all, whoever calls it and under whichever name."""
    if _is_public(statement):
        first = statement.body[0]
        note = ast.Expr(ast.Call(ast.Name(_LISTENER, ast.Load()), [ast.Constant(statement.name)], []))
        place = int(ast.get_docstring(statement, clean=False) is not None)
        statement.body.insert(place, ast.fix_missing_locations(ast.copy_location(note, first)))
    return statement


def _load_file(path: Path) -> ModuleType:
    """Import a file by path, once for each text in this process: a worker process outlives many edits of the file."""
    path = path.resolve()
    if not path.is_file():
        raise _no_file(path)
    text = path.read_bytes()
    if (path, text) not in _FILES:
        name = f"_implementation_{len(_FILES)}"
        module = ModuleType(name)
        module.__file__ = str(path)
        sys.modules[name] = module  # as any import does; a dataclass in the file looks itself up there
        _run(text, path, module)  # a loader might take stale bytecode instead
        _FILES[path, text] = module
    return _FILES[path, text]


def _run(text: bytes, path: Path, module: ModuleType) -> None:
    """Run a file's statements. One that defines nothing, such as a loop that also plots, costs nothing if it fails."""
    statements = ast.parse(text, path).body
    futures = [each for each in statements if isinstance(each, ast.ImportFrom) and each.module == "__future__"]
    flags = {getattr(__future__, alias.name).compiler_flag for each in futures for alias in each.names}
    module.__dict__[_LISTENER] = _note
    for statement in statements:
        code = compile(
            ast.Module([_noting(statement)], []), path, "exec", functools.reduce(operator.or_, flags, 0), True
        )
        try:
            exec(code, module.__dict__)
        except Exception:
            if not isinstance(statement, _DEFINES_NOTHING):
                raise
