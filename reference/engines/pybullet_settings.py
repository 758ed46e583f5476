"""The settings of PyBullet's profiles for a scenario, and by which rule Bullet steps with them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from reference.engines import pybullet_surveyor, surveying
from reference.engines.base import (
    ANSWERS_OF_BULLET,
    AT_STEP,
    BULLET,
    BULLET_DAMPED,
    BULLET_SPRING,
    CIRCLE,
    COMPLIANT,
    EXACT,
    SQUARE,
    Method,
)
from reference.engines.profiles import SWEPT
from reference.scene import geometry
from reference.scene.draping import ball_under
from reference.scene.off_centre import may_strike_off_centre
from reference.scene.pressed import sweeps_needed
from reference.scene.scenario import Box, Scenario
from reference.scene.settings import Option, Settings, steps_per_sample
from reference.scene.survey import Survey
from reference.spatial_impact import BY_AXES

STOCK_TIMESTEP = 1 / 240
STOCK_REST_SPEED = 0.2
"""Bullet's default for the relative speed below which it lets a contact rest, m/s."""
STOCK_DAMPING = 0.04
"""Bullet's default for the damping d of a multibody, 1/s: it takes d (1 + v) v per second from v and from the spin."""
MARGIN = 1e-3
"""By how much Bullet makes a hull thicker, unless it is told otherwise, and rounds the edges of a box, m."""
SWEEP_TOLERANCE = 1e-3
"""A swept ball that starts no farther than this from a surface, m, touches it at once: btContinuousConvexCollision."""
SWEPT_INSET = 1.1 * SWEEP_TOLERANCE
"""By how much the ball that Bullet sweeps is smaller than the body, m. If it were less than the tolerance, a ball could
stop in the air: what is swept touches at once, with an impact that has no restitution, and the body does not touch."""
SPRING_STIFFNESS = 1e6
"""Stiffness per unit mass of the `spring` profile, 1/s²: a contact lasts about π ms and a 1 m drop sinks in 4.4 mm."""
SPRING_TIMESTEP = 5e-5
"""Timestep of the `spring` profile, s: √stiffness · timestep = 0.05 gives some sixty steps a contact."""


def settings_of(scenario: Scenario, profile: str) -> Settings:
    """Derive the settings of a profile. An option that is absent is left at Bullet's default."""
    options: dict[str, Option]
    if isinstance(scenario, Survey):
        return surveying.settings_of(**pybullet_surveyor.SETTINGS[profile])

    # Told the vertices of a mesh, Bullet makes their hull; told its faces as well, it keeps the triangles.
    def solid(told: str) -> dict[str, Option]:
        return {surveying.CONTACTS_OF: told} if scenario.meets_a_solid else {}

    if profile == "stock":
        return Settings(STOCK_TIMESTEP, options={"coordinates": "multibody", **solid(surveying.HULL)})
    restitution = max((pair.restitution for pair in scenario.pairs), default=0.0)
    movable = [body for body in scenario.bodies if not body.immovable]
    boxes = any(isinstance(body.shape, Box) for body in movable)
    undamped: dict[str, Option] = {"linear_damping": 0.0, "angular_damping": 0.0, "contact_slop": 0.0}
    undamped |= solid(surveying.TRIANGLES)
    if profile == "spring":
        options = {
            "coordinates": "maximal",
            **undamped,
            # Contacts that count ahead of the touch would take 2.4 % from the rebound at e = 0.5.
            "contact_gap_falls": 0.0,
            "split_impulse": False,  # it would take deep overlap away from the spring
            "solver_iterations": 50,
            "solver_residual": 0.0,
            "stiffness": SPRING_STIFFNESS,
            "spring_of": "world",
        }
        return Settings(SPRING_TIMESTEP, steps_per_sample(SPRING_TIMESTEP), options)
    # On a plane Bullet finds one more contact point of a box in each step; on a large box all four at once.
    ground: dict[str, Option] = {"ground": "box"} if boxes else {}
    sweeps = 200 if len(movable) == 1 else max(100, sweeps_needed(scenario))
    firm: dict[str, Option] = {"solver_iterations": sweeps, "solver_residual": 0.0}
    if ball_under(scenario):
        # A mass that rests with a gap of zero touches or not as rounding decides; one that is in by so little does.
        undamped["contact_slop"] = 1e-9
    if restitution == 0 and geometry.starts_in_contact(scenario):
        options = {"coordinates": "multibody", **undamped, **ground, **firm}
        if boxes and not geometry.leaning(scenario):
            # Bullet finds a contact of two boxes only where they overlap. At a gap of exactly zero rounding decides
            # in which steps it does. On ground that is a margin higher, with an overlap of the margin allowed, it
            # always does.
            options |= {"margin": 1e-9, "contact_slop": 1e-9}
        return Settings(1e-3, options=options)
    if may_strike_off_centre(scenario):
        return _settings_off_centre({**undamped, **ground, **firm})
    options = {
        "coordinates": "maximal",
        **undamped,
        # A rebound slower than this many steps of gravity is taken for rest. Without it micro-bounces never end.
        "rest_threshold_steps": 3.0,
        # The share of the overlap that makes the mean error of a rebound vanish; see truth.rebound_shift_at_step.
        "contact_erp": 1.0 - restitution,
        "split_impulse": True,
        # The gap at which a contact counts, in falls of one step from rest, g dt². A gap of several falls
        # spoils a ball's rebound; with none, a box that has landed askew rocks from corner to corner without end.
        "contact_gap_falls": 1.0 if boxes else 0.0,
        **ground,
        **(firm if boxes or len(movable) > 1 else {"solver_iterations": 50}),
    }
    if profile == SWEPT:
        # By default Bullet sweeps only where a step goes 40 mm along the normal.
        options |= {"swept_inset": SWEPT_INSET, "sweep_from": 0.0}
    return Settings(1e-3, options=options)


def _settings_off_centre(common: Mapping[str, Option]) -> Settings:
    """Settings for impacts off the centre with friction: multibodies, whose friction has a cone.

    In a multibody overlap comes back as speed, so none is taken back, and a small timestep keeps it small.
    """
    options: dict[str, Option] = {
        "coordinates": "multibody",
        **common,
        "rest_threshold_steps": 3.0,
        "contact_erp": 0.0,
        # A contact that is made while there is a gap loses gap/dt of its rebound.
        "contact_gap_falls": 0.0,
    }
    return Settings(1e-4, steps_per_sample(1e-4), options)


def method_of(scenario: Scenario, settings: Settings) -> Method:
    """A spring yields. Else Bullet resolves an impact at the step, and split impulses take overlap back."""
    if isinstance(scenario, Survey):
        return Method(EXACT, rule=ANSWERS_OF_BULLET)
    if "stiffness" in settings.options:
        return Method(COMPLIANT, stiffness=settings.number("stiffness"), rule=BULLET_SPRING)
    free = scenario.in_flight or scenario.steering  # nobody means to touch anybody
    if free and settings["coordinates"] == "multibody" and "linear_damping" not in settings.options:
        return Method(AT_STEP, rule=BULLET_DAMPED)
    rest_speed = rest_speed_of(scenario, settings)
    rule, cone = BULLET if _is_known(scenario, settings) else "", _cone_of(settings)
    if settings["coordinates"] == "multibody" and "rest_threshold_steps" in settings.options:
        return Method(AT_STEP, rest_speed=rest_speed, weighed=1.0, law=BY_AXES, rule=rule, cone=cone)
    split = settings.options.get("split_impulse") is True
    recovery = settings.number("contact_erp") if split else 0.0
    falls = settings.number("contact_gap_falls") if "contact_gap_falls" in settings.options else 0.0
    reach = falls * gravity_of(scenario) * settings.timestep**2
    return Method(AT_STEP, recovery, rest_speed=rest_speed, reach=reach, rule=rule, cone=cone)


def _cone_of(settings: Settings) -> str:
    """A circle, but a square if Bullet is told so, or if bodies are in maximal coordinates: those know no other."""
    told = bool(settings.options.get("cone_friction", 1))
    return CIRCLE if told and settings["coordinates"] == "multibody" else SQUARE


def _is_known(scenario: Scenario, settings: Settings) -> bool:
    """Whether the rule in `reference.prediction` holds: nothing damps, and overlap does not come back as speed.

    A multibody turns back the speed that the step has already changed, and its overlap comes back as speed. So the rule
    is right without restitution, or without weight if overlap is left alone.
    """
    options = settings.options
    if options.get("linear_damping") != 0 or options.get("angular_damping") != 0:
        return False
    if options["coordinates"] == "maximal":
        return options.get("split_impulse") is True or options.get("contact_erp") == 0
    if any(pair.restitution > 0 for pair in scenario.pairs):
        return options.get("contact_erp") == 0 and not any(scenario.gravity)
    return True


def rest_speed_of(scenario: Scenario, settings: Settings) -> float:
    """The relative speed, m/s, below which Bullet lets a contact rest."""
    if "rest_threshold_steps" not in settings.options:
        return STOCK_REST_SPEED
    return settings.number("rest_threshold_steps") * settings.timestep * gravity_of(scenario)


def gravity_of(scenario: Scenario) -> float:
    """Size of the acceleration of free fall, m/s²."""
    return float(np.linalg.norm(scenario.gravity))
