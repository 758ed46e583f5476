"""Whether an engine is installed here: it is imported in a worker process, which will need it anyway."""

from __future__ import annotations

import functools

from reference.engines import load_engine
from reference.errors import EngineNotInstalled, RunFailed
from reference.running.isolate import run_isolated

PROBE_LIMIT = 60.0
"""How long the import of an engine may take, s."""


@functools.cache
def absent(engine: str) -> bool:
    """Whether an engine is missing here."""
    if load_engine(engine).package is None:
        return False
    try:
        run_isolated(_import, PROBE_LIMIT, engine)
    except EngineNotInstalled:
        return True
    except RunFailed:
        return False  # its own run will say what is wrong
    return False


def _import(engine: str) -> None:
    load_engine(engine).module()
