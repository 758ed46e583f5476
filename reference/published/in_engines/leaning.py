"""A published ladder in the engines: whether it holds."""

from __future__ import annotations

import math
from dataclasses import replace

from reference.catalogue import measure
from reference.engines.base import Engine
from reference.published.answers import Answer, Answers
from reference.published.case import Published
from reference.published.in_engines.scenes import gravity_of
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario

THIN, WIDE = 5e-3, 0.3
"""Half of the ladder's thickness and of its width, m. Its thickness changes the least coefficient by a thousandth."""
LEANS = 0.5
"""How long it is watched, s: at μ = 0.37 it slips by 13 mm."""
RESTS = 1e-3
"""A ladder that moves less than this holds, m."""
NO_FORCES = "the lab does not ask an engine for the forces of its contacts"


def ladder(case: Published, engine: Engine) -> Answers:
    """P41: whether the ladder holds, with a coefficient on either side of the least one."""
    holds = []
    for friction in case.numbers("tried_friction"):
        scenario = _leaning(case, friction)
        settings = engine.settings(scenario, "tuned")
        run = engine.run(scenario, replace(settings, sample_every=round(LEANS / 2 / settings.timestep)))
        holds.append(float(measure.displacement(run, "ladder") < RESTS))
    return {name: Answer(None, reason=NO_FORCES) for name in case.expected} | {"holds": Answer(tuple(holds))}


def _leaning(case: Published, friction: float) -> Scenario:
    """A thin box whose lower edge is on the floor and whose upper edge is at a wall to its right."""
    half, angle = case.value("length") / 2, math.radians(case.value("angle"))
    right, up = math.cos(angle), math.sin(angle)
    turned = (math.cos(angle / 2), 0.0, -math.sin(angle / 2), 0.0)
    place = (-half * right - THIN * up, 0.0, half * up + THIN * right)
    leaning = Body("ladder", Box((half, WIDE, THIN)), case.value("weight") / gravity_of(case), place, turned)
    pairs = (Pair("ladder", "floor", 0.0, friction), Pair("ladder", "wall"))
    bodies = (Body("floor", HalfSpace()), Body("wall", HalfSpace((-1.0, 0.0, 0.0))), leaning)
    return Scenario(case.name, bodies, pairs, LEANS, (0.0, 0.0, -gravity_of(case)))
