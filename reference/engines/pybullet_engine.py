"""PyBullet as an engine: units, quaternion order and how a pair's coefficients are said in Bullet.

Bullet multiplies the two bodies' coefficients, keeps its contact parameters for the whole world and cannot give them
back: what a run used is what its settings say.

Tuned, where something falls: rigid bodies in maximal coordinates, so that restitution acts on the speed before the
step, and split impulses, which take back a share `contact_erp` of the overlap without adding speed. Tuned, where bodies
slide: multibody coordinates, whose friction is exact on any ground; with maximal ones a block on Bullet's plane stops
up to 4 % short.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from reference.engines import mixing
from reference.engines.base import AT_STEP, Engine, Method
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.query import Query, Ray
from reference.scene.scenario import Body, Box, Force, HalfSpace, Scenario, Sphere
from reference.scene.settings import Move, Option, Settings
from reference.scene.trajectory import Recorder, Trajectory

STOCK_TIMESTEP = 1 / 240
GROUND_EXTENT, GROUND_DEPTH = (100.0, 100.0), 1.0
"""Half extents of the box that stands for a half-space, m: far larger than any way in the catalogue."""
FARTHEST = 1e6
"""Distance beyond which two bodies need not be told apart, m."""


class PyBullet(Engine):
    """Bullet's rigid-body engine through the `pybullet` package, without a window."""

    name = "pybullet"
    title = "PyBullet"
    order = 10
    package = "pybullet"
    extra = "pybullet"
    wheels = "CPython up to 3.11 on Linux x86-64 only"
    applies_forces = True

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the settings of a profile. An option that is absent is left at Bullet's default."""
        self.check_profile(scenario, profile)
        if profile == "stock":
            return Settings(STOCK_TIMESTEP, options={"coordinates": "multibody"})
        restitution = max((pair.restitution for pair in scenario.pairs), default=0.0)
        movable = [body for body in scenario.bodies if not body.immovable]
        boxes = any(isinstance(body.shape, Box) for body in movable)
        damping: dict[str, Option] = {"linear_damping": 0.0, "angular_damping": 0.0, "contact_slop": 0.0}
        # On a plane Bullet finds one more contact point of a box in each step; on a large box all four at once.
        ground: dict[str, Option] = {"ground": "box"} if boxes else {}
        firm: dict[str, Option] = {"solver_iterations": 200 if len(movable) == 1 else 100, "solver_residual": 0.0}
        if restitution == 0 and geometry.starts_in_contact(scenario):
            return Settings(1e-3, options={"coordinates": "multibody", **damping, **ground, **firm})
        options: dict[str, Option] = {
            "coordinates": "maximal",
            **damping,
            # Rebounds slower than this many steps of gravity are taken for rest. Without it micro-bounces go on and on.
            "rest_threshold_steps": 3.0,
            # The share of the overlap that makes the mean error of a rebound vanish; see truth.rebound_shift_at_step.
            "contact_erp": 1.0 - restitution,
            "split_impulse": True,
            # The gap at which a contact counts, in falls of one step from rest, g dt². A gap of several falls
            # spoils a ball's rebound; with none, a box that has landed askew rocks from corner to corner for ever.
            "contact_gap_falls": 1.0 if boxes else 0.0,
            **ground,
            **(firm if boxes or len(movable) > 1 else {"solver_iterations": 50}),
        }
        return Settings(1e-3, options=options)

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """Bullet answers at the step; split impulses take overlap back without adding speed."""
        recovery = settings.number("contact_erp") if settings.options.get("split_impulse") is True else 0.0
        return Method(AT_STEP, recovery, rest_speed=self._rest_speed(scenario, settings))

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
            return [self._run(bullet, client, scenario, settings) for scenario in scenarios]
        finally:
            bullet.disconnect(client)

    def _run(self, bullet: Any, client: int, scenario: Scenario, settings: Settings) -> Trajectory:
        self.check_friction(scenario)
        steps = self.check_settings(scenario, settings)
        bullet.resetSimulation(physicsClientId=client)
        self._set_world(bullet, client, scenario, settings)
        coefficients = self._coefficients(scenario)
        numbers = [
            self._add_body(bullet, client, scenario, body, settings, *pair)
            for body, pair in zip(scenario.bodies, coefficients, strict=True)
        ]
        places = {number: place for place, number in enumerate(numbers)}
        for first, second in scenario.unlisted_pairs():
            apart = numbers[scenario.index(first)], numbers[scenario.index(second)]
            bullet.setCollisionFilterPair(*apart, -1, -1, 0, physicsClientId=client)
        recorder = Recorder(self.name, scenario, settings)
        recorder.sample(_state(bullet, client, numbers, scenario))
        for number in range(1, steps + 1):
            for force in scenario.forces:
                _push(bullet, client, numbers[scenario.index(force.body)], force)
            bullet.stepSimulation(physicsClientId=client)
            if number % settings.sample_every == 0:
                recorder.sample(_state(bullet, client, numbers, scenario))
                for contact in bullet.getContactPoints(physicsClientId=client):
                    _keep_contact(recorder, places, contact)
        return recorder.trajectory()

    def query(self, query: Query) -> float:
        """Answer with Bullet's own rays and closest points."""
        bullet: Any = self.module()
        client = bullet.connect(bullet.DIRECT)
        here = {"physicsClientId": client}
        try:
            if isinstance(query, Ray):
                self._place(bullet, query.body, here)
                end = np.add(query.start, query.way).tolist()
                ((number, _, share, _, _),) = bullet.rayTest(query.start, end, **here)
                return float(share) if number >= 0 else math.inf
            pair = [self._place(bullet, body, here) for body in (query.body_a, query.body_b)]
            found = bullet.getClosestPoints(*pair, FARTHEST, **here)
            if not found:
                raise RunFailed(f"Bullet finds no closest points of {query.body_a.name} and {query.body_b.name}")
            return float(min(point[8] for point in found))
        finally:
            bullet.disconnect(client)

    @staticmethod
    def _place(bullet: Any, body: Body, here: dict[str, int]) -> int:
        """Add a body that nothing moves, where it stands, and return its number."""
        orientation = (*body.orientation[1:], body.orientation[0])  # x y z w
        shape = _collision_shape(bullet, body, here)
        return int(bullet.createMultiBody(0.0, shape, basePosition=body.position, baseOrientation=orientation, **here))

    def _set_world(self, bullet: Any, client: int, scenario: Scenario, settings: Settings) -> None:
        bullet.setGravity(*scenario.gravity, physicsClientId=client)
        bullet.setTimeStep(settings.timestep, physicsClientId=client)
        bullet.setPhysicsEngineParameter(deterministicOverlappingPairs=1, physicsClientId=client)
        words = {
            "contact_slop": "contactSlop",
            "contact_erp": "contactERP",
            "solver_iterations": "numSolverIterations",
            "solver_residual": "solverResidualThreshold",
            "cone_friction": "enableConeFriction",  # without it friction is limited along two axes, each by itself
        }
        chosen = {word: settings[option] for option, word in words.items() if option in settings.options}
        if "split_impulse" in settings.options:
            chosen["useSplitImpulse"] = int(bool(settings["split_impulse"]))
            chosen["splitImpulsePenetrationThreshold"] = (
                0.0  # Bullet's own −0.04 m leaves small overlaps to the velocity
            )
            chosen["restitutionVelocityThreshold"] = self._rest_speed(scenario, settings)
        if chosen:
            bullet.setPhysicsEngineParameter(**chosen, physicsClientId=client)

    def _rest_speed(self, scenario: Scenario, settings: Settings) -> float:
        """The relative speed, m/s, below which Bullet lets a contact rest; its default is 0.2."""
        if "rest_threshold_steps" not in settings.options:
            return 0.2
        return settings.number("rest_threshold_steps") * settings.timestep * self._gravity(scenario)

    @staticmethod
    def _gravity(scenario: Scenario) -> float:
        return float(np.linalg.norm(scenario.gravity))

    def _add_body(
        self,
        bullet: Any,
        client: int,
        scenario: Scenario,
        body: Body,
        settings: Settings,
        restitution: float,
        friction: float,
    ) -> int:
        here = {"physicsClientId": client}
        if isinstance(body.shape, HalfSpace) and settings.options.get("ground") == "box":
            body = _as_box(body)
        shape = _collision_shape(bullet, body, here)
        number: int = bullet.createMultiBody(
            0.0 if body.immovable else body.mass,
            shape,
            basePosition=body.position,
            baseOrientation=(*body.orientation[1:], body.orientation[0]),  # x y z w
            useMaximalCoordinates=settings["coordinates"] == "maximal",
            **here,
        )
        bullet.changeDynamics(number, -1, restitution=restitution, lateralFriction=friction, **here)
        if body.immovable:
            return number
        words = {
            "linear_damping": "linearDamping",
            "angular_damping": "angularDamping",
        }
        chosen = {word: settings[option] for option, word in words.items() if option in settings.options}
        if "contact_gap_falls" in settings.options:
            fall = self._gravity(scenario) * settings.timestep**2
            chosen["contactProcessingThreshold"] = settings.number("contact_gap_falls") * fall
        if chosen:
            bullet.changeDynamics(number, -1, maxJointVelocity=1e9, **chosen, **here)  # or speeds are cut at 100 m/s
        bullet.resetBaseVelocity(number, body.velocity, body.angular_velocity, **here)
        return number

    def _coefficients(self, scenario: Scenario) -> list[tuple[float, float]]:
        """One restitution and friction per body such that every pair's product is what the scenario asks for."""
        restitution = mixing.factors(scenario, lambda pair: pair.restitution)
        friction = mixing.factors(scenario, lambda pair: pair.kinetic_friction)
        if restitution is None or friction is None:
            raise self.cannot(
                scenario, "Bullet multiplies the coefficients of two bodies, and no choice gives all pairs"
            )
        return list(zip(restitution, friction, strict=True))


def _collision_shape(bullet: Any, body: Body, here: dict[str, int]) -> int:
    shape = body.shape
    if isinstance(shape, Sphere):
        number: int = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=shape.radius, **here)
    elif isinstance(shape, Box):
        number = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=shape.half_extents, **here)
    else:
        own_frame = geometry.rotate(geometry.opposite(np.array(body.orientation)), np.array(shape.normal))
        number = bullet.createCollisionShape(bullet.GEOM_PLANE, planeNormal=own_frame.tolist(), **here)
    return number


def _push(bullet: Any, client: int, number: int, force: Force) -> None:
    """Let a force act in the next step, after which Bullet forgets it."""
    centre, _ = bullet.getBasePositionAndOrientation(number, physicsClientId=client)
    bullet.applyExternalForce(number, -1, force.force, centre, bullet.WORLD_FRAME, physicsClientId=client)


def _keep_contact(recorder: Recorder, places: Mapping[int, int], contact: Sequence[Any]) -> None:
    """Of the fields, 1 and 2 are A and B, 5 and 6 the points on them, 7 the normal from B to A, 8 the distance."""
    middle = [(on_a + on_b) / 2 for on_a, on_b in zip(contact[5], contact[6], strict=True)]
    recorder.contact(places[contact[1]], places[contact[2]], middle, contact[7], contact[8])


def _as_box(body: Body) -> Body:
    """A box so large that its upper face stands for the half-space's surface."""
    normal = np.array(body.shape.normal)  # type: ignore[union-attr]
    orientation = geometry.quaternion_between(np.array([0.0, 0.0, 1.0]), normal)
    centre = np.array(body.position) - GROUND_DEPTH * normal
    return replace(
        body, shape=Box((*GROUND_EXTENT, GROUND_DEPTH)), position=tuple(centre), orientation=tuple(orientation)
    )


def _state(bullet: Any, client: int, numbers: list[int], scenario: Scenario) -> list[float]:
    """The 13 numbers of every body; Bullet's quaternions are x y z w. What cannot move is where the scenario has it."""
    state: list[float] = []
    for number, body in zip(numbers, scenario.bodies, strict=True):
        if body.immovable:
            state += (*body.position, *body.orientation, *body.velocity, *body.angular_velocity)
            continue
        position, (x, y, z, w) = bullet.getBasePositionAndOrientation(number, physicsClientId=client)
        velocity, spin = bullet.getBaseVelocity(number, physicsClientId=client)
        state += (*position, w, x, y, z, *velocity, *spin)
    return state


ENGINE = PyBullet
