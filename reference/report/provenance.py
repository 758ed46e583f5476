"""What a report was made with: engines and their versions, packages and the machine."""

from __future__ import annotations

import datetime
import importlib.metadata
import os
import platform
from collections.abc import Iterable, Mapping
from typing import Any

from reference.comparison.results import JobResult
from reference.engines.distributions import lab_version
from reference.engines.handwritten_engine import Handwritten
from reference.published.results import PublishedResult


def engine_versions(results: Iterable[JobResult]) -> dict[str, str]:
    """Version of each engine that ran, by title."""
    return {result.title: result.version for result in results if result.version}


def provenance(versions: Mapping[str, str]) -> dict[str, Any]:
    """When, on which machine and with which versions a report was made."""
    packages = {name: importlib.metadata.version(name) for name in ("numpy", "matplotlib")}
    return {
        "made": datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds"),
        "engines": dict(versions),
        "packages": packages,
        "python": platform.python_version(),
        "platform": platform.platform(),
        "processors": os.cpu_count(),
        "seed": None,  # nothing is drawn at random
    }


def compared(results: Iterable[JobResult] | Iterable[PublishedResult]) -> list[str]:
    """The implementations that ran, in a reader's words: an engine with its version, our own code without."""
    ran = {result.title: (result.job.engine, result.version) for result in results if result.version}
    by_hand = Handwritten.name
    return [f"{title} code" if name == by_hand else f"{title} {version}" for title, (name, version) in ran.items()]


def machine() -> str:
    """The lab's version, Python's and the machine, in one sentence of the page."""
    own = lab_version()
    return f"Collisions Lab {own}, Python {platform.python_version()} on {platform.system()} {platform.machine()}"
