"""What DART says of its world, compared with what it was told: everything that the adapter sets can be asked for."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from reference.engines import read_back
from reference.engines.sliding_joint import SlidingJoint
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

TITLE = "DART"
SWEEPS = {"nsgs": "maxSweeps", "fbf": "maxOuterIterations"}
"""The solvers with a cone for friction, and what each calls its iterations."""
TYPES = {"dantzig": "DantzigBoxedLcpSolver", "nsgs": "NsgsFrictionSolver", "fbf": "FbfFrictionSolver"}
"""What DART says of each solver that an option names."""


def check_world(world: Any, bodies: list[Any], scenario: Scenario, settings: Settings) -> None:
    """Refuse a world that is not what the scenario and the settings mean. bodies: DART's, in their order."""
    read_back.check(TITLE, "timestep", settings.timestep, world.getTimeStep(), "s")
    read_back.check(TITLE, "gravity", scenario.gravity, world.getGravity(), "m/s²")
    _check_options(world, settings)
    masses = [body.getMass() if body.getSkeleton().getNumDofs() else math.inf for body in bodies]
    tensors = [np.array(body.getInertia().getMoment()) for body in bodies]
    read_back.check_bodies(TITLE, scenario, masses, [tensor.diagonal().tolist() for tensor in tensors])
    for body, tensor in zip(scenario.bodies, tensors, strict=True):
        products = tensor[np.triu_indices(3, 1)].tolist()
        read_back.check(TITLE, f"products of inertia of {body.name}", (0, 0, 0), products, "kg m²")
    for body, node in zip(scenario.bodies, bodies, strict=True):
        centre = node.getInertia().getLocalCOM().ravel().tolist()
        read_back.check(TITLE, f"centre of mass of {body.name}", (0, 0, 0), centre, "m")
        read_back.check(TITLE, f"weight of {body.name}", True, node.getGravityMode())
    surfaces = [body.getShapeNode(0).getDynamicsAspect() for body in bodies]
    for pair in scenario.pairs:
        a, b = surfaces[scenario.index(pair.body_a)], surfaces[scenario.index(pair.body_b)]
        restitution = a.getRestitutionCoeff() * b.getRestitutionCoeff()
        read_back.check_pair(TITLE, "restitution", pair, pair.restitution, restitution)
        friction = min(a.getFrictionCoeff(), b.getFrictionCoeff())
        read_back.check_pair(TITLE, "friction", pair, pair.kinetic_friction, friction)


def check_joint(bodies: list[Any], sliding: SlidingJoint | None) -> None:
    """Refuse a joint that is not the spring. sliding: what DART was told, None where bodies are free."""
    if not sliding:
        return
    joint, spring, ends = bodies[0].getParentJoint(), sliding.spring, sliding.ends
    read_back.check(TITLE, "axis of the joint", tuple(sliding.axis), tuple(joint.getAxis().ravel()))
    read_back.check(TITLE, "stiffness of the joint", spring.stiffness, joint.getSpringStiffness(0), "N/m")
    read_back.check(TITLE, "damping of the joint", spring.damping, joint.getDampingCoefficient(0), "N s/m")
    read_back.check(TITLE, "rest length of the spring", spring.rest_length, joint.getRestPosition(0), "m")
    read_back.check(TITLE, "length of the spring", ends.length, joint.getPosition(0), "m")
    read_back.check(TITLE, "rate of the spring", ends.rate, joint.getVelocity(0), "m/s")


def _check_options(world: Any, settings: Settings) -> None:
    solver, options = world.getConstraintSolver(), settings.options
    if "detector" in options:
        read_back.check(TITLE, "detector", str(options["detector"]), solver.getCollisionDetector().getType())
    if "solver" in options:
        _check_solver(solver.getBoxedLcpSolver(), settings)
    if "split_impulse" in options:
        read_back.check(TITLE, "split impulses", bool(options["split_impulse"]), solver.isSplitImpulseEnabled())
    if "sleep" in options:
        read_back.check(TITLE, "sleep", bool(options["sleep"]), world.getDeactivationOptions().mEnabled)


def _check_solver(solver: Any, settings: Settings) -> None:
    name, options = str(settings["solver"]), settings.options
    read_back.check(TITLE, "solver", TYPES[name], solver.getType())
    if name in SWEEPS and "solver_tolerance" in options:
        read_back.check(TITLE, "solver tolerance", settings.number("solver_tolerance"), solver.getOptions().tolerance)
    if name in SWEEPS and "solver_iterations" in options:
        found = getattr(solver.getOptions(), SWEEPS[name])
        read_back.check(TITLE, "solver iterations", settings.number("solver_iterations"), found)
