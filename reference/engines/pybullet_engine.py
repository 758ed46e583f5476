"""PyBullet as an engine: units, order of quaternions, and how Bullet is told a pair's restitution and friction.

Bullet multiplies the coefficients of the two bodies; `pybullet_bodies.set_restitution_and_friction` sets them. It has
one set of contact parameters for the whole world and cannot give them back: what a run used is what its settings say.

Tuned, where something falls: rigid bodies in maximal coordinates, so that restitution acts on the speed before the
step, and split impulses, which take back a share `contact_erp` of the overlap without adding speed. Tuned, where bodies
slide: multibody coordinates, whose friction is exact on any ground; with maximal ones a block on Bullet's plane stops
up to 4 % short.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from reference.engines import mixing, pybullet_bodies
from reference.engines.base import AT_STEP, Engine, Method
from reference.engines.ground_box import from_raised
from reference.engines.ranges import COUNT, NOT_NEGATIVE, SHARE, Allowed
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.query import Query, Ray
from reference.scene.scenario import Body, Box, Force, Scenario
from reference.scene.settings import Move, Option, Settings
from reference.scene.trajectory import Recorder, Trajectory

STOCK_TIMESTEP = 1 / 240
STOCK_REST_SPEED = 0.2
"""Bullet's default for the relative speed below which it lets a contact rest, m/s."""
WORLD = {
    "contact_slop": "contactSlop",
    "contact_erp": "contactERP",
    "solver_iterations": "numSolverIterations",
    "solver_residual": "solverResidualThreshold",
    "cone_friction": "enableConeFriction",  # without it friction is limited along two axes, each by itself
}
"""Our options for the whole world, and what Bullet calls them."""
BODY_A, BODY_B, POINT_A, POINT_B, NORMAL, DISTANCE = 1, 2, 5, 6, 7, 8
"""Fields of a contact or closest point of Bullet's: bodies, a point on each, the normal from B to A, the distance."""
FARTHEST = 1e6
"""Distance beyond which no two bodies lie, m: Bullet searches for closest points up to it."""


class PyBullet(Engine):
    """Bullet's rigid-body engine through the `pybullet` package, without a window."""

    name = "pybullet"
    title = "PyBullet"
    order = 10
    package = "pybullet"
    extra = "pybullet"
    wheels = "CPython up to 3.11 on Linux x86-64 only"
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
    }

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the settings of a profile. An option that is absent is left at Bullet's default."""
        self.check_profile(scenario, profile)
        if profile == "stock":
            return Settings(STOCK_TIMESTEP, options={"coordinates": "multibody"})
        restitution = max((pair.restitution for pair in scenario.pairs), default=0.0)
        movable = [body for body in scenario.bodies if not body.immovable]
        boxes = any(isinstance(body.shape, Box) for body in movable)
        undamped: dict[str, Option] = {"linear_damping": 0.0, "angular_damping": 0.0, "contact_slop": 0.0}
        # On a plane Bullet finds one more contact point of a box in each step; on a large box all four at once.
        ground: dict[str, Option] = {"ground": "box"} if boxes else {}
        firm: dict[str, Option] = {"solver_iterations": 200 if len(movable) == 1 else 100, "solver_residual": 0.0}
        if restitution == 0 and geometry.starts_in_contact(scenario):
            options: dict[str, Option] = {"coordinates": "multibody", **undamped, **ground, **firm}
            if boxes and not geometry.leaning(scenario):
                # Bullet finds a contact of two boxes only where they overlap. At a gap of exactly zero rounding decides
                # in which steps it does. On ground that is a margin higher, with an overlap of the margin allowed, it
                # always does.
                options |= {"margin": 1e-9, "contact_slop": 1e-9}
            return Settings(1e-3, options=options)
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
        return Settings(1e-3, options=options)

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """Bullet resolves an impact at the step; split impulses take overlap back without adding speed."""
        recovery = settings.number("contact_erp") if settings.options.get("split_impulse") is True else 0.0
        return Method(AT_STEP, recovery, rest_speed=_rest_speed(scenario, settings))

    def moves(self, scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
        """A lower threshold of rest, and twice the solver's iterations."""
        found = []
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
        steps = self.check_settings(scenario, settings)
        bullet.resetSimulation(**here)
        self._set_world(bullet, scenario, settings, here)
        fall = _gravity(scenario) * settings.timestep**2
        numbers = [
            pybullet_bodies.add_body(bullet, body, settings, *coefficients, fall, here)
            for body, coefficients in zip(scenario.bodies, self._restitution_and_friction(scenario), strict=True)
        ]
        for first, second in scenario.unlisted_pairs():
            apart = numbers[scenario.index(first)], numbers[scenario.index(second)]
            bullet.setCollisionFilterPair(*apart, -1, -1, 0, **here)
        places = {number: place for place, number in enumerate(numbers)}
        margin = settings.number("margin") if "margin" in settings.options else 0.0
        recorder = Recorder(self.name, scenario, settings)
        recorder.sample(_state(bullet, numbers, scenario, here))
        for step in range(1, steps + 1):
            for force in scenario.forces:
                _push(bullet, numbers[scenario.index(force.body)], force, here)
            bullet.stepSimulation(**here)
            if step % settings.sample_every == 0:
                recorder.sample(_state(bullet, numbers, scenario, here))
                for contact in bullet.getContactPoints(**here):
                    _keep_contact(recorder, scenario, places, contact, margin)
        return recorder.trajectory()

    def query(self, query: Query) -> float:
        """Answer with Bullet's own rays and closest points."""
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
            return float(min(point[DISTANCE] for point in found))
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
            chosen["restitutionVelocityThreshold"] = _rest_speed(scenario, settings)
        if chosen:
            bullet.setPhysicsEngineParameter(**chosen, **here)

    def _restitution_and_friction(self, scenario: Scenario) -> list[tuple[float, float]]:
        """One restitution and friction per body such that every pair's product is what the scenario asks for."""
        restitution = mixing.factors(scenario, lambda pair: pair.restitution)
        friction = mixing.factors(scenario, lambda pair: pair.kinetic_friction)
        if restitution is None or friction is None:
            raise self.cannot(
                scenario, "Bullet multiplies the coefficients of two bodies, and no choice gives all pairs"
            )
        return list(zip(restitution, friction, strict=True))


def _rest_speed(scenario: Scenario, settings: Settings) -> float:
    """The relative speed, m/s, below which Bullet lets a contact rest."""
    if "rest_threshold_steps" not in settings.options:
        return STOCK_REST_SPEED
    return settings.number("rest_threshold_steps") * settings.timestep * _gravity(scenario)


def _gravity(scenario: Scenario) -> float:
    return float(np.linalg.norm(scenario.gravity))


def _fixed(body: Body) -> Body:
    """The body as one that nothing moves."""
    return replace(body, mass=math.inf, velocity=(0.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 0.0))


def _push(bullet: Any, number: int, force: Force, here: dict[str, int]) -> None:
    """Let a force act in the next step, after which Bullet forgets it."""
    centre, _ = bullet.getBasePositionAndOrientation(number, **here)
    bullet.applyExternalForce(number, -1, force.force, centre, bullet.WORLD_FRAME, **here)


def _keep_contact(
    recorder: Recorder, scenario: Scenario, places: Mapping[int, int], contact: Sequence[Any], margin: float
) -> None:
    """Keep a contact of Bullet's; its place is midway between the two surfaces."""
    middle, normal = (np.array(contact[POINT_A]) + contact[POINT_B]) / 2, np.array(contact[NORMAL])
    pair = places[contact[BODY_A]], places[contact[BODY_B]]
    place, separation = from_raised(scenario.bodies, pair, middle, normal, contact[DISTANCE], margin)
    recorder.contact(*pair, place, contact[NORMAL], separation)


def _state(bullet: Any, numbers: list[int], scenario: Scenario, here: dict[str, int]) -> list[float]:
    """The 13 numbers of every body; Bullet's quaternions are x y z w. What cannot move is where the scenario has it."""
    state: list[float] = []
    for number, body in zip(numbers, scenario.bodies, strict=True):
        if body.immovable:
            state += body.state()
            continue
        position, (x, y, z, w) = bullet.getBasePositionAndOrientation(number, **here)
        velocity, spin = bullet.getBaseVelocity(number, **here)
        state += (*position, w, x, y, z, *velocity, *spin)
    return state


ENGINE = PyBullet
