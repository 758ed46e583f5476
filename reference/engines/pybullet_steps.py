"""What happens around each step of PyBullet: forces are handed over, and poses, velocities and contacts read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from reference.engines.ground_box import from_raised
from reference.scene.loads import Loads
from reference.scene.scenario import Scenario
from reference.scene.trajectory import Recorder

BODY_A, BODY_B, POINT_A, POINT_B, NORMAL, DISTANCE = 1, 2, 5, 6, 7, 8
"""Fields of a contact or closest point of Bullet's: bodies, a point on each, the normal from B to A, the distance."""


def push(bullet: Any, numbers: list[int], loads: Loads, time: float, here: dict[str, int]) -> None:
    """Let forces and torques act in the next step, after which Bullet forgets them."""
    scenario = loads.scenario
    kept = loads.kept(time)
    if kept is None:
        states = np.array(state(bullet, numbers, scenario, here)).reshape(len(numbers), 13)
        kept = loads.on_bodies(time, *np.split(states, (3, 7, 10), axis=-1))
    force, torque = kept
    for place, (number, body) in enumerate(zip(numbers, scenario.bodies, strict=True)):
        if body.immovable:
            continue
        if force[place].any():
            # The force is given in the frame of the world, so that it need not be turned. Bullet then wants to know
            # where the centre is as well.
            at, _ = bullet.getBasePositionAndOrientation(number, **here)
            bullet.applyExternalForce(number, -1, force[place].tolist(), at, bullet.WORLD_FRAME, **here)
        if torque[place].any():
            bullet.applyExternalTorque(number, -1, torque[place].tolist(), bullet.WORLD_FRAME, **here)


def keep_contact(
    recorder: Recorder, scenario: Scenario, places: Mapping[int, int], contact: Sequence[Any], margin: float
) -> None:
    """Keep a contact of Bullet's; its place is midway between the two surfaces."""
    middle, normal = (np.array(contact[POINT_A]) + contact[POINT_B]) / 2, np.array(contact[NORMAL])
    pair = places[contact[BODY_A]], places[contact[BODY_B]]
    place, separation = from_raised(scenario.bodies, pair, middle, normal, contact[DISTANCE], margin)
    recorder.contact(*pair, place, contact[NORMAL], separation)


def state(bullet: Any, numbers: list[int], scenario: Scenario, here: dict[str, int]) -> list[float]:
    """The 13 numbers of every body; Bullet's quaternions are x y z w. What cannot move is where the scenario has it."""
    found: list[float] = []
    for number, body in zip(numbers, scenario.bodies, strict=True):
        if body.immovable:
            found += body.state()
            continue
        position, (x, y, z, w) = bullet.getBasePositionAndOrientation(number, **here)
        velocity, spin = bullet.getBaseVelocity(number, **here)
        found += (*position, w, x, y, z, *velocity, *spin)
    return found
