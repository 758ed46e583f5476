"""Where submissions are graded: in processes of this machine, or on a cluster that Dask runs.

There is no scheduler of ours. `tcp://host:8786` is the address of Dask's scheduler, whose workers have the whole
project installed, with the same versions; `local:4` starts four of Dask's workers here. Dask gives a submission to
another worker if one is lost.
"""

from __future__ import annotations

import importlib
import multiprocessing
import re
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from typing import Any

from reference.errors import InvalidInput

_LOCAL = re.compile(r"^local:([1-9]\d{0,3})$")
_ADDRESS = re.compile(r"^(tcp|tls|ucx|ws|wss)://\S+$")
_PATIENCE = 15
"""So long a scheduler may take to answer, s."""


@dataclass(frozen=True)
class Workers:
    """Who grades. count: submissions at a time. pool: makes the workers, again if they are lost."""

    count: int
    pool: Callable[[], Executor]


def here(count: int) -> AbstractContextManager[Workers]:
    """Processes of this machine."""
    return _as_context(Workers(count, lambda: ProcessPoolExecutor(count, multiprocessing.get_context("spawn"))))


@contextmanager
def _as_context(workers: Workers) -> Iterator[Workers]:
    yield workers


@contextmanager
def on_cluster(address: str) -> Iterator[Workers]:
    """The workers of a Dask cluster.

    Raises
    ------
    InvalidInput
        If it is no address, nobody answers there, the cluster has no workers, or Dask is missing.
    """
    local = _LOCAL.match(address)
    if not local and not _ADDRESS.match(address):
        raise InvalidInput(f"--cluster is {address!r}; it is the address of a scheduler, tcp://host:8786, or local:4")
    try:
        distributed: Any = importlib.import_module("distributed")  # only a cluster needs it
    except ImportError:
        raise InvalidInput('a cluster needs Dask: pip install -e ".[cluster]"') from None
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
        yield Workers(threads, lambda: client.get_executor(pure=False))
    finally:
        client.close()
        if found is not None:
            found.close()


def lost() -> tuple[type[BaseException], ...]:
    """The errors that say that the worker of a submission died."""
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        return (BrokenProcessPool,)
    return BrokenProcessPool, distributed.KilledWorker
