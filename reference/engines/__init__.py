"""The engines, found by file: every `…_engine.py` in this folder, or any file by its path.

A new engine is one file that ends in `ENGINE = MyEngine`, a subclass of `reference.engines.base.Engine`.
"""

from __future__ import annotations

import functools
import importlib
import importlib.util
import pkgutil
import sys
from pathlib import Path
from types import ModuleType

from reference.engines.base import Engine
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, UnknownName, one_line

__all__ = ["Engine", "engine_names", "load_engine"]


def load_engine(name: str, implementation: Implementation | None = None) -> Engine:
    """Return the engine of that name, or the one that a `.py` file defines."""
    if name.endswith(".py"):
        return _made(name, _engine_class(_load_file(Path(name))), implementation)
    classes = _found()
    if name not in classes:
        raise UnknownName("engine", name, classes)
    return classes[name](implementation)


def engine_names() -> tuple[str, ...]:
    """Names of all engines in the order of the tables, installed or not."""
    return tuple(_found())


@functools.cache
def _found() -> dict[str, type[Engine]]:
    adapters = [info.name for info in pkgutil.iter_modules(__path__) if info.name.endswith("_engine")]
    classes = [_engine_class(importlib.import_module(f"{__name__}.{name}")) for name in adapters]
    return {engine.name: engine for engine in sorted(classes, key=lambda engine: (engine.order, engine.name))}


def _load_file(path: Path) -> ModuleType:
    if not path.is_file():
        raise InvalidInput(f"no engine file {str(path)!r}; an engine is a name ({', '.join(_found())}) or a .py file")
    spec = importlib.util.spec_from_file_location(f"_engine_{path.stem}", path)
    assert spec is not None  # a .py file always has one, and a loader
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # as any import does; a dataclass in the file looks itself up there
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:  # a file that ends Python ends with it whatever the lab was about to do
        raise InvalidInput(f"the engine file {str(path)!r} cannot be loaded: {one_line(error)}") from error
    return module


def _made(file: str, engine: type[Engine], implementation: Implementation | None) -> Engine:
    """Make the engine of somebody's file; refuse one that lacks a method, or that would pass for one of the lab's."""
    if missing := sorted(engine.__abstractmethods__):
        raise InvalidInput(f"the engine of {file!r} lacks {', '.join(missing)}; docs/design.md says what each does")
    for word in ("name", "title"):
        if not isinstance(getattr(engine, word, None), str):
            raise InvalidInput(f"the engine of {file!r} has no {word}: give its class one, in words")
    if engine.name in _found():
        raise InvalidInput(f"the engine of {file!r} has the name {engine.name!r}, which is taken; give it another")
    try:
        return engine(implementation)
    except (Exception, SystemExit) as error:
        raise InvalidInput(f"the engine of {file!r} cannot be made: {one_line(error)}") from error


def _engine_class(module: ModuleType) -> type[Engine]:
    engine = getattr(module, "ENGINE", None)
    if not (isinstance(engine, type) and issubclass(engine, Engine)):
        raise InvalidInput(f"{module.__file__} does not define ENGINE, a subclass of reference.engines.base.Engine")
    return engine
