"""Finds out whether the files of fingerprints still say what they would if they were made now."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from labs.grading.diagnosis.fingerprints import building
from labs.grading.diagnosis.fingerprints.reading import FOLDER, read

AGREES = 1e-6
"""How closely two machines' numbers agree: they differ in the last of 16 digits, or somewhat more if terms cancel."""


def stale(folder: Path | None = None, inheriting: bool = True) -> list[str]:
    """How the files differ from what they would say now, one line each; on request without what is inherited."""
    found = []
    for topic, content in building.build(inheriting=inheriting).items():
        path = (folder or FOLDER) / f"{topic}.json"
        if not path.exists():
            found.append(f"{topic}.json: there is none")
            continue
        made, kept = json.loads(building.lines(content)), json.loads(json.dumps(read(path)))
        for entry in () if inheriting else (*made["functions"].values(), *kept["functions"].values()):
            entry.pop("inherited", None)
        found += [f"{topic}.json: {place}" for place in _differences(made, kept, "")]
    return found


def _differences(made: Any, kept: Any, place: str) -> list[str]:
    if isinstance(made, dict) and isinstance(kept, dict):
        names = [*made, *(name for name in kept if name not in made)]
        return [line for name in names for line in _differences(made.get(name), kept.get(name), f"{place}/{name}")]
    if isinstance(made, list) and isinstance(kept, list) and len(made) == len(kept):
        pairs = enumerate(zip(made, kept, strict=True))
        return [line for i, (a, b) in pairs for line in _differences(a, b, f"{place}[{i}]")]
    if isinstance(made, int | float) and isinstance(kept, int | float):
        near = abs(made - kept) <= AGREES * (1 + max(abs(made), abs(kept)))
        return [] if near else [f"{place} is {kept}, now {made}"]
    return [] if made == kept else [f"{place} has changed"]
