"""Which engines are available on this machine, and how: live, from recordings, or not at all."""

from __future__ import annotations

from collections.abc import Iterator

from labs.desk.case_runs import ENGINES
from reference.catalogue.scenarios import catalogue
from reference.engines import load_engine
from reference.recording.files import content_of
from reference.running.availability import absent


def answering() -> Iterator[str]:
    """One line for each engine."""
    for name in ENGINES:
        engine = load_engine(name)
        if not absent(name):
            yield f"{engine.title} {engine.version()} runs here."
        elif any(content_of(name, family) for family in catalogue()):
            yield f"{engine.title} is not installed: its results come from recordings, at the recorded points."
        else:
            yield f"{engine.title} is not installed and has no recordings."
