"""What MuJoCo's compiled model says, compared with what the scenario and the settings mean.

All that the adapter sets is in the model. The restitution is read out of the contact's damping.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from reference import truth
from reference.engines import read_back
from reference.scene import leaping
from reference.scene.scenario import Pair, Scenario
from reference.scene.settings import Settings

TITLE = "MuJoCo"
DIMENSIONS = 3
"""Of a contact's force: along the normal and in two directions along the surface. With one there is no friction."""
MOST_DAMPED = 5.0
"""Damping ratio of a spring that stands for e = 0, which has no finite one: it rebounds with 1 % of the speed."""


def dimensions(settings: Settings) -> int:
    """Dimensions of a contact's force."""
    return 1 if settings.options.get("frictionless") else DIMENSIONS


def margin_of(scenario: Scenario, settings: Settings) -> float:
    """The gap up to which MuJoCo makes a contact, m."""
    if "margin_steps" in settings.options:
        return settings.number("margin_steps") * leaping.way_of_a_step(scenario, settings.timestep)
    return settings.number("margin") if "margin" in settings.options else 0.0


def check_world(mujoco: Any, model: Any, scenario: Scenario, settings: Settings) -> None:
    """Refuse a model that is not what the scenario and the settings mean."""
    read_back.check(TITLE, "timestep", settings.timestep, model.opt.timestep, "s")
    read_back.check(TITLE, "gravity", scenario.gravity, model.opt.gravity, "m/s²")
    reset = int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    read_back.check(TITLE, "disableflags", reset, model.opt.disableflags)
    for name, enumeration in (("integrator", mujoco.mjtIntegrator), ("cone", mujoco.mjtCone)):
        found = enumeration(getattr(model.opt, name)).name.partition("_")[2]
        read_back.check(TITLE, name, str(settings[name]).upper(), found)
    if "impratio" in settings.options:
        for name in ("impratio", "noslip_iterations"):
            read_back.check(TITLE, name, settings.number(name), getattr(model.opt, name))
        read_back.check(TITLE, "noslip_tolerance", 0.0, model.opt.noslip_tolerance)
    masses = [mass if dofs else math.inf for mass, dofs in zip(model.body_mass, model.body_dofnum, strict=True)]
    read_back.check_bodies(TITLE, scenario, masses[1:], model.body_inertia[1:])  # body 0 is the world
    for body, axes in zip(scenario.bodies, model.body_iquat[1:], strict=True):
        if not body.immovable:
            read_back.check(TITLE, f"turn of the axes of inertia of {body.name}", (1, 0, 0, 0), axes)
    if settings["contact"] == "default":
        _check_geoms(model, scenario)
    else:
        _check_pairs(model, scenario, settings)


def _check_geoms(model: Any, scenario: Scenario) -> None:
    """Of two geoms that touch, MuJoCo takes the larger friction."""
    own = dict(zip((model.geom_bodyid - 1).tolist(), model.geom_friction[:, 0], strict=True))
    for pair in scenario.pairs:
        friction = [own[scenario.index(name)] for name in (pair.body_a, pair.body_b)]
        read_back.check_pair(TITLE, "friction", pair, pair.kinetic_friction, max(friction))


def _check_pairs(model: Any, scenario: Scenario, settings: Settings) -> None:
    bodies = dict(enumerate((model.geom_bodyid - 1).tolist()))  # body 0 is the world
    geoms = zip(model.pair_geom1.tolist(), model.pair_geom2.tolist(), strict=True)
    made = [frozenset((bodies.get(first), bodies.get(second))) for first, second in geoms]
    for pair in scenario.pairs:
        both = [scenario.index(pair.body_a), scenario.index(pair.body_b)]
        places = [place for place, two in enumerate(made) if two == frozenset(both)]
        # A solid has a geom for each of its pieces.
        told = math.prod(list(bodies.values()).count(body) for body in both)
        read_back.check_pair(TITLE, "contact pairs", pair, told, len(places))
        for place in places:
            _check_pair(model, place, scenario, pair, settings)


def _check_pair(model: Any, place: int, scenario: Scenario, pair: Pair, settings: Settings) -> None:
    read_back.check_pair(TITLE, "dimensions of the contact", pair, dimensions(settings), int(model.pair_dim[place]))
    for axis in range(2):
        read_back.check_pair(TITLE, "friction", pair, pair.kinetic_friction, model.pair_friction[place, axis])
    for number in range(2):
        impedance = model.pair_solimp[place, number]
        read_back.check_pair(TITLE, "impedance", pair, settings.number("impedance"), impedance)
    margin = margin_of(scenario, settings)
    read_back.check_pair(TITLE, "margin", pair, margin, model.pair_margin[place])
    if settings["contact"] == "one step":
        _check_one_step(pair, model.pair_solref[place], model.pair_solreffriction[place], settings)
    else:
        _check_spring(pair, model.pair_solref[place], settings)


def _check_one_step(pair: Pair, solref: Sequence[float], along: Sequence[float], settings: Settings) -> None:
    """A damping of (1 + e)/dt turns v into −e v in one step; one of 1/dt takes away the slip."""
    dt = settings.timestep
    recovery = settings.number("overlap_recovery")
    read_back.check_pair(TITLE, "overlap_recovery", pair, recovery, -solref[0] * dt**2)
    read_back.check_pair(TITLE, "1 + restitution", pair, 1 + pair.restitution, -solref[1] * dt)
    read_back.check_pair(TITLE, "share of the slip that a step takes away", pair, 1.0, -along[1] * dt)


def _check_spring(pair: Pair, solref: Sequence[float], settings: Settings) -> None:
    """The restitution of a spring and a dashpot follows from its damping ratio, c/(2√k)."""
    read_back.check_pair(TITLE, "stiffness", pair, settings.number("stiffness"), -solref[0])
    found = truth.spring_dashpot_restitution(-solref[1] / (2 * math.sqrt(-solref[0])))
    least = truth.spring_dashpot_restitution(MOST_DAMPED)
    read_back.check_pair(TITLE, "restitution", pair, max(pair.restitution, least), found)
