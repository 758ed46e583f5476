"""Runs jobs on an executor; a result comes from the cache, a worker process or a recording, or a row says why not."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Generator, Iterable, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor, as_completed, wait
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from reference.engines import load_engine
from reference.errors import (
    CannotExpress,
    CollisionsError,
    EngineNotInstalled,
    InvalidInput,
    NeedsFunction,
    RunFailed,
    RunLost,
    WorkerCrashed,
    WorkerStopped,
    WorkerTimeout,
    one_line,
)
from reference.running.cache import Cache, key_of, key_of_recorded
from reference.running.isolate import run_isolated, stop_workers
from reference.running.protocol import Job, Result
from reference.running.sources import Texts

J = TypeVar("J", bound=Job)
R = TypeVar("R", bound=Result)
A = TypeVar("A")
B = TypeVar("B")

TIME_LIMIT = 300.0
"""Wall-clock limit of one job, s."""
_STOP_INTERVAL = 0.05
"""Time between two rounds of stopping workers, s: enough for a thread to see that its worker is gone."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Work(Generic[J, R]):
    """How one kind of job is done.

    run: do the job here and now, within a worker. recorded: the result that was measured elsewhere, None where there is
    no recording. refused: the result that says why there is no number, from the job, the error and how long it took, s.
    in_order: the order in which to start jobs. parts: a job for each case of a job, if it has several that can run
    alone. joined: the result of a job from those of its parts.
    """

    run: Callable[[J], R]
    recorded: Callable[[J], R | None]
    refused: Callable[[J, CollisionsError, float], R]
    in_order: Callable[[Iterable[J]], list[J]]
    parts: Callable[[J], list[J]] | None = None
    joined: Callable[[J, list[R]], R] | None = None


def recall(jobs: Iterable[Job], cache: Cache) -> list[Any]:
    """The results of those jobs that the cache has; of an engine that is not installed, what its recording gave."""
    texts = Texts()

    def found(job: Job) -> Any:
        return cache.get(job, texts) if _has_version(job) else cache.get_recorded(job, texts)

    return [result for job in jobs if (result := found(job)) is not None]


def _has_version(job: Job) -> bool:
    """Whether the package of a job's engine is here, as far as its metadata say; it is not imported."""
    try:
        load_engine(job.engine).version()
    except EngineNotInstalled:
        return False
    except CollisionsError:
        pass
    return True


def run_all(
    jobs: Sequence[J], work: Work[J, R], executor: Executor, timeout: float = TIME_LIMIT, cache: Cache | None = None
) -> Generator[R, None, None]:
    """Run jobs on an executor and yield their results as they finish; a job that fails gives a row that says so.

    Results that a cache has are taken from it, in the executor's threads, without a worker process. Closing the
    generator early, also by an interrupt, stops every worker process and waits for no job.
    """
    waiting: dict[Future[R], J] = {}
    try:
        waiting.update((executor.submit(run_one, job, work, timeout, cache), job) for job in jobs)
        for future in as_completed(waiting):
            yield _result(future, waiting[future], work)
    finally:
        _abandon(waiting)


def _result(future: Future[R], job: J, work: Work[J, R]) -> R:
    """What a job gave; where the executor itself lost it, as a cluster does whose machine is gone, a row says so."""
    try:
        return future.result()
    except CollisionsError:
        raise
    except Exception as error:
        _log.warning("%s is lost", job, exc_info=error)
        return work.refused(job, RunLost(f"what should run it gave no answer ({one_line(error)})"), 0.0)


def each_isolated(function: Callable[[A], B], arguments: Sequence[A], workers: int) -> list[B]:
    """What a function gives for each argument, in their order, several worker processes at a time.

    An error or an interrupt stops every worker process and waits for none.
    """
    with ThreadPoolExecutor(workers) as executor:
        waiting = [executor.submit(run_isolated, function, TIME_LIMIT, argument) for argument in arguments]
        try:
            return [future.result() for future in waiting]
        finally:
            _abandon(waiting)


def _abandon(futures: Iterable[Future[Any]]) -> None:
    """Cancel the jobs that have not started, and stop the workers of the others until no job is running."""
    running = {future for future in futures if not (future.cancel() or future.done())}
    while running:  # repeatedly, because a thread may be about to start a worker
        stop_workers()
        running = wait(running, _STOP_INTERVAL).not_done


def run_one(job: J, work: Work[J, R], timeout: float = TIME_LIMIT, cache: Cache | None = None) -> R:
    """Run a job in a worker process, or take its result from a cache; a crash or a hang becomes a row that says so.

    For an engine that is not installed, the result comes from its recording, or is a row that says how to get it.
    """
    found: R | None = cache.get(job) if cache else None
    if found is not None:
        return found
    start, key, result = time.perf_counter(), None, None
    _log.info("%s: started", job)
    try:
        if cache:
            key, result = run_isolated(_run_with_key, timeout, work.run, job)
        else:
            result = run_isolated(work.run, timeout, job)
    except EngineNotInstalled as error:
        kept: R | None = cache.get_recorded(job) if cache else None
        if kept is not None:
            return kept
        result = _recorded(job, work, error, start)
        key = key_of_recorded(job) if cache and result.recording else None
    except (NeedsFunction, CannotExpress, RunFailed) as error:
        refused = work.refused(job, error, time.perf_counter() - start)
        lost = _is_lost(error) and not isinstance(error, WorkerStopped)
        result = (lost and _part_by_part(job, work, timeout, refused)) or refused
    _log.info("%s: finished after %.1f s", job, time.perf_counter() - start)
    if cache:
        cache.put(job, key, result)
    return result


def _is_lost(error: CollisionsError) -> bool:
    """Whether an error says that a job's process died, was killed or was stopped at its limit."""
    return isinstance(error, WorkerCrashed | RunLost)


def _part_by_part(job: J, work: Work[J, R], timeout: float, refused: R) -> R | None:
    """The result of a job whose process was lost, from runs of each part by itself; None if it has no parts.

    Only the part that crashes or hangs is lost then. All parts together have as much time as the job had.

    refused: what says that the job was lost. It belongs to the result if no part is lost, as where a study was: nothing
    else would tell.
    """
    parts = work.parts(job) if work.parts else []
    if len(parts) < 2 or work.joined is None:
        return None
    found, any_lost = list[R](), False
    for part in parts:
        start = time.perf_counter()
        try:
            found.append(run_isolated(work.run, timeout / len(parts), part))
        except WorkerStopped:
            return None
        except (NeedsFunction, CannotExpress, RunFailed) as error:
            if isinstance(error, WorkerTimeout):
                error = WorkerTimeout(f"{error}: its part of {timeout:g} s for all cases")
            found.append(work.refused(part, error, time.perf_counter() - start))
            any_lost = any_lost or _is_lost(error)
    return work.joined(job, found if any_lost else [*found, refused])


def _recorded(job: J, work: Work[J, R], missing: EngineNotInstalled, start: float) -> R:
    """The recorded result of a job; where there is none, or it cannot be used, a result that says why.

    missing: what is said of the engine, which is not installed. start: when the job was started.
    """
    try:
        found = work.recorded(job)
    except InvalidInput as unusable:
        _log.warning("%s: %s", job, unusable)
        found, missing = None, EngineNotInstalled(f"{missing}; {unusable}")
    return found or work.refused(job, missing, time.perf_counter() - start)


def _run_with_key(run: Callable[[J], R], job: J) -> tuple[str | None, R]:
    """Run a job in a worker, and return the key of the code that it runs: a file may have changed since its import."""
    return key_of(job, once=True), run(job)
