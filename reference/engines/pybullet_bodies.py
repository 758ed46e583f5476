"""Bodies as PyBullet has them: a collision shape, a mass, and coefficients that belong to one body.

Every call of PyBullet takes `here`, which names the client.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.engines.ground_box import ground_box, raised
from reference.engines.surveying import CONTACTS_OF, HULL, TRIANGLES
from reference.scene import geometry
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Sphere
from reference.scene.settings import Settings

NO_SPEED_LIMIT = 1e9
"""Bullet cuts speeds at 100, m/s or rad/s, unless we set a larger limit."""
DAMPING = {"linear_damping": "linearDamping", "angular_damping": "angularDamping"}
"""Our options for a body, and what Bullet calls them."""


def add_body(
    bullet: Any,
    body: Body,
    settings: Settings,
    restitution: float,
    friction: float,
    fall: float,
    here: dict[str, int],
) -> int:
    """Add a body as it starts and return its number. fall: how far a body at rest falls in one step, g dt², m."""
    if isinstance(body.shape, HalfSpace):
        body = _ground(body, settings)
    contacts_of = str(settings.options.get(CONTACTS_OF, HULL))
    number = stand(bullet, body, here, contacts_of, useMaximalCoordinates=settings["coordinates"] == "maximal")
    set_restitution_and_friction(bullet, number, restitution, friction, here)
    if body.inertia:  # together with the mass, which a body in maximal coordinates would otherwise lose
        bullet.changeDynamics(number, -1, mass=body.mass, localInertiaDiagonal=body.inertia, **here)
    if not body.immovable:
        _set_damping_and_contact_gap(bullet, number, settings, fall, here)
        if "swept_inset" in settings.options and isinstance(body.shape, Sphere):
            radius = max(0.0, body.shape.radius - settings.number("swept_inset"))  # without a radius nothing is swept
            bullet.changeDynamics(number, -1, ccdSweptSphereRadius=radius, **here)
        bullet.resetBaseVelocity(number, body.velocity, body.angular_velocity, **here)
    return number


def _ground(body: Body, settings: Settings) -> Body:
    """A half-space as Bullet gets it: higher by the margin, and perhaps as a large box."""
    if "margin" in settings.options:
        body = raised(body, settings.number("margin"))
    return ground_box(body) if settings.options.get("ground") == "box" else body


def stand(bullet: Any, body: Body, here: dict[str, int], contacts_of: str = HULL, **options: bool) -> int:
    """Add a body at rest where the scenario has it, and return its number. contacts_of: what a mesh is to contacts."""
    mass = 0.0 if body.immovable else body.mass  # Bullet writes 0 for a body that nothing moves
    shape = _collision_shape(bullet, body, contacts_of, here)
    orientation = (*body.orientation[1:], body.orientation[0])  # x y z w
    placed = {"basePosition": body.position, "baseOrientation": orientation}
    return int(bullet.createMultiBody(mass, shape, **placed, **options, **here))


def set_restitution_and_friction(
    bullet: Any, number: int, restitution: float, friction: float, here: dict[str, int]
) -> None:
    """Give one body its coefficients; of two that touch, Bullet multiplies them."""
    bullet.changeDynamics(number, -1, restitution=restitution, lateralFriction=friction, **here)


def _set_damping_and_contact_gap(
    bullet: Any, number: int, settings: Settings, fall: float, here: dict[str, int]
) -> None:
    chosen = {word: settings[option] for option, word in DAMPING.items() if option in settings.options}
    if "contact_gap_falls" in settings.options:
        chosen["contactProcessingThreshold"] = settings.number("contact_gap_falls") * fall
    if chosen:
        bullet.changeDynamics(number, -1, maxJointVelocity=NO_SPEED_LIMIT, **chosen, **here)


def _collision_shape(bullet: Any, body: Body, contacts_of: str, here: dict[str, int]) -> int:
    shape = body.shape
    if isinstance(shape, Sphere):
        number: int = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=shape.radius, **here)
    elif isinstance(shape, Box):
        number = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=shape.half_extents, **here)
    elif isinstance(shape, Polyhedron):
        # Told the vertices alone, Bullet makes their convex hull.
        told = {"indices": np.array(shape.faces).ravel().tolist()} if contacts_of == TRIANGLES else {}
        number = bullet.createCollisionShape(bullet.GEOM_MESH, vertices=shape.points.tolist(), **told, **here)
    else:
        assert isinstance(shape, HalfSpace)
        own_frame = geometry.rotate(geometry.opposite(np.array(body.orientation)), np.array(shape.normal))
        number = bullet.createCollisionShape(bullet.GEOM_PLANE, planeNormal=own_frame.tolist(), **here)
    return number
