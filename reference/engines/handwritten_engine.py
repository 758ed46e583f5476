"""Hand-written code as an engine: it picks driver and policy, and `solutions` (or a student) does the physics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from reference.engines import profiles
from reference.engines.base import (
    AT_STEP,
    CHORD,
    EXACT,
    INTERPOLATED,
    RESPOND_THEN_STEP,
    TURN_BACK,
    Engine,
    Method,
)
from reference.engines.handwritten import (
    ball_over_plane,
    ball_rows,
    balls_between_planes,
    corner_impact,
    queries,
    slabs,
    thin_wall,
    two_bodies,
    world,
    world_settings,
)
from reference.engines.handwritten.scenario_kind import Kind, kind, laws_may_part
from reference.engines.ranges import NOT_NEGATIVE, Allowed
from reference.errors import InvalidInput, RunFailed
from reference.impact_truth import DISSIPATIVE, NEWTON, POISSON, STRONGE
from reference.scene.query import Query
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.spatial_impact import ALONG_GRIP

BOUNCES = Kind.BOUNCE, Kind.WALLS
"""The kinds for which the slide's T is a method too: the surfaces are planes, and the ball comes back."""

POLICIES = {
    "exact_root": EXACT,
    "interpolated": INTERPOLATED,
    "at_step": AT_STEP,
}
RULES = {INTERPOLATED: CHORD, AT_STEP: RESPOND_THEN_STEP}
"""The recurrences of the policies that have one; the exact root gives what theory says."""
RULES_AT_A_WALL = {AT_STEP: TURN_BACK}
"""The same for a ball that flies at a thin wall, of which `overlap_interval` sees both faces."""

LAWS = {
    DISSIPATIVE: "exact root, maximal dissipation",
    POISSON: "exact root, Poisson's restitution",
    STRONGE: "exact root, Stronge's restitution",
}
"""The profiles for the laws of an impact with friction that are not Newton's, where the laws can part."""

IN_THE_WORLD = "rigid-body world"
DRIVERS = {
    Kind.BOUNCE: ball_over_plane.bounce,
    Kind.WALLS: balls_between_planes.fly,
    Kind.SLIDE: slabs.slide,
    Kind.THIN_WALL: thin_wall.shoot,
    Kind.BALLS: two_bodies.strike_ball,
    Kind.FACE: two_bodies.strike_face,
    Kind.CORNER: corner_impact.strike_corner,
    Kind.ROW: ball_rows.cradle,
}


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
        "impact_law": (NEWTON, *LAWS),
        "shortest_flight": NOT_NEGATIVE,
        **world_settings.ALLOWED,
    }

    def profiles(self, scenario: Scenario) -> Mapping[str, str]:
        """The exact root counts; the plainest method is the step. The slide's T is for what falls on a plane.

        The world counts too. It runs every scenario, and alone those that no other method can run.
        """
        if kind(scenario) is None:
            return {profiles.WORLD: IN_THE_WORLD}
        found = {profiles.EXACT: "exact root", profiles.WORLD: IN_THE_WORLD}
        if kind(scenario) in BOUNCES:
            found[profiles.SLIDE] = "the slide's T"
        if laws_may_part(scenario):
            found |= LAWS
        return found | {profiles.STEP: "respond at the step"}

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Timestep 1 ms. A ball rests if its next flight would be over within `shortest_flight` steps."""
        self.check_profile(scenario, profile)
        if profile == profiles.WORLD:
            return world_settings.settings_of(scenario)
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
        if _in_the_world(settings):
            return world_settings.method_of(scenario, settings)
        steps = settings.number("shortest_flight") if "shortest_flight" in settings.options else 0.0
        gravity = float(np.linalg.norm(scenario.gravity))
        law = str(settings.options.get("impact_law", NEWTON))
        if law == NEWTON and kind(scenario) is Kind.CORNER:
            law = ALONG_GRIP  # in a plane, where all other impacts of the drivers are, the two are one
        rest_speed = steps * settings.timestep * gravity / 2
        policy = POLICIES[str(settings["policy"])]
        rules = RULES_AT_A_WALL if kind(scenario) is Kind.THIN_WALL else RULES
        return Method(policy, rest_speed=rest_speed, law=law, rule=rules.get(policy, ""))

    def check_settings(self, scenario: Scenario, settings: Settings) -> int:
        """Refuse also a `shortest_flight` below the one step that the slide's T can see."""
        if not _in_the_world(settings) and settings["policy"] == "interpolated" and kind(scenario) in BOUNCES:
            shortest = settings.number("shortest_flight")
            if shortest < 1:
                raise InvalidInput(f"shortest_flight is {shortest:g}; with the policy interpolated it is at least 1")
        return super().check_settings(scenario, settings)

    def lets_forces_act(self, scenario: Scenario, settings: Settings) -> bool:
        """A constant force pushes what slides, and all in the world; no other loop knows any."""
        return _in_the_world(settings) or kind(scenario) is Kind.SLIDE

    def query(self, query: Query) -> float:
        """Answer with the functions of swept volumes."""
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
        if _in_the_world(settings):
            return world.run(self.name, scenarios, settings, steps, self.implementation)
        kinds = {kind(scenario) for scenario in scenarios}
        for each, driver in DRIVERS.items():
            if kinds == {each}:
                return driver(self.name, scenarios, settings, steps, self.implementation)
        raise RunFailed(f"{scenarios[0].name} has no policy that could run it; the profile {profiles.WORLD} can")


def _in_the_world(settings: Settings) -> bool:
    return "policy" not in settings.options


ENGINE = Handwritten
