"""A ball on a spring as MuJoCo and DART have it: a body in a sliding joint along the spring, which is the joint's own.

Such an engine knows the stiffness and the damper of its own joint, and so takes some of their forces as they will be at
the end of the step. Of a force from outside it cannot know how it changes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.engines.profiles import JOINT
from reference.errors import InvalidInput
from reference.scene import geometry
from reference.scene.forces import Spring
from reference.scene.scenario import Body, Scenario
from reference.scene.settings import Settings
from reference.scene.straight_spring import Ends, on_one_spring


@dataclass(frozen=True)
class SlidingJoint:
    """The joint of a scenario that is one ball on one spring. Its coordinate is the length of the spring, m."""

    body: Body
    spring: Spring
    ends: Ends

    @property
    def axis(self) -> Array:
        """Along the spring to the ball, (3,), in the ball's own axes."""
        conjugate = geometry.opposite(np.array(self.body.orientation))
        return geometry.rotate(conjugate, self.ends.direction)

    def as_free(self, length: float, rate: float) -> tuple[list[float], list[float]]:
        """Pose (place, turn) and velocities (of the centre, spin) of the ball at a length, m, and its rate, m/s."""
        # From the start on, so that rounding leaves the start itself as it is
        place = self.body.position + (length - self.ends.length) * self.ends.direction
        velocity = self.body.velocity + (rate - self.ends.rate) * self.ends.direction
        return [*place.tolist(), *self.body.orientation], [*velocity.tolist(), 0.0, 0.0, 0.0]


def has_joint(settings: Settings) -> bool:
    """Whether an engine is told of the spring as of that of a joint."""
    return settings.options.get("springs") == JOINT


def joint_of(scenario: Scenario, settings: Settings) -> SlidingJoint | None:
    """The joint that an engine gets with these settings, None where its bodies are free.

    Raises
    ------
    InvalidInput
        If the settings ask for a joint, and the scenario is not one ball on one spring.
    """
    if not has_joint(settings):
        return None
    ends = on_one_spring(scenario)
    if ends is None:
        raise InvalidInput(f"{scenario.name}: a sliding joint takes one ball that moves along one spring, and no more")
    return SlidingJoint(scenario.bodies[ends.first], scenario.springs[0], ends)
