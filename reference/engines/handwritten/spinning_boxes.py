"""Step loops for a smooth ball that the face of a spinning box strikes, both without weight, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from reference.arrays import Array, Mask
from reference.engines.handwritten.impact_response import NEEDS_A_WORLD
from reference.engines.handwritten.scenario_bodies import turns_steadily
from reference.engines.handwritten.stepping import checked_impact_times, policy_of, record
from reference.engines.handwritten.two_bodies import Pairs
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction
from reference.scene import geometry
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

_ROUNDING = 1e-9  # a speed below this is rounding, m/s
_SIGNS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
_STILL = np.zeros(3)


def strike_in_turning(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Boxes that turn about a principal axis and strike a smooth ball with a face, and both fly on."""
    pairs = _BallAndSpinningBox(scenarios, settings, implementation)
    policies = {"exact_root": pairs.step_through_impacts, "at_step": pairs.respond_then_step}
    return record(engine, scenarios, settings, steps, pairs.states, policy_of(policies, settings), pairs.events)


class _BallAndSpinningBox(Pairs):
    """A ball, A, and a box, B, whose nearest face it meets. Time is advanced as long as the two surely stay apart."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        self.half_extents = np.array([box.shape.half_extents for box in self.b.bodies])  # type: ignore[union-attr]

    def normal(self) -> Array:
        own, face = self._own_place_and_face()
        side = np.sign(np.take_along_axis(own, face[:, None], axis=1))
        return geometry.rotate(self.b.orientation, side * np.eye(3)[face])

    def gap(self) -> Array:
        normal, (_, face) = self.normal(), self._own_place_and_face()
        height = np.take_along_axis(self.half_extents, face[:, None], axis=1)[:, 0]
        offset = -np.vecdot(normal, self.b.position) - height - self.radius
        return np.asarray(self.function("signed_distance")(self.a.position, normal, offset))

    def normal_velocity(self) -> Array:
        normal = self.normal()
        arm = -self.radius[:, None] * normal
        at_a, at_b = self.a.struck_at(arm), self.b.struck_at(self.a.position + arm - self.b.position)
        return np.asarray(self.function("normal_velocity")(at_a, at_b, normal))

    def until_impact(self, remaining: Array) -> Array:
        a, b = self.a, self.b
        corners = geometry.rotate(b.orientation[:, None, :], _SIGNS * self.half_extents[:, None, :])
        ball, box = (
            (_STILL[None], a.position, a.velocity, _STILL, self.radius),
            (corners, b.position, b.velocity, b.spin, 0.0),
        )
        time = self.function("sweep_convex")(*ball, *box, remaining)
        approaching = self.normal_velocity() < -_ROUNDING  # a sweep also gives 0 for two that touch and part
        touched = np.isfinite(np.asarray(time)) & (np.asarray(time) <= 0)
        return checked_impact_times("sweep_convex", np.where(touched & ~approaching, np.inf, time))

    def out_of_reach(self) -> Mask:
        return np.zeros(len(self.scenarios), dtype=bool)

    def respond(self, struck: Mask, time: Array) -> None:
        """As for any two bodies; refuse a ball that an edge has met, and a box that tumbles afterwards."""
        own, face = self._own_place_and_face()
        beside = np.abs(own) > self.half_extents
        np.put_along_axis(beside, face[:, None], False, axis=1)
        super().respond(struck, time)
        for member in np.flatnonzero(struck).tolist():
            steady = turns_steadily(self.b.bodies[member], self.b.orientation[member], self.b.spin[member])
            if beside[member].any() or not steady:
                raise NeedsFunction(NEEDS_A_WORLD)

    def _own_place_and_face(self) -> tuple[Array, NDArray[np.intp]]:
        """The ball in the box's own axes, (N, 3), m, and the axis of the face beyond which it lies farthest, (N,)."""
        own = geometry.rotate(geometry.opposite(self.b.orientation), self.a.position - self.b.position)
        return own, np.argmax(np.abs(own) - self.half_extents, axis=1)
