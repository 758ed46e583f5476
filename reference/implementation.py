"""Which hand-written code runs, said by data: a package name or a file's path, loaded only where it runs."""

from __future__ import annotations

import functools
import importlib
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from reference import lecture
from reference.errors import InvalidInput, NeedsFunction


@dataclass(frozen=True)
class Implementation:
    """Hand-written code by name.

    source: an importable package with one module a topic (`"solutions"`), or the path of a `.py` file that holds the
    functions side by side, as a student hands it in. Being a string, it pickles.
    """

    source: str = "solutions"

    def function(self, name: str) -> Callable[..., Any]:
        """Return the function of that name; where it is not written yet, raise `NeedsFunction` that says what to do."""
        entry = lecture.function(name)
        found = getattr(self._module(entry.topic), name, None)
        if not callable(found):
            raise NeedsFunction(f"needs {name} ({entry.topic}, step {entry.step})")

        @functools.wraps(found)
        def call(*arguments: Any, **named: Any) -> Any:
            try:
                return found(*arguments, **named)
            except NotImplementedError:
                raise NeedsFunction(f"needs {name} ({entry.topic}, step {entry.step})") from None

        return call

    def _module(self, topic: str) -> ModuleType | None:
        """Return the module that holds a topic's functions, or None where there is none."""
        path = Path(self.source)
        if path.suffix == ".py":
            return _load_file(path)
        name = f"{self.source}.{topic}"
        try:
            if all(part.isidentifier() for part in self.source.split(".")):
                return importlib.import_module(name)
        except ModuleNotFoundError as missing:
            if missing.name == name:
                return None
            if not f"{self.source}.".startswith(f"{missing.name}."):
                raise  # something that the implementation itself imports
        choices = "a package such as 'solutions', or the path of a .py file"
        raise InvalidInput(f"no implementation {self.source!r}; give {choices}")


_FILES: dict[tuple[Path, bytes], ModuleType] = {}


def _load_file(path: Path) -> ModuleType:
    """Import a file by path, once per process and text: a worker process outlives many an edit of the file."""
    path = path.resolve()
    if not path.is_file():
        raise InvalidInput(f"no implementation {str(path)!r}: there is no such file")
    text = path.read_bytes()
    if (path, text) not in _FILES:
        name = f"_implementation_{len(_FILES)}"
        module = ModuleType(name)
        module.__file__ = str(path)
        sys.modules[name] = module  # as any import does; a dataclass in the file looks itself up there
        exec(compile(text, path, "exec"), module.__dict__)  # not by a loader, which may take stale bytecode for it
        _FILES[path, text] = module
    return _FILES[path, text]
