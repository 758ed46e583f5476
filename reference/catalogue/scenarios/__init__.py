"""The catalogue: one module a subject, each with its `FAMILIES`. A new module is one more name in `MODULES`."""

from __future__ import annotations

import functools
import importlib

from reference import lecture
from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.errors import UnknownName

MODULES = (
    "tunnelling",
    "bouncing_ball",
    "walls",
    "friction",
    "critical_incline",
    "two_frictions",
    "rolling",
    "two_balls",
    "struck_cube",
    "struck_floor",
    "dropped_box",
    "cradle",
    "rods",
    "spinning_ball",
    "tipping_box",
    "stacks",
)
"""In the order of the report within each topic. They are loaded together, and only once somebody needs the catalogue:
a thousand scenarios take 50 ms to build."""


@functools.cache
def catalogue() -> dict[str, Family]:
    """All families by name, in the order of teaching."""
    order = {topic.name: place for place, topic in enumerate(lecture.TOPICS)}
    modules = [importlib.import_module(f"{__name__}.{name}") for name in MODULES]
    families = [family for module in modules for family in module.FAMILIES]
    return {family.name: family for family in sorted(families, key=lambda family: order[family.topic])}


def find(name: str) -> tuple[Family, Case | None]:
    """Return the family, or the family and one of its cases, that `family` or `family/case` names."""
    family_name, slash, case_name = name.partition("/")
    families = catalogue()
    if family_name not in families:
        raise UnknownName("scenario", name, families)
    family = families[family_name]
    return family, family.case(case_name) if slash else None
