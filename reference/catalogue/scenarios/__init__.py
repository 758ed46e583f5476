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
    "pellets",
    "passing_balls",
    "spinning_rods",
    "bouncing_ball",
    "one_drop",
    "walls",
    "friction",
    "critical_incline",
    "two_frictions",
    "break_away",
    "slab_off_the_axes",
    "creep",
    "rubbing_oscillator",
    "rolling",
    "two_balls",
    "struck_cube",
    "struck_floor",
    "dropped_box",
    "crossed_edges",
    "cradle",
    "mass_ratios",
    "rods",
    "spinning_ball",
    "superball",
    "tipping_box",
    "antipodal_circle",
    "crossing_streams",
    "lone_flier",
    "flock_past_pillar",
    "stacks",
    "projectile",
    "hanging_chain",
    "oscillator",
    "driven_oscillator",
    "sinking_ball",
    "convex_solid",
    "concave_solid",
    "ball_in_a_bowl",
    "step_limit",
    "orbit",
    "hanging_cloth",
    "jelly",
    "cloth_over_a_ball",
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
