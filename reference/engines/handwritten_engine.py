"""Hand-written code as an engine: it picks driver and policy, and `solutions` (or a student) does the physics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from reference.engines import profiles, surveying
from reference.engines.base import (
    ANSWERS_EXACT,
    AT_STEP,
    CHORD,
    COMPLIANT,
    EXACT,
    EXPLICIT,
    INTERPOLATED,
    PENALTY,
    RESPOND_THEN_STEP,
    RUNGE_KUTTA,
    STEP_THEN_PUT_OUT,
    TURN_BACK,
    VERLET,
    Engine,
    Method,
)
from reference.engines.handwritten import (
    ball_over_plane,
    ball_rows,
    balls_between_planes,
    corner_impact,
    flight,
    pushed_slabs,
    queries,
    rubbing_slabs,
    slabs,
    spinning_boxes,
    spring_meshes,
    surveyor,
    thin_wall,
    two_bodies,
    world,
    world_settings,
)
from reference.engines.handwritten.scenario_bodies import planes_met
from reference.engines.handwritten.scenario_kind import Kind, kind, laws_may_part
from reference.engines.ranges import NOT_NEGATIVE, POSITIVE, Allowed
from reference.errors import InvalidInput, RunFailed
from reference.impact_truth import DISSIPATIVE, NEWTON, POISSON, STRONGE
from reference.scene import geometry
from reference.scene.query import Query
from reference.scene.scenario import Scenario
from reference.scene.settings import Option, Settings, steps_per_sample
from reference.scene.survey import Survey
from reference.scene.trajectory import Trajectory
from reference.spatial_impact import ALONG_GRIP

BOUNCES = Kind.BOUNCE, Kind.WALLS
"""The kinds for which the slide's T is a method too: the surfaces are planes, and the ball comes back."""

POLICIES = {
    "exact_root": EXACT,
    "interpolated": INTERPOLATED,
    "at_step": AT_STEP,
    "penalty": COMPLIANT,
    "closed_form": EXACT,
    **dict.fromkeys(flight.INTEGRATORS, AT_STEP),
}
POLICIES_IN_FLIGHT = {
    profiles.EXACT: "closed_form",
    "runge-kutta": "runge_kutta",
    "verlet": "verlet",
    "explicit": "explicit",
    profiles.STEP: "semi_implicit",
}
"""Of what meets nothing: there is no instant to look for."""
RULES = {INTERPOLATED: CHORD, AT_STEP: RESPOND_THEN_STEP, COMPLIANT: PENALTY}
"""The recurrences of the policies that have one; the exact root gives what theory says."""
RULES_AT_A_WALL = {AT_STEP: TURN_BACK}
"""The same for a ball that flies at a thin wall, of which `overlap_interval` sees both faces."""
RULES_ON_A_BALL = {AT_STEP: STEP_THEN_PUT_OUT}
"""The same for a mesh on a ball, whose nodes respond where a step has taken them."""
RULES_OF_KINDS: Mapping[Kind | None, Mapping[str, str]] = {Kind.THIN_WALL: RULES_AT_A_WALL, Kind.DRAPE: RULES_ON_A_BALL}
RULES_OF_INTEGRATORS = {"explicit": EXPLICIT, "verlet": VERLET, "runge_kutta": RUNGE_KUTTA}
"""The recurrences of the policies that are integrators; semi-implicit Euler is every other step method's."""

LAWS = {
    DISSIPATIVE: "exact root, maximal dissipation",
    POISSON: "exact root, Poisson's restitution",
    STRONGE: "exact root, Stronge's restitution",
}
"""The profiles for the laws of an impact with friction that are not Newton's, where the laws can part."""

SPRING_STIFFNESS = 1e6
"""Stiffness per unit mass of the profile `spring`, 1/s², that of the engines: a contact lasts about π ms."""
SPRING_TIMESTEP = 5e-5
"""Timestep of the profile `spring`, s: √stiffness · timestep = 0.05 gives some sixty steps a contact."""
LONGEST_SPRING = 0.4
"""s. A spring takes 20,000 steps a second. Scenarios that last longer have no such profile: they would take seconds."""

IN_THE_WORLD = "rigid-body world"
DRIVERS = {
    Kind.BOUNCE: ball_over_plane.bounce,
    Kind.WALLS: balls_between_planes.fly,
    Kind.SLIDE: slabs.slide,
    Kind.PUSHED: pushed_slabs.break_away,
    Kind.SWINGING: rubbing_slabs.swing,
    Kind.THIN_WALL: thin_wall.shoot,
    Kind.BALLS: two_bodies.strike_ball,
    Kind.FACE: two_bodies.strike_face,
    Kind.CORNER: corner_impact.strike_corner,
    Kind.SPINNING: spinning_boxes.strike_in_turning,
    Kind.ROW: ball_rows.cradle,
    Kind.FLIGHT: flight.fly,
    Kind.ORBIT: flight.fly,
    Kind.MESH: spring_meshes.settle,
    Kind.VIBRATION: spring_meshes.vibrate,
    Kind.DRAPE: spring_meshes.drape,
}


LETS_FORCES_ACT = (
    *(Kind.SLIDE, Kind.PUSHED, Kind.SWINGING, Kind.FLIGHT, Kind.ORBIT),
    *(Kind.MESH, Kind.VIBRATION, Kind.DRAPE),
)
"""The kinds whose loops know forces besides weight and contact."""


class Handwritten(Engine):
    """Newton's laws with the functions of the lecture.

    The option `policy` says when a collision is resolved: at the exact root of the parabola, at the slide's T, or at
    the step that begins behind the plane. A sliding body stops exactly, or (`at_step`) as semi-implicit Euler makes it.
    Where a body can be struck off its centre with friction, the option `impact_law` names the law of restitution.

    The profile `world` has no policy: one step loop runs all that there is, and its options say how contacts are
    resolved.
    """

    name = "handwritten"
    title = "hand-written"
    order = 0
    allowed: ClassVar[Mapping[str, Allowed]] = {
        "policy": POLICIES,
        "signs": ("exact",),
        "impact_law": (NEWTON, *LAWS),
        "shortest_flight": NOT_NEGATIVE,
        "stiffness": POSITIVE,
        **world_settings.ALLOWED,
    }

    def profiles(self, scenario: Scenario) -> Mapping[str, str]:
        """The exact root counts; the plainest method is the step. The slide's T is for what falls on a plane.

        The world counts too. It runs every scenario, and alone those that no other method can run.
        """
        if isinstance(scenario, Survey):
            return {profiles.EXACT: "exact root"}
        if kind(scenario) is None:
            return {profiles.WORLD: IN_THE_WORLD}
        if kind(scenario) is Kind.FLIGHT:
            closed = {profiles.EXACT: "closed form", profiles.WORLD: IN_THE_WORLD}
            return closed | {profiles.STEP: "semi-implicit Euler"}
        if kind(scenario) is Kind.ORBIT:  # the lecture has no closed form of it, and four ways to step it
            others = {"runge-kutta": "Runge–Kutta", "verlet": "velocity Verlet", "explicit": "explicit Euler"}
            return {profiles.WORLD: IN_THE_WORLD} | others | {profiles.STEP: "semi-implicit Euler"}
        if kind(scenario) is Kind.DRAPE:  # the lecture has no shape at rest with contacts, and a step with them
            return {profiles.WORLD: IN_THE_WORLD, profiles.STEP: "respond at the step"}
        found = {profiles.EXACT: "exact root", profiles.WORLD: IN_THE_WORLD}
        if kind(scenario) in BOUNCES:
            found[profiles.SLIDE] = "the slide's T"
        if _may_yield(scenario):
            found[profiles.SPRING] = "penalty spring"
        if laws_may_part(scenario):
            found |= LAWS
        return found | {profiles.STEP: "respond at the step"}

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Timestep 1 ms. A ball rests if its next flight would be over within `shortest_flight` steps."""
        self.check_profile(scenario, profile)
        if profile == profiles.WORLD:
            return world_settings.settings_of(scenario)
        if isinstance(scenario, Survey):
            return surveying.settings_of(signs="exact")
        if profile == profiles.SPRING:
            told: dict[str, Option] = {"policy": "penalty", "stiffness": SPRING_STIFFNESS}
            return Settings(SPRING_TIMESTEP, steps_per_sample(SPRING_TIMESTEP), told)
        if kind(scenario) in (Kind.FLIGHT, Kind.ORBIT):
            return Settings(1e-3, options={"policy": POLICIES_IN_FLIGHT[profile]})
        policy = {profiles.SLIDE: "interpolated", profiles.STEP: "at_step"}.get(profile, "exact_root")
        options: dict[str, float | str] = {"policy": policy}
        if laws_may_part(scenario):
            options["impact_law"] = profile if profile in LAWS else NEWTON
        if kind(scenario) in BOUNCES:
            # The exact root follows the bounces down to rounding. A flight within one step starts and ends on the
            # plane, so the slide's T cannot see it. At the step, even a flight of two steps is lost in the overlap.
            options["shortest_flight"] = {"exact_root": 1e-9, "interpolated": 1.0, "at_step": 2.0}[policy]
        return Settings(1e-3, options=options)

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """As the policy says, or as the world's options do."""
        if isinstance(scenario, Survey):
            return Method(EXACT, rule=ANSWERS_EXACT)
        if _in_the_world(settings):
            method = world_settings.method_of(scenario, settings)
            return self.steered(scenario, replace(method, in_turn=world.is_small(self.implementation)))
        steps = settings.number("shortest_flight") if "shortest_flight" in settings.options else 0.0
        law = str(settings.options.get("impact_law", NEWTON))
        if law == NEWTON and kind(scenario) is Kind.CORNER:
            law = ALONG_GRIP  # in a plane, where all other impacts of the drivers are, the two are one
        rest_speed = steps * settings.timestep * _towards_the_plane(scenario) / 2
        policy = POLICIES[str(settings["policy"])]
        if policy == COMPLIANT:
            return Method(COMPLIANT, stiffness=settings.number("stiffness"), rule=PENALTY)
        rules = RULES_OF_KINDS.get(kind(scenario), RULES)
        rule = RULES_OF_INTEGRATORS.get(str(settings["policy"])) or rules.get(policy, "")
        return Method(policy, rest_speed=rest_speed, law=law, rule=rule)

    def check_settings(self, scenario: Scenario, settings: Settings) -> int:
        """Refuse also a `shortest_flight` below the one step that the slide's T can see."""
        if settings.options.get("policy") == "interpolated" and kind(scenario) in BOUNCES:
            shortest = settings.number("shortest_flight")
            if shortest < 1:
                raise InvalidInput(f"shortest_flight is {shortest:g}; with the policy interpolated it is at least 1")
        return super().check_settings(scenario, settings)

    def lets_forces_act(self, scenario: Scenario, settings: Settings) -> bool:
        """All forces act in the world, in meshes and on what flies, pushes on what slides, and none elsewhere."""
        return _in_the_world(settings) or kind(scenario) in LETS_FORCES_ACT

    def query(self, query: Query) -> float:
        """Answer with the functions of swept volumes, or of polyhedra."""
        if surveying.is_of_solids(query):
            return surveying.ask(self, query)
        return queries.answer(query, self.implementation)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        """Run one scenario as a batch of one."""
        return self.run_many([scenario], settings)[0]

    def runs_together(self, settings: Settings) -> bool:
        """The world steps any scenarios side by side."""
        return _in_the_world(settings)

    def run_many(self, scenarios: Sequence[Scenario], settings: Settings) -> list[Trajectory]:
        """Run a batch of scenarios side by side, in arrays: of one kind, or in the world any of them."""
        steps = [self.check_settings(scenario, settings) for scenario in scenarios]
        if all(isinstance(scenario, Survey) for scenario in scenarios):
            asked = surveyor.Surveyor(self.implementation)
            return [surveying.run(self, asked, each, settings) for each in scenarios if isinstance(each, Survey)]
        if _in_the_world(settings):
            return world.run(self.name, scenarios, settings, steps, self.implementation)
        kinds = {kind(scenario) for scenario in scenarios}
        for each, driver in DRIVERS.items():
            if kinds == {each}:
                return driver(self.name, scenarios, settings, steps, self.implementation)
        raise RunFailed(f"{scenarios[0].name} has no policy that could run it; the profile {profiles.WORLD} can")


def _towards_the_plane(scenario: Scenario) -> float:
    """Size of the weight per unit mass that brings a ball back to what it has left, m/s²."""
    gravity = np.array(scenario.gravity)
    if kind(scenario) is not Kind.BOUNCE:
        return float(np.linalg.norm(gravity))
    (plane,) = planes_met(scenario)
    return float(-gravity @ np.array(plane.shape.normal))  # type: ignore[union-attr]


def _may_yield(scenario: Scenario) -> bool:
    """Whether a scenario has the profile `spring`: a short one, in which a ball falls on a plane."""
    falls = kind(scenario) is Kind.BOUNCE and not geometry.starts_in_contact(scenario)
    return falls and scenario.duration <= LONGEST_SPRING


def _in_the_world(settings: Settings) -> bool:
    return not {"policy", "signs"} & set(settings.options)


ENGINE = Handwritten
