"""What tests of the commands share: engines that fail, homework, a terminal of a known size, runs that nobody made."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import pytest
from made_results import absent, made
from odd_engine import write_engine
from program import EVERYTHING
from rich.console import Console

from labs.cli import jobs, show
from reference.comparison.results import Job


@pytest.fixture
def odd(tmp_path) -> Callable[..., str]:
    """Write an engine to a file, as `write_engine` does."""
    return lambda *body, **package: write_engine(tmp_path / "odd.py", *body, **package)


@pytest.fixture
def homework(tmp_path) -> Callable[[str], str]:
    """Write the solutions to a file, as a student hands them in, and below them what a test adds."""

    def write(added: str) -> str:
        path = tmp_path / "homework.py"
        path.write_text(EVERYTHING + added, encoding="utf-8")
        return str(path)

    return write


@pytest.fixture
def screen(monkeypatch):
    """A terminal of 80 × 24 without colour; call it for another size."""

    def resize(width: int = 80, height: int = 24) -> None:
        monkeypatch.setattr(show, "output", Console(width=width, height=height, force_terminal=True, color_system=None))

    resize()
    return resize


@pytest.fixture
def without_runs(monkeypatch):
    """Let the command get results that nobody ran, with those of some engines missing; counts the calls."""
    calls = []

    def use(*missing: str) -> list[list[Job]]:
        def run(planned, workers, cache, seconds):
            calls.append(list(planned))
            numbers = itertools.count(1)
            return [absent(job) if job.engine in missing else made(job, 0.1 + next(numbers) / 100) for job in planned]

        monkeypatch.setattr(jobs, "run", run)
        return calls

    return use
