"""The catalogue: one module per topic, each with its `FAMILIES`. A new family is an entry there and nothing else."""

from __future__ import annotations

import functools
import importlib
import pkgutil
from pathlib import Path

from reference import lecture
from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.errors import UnknownName


@functools.cache
def catalogue() -> dict[str, Family]:
    """All families by name, in the order of teaching."""
    order = {topic.name: place for place, topic in enumerate(lecture.TOPICS)}
    families = [family for module in _modules() for family in _families(module)]
    return {family.name: family for family in sorted(families, key=lambda family: order[family.topic])}


def family(name: str) -> Family:
    """Return one family, without loading all modules where the source tells which one has it."""
    for module in _modules():
        source = Path(__path__[0], f"{module}.py")
        if source.is_file() and f'"{name}"' in source.read_text(encoding="utf-8"):
            for found in _families(module):
                if found.name == name:
                    return found
    return find(name)[0]


def find(name: str) -> tuple[Family, Case | None]:
    """Return the family, or the family and one of its cases, that `family` or `family/case` names."""
    family_name, slash, case_name = name.partition("/")
    families = catalogue()
    if family_name not in families:
        raise UnknownName("scenario", name, families)
    family = families[family_name]
    return family, family.case(case_name) if slash else None


def _modules() -> list[str]:
    return [info.name for info in pkgutil.iter_modules(__path__)]


def _families(module: str) -> tuple[Family, ...]:
    return tuple(importlib.import_module(f"{__name__}.{module}").FAMILIES)
