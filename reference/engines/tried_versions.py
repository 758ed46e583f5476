"""Which versions of an engine the lab was tried with: the bounds that `pyproject.toml` gives for its extra."""

from __future__ import annotations

import functools
import importlib.metadata

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name
from packaging.version import InvalidVersion, Version

from reference.engines.base import Engine


def warning(engine: Engine, version: str, distribution: str = "") -> str:
    """A sentence if a version of an engine is outside of the bounds; empty if it is within, or if there are none.

    An engine may come from one of several distributions, each with bounds of its own; from which, where it is known.
    """
    sources = [distribution] if distribution in engine.sources() else engine.sources()
    bounds = {name: each for name in sources if (each := _bounds().get(canonicalize_name(name)))}
    if not version or not bounds or any(_within(each, version) for each in bounds.values()):
        return ""
    tried = " or ".join(f"{name}{','.join(sorted(map(str, each), reverse=True))}" for name, each in bounds.items())
    return (
        f"{engine.title} {version} is none of the versions that the lab was tried with ({tried}): its numbers may"
        " differ, or it may not run."
    )


def _within(bounds: SpecifierSet, version: str) -> bool:
    try:
        return bounds.contains(Version(version), prereleases=True)
    except InvalidVersion:
        return False


@functools.cache
def _bounds() -> dict[str, SpecifierSet]:
    """The bounds of each required package, as the installed lab says; none where it is not installed."""
    try:
        required = importlib.metadata.requires("collisions-lab") or []
    except importlib.metadata.PackageNotFoundError:
        return {}
    every = map(Requirement, required)
    return {canonicalize_name(each.name): each.specifier for each in every if each.specifier}
