"""Bodies as DART has them: skeletons of one body each, with a shape that touches."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Sphere
from reference.scene.settings import Settings

GROUND_EXTENT, GROUND_DEPTH = 100.0, 1.0
"""Half extents of the box that stands for a half-space, m: far larger than any way in the catalogue."""


def add_body(
    dart: Any, world: Any, body: Body, settings: Settings, restitution: float, friction: float
) -> tuple[Any, Any]:
    """Add a skeleton of one body; return its shape, by which contacts are told apart, and the body."""
    skeleton = dart.dynamics.Skeleton(body.name)
    placed = _placed(body, settings)
    if body.immovable:
        node = _standing(dart, skeleton, placed)
    else:
        joint, node = skeleton.createFreeJointAndBodyNodePair()
        joint.setTransform(_transform(dart, body))
        joint.setLinearVelocity(body.velocity)
        joint.setAngularVelocity(body.angular_velocity)
    shape = _shape(dart, placed.shape)
    shape_node = node.createShapeNode(shape)
    shape_node.createCollisionAspect()
    surface = shape_node.createDynamicsAspect()
    surface.setRestitutionCoeff(restitution)
    surface.setFrictionCoeff(friction)
    if not body.immovable:
        node.setInertia(dart.dynamics.Inertia(body.mass, [0.0, 0.0, 0.0], shape.computeInertia(body.mass)))
    world.addSkeleton(skeleton)
    return shape, node


def stand(dart: Any, body: Body) -> tuple[Any, Any]:
    """A body that nothing moves, in no world: its skeleton, and its shape where it stands."""
    skeleton, placed = dart.dynamics.Skeleton(body.name), _placed(body, Settings(1.0))
    shape_node = _standing(dart, skeleton, placed).createShapeNode(_shape(dart, placed.shape))
    shape_node.createCollisionAspect()
    return skeleton, shape_node


def _standing(dart: Any, skeleton: Any, placed: Body) -> Any:
    joint, node = skeleton.createWeldJointAndBodyNodePair()
    joint.setTransformFromParentBodyNode(_transform(dart, placed))
    return node


def _placed(body: Body, settings: Settings) -> Body:
    """The body as DART gets it: a half-space's normal is the world's, and a large box may stand for it."""
    if not isinstance(body.shape, HalfSpace):
        return body
    if settings.options.get("ground") != "box":
        return replace(body, orientation=(1.0, 0.0, 0.0, 0.0))
    normal = np.array(body.shape.normal)
    orientation = geometry.quaternion_between(np.array([0.0, 0.0, 1.0]), normal)
    centre = np.array(body.position) - GROUND_DEPTH * normal
    shape = Box((GROUND_EXTENT, GROUND_EXTENT, GROUND_DEPTH))
    return replace(body, shape=shape, position=tuple(centre), orientation=tuple(orientation))


def _transform(dart: Any, body: Body) -> Any:
    transform = dart.math.Isometry3()
    transform.set_quaternion(dart.math.Quaternion(*body.orientation))  # w x y z
    transform.set_translation(body.position)
    return transform


def _shape(dart: Any, shape: Sphere | Box | HalfSpace) -> Any:
    if isinstance(shape, Sphere):
        return dart.dynamics.SphereShape(shape.radius)
    if isinstance(shape, Box):
        return dart.dynamics.BoxShape([2 * extent for extent in shape.half_extents])
    return dart.dynamics.PlaneShape(shape.normal, 0.0)
