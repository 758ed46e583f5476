"""PyBullet as an engine: units, order of quaternions, and how Bullet is told a pair's restitution and friction.

Bullet multiplies the coefficients of the two bodies; `pybullet_bodies.set_restitution_and_friction` sets them. It has
one set of contact parameters for the whole world and cannot give them back: what a run used is what its settings say.
What it can give back is compared with what it was told, before the first step; see `pybullet_read_back`.

Tuned, where something falls: rigid bodies in maximal coordinates, so that restitution acts on the speed before the
step, and split impulses, which take back a share `contact_erp` of the overlap without adding speed. Tuned, where bodies
slide: multibody coordinates, whose friction is exact on any ground; with maximal ones a block on Bullet's plane stops
up to 4 % short. They are chosen for impacts off the centre with friction as well: in maximal coordinates Bullet limits
friction along two axes, each by itself.

`spring`: balls that fall or strike meet a spring with a dashpot instead, which `pybullet_spring` explains.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from reference.engines import (
    mixing,
    pybullet_bodies,
    pybullet_read_back,
    pybullet_settings,
    pybullet_spring,
    pybullet_steps,
    pybullet_surveyor,
    surveying,
)
from reference.engines.base import Engine, Method
from reference.engines.profiles import SWEPT, TUNED
from reference.engines.pybullet_settings import gravity_of, rest_speed_of
from reference.engines.ranges import COUNT, NOT_NEGATIVE, POSITIVE, SHARE, Allowed
from reference.engines.steering import sampled, unhurried
from reference.errors import RunFailed
from reference.scene import geometry, leaping
from reference.scene.loads import Loads
from reference.scene.query import Distance, Query, Ray
from reference.scene.scenario import Body, Scenario
from reference.scene.settings import Move, Settings
from reference.scene.survey import Survey
from reference.scene.trajectory import Recorder, Trajectory

WORLD = {
    "contact_slop": "contactSlop",
    "contact_erp": "contactERP",
    "solver_iterations": "numSolverIterations",
    "solver_residual": "solverResidualThreshold",
    "sweep_from": "allowedCcdPenetration",
    "cone_friction": "enableConeFriction",  # without it friction is limited along two axes, each by itself
}
"""Our options for the whole world, and what Bullet calls them."""
NEAR_AT_THE_START = 1e-4
"""Gap below which two bodies may touch in the first step, m: ten times the gap at which a contact counts, g dt²."""
FARTHEST = 1e6
"""Distance beyond which no two bodies lie, m: Bullet searches for closest points up to it."""


class PyBullet(Engine):
    """Bullet's rigid-body engine through the `pybullet` package, without a window."""

    name = "pybullet"
    title = "PyBullet"
    order = 10
    package = "pybullet"
    distributions = ("pybullet", "pybullet-arm64")
    extra = "pybullet"
    installing = "pip install --force-reinstall --no-deps --require-hashes -r bullet.txt"
    wheels = "CPython 3.11 to 3.13 on Linux x86-64, Windows x86-64 and macOS on ARM, 3.13 from macOS 14"
    applies_forces = True
    allowed: ClassVar[Mapping[str, Allowed]] = {
        "coordinates": ("maximal", "multibody"),
        "ground": ("box", "plane"),
        "linear_damping": SHARE,
        "angular_damping": SHARE,
        "contact_slop": NOT_NEGATIVE,
        "contact_erp": SHARE,
        "contact_gap_falls": NOT_NEGATIVE,
        "margin": NOT_NEGATIVE,
        "rest_threshold_steps": NOT_NEGATIVE,
        "solver_iterations": COUNT,
        "solver_residual": NOT_NEGATIVE,
        "stiffness": POSITIVE,
        "spring_of": ("world", "bodies"),
        **pybullet_surveyor.ALLOWED,
        surveying.CONTACTS_OF: (surveying.TRIANGLES, surveying.HULL),
        "swept_inset": NOT_NEGATIVE,
        "sweep_from": NOT_NEGATIVE,
    }

    def profiles(self, scenario: Scenario) -> Mapping[str, str]:
        """`spring`, the resolved contact of the textbooks, joins where balls fall or strike; `swept` for fast shots."""
        found = dict(super().profiles(scenario))
        if isinstance(scenario, Survey):
            return found
        stock = found.pop("stock")
        expressible = pybullet_spring.spring_of(scenario, pybullet_settings.SPRING_STIFFNESS) is not None
        if leaping.may_leap(scenario):  # a spring would give way farther than the wall is thick
            found[SWEPT] = "continuous detection"
        elif expressible and not (geometry.starts_in_contact(scenario) or scenario.steering or scenario.meets_a_solid):
            found["spring"] = "spring–dashpot contact"
        return found | {"stock": stock}

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the settings of a profile. An option that is absent is left at Bullet's default."""
        self.check_profile(scenario, profile)
        settings = pybullet_settings.settings_of(scenario, profile)
        return unhurried(scenario, settings) if profile == TUNED else sampled(scenario, settings)

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """A spring yields. Else Bullet resolves an impact at the step, and split impulses take overlap back."""
        return self.steered(scenario, pybullet_settings.method_of(scenario, settings))

    def moves(self, scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
        """A lower threshold of rest or a stiffer spring, and twice the solver's iterations."""
        if not scenario.pairs:
            return ()
        found = []
        if "stiffness" in settings.options:
            found.append(Move("contact model", "stiffness", 4 * settings.number("stiffness")))
        if "rest_threshold_steps" in settings.options:
            found.append(Move("contact model", "rest_threshold_steps", settings.number("rest_threshold_steps") / 2))
        if "solver_iterations" in settings.options:
            found.append(Move("solver", "solver_iterations", 2 * int(settings.number("solver_iterations"))))
        return tuple(found)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        """Run one scenario in a world of its own."""
        return self.run_many([scenario], settings)[0]

    def run_many(self, scenarios: Sequence[Scenario], settings: Settings) -> list[Trajectory]:
        """Run scenarios one after another in one client, reset in between: connecting costs more than a short run."""
        bullet: Any = self.module()
        client = bullet.connect(bullet.DIRECT)
        try:
            return [self._run(bullet, scenario, settings, {"physicsClientId": client}) for scenario in scenarios]
        finally:
            bullet.disconnect(client)

    def _run(self, bullet: Any, scenario: Scenario, settings: Settings, here: dict[str, int]) -> Trajectory:
        self.check_friction(scenario)
        self._check_inertia(scenario, settings)
        steps = self.check_settings(scenario, settings)
        bullet.resetSimulation(**here)
        if isinstance(scenario, Survey):
            return surveying.run(self, pybullet_surveyor.Surveyor(bullet, settings, here), scenario, settings)
        self._set_world(bullet, scenario, settings, here)
        fall = gravity_of(scenario) * settings.timestep**2
        both = self._restitution_and_friction(scenario, settings)
        numbers = [
            pybullet_bodies.add_body(bullet, body, settings, *coefficients, fall, here)
            for body, coefficients in zip(scenario.bodies, both, strict=True)
        ]
        if "stiffness" in settings.options:
            spring = pybullet_spring.spring_of(scenario, settings.number("stiffness"))
            if spring is None:
                raise self.cannot(scenario, "its contact spring needs balls with one effective mass and restitution")
            pybullet_spring.set_spring(bullet, numbers, spring, settings, here)
        for first, second in scenario.unlisted_pairs():
            apart = numbers[scenario.index(first)], numbers[scenario.index(second)]
            bullet.setCollisionFilterPair(*apart, -1, -1, 0, **here)
        pybullet_read_back.check_world(bullet, numbers, scenario, settings, here)
        places = {number: place for place, number in enumerate(numbers)}
        margin = settings.number("margin") if "margin" in settings.options else 0.0
        recorder = Recorder(self.name, scenario, settings)
        recorder.sample(pybullet_steps.state(bullet, numbers, scenario, here))
        loads = Loads(scenario, steers=self.steers(scenario)) if scenario.forces or scenario.pushes_change else None
        for step in range(1, steps + 1):
            if loads:
                pybullet_steps.push(bullet, numbers, loads, (step - 1) * settings.timestep, here)
            bullet.stepSimulation(**here)
            if step % settings.sample_every == 0:
                recorder.sample(pybullet_steps.state(bullet, numbers, scenario, here))
                for contact in bullet.getContactPoints(**here):
                    pybullet_steps.keep_contact(recorder, scenario, places, contact, margin)
        return recorder.trajectory()

    def query(self, query: Query) -> float:
        """Answer with Bullet's own rays and closest points."""
        if surveying.is_of_solids(query):
            return surveying.ask(self, query)
        assert isinstance(query, Ray | Distance)
        bullet: Any = self.module()
        client = bullet.connect(bullet.DIRECT)
        here = {"physicsClientId": client}
        try:
            if isinstance(query, Ray):
                pybullet_bodies.stand(bullet, _fixed(query.body), here)
                end = np.add(query.start, query.way).tolist()
                ((number, _, share, _, _),) = bullet.rayTest(query.start, end, **here)
                return float(share) if number >= 0 else math.inf
            pair = [pybullet_bodies.stand(bullet, _fixed(body), here) for body in (query.body_a, query.body_b)]
            found = bullet.getClosestPoints(*pair, FARTHEST, **here)
            if not found:
                raise RunFailed(f"Bullet finds no closest points of {query.body_a.name} and {query.body_b.name}")
            return float(min(point[pybullet_steps.DISTANCE] for point in found))
        finally:
            bullet.disconnect(client)

    def _set_world(self, bullet: Any, scenario: Scenario, settings: Settings, here: dict[str, int]) -> None:
        bullet.setGravity(*scenario.gravity, **here)
        bullet.setTimeStep(settings.timestep, **here)
        bullet.setPhysicsEngineParameter(deterministicOverlappingPairs=1, **here)
        chosen = {word: settings[option] for option, word in WORLD.items() if option in settings.options}
        if "split_impulse" in settings.options:
            chosen["useSplitImpulse"] = int(bool(settings["split_impulse"]))
            # Bullet's own −0.04 m leaves small overlaps to the velocity
            chosen["splitImpulsePenetrationThreshold"] = 0.0
        if "rest_threshold_steps" in settings.options:
            chosen["restitutionVelocityThreshold"] = rest_speed_of(scenario, settings)
        if chosen:
            bullet.setPhysicsEngineParameter(**chosen, **here)

    def _check_inertia(self, scenario: Scenario, settings: Settings) -> None:
        """Refuse a body that touches another in the first step and whose inertia is not its shape's.

        In maximal coordinates the impulses of the first step turn it by its shape's; those of the next by its own.
        """
        if settings.options.get("coordinates") != "maximal":
            return
        for pair in scenario.pairs:
            a, b = scenario.body(pair.body_a), scenario.body(pair.body_b)
            if (a.inertia or b.inertia) and geometry.gap(a, b) < NEAR_AT_THE_START:
                raise self.cannot(
                    scenario,
                    f"{a.name} and {b.name} touch in the first step, which does not know their own inertia yet",
                )

    def _restitution_and_friction(self, scenario: Scenario, settings: Settings) -> list[tuple[float, float]]:
        """One restitution and friction per body such that every pair's product is what the scenario asks for.

        With a spring, the restitution is in the damping, and Bullet's own coefficient is 0.
        """
        springs = "stiffness" in settings.options
        restitution = mixing.factors(scenario, lambda pair: 0.0 if springs else pair.restitution)
        friction = mixing.factors(scenario, lambda pair: pair.kinetic_friction)
        if restitution is None or friction is None:
            raise self.cannot(
                scenario, "Bullet multiplies the coefficients of two bodies, and no choice gives all pairs"
            )
        return list(zip(restitution, friction, strict=True))


def _fixed(body: Body) -> Body:
    """The body as one that nothing moves."""
    return replace(body, mass=math.inf, inertia=(), velocity=(0.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 0.0))


ENGINE = PyBullet
