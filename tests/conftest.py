"""What every test may use: engines through `installed`, so that the suite passes where one is missing."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from reference.engines import Engine, load_engine
from reference.errors import EngineNotInstalled

pytest_plugins = ["oracles", "processor_time", "watchdog"]
AUTOGRADER = Path(__file__).parent / "autograder"


def pytest_configure(config: pytest.Config) -> None:
    """The same examples in every run, and no limit on the time of one: a busy machine must not fail a test."""
    if config.getoption("--submission"):
        return  # the plugin for grading has its own, and loads hypothesis only where tests need it
    from hypothesis import settings  # noqa: PLC0415

    settings.register_profile("lab", derandomize=True, deadline=None)
    settings.load_profile("lab")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Tests of a submission are none of the lab's: without one they are left out, unless they are asked for by name."""
    if collection_path != AUTOGRADER or config.getoption("--submission"):
        return None
    return True if not any(AUTOGRADER.name in argument for argument in config.args) else None


@pytest.fixture(autouse=True)
def cache_folder(tmp_path_factory, monkeypatch) -> Path:
    """A cache of the test's own: it neither finds what others kept nor fills the user's."""
    folder = tmp_path_factory.mktemp("cache")
    monkeypatch.setenv("COLLISIONS_CACHE", str(folder))
    return folder


@pytest.fixture(scope="session")
def installed() -> Callable[[str], Engine]:
    """Load an engine by name or by file; where its package is missing, the test is skipped and says so."""

    def load(name: str) -> Engine:
        engine = load_engine(name)
        try:
            engine.module()
        except EngineNotInstalled as error:
            pytest.skip(str(error))
        return engine

    return load
