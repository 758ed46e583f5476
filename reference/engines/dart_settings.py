"""The settings of DART's profiles for a scenario, and by which rule DART steps with them."""

from __future__ import annotations

from reference.engines import dart_surveyor, surveying
from reference.engines.base import ANSWERS_IN_SINGLE, AT_STEP, CIRCLE, DART, DART_JOINT, EXACT, SQUARE, Method
from reference.engines.profiles import JOINT, STOCK
from reference.engines.sliding_joint import has_joint
from reference.engines.steering import sampled, unhurried
from reference.scene import geometry
from reference.scene.draping import ball_under
from reference.scene.off_centre import may_strike_off_centre
from reference.scene.pressed import sweeps_needed
from reference.scene.scenario import Box, HalfSpace, Scenario, Sphere
from reference.scene.settings import Option, Settings, steps_per_sample
from reference.scene.survey import Survey

REST_SPEED = 0.1
"""DART lets a body rest whose rebound would be slower than this, m/s; a constant of its source."""
SOFTNESS = 1e-5
"""Share of the change of speed by which an impact falls short; a constant of DART's source too."""


def settings_of(scenario: Scenario, profile: str) -> Settings:
    """Derive the settings of a profile. An option that is absent is left at DART's default."""
    if isinstance(scenario, Survey):
        return surveying.settings_of(**dart_surveyor.SETTINGS)
    if profile == STOCK:
        return sampled(scenario, Settings(1e-3))
    if profile == JOINT:
        return Settings(1e-3, options={"springs": JOINT})
    boxes = any(isinstance(body.shape, Box) and not body.immovable for body in scenario.bodies)
    options: dict[str, Option] = {
        "detector": "dart",
        # Of a box on a plane DART finds one contact point, of a box on a box all four at once.
        "ground": "box" if boxes else "plane",
        # Overlap comes back without speed, or what rests would have up to 1 mm/s.
        "split_impulse": True,
        "sleep": False,
    }
    on_the_ground = any(isinstance(body.shape, HalfSpace) for body in scenario.bodies)
    if may_strike_off_centre(scenario, smooth=True) and on_the_ground:
        # Of a corner that digs into a box DART's own detector also gives points where the surfaces cut each other.
        options["detector"] = "ode"
    if _boxes_strike(scenario):
        # Nor does it find where two edges cross: impulses were up to 6 % off.
        options["detector"] = "fcl"
    if geometry.leaning(scenario) and boxes:
        # The default solver, by pivots, has a stack at once; sweeps go from one contact to the next. Its friction
        # cone is a pyramid, which does not matter where nothing slides.
        options["solver"] = "dantzig"
    elif boxes:
        # Four corners are one more than it takes to carry a box: sweeps converge slowly, and stop near enough.
        options |= {"solver": "nsgs", "solver_tolerance": 1e-7, "solver_iterations": 200}
    else:
        sweeps = max(1000, sweeps_needed(scenario))
        options |= {"solver": "nsgs", "solver_tolerance": 1e-12, "solver_iterations": sweeps}
    if not scenario.pairs:
        return unhurried(scenario, Settings(1e-3, options=options))  # no instant of an impact can be missed
    if geometry.starts_in_contact(scenario) and not any(pair.restitution for pair in scenario.pairs):
        if not geometry.leaning(scenario):
            # At a gap of exactly zero rounding decides whether a ball touches in the first step; on ground that is
            # so much higher it does.
            options["margin"] = 1e-9
        return Settings(1e-3, options=options)
    if ball_under(scenario):
        return Settings(1e-3, options=options)  # nothing rebounds, and what an impact leaves of overlap comes back
    # Only a small timestep removes what a step does to an impact: DART takes back hardly any overlap.
    return unhurried(scenario, Settings(1e-4, steps_per_sample(1e-4), options))


def method_of(scenario: Scenario, settings: Settings) -> Method:
    """DART responds at the step, to the speed that this step has just gained; a ball is pushed where it is cut."""
    if isinstance(scenario, Survey):
        return Method(EXACT, rule=ANSWERS_IN_SINGLE)
    if has_joint(settings):
        return Method(AT_STEP, rule=DART_JOINT)
    bouncing = [pair.restitution for pair in scenario.pairs if pair.restitution > 0]
    slowest = REST_SPEED / min(bouncing) if bouncing else 0.0
    # Open Dynamics Engine's detector gives the corner itself, but of a ball a point on the other surface.
    at_corners = settings.options.get("detector") == "ode" and not any(
        isinstance(body.shape, Sphere) for body in scenario.bodies
    )
    inset = 0.0 if at_corners else 1.0
    cone = SQUARE if settings.options.get("solver", "dantzig") == "dantzig" else CIRCLE
    return Method(AT_STEP, rest_speed=slowest, inset=inset, softness=SOFTNESS, weighed=1.0, rule=DART, cone=cone)


def _boxes_strike(scenario: Scenario) -> bool:
    """Whether two boxes may strike each other that are apart at the start."""
    pairs = ((scenario.body(pair.body_a), scenario.body(pair.body_b)) for pair in scenario.pairs)
    boxes = any(isinstance(a.shape, Box) and isinstance(b.shape, Box) for a, b in pairs)
    return boxes and not geometry.starts_in_contact(scenario)
