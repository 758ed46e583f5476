"""How MuJoCo is told bodies, their velocities, and the restitution and friction of a pair."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from reference import truth
from reference.engines import mujoco_read_back
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Shape, Sphere
from reference.scene.settings import Settings


def add_body(mujoco: Any, spec: Any, body: Body, friction: float | None) -> None:
    """Add a body with its geom; friction: of the geom, None where only the pairs that are listed collide."""
    orientation: Any = body.orientation
    if isinstance(body.shape, HalfSpace):
        orientation = geometry.upright_on(np.array(body.shape.normal))
    frame = spec.worldbody.add_body(name=body.name, pos=body.position, quat=orientation)
    kind, size = _geom(mujoco, body.shape)
    options: dict[str, Any] = {"contype": 0, "conaffinity": 0}  # only the pairs that are listed collide
    if friction is not None:
        options = {"friction": [friction, 0.005, 0.0001]}  # the two others are MuJoCo's defaults
    if not body.immovable:
        frame.add_freejoint()
        options["mass"] = body.mass
    if body.inertia:
        frame.explicitinertial, frame.mass, frame.inertia = True, body.mass, body.inertia
        frame.ipos, frame.iquat = (0, 0, 0), (1, 0, 0, 0)  # in the body; without it MuJoCo takes the body's pose
    frame.add_geom(name=body.name, type=kind, size=size, **options)


def set_restitution_and_friction(spec: Any, pair: Pair, settings: Settings, margin: float = 0.0) -> None:
    """Add an explicit contact pair: its `solref` makes the restitution."""
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
    spec.add_pair(
        geomname1=pair.body_a,
        geomname2=pair.body_b,
        condim=mujoco_read_back.dimensions(settings),
        friction=[friction, friction, 0, 0, 0],
        **options,
    )


def _geom(mujoco: Any, shape: Shape) -> tuple[Any, list[float]]:
    if isinstance(shape, Sphere):
        return mujoco.mjtGeom.mjGEOM_SPHERE, [shape.radius, 0, 0]
    if isinstance(shape, Box):
        return mujoco.mjtGeom.mjGEOM_BOX, list(shape.half_extents)
    assert isinstance(shape, HalfSpace), "a survey asks about a polyhedron"
    return mujoco.mjtGeom.mjGEOM_PLANE, [0, 0, 1]  # infinite


def set_velocity(state: Any, slot: int, body: Body) -> None:
    """A free joint's velocity: linear in the world frame, angular in the body's own."""
    conjugate = geometry.opposite(np.array(body.orientation))
    state.qvel[6 * slot : 6 * slot + 3] = body.velocity
    state.qvel[6 * slot + 3 : 6 * slot + 6] = geometry.rotate(conjugate, np.array(body.angular_velocity))
