"""Bodies as DART has them: skeletons of one body each, with a shape that touches."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from reference.engines.ground_box import ground_box, raised
from reference.engines.sliding_joint import SlidingJoint
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Shape, Sphere
from reference.scene.settings import Settings


def add_body(
    dart: Any,
    world: Any,
    body: Body,
    settings: Settings,
    restitution: float,
    friction: float,
    sliding: SlidingJoint | None = None,
) -> tuple[Any, Any]:
    """Add a skeleton of one body; return its shape, by which a contact names its bodies, and the body."""
    skeleton = dart.dynamics.Skeleton(body.name)
    placed = _placed(body, settings)
    if body.immovable:
        node = _standing(dart, skeleton, placed)
    elif sliding:
        node = _sliding(dart, skeleton, sliding)
    else:
        joint, node = skeleton.createFreeJointAndBodyNodePair()
        joint.setTransform(_transform(dart, body))
        joint.setLinearVelocity(body.velocity)
        joint.setAngularVelocity(body.angular_velocity)
    shape = _shape(dart, placed.shape)
    shape_node = node.createShapeNode(shape)
    shape_node.createCollisionAspect()
    set_restitution_and_friction(shape_node, restitution, friction)
    if not body.immovable:
        inertia = np.diag(body.inertia) if body.inertia else shape.computeInertia(body.mass)
        node.setInertia(dart.dynamics.Inertia(body.mass, [0.0, 0.0, 0.0], inertia))
    world.addSkeleton(skeleton)
    return shape, node


def set_restitution_and_friction(shape_node: Any, restitution: float, friction: float) -> None:
    """Give one shape its coefficients; of two that touch, DART multiplies the first and takes the smaller second."""
    surface = shape_node.createDynamicsAspect()
    surface.setRestitutionCoeff(restitution)
    surface.setFrictionCoeff(friction)


def stand(dart: Any, body: Body, shape: Any = None) -> tuple[Any, Any]:
    """A body that nothing moves, in no world: its skeleton, and its shape, if not the given one, where it stands."""
    skeleton, placed = dart.dynamics.Skeleton(body.name), _placed(body, Settings(1.0))
    shape_node = _standing(dart, skeleton, placed).createShapeNode(shape or _shape(dart, placed.shape))
    shape_node.createCollisionAspect()
    return skeleton, shape_node


def _standing(dart: Any, skeleton: Any, placed: Body) -> Any:
    joint, node = skeleton.createWeldJointAndBodyNodePair()
    joint.setTransformFromParentBodyNode(_transform(dart, placed))
    return node


def _sliding(dart: Any, skeleton: Any, sliding: SlidingJoint) -> Any:
    """A body in a joint along its spring, whose coordinate is the spring's length."""
    joint, node = skeleton.createPrismaticJointAndBodyNodePair()
    start = replace(sliding.body, position=tuple(sliding.ends.fixed.tolist()))
    joint.setTransformFromParentBodyNode(_transform(dart, start))
    joint.setAxis(sliding.axis)
    joint.setSpringStiffness(0, sliding.spring.stiffness)
    joint.setDampingCoefficient(0, sliding.spring.damping)
    joint.setRestPosition(0, sliding.spring.rest_length)
    joint.setPosition(0, sliding.ends.length)
    joint.setVelocity(0, sliding.ends.rate)
    return node


def _placed(body: Body, settings: Settings) -> Body:
    """The body as DART gets it: a half-space's normal is the world's, and a large box may stand for it."""
    if not isinstance(body.shape, HalfSpace):
        return body
    if "margin" in settings.options:
        body = raised(body, settings.number("margin"))
    if settings.options.get("ground") != "box":
        return replace(body, orientation=(1.0, 0.0, 0.0, 0.0))
    return ground_box(body)


def _transform(dart: Any, body: Body) -> Any:
    transform = dart.math.Isometry3()
    transform.set_quaternion(dart.math.Quaternion(*body.orientation))  # w x y z
    transform.set_translation(body.position)
    return transform


def _shape(dart: Any, shape: Shape) -> Any:
    if isinstance(shape, Sphere):
        return dart.dynamics.SphereShape(shape.radius)
    if isinstance(shape, Box):
        return dart.dynamics.BoxShape([2 * extent for extent in shape.half_extents])
    if isinstance(shape, Polyhedron):
        return mesh(dart, shape)
    assert isinstance(shape, HalfSpace)
    return dart.dynamics.PlaneShape(shape.normal, 0.0)


_URDF = """<robot name="solid"><link name="solid">
<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><mesh filename="{uri}"/></geometry></collision></link></robot>"""


def mesh(dart: Any, shape: Polyhedron) -> Any:
    """A mesh as DART reads it from a file, the only way that it has: in single precision."""
    lines = ["v {!r} {!r} {!r}".format(*vertex) for vertex in shape.vertices]
    lines += ["f {} {} {}".format(*(corner + 1 for corner in face)) for face in shape.faces]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "solid.obj"
        file.write_text("\n".join([*lines, ""]))
        urdf = _URDF.format(uri=file.as_uri())
        skeleton = dart.utils.DartLoader().parseSkeletonString(urdf, file.parent.as_uri())
    return skeleton.getBodyNode(0).getShapeNode(0).getShape()
