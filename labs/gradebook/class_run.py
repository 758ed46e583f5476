"""Grades submissions in worker processes, each once: what one of them raises or breaks stops no other."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field

from labs.gradebook.grading import Graded, Task, grade_one
from labs.grading.budget import ON_THE_CLOCK
from labs.grading.errors import GraderFailed, MachineBusy
from labs.grading.safe_text import cause_of
from labs.workers import Workers, lost, starting_workers
from reference.errors import InvalidInput

_AHEAD = 2
"""So many submissions wait for each worker: those further back are not read yet, so that memory does not grow."""
_PATIENCE, _LEAST_PATIENCE = 2 * ON_THE_CLOCK, 600.0
"""So many times its seconds a submission may take on the clock, all in all, and never less than so many seconds. The
budget of its tests ends at half of it."""


@dataclass
class Failures:
    """Tasks that could not be graded: the student's number, and why. They have no score, and cost nobody else anything.

    busy: those for which the machine was too busy. without_page: those that are graded, but for whom no page could be
    made, and why.
    """

    said: dict[str, str] = field(default_factory=dict)
    busy: set[str] = field(default_factory=set)
    without_page: dict[str, str] = field(default_factory=dict)

    def add(self, student: str, error: BaseException) -> None:
        """Note why a submission could not be graded."""
        if isinstance(error, GraderFailed):
            self.said[student] = str(error)
        else:
            self.said[student] = f"it could not be graded: {cause_of(error)}"
        if isinstance(error, MachineBusy):
            self.busy.add(student)


def run(
    tasks: Iterable[Task],
    workers: Workers,
    keep: Callable[[Graded], None],
    failures: Failures,
    stopping: Callable[[], None] = lambda: None,
) -> None:
    """Grade tasks in worker processes, each once; `keep` gets every grade as soon as it is there.

    A task that was running when a worker died is tried once more, by itself, so that it takes no other with it. What
    a task raises belongs to its submission, and the others continue. On Ctrl-C the workers are ended at once, and what
    they have finished is kept; `stopping` is called before.
    """
    waiting, alone = iter(tasks), deque[Task]()
    running: dict[Future[Graded], Task] = {}
    workers_now = _Pool(workers)
    try:
        while True:
            while len(running) < workers.count * _AHEAD and (task := next(waiting, None)) is not None:
                running[workers_now.submit(task)] = task
            if not running:
                break
            patience = max(map(_patience, running.values()))
            done = wait(running, patience, FIRST_COMPLETED).done
            if not done:  # one of them has no end, and nobody can say which
                alone.extend(running.values())
                running.clear()
                workers_now.renew()
            for future in done:
                task = running[future]
                if not _settled(task, future, keep, failures):
                    alone.append(task)
                del running[future]
        for task in alone:
            _by_itself(task, workers_now, keep, failures)
    except KeyboardInterrupt:
        stopping()
        workers.stop()
        for future in [each for each in running if each.done() and not each.cancelled() and not each.exception()]:
            keep(future.result())
        raise
    finally:
        for future in running:
            future.cancel()
        workers_now.executor.shutdown(wait=True)


def _patience(task: Task) -> float:
    return max(_LEAST_PATIENCE, task.seconds * _PATIENCE)


def _settled(task: Task, future: Future[Graded], keep: Callable[[Graded], None], failures: Failures) -> bool:
    """Keep a grade, or note why there is none; False if the worker has died, and perhaps not of this submission."""
    error = future.exception()
    if isinstance(error, lost()):
        return False
    if error is None:
        try:
            keep(future.result())
        except (OSError, InvalidInput):  # the disk is full, or the versions differ: then no grade can be kept
            raise
        except Exception as cause:  # such as a number that cannot be written into a grade
            error = cause
    if error is not None:
        failures.add(task.student, error)
    return True


def _by_itself(task: Task, workers_now: _Pool, keep: Callable[[Graded], None], failures: Failures) -> None:
    """Try a task for the second and last time, while no other runs."""
    future, patience = workers_now.submit(task), _patience(task)
    try:
        future.exception(patience)
    except TimeoutError:
        workers_now.renew()
        failures.said[task.student] = f"it could not be graded: it was stopped after {patience / 60:.0f} minutes"
        return
    if not _settled(task, future, keep, failures):
        failures.said[task.student] = "it could not be graded: the process that graded it died twice"


class _Pool:
    """Workers that are made again when one of them has died, or has to be ended."""

    def __init__(self, workers: Workers) -> None:
        self._workers, self.executor = workers, workers.pool()

    def submit(self, task: Task) -> Future[Graded]:
        """Begin to grade a task."""
        with starting_workers():
            try:
                return self.executor.submit(grade_one, task)
            except BrokenProcessPool:
                self.executor.shutdown(wait=False)
                self.executor = self._workers.pool()
                return self.executor.submit(grade_one, task)

    def renew(self) -> None:
        """End the workers, whatever they do, and make others."""
        self._workers.stop()
        self.executor.shutdown(wait=False, cancel_futures=True)
        self.executor = self._workers.pool()
