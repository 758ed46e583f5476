"""DART as an engine: units, frames, how DART is told a pair's restitution and friction, and which solver is right.

DART multiplies the restitution of two shapes and takes the smaller of their frictions. Its contact constants are out of
Python's reach: there is no rebound slower than 0.1 m/s, and overlap is taken back at 1 mm/s at most.

Tuned: its own collision detector, which finds all corners of a box at once if the ground is a box, and an exact Coulomb
solver; the default one has a pyramid for a friction cone. Nothing falls asleep.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from reference.engines import dart_bodies, dart_read_back, dart_settings, dart_surveyor, mixing, surveying
from reference.engines.base import Engine, Method
from reference.engines.dart_read_back import SWEEPS
from reference.engines.ground_box import from_raised
from reference.engines.profiles import JOINT, STOCK
from reference.engines.ranges import COUNT, NOT_NEGATIVE, POSITIVE, Allowed
from reference.engines.sliding_joint import joint_of
from reference.errors import CannotExpress, RunFailed
from reference.scene.loads import Loads
from reference.scene.query import Distance, Query, Ray
from reference.scene.scenario import Scenario, Sphere
from reference.scene.settings import Move, Settings
from reference.scene.straight_spring import on_one_spring
from reference.scene.survey import Survey
from reference.scene.trajectory import Recorder, Trajectory

LEAST_COEFFICIENT = 1e-3
"""A coefficient up to this counts as zero in DART."""
LARGEST = 1e150
"""Of numbers above this the square is infinite."""
MOST_DEPTH = 1e6
"""Depth that no two bodies reach, m; without such a limit DART gives no distance below zero."""
DETECTORS: Mapping[str, Callable[[Any], Any]] = {
    "dart": lambda dart: dart.collision.DARTCollisionDetector(),
    "fcl": lambda dart: dart.collision.FCLCollisionDetector(),
    "bullet": lambda dart: dart.collision.BulletCollisionDetector(),
    "ode": lambda dart: dart.collision.OdeCollisionDetector(),
}
GROUNDS = ("plane", "box")
SOLVERS = ("dantzig", *SWEEPS)


class Dart(Engine):
    """The Dynamic Animation and Robotics Toolkit through its package `dartpy`, without a window."""

    name = "dart"
    title = "DART"
    order = 30
    package = "dartpy"
    extra = "dart"
    wheels = "CPython from 3.12 on Linux, macOS 15 on ARM and Windows, and 3.11 on Linux"
    applies_forces = True
    allowed: ClassVar[Mapping[str, Allowed]] = {
        "detector": DETECTORS,
        "ground": GROUNDS,
        "margin": NOT_NEGATIVE,
        "solver": SOLVERS,
        "solver_tolerance": POSITIVE,
        "solver_iterations": COUNT,
        "springs": (JOINT,),
        **dart_surveyor.ALLOWED,
    }

    def profiles(self, scenario: Scenario) -> Mapping[str, str]:
        """`joint`, a sliding joint with a spring, joins where a ball on a spring is all there is."""
        named = dict(super().profiles(scenario))
        stock = named.pop(STOCK)
        return named | ({JOINT: "a sliding joint with a spring"} if on_one_spring(scenario) else {}) | {STOCK: stock}

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the settings of a profile. An option that is absent is left at DART's default."""
        self.check_profile(scenario, profile)
        return dart_settings.settings_of(scenario, profile)

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """DART responds at the step, to the speed that this step has just gained; a ball is pushed where it is cut."""
        return self.steered(scenario, dart_settings.method_of(scenario, settings))

    def moves(self, scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
        """A tenth of the friction solver's tolerance; the contact itself has nothing to move."""
        if not scenario.pairs or "solver_tolerance" not in settings.options:
            return ()
        return (Move("solver", "solver_tolerance", settings.number("solver_tolerance") / 10),)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        """Build a world, step it in C++ and read the bodies at the samples."""
        dart: Any = self.module()
        if isinstance(scenario, Survey):
            return surveying.run(self, dart_surveyor.Surveyor(dart), scenario, settings)
        self.check_friction(scenario)
        steps = self.check_settings(scenario, settings)
        coefficients = self._restitution_and_friction(scenario)
        world = _world(dart, scenario, settings)
        sliding, shapes, bodies = joint_of(scenario, settings), [], []
        for body, pair in zip(scenario.bodies, coefficients, strict=True):
            shape, node = dart_bodies.add_body(dart, world, body, settings, *pair, sliding)
            shapes.append(shape)
            bodies.append(node)
        apart = world.getConstraintSolver().getCollisionOption().collisionFilter
        for first, second in scenario.unlisted_pairs():
            apart.addBodyNodePairToBlackList(bodies[scenario.index(first)], bodies[scenario.index(second)])
        dart_read_back.check_world(world, bodies, scenario, settings)
        recorder = Recorder(self.name, scenario, settings)
        recorder.sample([number for body in scenario.bodies for number in body.state()])
        dart_read_back.check_joint(bodies, sliding)
        outside = replace(scenario, springs=()) if sliding else scenario
        loads = Loads(outside, steers=self.steers(scenario)) if outside.forces or outside.pushes_change else None
        for number in range(1, steps + 1):
            if loads:
                _push(bodies, loads, (number - 1) * settings.timestep)
            world.step()
            if number % settings.sample_every == 0:
                recorder.sample(_state(scenario, bodies))
                for contact in world.getLastCollisionResult().getContacts():
                    _keep_contact(recorder, scenario, shapes, contact, settings)
        return recorder.trajectory()

    def query(self, query: Query) -> float:
        """Answer with the rays and distances of DART's own detector; each of the others lacks one, or the depth."""
        if surveying.is_of_solids(query):
            return surveying.ask(self, query)
        assert isinstance(query, Ray | Distance)
        dart: Any = self.module()
        bodies = (query.body,) if isinstance(query, Ray) else (query.body_a, query.body_b)
        detector = DETECTORS["dart"](dart)
        group = detector.createCollisionGroup()
        standing = [dart_bodies.stand(dart, body) for body in bodies]  # kept: a group does not keep them
        for _, frame in standing:
            group.addShapeFrame(frame)
        if isinstance(query, Ray):
            hits = dart.collision.RaycastResult()
            group.raycast(query.start, np.add(query.start, query.way), dart.collision.RaycastOption(), hits)
            return min((float(hit.mFraction) for hit in hits.mRayHits), default=math.inf)
        found = dart.collision.DistanceResult()
        group.distance(dart.collision.DistanceOption(False, -MOST_DEPTH), found)
        if not found.found():
            raise CannotExpress("DART's own detector knows no distance of two half-spaces")
        return float(found.minDistance)

    def _restitution_and_friction(self, scenario: Scenario) -> list[tuple[float, float]]:
        """One restitution and friction per body such that every pair gets what the scenario asks for."""
        for pair in scenario.pairs:
            for name, value in (("restitution", pair.restitution), ("friction", pair.kinetic_friction)):
                if 0 < value <= LEAST_COEFFICIENT:
                    raise self.cannot(scenario, f"it takes a {name} of {value:g} for none, as all up to 0.001")
        restitution = mixing.factors(scenario, lambda pair: pair.restitution, most=1.0)
        friction = mixing.least(scenario, lambda pair: pair.kinetic_friction)
        if restitution is None:
            raise self.cannot(
                scenario, "it multiplies the restitutions of two bodies, and no choice of up to 1 gives all pairs"
            )
        if friction is None:
            raise self.cannot(scenario, "it takes the smaller friction of two bodies, and no choice gives all pairs")
        return list(zip(restitution, friction, strict=True))


def _world(dart: Any, scenario: Scenario, settings: Settings) -> Any:
    world = dart.simulation.World()
    world.setTimeStep(settings.timestep)
    world.setGravity(scenario.gravity)
    solver, options = world.getConstraintSolver(), settings.options
    if "detector" in options:
        solver.setCollisionDetector(DETECTORS[str(options["detector"])](dart))
    if options.get("solver", "dantzig") != "dantzig":  # that one is there from the start, and cannot be made
        solver.setBoxedLcpSolver(_friction_solver(dart, settings))
    if "split_impulse" in options:
        solver.setSplitImpulseEnabled(bool(options["split_impulse"]))
    if "sleep" in options:
        sleeping = world.getDeactivationOptions()
        sleeping.mEnabled = bool(options["sleep"])
        world.setDeactivationOptions(sleeping)
    return world


def _friction_solver(dart: Any, settings: Settings) -> Any:
    name = str(settings["solver"])
    solver = dart.constraint.FbfFrictionSolver() if name == "fbf" else dart.constraint.NsgsFrictionSolver()
    options = solver.getOptions()
    if "solver_tolerance" in settings.options:
        options.tolerance = settings.number("solver_tolerance")
    if "solver_iterations" in settings.options:
        setattr(options, SWEEPS[name], int(settings.number("solver_iterations")))
    solver.setOptions(options)
    return solver


def _push(bodies: list[Any], loads: Loads, time: float) -> None:
    """Let forces and torques act in the next step, after which DART forgets them.

    DART takes an acceleration that is not finite for none, a place that is not finite for the origin, and goes on: a
    run that explodes would end with numbers that mean nothing.
    """
    kept = loads.kept(time)
    if kept is None:
        state = np.array(_state(loads.scenario, bodies)).reshape(len(bodies), 13)
        kept = loads.on_bodies(time, *np.split(state, (3, 7, 10), axis=-1))
        if not all(np.all(np.abs(each) < LARGEST) for each in (state, *kept)):
            said = f"places, velocities or forces are not finite, or not for long, from t = {time:.6g} s on"
            raise RunFailed(f"dart: {said}")
    force, torque = kept
    for place, (node, body) in enumerate(zip(bodies, loads.scenario.bodies, strict=True)):
        if body.immovable:
            continue
        if force[place].any():
            node.addExtForce(force[place], [0.0, 0.0, 0.0])  # at the centre
        if torque[place].any():
            node.addExtTorque(torque[place], False)  # in the world frame


def _state(scenario: Scenario, bodies: list[Any]) -> list[float]:
    """The 13 numbers of every body. What cannot move is where the scenario has it."""
    state: list[float] = []
    for body, node in zip(scenario.bodies, bodies, strict=True):
        if body.immovable:
            state += body.state()
            continue
        pose = node.getWorldTransform()
        turn = pose.quaternion()
        state += (*pose.translation().ravel(), turn.w(), turn.x(), turn.y(), turn.z())
        state += (*node.getLinearVelocity().ravel(), *node.getAngularVelocity().ravel())
    return state


def _keep_contact(recorder: Recorder, scenario: Scenario, shapes: list[Any], contact: Any, settings: Settings) -> None:
    """DART's normal points from its second object to its first, and depth is positive inside.

    Its point lies midway between the surfaces, with two exceptions. For a ball on something flat DART's own detector
    gives a point of the flat surface. For two balls the Flexible Collision Library, DART's default, divides the way
    from centre to centre as the radii are to each other. Bodies are recognized by their shapes, since asking a
    collision object for its frame makes the process crash as it ends.
    """
    first, second = (
        next(place for place, shape in enumerate(shapes) if thing.getShape() is shape)
        for thing in (contact.collisionObject1, contact.collisionObject2)
    )
    normal, depth = contact.normal.ravel(), contact.penetrationDepth
    flat = settings.options.get("detector") == "dart"
    margin = settings.number("margin") if "margin" in settings.options else 0.0
    both = [scenario.bodies[place].shape for place in (first, second)]
    balls = [flat and isinstance(shape, Sphere) for shape in both]
    inside = (balls[1] - balls[0]) / 2
    if settings.options.get("detector", "fcl") == "fcl" and isinstance(both[0], Sphere) and isinstance(both[1], Sphere):
        inside = 1 / 2 - both[0].radius / (both[0].radius + both[1].radius)
    middle = contact.point.ravel() + inside * depth * normal
    place, separation = from_raised(scenario.bodies, (first, second), middle, normal, -depth, margin)
    recorder.contact(first, second, place, normal.tolist(), separation)


ENGINE = Dart
