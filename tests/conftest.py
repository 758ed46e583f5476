"""What every test may use: engines through `installed`, so that the suite passes where one is missing."""

from __future__ import annotations

import gc
import itertools
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import Any

import pytest

from reference.engines import Engine, load_engine
from reference.errors import EngineNotInstalled

pytest_plugins = ["oracles", "processor_time", "skips"]
AUTOGRADER = Path(__file__).parent / "autograder"
LAB_FIGURES = Path(__file__).parents[1] / "labs" / "figures"


def pytest_configure(config: pytest.Config) -> None:
    """Refuse a clone without built files; draw the same examples in every run, without a time limit for one.

    A busy machine must not fail a test.

    `make test` draws 15 examples for a property, and `make weekly` 50 others with a seed of its own. `make verify`
    draws 50 for the properties that are slow.
    """
    if config.getoption("--submission"):
        return  # the plugin for grading has its own, and loads hypothesis only where tests need it
    if not any(LAB_FIGURES.glob("*.svg")):
        raise pytest.UsageError("The figures of the labs are not drawn here. `make docs` draws them, before any test.")
    from hypothesis import settings  # noqa: PLC0415

    draw_without_constants_of_modules()
    lab = settings(derandomize=True, deadline=None, max_examples=15)
    settings.register_profile("lab", lab)
    settings.register_profile("more", lab, max_examples=50)
    settings.register_profile("others", lab, max_examples=50, derandomize=False, database=None)
    settings.load_profile("lab")


def draw_without_constants_of_modules() -> None:
    """Make examples depend on the test alone.

    About one time in twenty hypothesis draws a constant, and half of these it reads from the source of the modules
    of ours that happen to be imported. So a test would get other examples in its own file than in the whole suite.
    """
    from hypothesis.internal.conjecture import providers  # noqa: PLC0415

    if hasattr(providers, "_get_local_constants"):  # since hypothesis 6.131; there is no setting for it
        providers._get_local_constants = providers.Constants  # which has none


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, Any, Any]:
    """Have Python search for garbage among what the tests make, not among what was collected.

    Collecting makes millions of objects that stay until the end, and all of them were searched again and again.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Tests of a submission are none of the lab's: without one they are left out, unless they are asked for by name."""
    if collection_path != AUTOGRADER or config.getoption("--submission"):
        return None
    return True if not any(AUTOGRADER.name in argument for argument in config.args) else None


@pytest.fixture(scope="session")
def cache_folders(tmp_path_factory) -> Iterator[Path]:
    """Names of folders that are not there yet: few of thousands of tests keep anything."""
    return map(tmp_path_factory.mktemp("caches").joinpath, map(str, itertools.count()))


@pytest.fixture(autouse=True)
def cache_folder(cache_folders, monkeypatch) -> Path:
    """A cache of the test's own: it neither finds what others kept nor fills the user's."""
    folder = next(cache_folders)
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
