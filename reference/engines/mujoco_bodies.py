"""How MuJoCo is told bodies, their velocities, and the restitution and friction of a pair."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from reference import truth
from reference.engines import mujoco_read_back
from reference.engines.sliding_joint import SlidingJoint
from reference.engines.surveying import CONTACTS_OF, HULL, PIECES
from reference.scene import geometry
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Shape, Sphere
from reference.scene.settings import Settings


def add_body(
    mujoco: Any, spec: Any, body: Body, friction: float | None, contacts_of: str = HULL, *, free: bool = True
) -> None:
    """Add a body with its geoms. friction: of these, None where only the pairs that are listed collide.

    free: whether a movable body gets all six degrees of freedom; otherwise it still needs a joint.
    """
    orientation: Any = body.orientation
    if isinstance(body.shape, HalfSpace):
        orientation = geometry.upright_on(np.array(body.shape.normal))
    frame = spec.worldbody.add_body(name=body.name, pos=body.position, quat=orientation)
    options: dict[str, Any] = {"contype": 0, "conaffinity": 0}  # only the pairs that are listed collide
    if friction is not None:
        options = {"friction": [friction, 0.005, 0.0001]}  # the two others are MuJoCo's defaults
    if not body.immovable:
        if free:
            frame.add_freejoint()
        options["mass"] = body.mass
    if body.inertia:
        frame.explicitinertial, frame.mass, frame.inertia = True, body.mass, body.inertia
        frame.ipos, frame.iquat = (0, 0, 0), (1, 0, 0, 0)  # in the body; without it MuJoCo takes the body's pose
    if isinstance(body.shape, Polyhedron):
        _add_solid(mujoco, spec, frame, body, contacts_of, options)
        return
    kind, size = _geom(mujoco, body.shape)
    frame.add_geom(name=body.name, type=kind, size=size, **options)


def _add_solid(mujoco: Any, spec: Any, frame: Any, body: Body, contacts_of: str, options: dict[str, Any]) -> None:
    """Add the geoms of a solid: one mesh, whose contacts are those of its hull, or one for each convex piece."""
    shape = body.shape
    assert isinstance(shape, Polyhedron)
    names = geoms_of(body, contacts_of)
    if contacts_of == PIECES:
        for name, group in zip(names, shape.convex_pieces, strict=True):
            spec.add_mesh(name=name, uservert=shape.points[list(group)].ravel())
    else:
        spec.add_mesh(name=body.name, uservert=shape.points.ravel(), userface=np.array(shape.faces).ravel())
    for name in names:
        frame.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, **options)


def geoms_of(body: Body, contacts_of: str) -> list[str]:
    """The names of a body's geoms: its own, or that of each convex piece."""
    if contacts_of != PIECES or not isinstance(body.shape, Polyhedron):
        return [body.name]
    return [f"{body.name} {number}" for number in range(len(body.shape.convex_pieces))]


def set_restitution_and_friction(
    spec: Any, scenario: Scenario, pair: Pair, settings: Settings, margin: float = 0.0
) -> None:
    """Add an explicit contact pair, or one for each piece of a solid: its `solref` makes the restitution."""
    dt, restitution, friction = settings.timestep, pair.restitution, pair.kinetic_friction
    impedance = settings.number("impedance")
    # An impedance that does not depend on depth; width, midpoint and power, which then do nothing, are the defaults
    options: dict[str, Any] = {"solimp": [impedance, impedance, 0.001, 0.5, 2]}
    if settings["contact"] == "one step":
        options["solref"] = [-settings.number("overlap_recovery") / dt**2, -(1 + restitution) / dt]
        options["solreffriction"] = [0, -1 / dt]  # takes away the whole slip in a step, as far as Coulomb allows
    else:
        stiffness = settings.number("stiffness")
        ratio = min(truth.damping_ratio(restitution), mujoco_read_back.MOST_DAMPED)
        options["solref"] = [-stiffness, -2 * ratio * math.sqrt(stiffness)]
    if margin:
        options["margin"] = margin
    contacts_of = str(settings.options.get(CONTACTS_OF, HULL))
    both = (geoms_of(scenario.body(name), contacts_of) for name in (pair.body_a, pair.body_b))
    for geom_a, geom_b in itertools.product(*both):
        spec.add_pair(
            geomname1=geom_a,
            geomname2=geom_b,
            condim=mujoco_read_back.dimensions(settings),
            friction=[friction, friction, 0, 0, 0],
            **options,
        )


def _geom(mujoco: Any, shape: Shape) -> tuple[Any, list[float]]:
    if isinstance(shape, Sphere):
        return mujoco.mjtGeom.mjGEOM_SPHERE, [shape.radius, 0, 0]
    if isinstance(shape, Box):
        return mujoco.mjtGeom.mjGEOM_BOX, list(shape.half_extents)
    assert isinstance(shape, HalfSpace)
    return mujoco.mjtGeom.mjGEOM_PLANE, [0, 0, 1]  # infinite


def set_velocity(state: Any, slot: int, body: Body, joint: SlidingJoint | None) -> None:
    """A free joint's velocity: linear in the world frame, angular in the body's own; a sliding joint has its rate."""
    if joint:
        state.qvel[slot] = joint.ends.rate
        return
    conjugate = geometry.opposite(np.array(body.orientation))
    state.qvel[6 * slot : 6 * slot + 3] = body.velocity
    state.qvel[6 * slot + 3 : 6 * slot + 6] = geometry.rotate(conjugate, np.array(body.angular_velocity))
