"""Where submissions are graded and scenarios run: in processes of this machine, or on a cluster that Dask runs.

There is no scheduler of ours. `tcp://host:8786` is the address of Dask's scheduler, whose workers have the whole
project installed, with the same versions; `local:4` starts four of Dask's workers here. Dask gives a task to another
worker if one is lost.
"""

from __future__ import annotations

import importlib
import logging
import multiprocessing
import os
import platform
import re
import shutil
import signal
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from labs.correct_functions import package_of_correct_functions
from reference.engines import engine_names, load_engine
from reference.errors import EngineNotInstalled, InvalidInput
from reference.running import sources

_LOCAL = re.compile(r"^local:([1-9]\d{0,3})$")
_ADDRESS = re.compile(r"^(tcp|tls|ucx|ws|wss)://\S+$")
_PATIENCE = 15
"""So long a scheduler may take to answer, s."""


def _nothing() -> None:
    pass


@dataclass(frozen=True)
class Workers:
    """Who works. count: tasks at a time. pool: makes the workers, again if they are lost.

    stop: ends them at once, where they are ours to end.
    """

    count: int
    pool: Callable[[], Executor]
    stop: Callable[[], None] = _nothing


@contextmanager
def here(count: int, folder: Path) -> Iterator[Workers]:
    """Processes of this machine, which end with this one, however it ends.

    folder: for all their temporary files. The caller sees to it that nobody else uses it: what an earlier run left
    there is removed first, and everything at the end.
    """
    others = {*multiprocessing.active_children()}
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)

    def pool() -> Executor:
        begin = partial(_begin, str(folder.absolute()))
        return ProcessPoolExecutor(count, multiprocessing.get_context("spawn"), begin)

    def stop() -> None:
        ours = {*multiprocessing.active_children()} - others
        for process in ours:
            process.kill()
        for process in ours:
            process.join(_PATIENCE)

    try:
        yield Workers(count, pool, stop)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _begin(folder: str) -> None:
    """Become a worker, in its process."""
    tempfile.tempdir = folder
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, _wait_for_the_parent)
        if hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    threading.Thread(target=_end_with_the_parent, daemon=True).start()


def _wait_for_the_parent(*_: object) -> None:
    """Ignore Ctrl-C, which a terminal sends to all processes at once: the parent decides when to stop.

    It is a handler, and no "ignore", because processes that are started from here would inherit that.
    """


def _end_with_the_parent() -> None:
    """End this process when the parent is gone, however it ended; what it has started notices that by itself.

    A pipe that only the parent holds says so. The kernel's signal at a parent's death would come too early, when the
    parent's *thread* ends that has started this process.
    """
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextmanager
def starting_workers() -> Iterator[None]:
    """A process that is started meanwhile begins with Ctrl-C blocked, until it is ready to ignore it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def what_runs_here() -> dict[str, str]:
    """All that the numbers of a scenario depend on, in words: a digest of the lab's code, and versions."""
    code = [sources.digest(name) for name in ("reference", package_of_correct_functions() or "reference")]
    found = {"the lab": " ".join(code), "Python": platform.python_version(), "NumPy": np.__version__}
    for name in engine_names():
        engine = load_engine(name)
        if engine.package is not None:
            try:
                found[engine.title] = engine.version()
            except EngineNotInstalled:
                found[engine.title] = "not installed"
    return found


@contextmanager
def on_cluster(address: str, alike: Callable[[], Mapping[str, str]] | None = None) -> Iterator[Workers]:
    """The workers of a Dask cluster.

    alike: what has to be the same on every worker as here, if anything has to.

    Raises
    ------
    InvalidInput
        If it is no address, nobody answers there, the cluster has no workers, they are not like this machine, or Dask
        is missing.
    """
    local = _LOCAL.match(address)
    if not local and not _ADDRESS.match(address):
        raise InvalidInput(f"--cluster is {address!r}; it is the address of a scheduler, tcp://host:8786, or local:4")
    try:
        distributed: Any = importlib.import_module("distributed")  # only a cluster needs it
    except ImportError:
        raise InvalidInput('a cluster needs Dask: pip install -e ".[cluster]"') from None
    logging.getLogger("distributed").setLevel(logging.WARNING)  # it tells of every connection
    try:
        if local:
            found = distributed.LocalCluster(
                n_workers=int(local[1]), threads_per_worker=1, dashboard_address=None, host="127.0.0.1"
            )
            client = distributed.Client(found)
        else:
            found, client = None, distributed.Client(address, timeout=_PATIENCE)
    except (OSError, TimeoutError) as error:
        raise InvalidInput(f"no Dask scheduler answers at {address}: {error}") from None
    try:
        threads = sum(client.nthreads().values())
        if not threads:
            raise InvalidInput(f"the cluster at {address} has no workers: start some with dask worker {address}")
        if alike is not None:
            refuse_others(alike(), client.run(alike, on_error="ignore"))  # one that has just died answers nothing
        quiet = partial(logging.getLogger("distributed").setLevel, logging.ERROR)  # it warns of each task that is lost
        yield Workers(threads, lambda: client.get_executor(pure=False), quiet)
    finally:
        client.close()
        if found is not None:
            found.close()


def refuse_others(here: Mapping[str, str], there: Mapping[str, Mapping[str, str]]) -> None:
    """Refuse a cluster on which the same task would give other numbers. there: by address of each worker."""
    for address, found in there.items():
        for name, wanted in here.items():
            if (other := found.get(name, "unknown")) != wanted:
                words = "other code of the lab" if name == "the lab" else f"{name} {other}, and this machine {wanted}"
                raise InvalidInput(f"the worker at {address} has {words}: install the same there")


def lost() -> tuple[type[BaseException], ...]:
    """The errors that say that the worker of a submission died."""
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        return (BrokenProcessPool,)
    return BrokenProcessPool, distributed.KilledWorker
