"""Times our own function beside what others offer for the same task, on the same input and in one run."""

from __future__ import annotations

import importlib.util
import math
import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

from labs.benching.programs import Environment, Run
from labs.project_folders import BENCHES
from reference.errors import UnknownName

Prepare = Callable[[], Callable[[], object]]
"""Makes the input, untimed, and returns the call that is timed. Rivals are imported in it; one may be missing."""
REPEATS = 7
"""Calls of each function; the median of so many is steady enough."""


@dataclass(frozen=True)
class Watched:
    """A number that is shown beside the time, because a fast answer may be a poor one.

    heading: what it is, with its unit. of: takes it from what a call returns, untimed; the largest is shown.
    """

    heading: str
    of: Callable[[Any], float]


@dataclass(frozen=True)
class Bench:
    """One question of speed.

    what: the task in words. ours, rivals: who does it. goal: the s that ours should stay below. beyond: the rival whose
    time the goal leaves out. who: the title of ours. environments: for rivals that are not installed beside the lab.
    repeats: calls of each, unless the user says how many. watched: what is shown beside the times.
    """

    name: str
    what: str
    ours: Prepare
    rivals: Mapping[str, Prepare] = field(default_factory=dict)
    goal: float | None = None
    beyond: str = ""
    who: str = "hand-written"
    environments: tuple[Environment, ...] = ()
    repeats: int = REPEATS
    watched: Watched | None = None


@dataclass(frozen=True)
class Timing:
    """Median and fastest of several calls, s; None if a rival is not installed, and then `note` says so.

    memory: the most bytes that a call took; None unless the calls are programs of their own whose memory is known.
    watched: the largest number of those that the bench takes from the results; None if it takes none.
    """

    who: str
    median: float | None
    fastest: float | None
    note: str = ""
    memory: int | None = None
    watched: float | None = None


def benches(folder: Path | None = None) -> dict[str, Bench]:
    """All benches by name, from the files `bench_*.py` of a folder; by default the project's own."""
    modules = [_load(path) for path in sorted((folder or BENCHES).glob("bench_*.py"))]
    return {bench.name: bench for module in modules for bench in module.BENCHES}


def find(name: str) -> Bench:
    """Return the bench of that name.

    Raises
    ------
    UnknownName
        If there is none.
    """
    known = benches()
    if name not in known:
        raise UnknownName("bench", name, known)
    return known[name]


def measure(bench: Bench, repeats: int | None = None) -> list[Timing]:
    """Time our own function and its rivals in turn, round by round, so that a busy moment affects all of them.

    repeats: calls of each; by default as many as the bench wants.
    """
    timings: list[Timing] = []
    calls: dict[str, Callable[[], object]] = {}
    samples: dict[str, list[float]] = {}
    memory: dict[str, int] = {}
    watched: dict[str, float] = {}
    for who, prepare in {bench.who: bench.ours, **bench.rivals}.items():
        try:
            calls[who] = prepare()
        except ImportError as missing:
            timings.append(Timing(who, None, None, f"not installed: {missing.name}"))
            continue
        calls[who]()  # the first call pays for what is loaded late
        samples[who] = []
    for _ in range(repeats or bench.repeats):
        for who, call in calls.items():
            start = time.perf_counter()
            result = call()
            samples[who].append(time.perf_counter() - start)
            if isinstance(result, Run) and result.memory:
                memory[who] = max(result.memory, memory.get(who, 0))
            if bench.watched:
                watched[who] = max(bench.watched.of(result), watched.get(who, -math.inf))
    return [
        Timing(who, statistics.median(found), min(found), memory=memory.get(who), watched=watched.get(who))
        for who, found in samples.items()
    ] + timings


def _load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
