"""What the engines do by themselves: one sentence for each fact that several texts of a report need.

The reasons in `reference.catalogue.apart`, the families and the first screen read their sentences from here. They were
measured with the versions in `MEASURED_WITH`; `docs/engines.md` has the figures, their conditions and the reasons. A
number that an engine has as a constant is beside the settings of that engine.
"""

from __future__ import annotations

from reference.engines import dart_settings, pybullet_settings

MEASURED_WITH = "PyBullet 3.2.7, MuJoCo 4.0.0 and DART 6.20.0"

PYBULLET_DAMPS = (
    "PyBullet, as installed, damps every velocity v, in m/s, by"
    f" {pybullet_settings.STOCK_DAMPING:g} (1 + v) v per second, and every spin likewise."
)
PYBULLET_DAMPED = PYBULLET_DAMPS.removesuffix(".")
"""The same, as the note of a row."""
PYBULLET_STARTS_EARLY = (
    "PyBullet, as installed, makes a contact while there is still a gap, and takes gap/Δt off the rebound."
)
PYBULLET_GIVES_BACK = "PyBullet, as installed, gives overlap back as speed."
PYBULLET_TAKES_CORNERS_IN_TURN = "On its half-space PyBullet finds one new contact point of a box in each step."
PYBULLET_MAKES_HULLS = "PyBullet takes a mesh for its convex hull if it is given the vertices alone."
PYBULLET_WIDENS_HULLS = (
    f"Bullet makes a convex hull {1e3 * pybullet_settings.MARGIN:g} mm thicker than its vertices say."
)
MUJOCO_HAS_NO_RESTITUTION = "MuJoCo has no coefficient of restitution; nothing bounces unless its contact is tuned."
MUJOCO_IS_SOFT = "MuJoCo's contact, as installed, is a soft, critically damped spring, and bodies sink in."
MUJOCO_CREEPS = "MuJoCo, as installed, creeps: its friction is a soft constraint, and any pull makes it yield a little."
MUJOCO_ROCKS = (
    "MuJoCo, tuned, creeps where friction should hold, in proportion to the timestep: its noslip passes compute the"
    " friction, and the main solver does not know of it, so the body stands on four corners and on two in turns."
)
MUJOCO_HAS_A_DIAMOND = (
    "MuJoCo's friction cone, as installed, is a pyramid: between its axes it is weaker, and pulls sideways."
)
MUJOCO_LIFTS = "MuJoCo's convex contact law pays for slip with lift, so that a body that slides hops."
MUJOCO_ALWAYS_RUBS = "MuJoCo takes 10⁻⁵ for the least coefficient of friction, so that a smooth contact rubs a little."
MUJOCO_CANNOT_RUB_OFF_CENTRE = (
    "MuJoCo cannot keep both e and μ in an impact off the centre of a body. Its convex solver adds μ times the slip"
    " that is left to the speed of parting; its noslip passes settle friction after the normal impulse, which off the"
    " centre depends on friction."
)
MUJOCO_TAKES_HULLS = (
    "MuJoCo computes contacts and distances with the convex hull of a mesh, even if the mesh has faces."
)
DART_RESTS = f"DART takes any rebound below {dart_settings.REST_SPEED:g} m/s for rest, and no setting changes this."
DART_HAS_A_SQUARE = "DART's friction cone, as installed, is a pyramid that brakes each axis by itself."
DART_HAS_ONE_POINT = (
    "DART, as installed, finds one contact point of a box on its half-space, so the box rocks without end."
)
DART_SEES_NO_INSIDE = (
    "DART measures distances to the triangles of a mesh, which have no inside: for a ball that is wholly within the"
    " solid, it gives the gap that the ball would have outside."
)
NO_ENGINE_KNOWS_INSIDE = (
    "No engine has a function that decides whether a point is inside. With tuned engines the lab counts how often a ray"
    " from the point crosses the triangles."
)
