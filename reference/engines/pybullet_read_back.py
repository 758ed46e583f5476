"""What PyBullet says truthfully of its world, compared with what it was told.

It gives back the timestep, gravity and the number of the solver's iterations, and of a body its mass, inertia and
friction. The restitution that it gives back is a body's own in multibody coordinates alone: of a body in maximal ones
PyBullet returns what the last multibody had. All else that is set for the world cannot be asked for.
"""

from __future__ import annotations

import math
from typing import Any

from reference.engines import read_back
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

TITLE = "PyBullet"
MASS, FRICTION, INERTIA, RESTITUTION, ROLLING, SPINNING = 0, 1, 2, 5, 6, 7
"""Fields of a body's dynamics as PyBullet returns them."""


def check_world(bullet: Any, numbers: list[int], scenario: Scenario, settings: Settings, here: dict[str, int]) -> None:
    """Refuse a world that is not what the scenario and the settings mean. numbers: of the bodies, in their order."""
    world = bullet.getPhysicsEngineParameters(**here)
    read_back.check(TITLE, "timestep", settings.timestep, world["fixedTimeStep"], "s")
    read_back.check(TITLE, "substeps", 0, world["numSubSteps"])
    gravity = [world[f"gravityAcceleration{axis}"] for axis in "XYZ"]
    read_back.check(TITLE, "gravity", scenario.gravity, gravity, "m/s²")
    if "solver_iterations" in settings.options:
        told = settings.number("solver_iterations")
        read_back.check(TITLE, "solver iterations", told, world["numSolverIterations"])
    bodies = [bullet.getDynamicsInfo(number, -1, **here) for number in numbers]
    masses = [known[MASS] or math.inf for known in bodies]  # Bullet writes 0 for a body that nothing moves
    read_back.check_bodies(TITLE, scenario, masses, [known[INERTIA] for known in bodies])
    for body, known in zip(scenario.bodies, bodies, strict=True):
        torques = known[ROLLING], known[SPINNING]  # a scenario has neither of these frictions
        read_back.check(TITLE, f"friction of {body.name} against rolling and spinning", (0, 0), torques)
    for pair in scenario.pairs:
        a, b = bodies[scenario.index(pair.body_a)], bodies[scenario.index(pair.body_b)]
        read_back.check_pair(TITLE, "friction", pair, pair.kinetic_friction, a[FRICTION] * b[FRICTION])
        if settings["coordinates"] == "multibody":
            read_back.check_pair(TITLE, "restitution", pair, pair.restitution, a[RESTITUTION] * b[RESTITUTION])
