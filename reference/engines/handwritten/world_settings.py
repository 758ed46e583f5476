"""The settings of the hand-written world for a scenario, and what it makes of contacts with them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from reference.engines.base import AT_STEP, WORLD, Method
from reference.engines.handwritten.scenario_kind import kind
from reference.engines.ranges import COUNT, NOT_NEGATIVE, SHARE, Allowed
from reference.engines.steering import unhurried
from reference.impact_truth import DISSIPATIVE
from reference.scene import geometry
from reference.scene.pressed import sweeps_needed
from reference.scene.scenario import Box, Scenario
from reference.scene.settings import Option, Settings, steps_per_sample

TIMESTEP, TIMESTEP_OF_STACKS = 1e-3, 2e-3
"""s. Boxes that stand on each other have many contacts, which take their turns many times, and nothing moves."""
LEAST_REACH = 1e-9
"""A gap of less than this is none, m."""
ALLOWED: Mapping[str, Allowed] = {
    "rest_threshold_steps": NOT_NEGATIVE,
    "contact_gap_falls": NOT_NEGATIVE,
    "overlap_slop": NOT_NEGATIVE,
    "overlap_recovery": SHARE,
    "sweeps": COUNT,
    "tolerance": SHARE,
    "push_sweeps": COUNT,
    "response": ("sequential", "simultaneous"),
}
"""What each option may be."""


def settings_of(scenario: Scenario) -> Settings:
    """Derive the settings of the profile `world`."""
    movable = [body for body in scenario.bodies if not body.immovable]
    boxes = all(isinstance(body.shape, Box) for body in movable) and geometry.starts_in_contact(scenario)
    stack, may_tip = boxes and len(movable) > 1, boxes and kind(scenario) is None
    timestep = TIMESTEP_OF_STACKS if stack else TIMESTEP
    options: dict[str, Option] = {
        # A rebound that takes fewer steps of gravity than this to come about is taken for rest.
        "rest_threshold_steps": 2.0,
        # The gap at which a contact counts, in falls of one step from rest, g dt²: a body at rest keeps its contacts.
        "contact_gap_falls": 1.0,
        "with_weight": False,
        # What is left of an overlap, m: a stack whose overlaps are all taken back is shaken by it.
        "overlap_slop": 1e-6,
        "overlap_recovery": 0.2,
        # One contact has its answer in one turn. A box on four corners that slides, or just holds, needs up to 2000
        # sweeps in its first step and hardly any later, because a step begins with what the last one has found. Edges
        # that tip, and stacks, would need hundreds in every step; what fewer leave has no effect that one can see.
        "sweeps": 200 if stack else 50 if may_tip else 2000,
        "tolerance": 1e-6 if stack else 1e-7 if may_tip else 1e-10,
        "push_sweeps": 20 if stack else 100 if may_tip else 200,
    }
    if sweeps_needed(scenario) > options["sweeps"]:  # type: ignore[operator]
        # Through a light body between heavy ones a sweep carries next to nothing; then all contacts are solved at once.
        options["response"] = "simultaneous"
    return unhurried(scenario, Settings(timestep, steps_per_sample(timestep), options=options))


def method_of(scenario: Scenario, settings: Settings) -> Method:
    """What the world does with a contact that it finds at the start of a step."""
    return Method(
        AT_STEP,
        recovery=settings.number("overlap_recovery"),
        rest_speed=rest_speed(scenario, settings),
        inset=0.5,  # impulses act halfway between the two surfaces
        weighed=float(bool(settings["with_weight"])),
        law=DISSIPATIVE,
        reach=reach(scenario, settings),
        rule=WORLD,
    )


def rules(scenario: Scenario, settings: Settings) -> tuple[float | str, ...]:
    """How a step responds to contacts, in the order in which `advance_world` takes it."""
    found = (
        rest_speed(scenario, settings),
        reach(scenario, settings),
        bool(settings["with_weight"]),
        settings.number("overlap_slop"),
        settings.number("overlap_recovery"),
        int(settings.number("sweeps")),
        settings.number("tolerance"),
        int(settings.number("push_sweeps")),
    )
    return (*found, str(settings["response"])) if "response" in settings.options else found


def rest_speed(scenario: Scenario, settings: Settings) -> float:
    """Speed of an approach up to which nothing rebounds, m/s; nothing rests where nothing is pulled."""
    return settings.number("rest_threshold_steps") * _gained(scenario, settings)


def reach(scenario: Scenario, settings: Settings) -> float:
    """Gap up to which there is a contact, m; some also without weight, because a gap of zero may be rounded."""
    return max(LEAST_REACH, settings.number("contact_gap_falls") * _gained(scenario, settings) * settings.timestep)


def _gained(scenario: Scenario, settings: Settings) -> float:
    """Speed that weight adds in a step, m/s."""
    return float(np.linalg.norm(scenario.gravity)) * settings.timestep
