"""The smallest faults that verdicts notice, kept in `sensitivity.json` beside this module for the report to read."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from reference.catalogue.scenarios import catalogue
from reference.comparison.sensitivity import Finding, Outcome, Sensitivity
from reference.engines import engine_names, load_engine
from reference.recording.files import read_json, write_json

SCHEMA, VERSION = "collisions-lab/sensitivity", 1
FILE = Path(__file__).with_name("sensitivity.json")
LINES_DOWN_TO = 4
"""Depth of the file down to which each entry has a line of its own: that of a profile."""


def as_content(found: Iterable[Sensitivity]) -> dict[str, Any]:
    """What a file holds of these: family → engine → profile, in order; a size is a share, or in degrees."""
    families: dict[str, Any] = {}
    for each in sorted(found, key=_place):
        entry = {"predicted": each.predicted, "faults": {finding.fault: _entry(finding) for finding in each.findings}}
        families.setdefault(each.family, {}).setdefault(each.engine, {})[each.profile] = entry
    return {"schema": SCHEMA, "version": VERSION, "families": families}


def keep(found: Iterable[Sensitivity], file: Path | None = None) -> None:
    """Write these to the file that the report reads, and leave there what was kept of other runs.

    What belongs to a family or an engine that the lab no longer has is left out.
    """
    known, engines = catalogue(), engine_names()
    kept = {(each.family, each.engine, each.profile): each for each in (*read(file), *found)}
    current = [each for each in kept.values() if each.family in known and each.engine in engines]
    write_json(file or FILE, as_content(current), LINES_DOWN_TO)
    _read.cache_clear()


def read(file: Path | None = None) -> tuple[Sensitivity, ...]:
    """What is kept; nothing where there is no file.

    Raises
    ------
    InvalidInput
        If the file holds something else, or another version.
    """
    return _read(file or FILE)


@functools.cache
def _read(file: Path) -> tuple[Sensitivity, ...]:
    content = read_json(file, SCHEMA, VERSION) or {"families": {}}
    return tuple(
        Sensitivity(family, engine, load_engine(engine).title, profile, entry["predicted"], _findings(entry["faults"]))
        for family, engines in content["families"].items()
        for engine, profiles in engines.items()
        for profile, entry in profiles.items()
    )


def _place(found: Sensitivity) -> tuple[int, int]:
    families, engines = list(catalogue()), engine_names()
    engine = engines.index(found.engine) if found.engine in engines else len(engines)
    return families.index(found.family), engine


def _entry(finding: Finding) -> dict[str, Any]:
    whole = asdict(finding)
    del whole["fault"]
    return {name: value for name, value in whole.items() if value not in (None, "")}


def _findings(faults: dict[str, Any]) -> tuple[Finding, ...]:
    return tuple(Finding(name, **entry | {"outcome": Outcome(entry["outcome"])}) for name, entry in faults.items())
