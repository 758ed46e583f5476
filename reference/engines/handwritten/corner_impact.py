"""Step loop for boxes without weight that fly at a half-space, turning or not, strike it once and fly on, batch first.

All physics comes from the implementation's functions; the loop only decides when to call them. No function of the
lecture gives the instant at which the corner of a turning box meets a plane, since the corner moves on a helix. The
loop halves the interval in which the lowest corner goes under.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Sequence

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.handwritten.impact_response import (
    MEETS_AGAIN,
    NEEDS_A_WORLD,
    after_impact,
    impulse_function,
)
from reference.engines.handwritten.rigid_bodies import RigidBodies
from reference.engines.handwritten.scenario_bodies import box_and_plane, turns_steadily
from reference.engines.handwritten.stepping import policy_of, record, start
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction
from reference.scene import geometry
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

HALVINGS = 60
"""How often the interval of an impact is halved: from one step down to rounding."""
_ROUNDING = 1e-9  # a length (m) or a speed (m/s) below this is rounding
_SIGNS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


def strike_corner(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Boxes that strike a half-space with a corner or straight on with an edge, with friction and spin, and fly on."""
    boxes = _Boxes(scenarios, settings, implementation)
    policies = {"exact_root": boxes.step_through_impact, "at_step": boxes.respond_then_step}
    return record(engine, scenarios, settings, steps, boxes.states, policy_of(policies, settings), boxes.events)


class _Boxes:
    """The box of each of N scenarios and the half-space that it flies at: two ways to step them."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        self.scenarios, self.dt, self.law = scenarios, settings.timestep, impulse_function(settings)
        self.function = functools.cache(implementation.function)  # looked up when a step first needs it
        both = [box_and_plane(scenario) for scenario in scenarios]
        self.box, self.plane = (RigidBodies(scenarios, bodies, implementation) for bodies in zip(*both, strict=True))
        self.corners = _SIGNS * np.array([box.shape.half_extents for box, _ in both])[:, None, :]  # type: ignore[union-attr]
        self.normal = np.array([plane.shape.normal for _, plane in both])  # type: ignore[union-attr]
        self.offset = -np.vecdot(self.normal, self.plane.position)
        self.has_struck = np.zeros(len(scenarios), dtype=bool)
        self.events: list[list[Event]] = [[] for _ in scenarios]
        self._start = start(scenarios)

    def step_through_impact(self, time: float) -> None:
        """Fly each box to its impact, if it has one within the step, resolve it there, and fly on."""
        whole = np.full(len(self.scenarios), self.dt)
        motion = self.function("ballistic_motion")
        struck = self.lowest_gap(motion, whole) < -_ROUNDING
        if not struck.any():
            self.box.move(motion, whole)
            return
        until = np.where(struck, self._until_impact(motion), whole)
        self.box.move(motion, until)
        self.respond(struck, time + until)
        self.box.move(motion, whole - until)

    def respond_then_step(self, time: float) -> None:
        """Resolve the impact of every box that overlaps the plane and approaches it, then take a step of Euler's."""
        none = np.zeros(len(self.scenarios))
        gap = self.lowest_gap(self.function("ballistic_motion"), none)
        struck = (self.function("side_of_plane")(gap) < 0) & (self.approach() < -_ROUNDING)
        if struck.any():
            self.respond(struck, np.full(len(struck), time))
        self.box.move(self.function("semi_implicit_euler"), none + self.dt)

    def lowest_gap(self, motion: Callable[..., tuple[Array, Array]], duration: Array) -> Array:
        """Gap below the lowest corner of each box after a while (N,), s: (N,), m."""
        position, _ = motion(self.box.position, self.box.velocity, self.box.acceleration, duration)
        turned = geometry.turned(self.box.orientation, self.box.spin * duration[:, None])
        places = np.asarray(position)[:, None, :] + geometry.rotate(turned[:, None, :], self.corners)
        gaps = self.function("signed_distance")(places, self.normal[:, None, :], self.offset[:, None])
        return np.asarray(np.min(gaps, axis=-1))

    def lowest_point(self) -> Array:
        """From the centre to the lowest corner, or to the middle of the lowest edge, (N, 3), m."""
        arms = geometry.rotate(self.box.orientation[:, None, :], self.corners)
        heights = np.vecdot(arms, self.normal[:, None, :])
        lowest = heights < heights.min(axis=-1, keepdims=True) + _ROUNDING
        return np.asarray(np.sum(arms * lowest[..., None], axis=1) / lowest.sum(axis=-1, keepdims=True))

    def approach(self) -> Array:
        """Velocity of the lowest point along the normal, (N,), m/s; negative when it approaches."""
        return np.asarray(np.vecdot(self.box.velocity + np.cross(self.box.spin, self.lowest_point()), self.normal))

    def respond(self, struck: Mask, time: Array) -> None:
        """Give the boxes that strike their velocities after the impact; refuse what needs a rigid-body world."""
        if np.any(struck & self.has_struck):
            raise NeedsFunction(MEETS_AGAIN)
        arm = self.lowest_point()
        for member in np.flatnonzero(struck).tolist():
            self._refuse_two_points(member, arm[member])
        at_box = self.box.struck_at(arm)
        at_plane = self.plane.struck_at(self.box.position + arm - self.plane.position)
        after = after_impact(self.function, self.law, self.scenarios, at_box, at_plane, self.normal)
        self.box.set_velocities(struck, after[0], after[1])
        for member in np.flatnonzero(struck).tolist():
            if not turns_steadily(self.box.bodies[member], self.box.orientation[member], self.box.spin[member]):
                raise NeedsFunction(NEEDS_A_WORLD)
            self.events[member].append(Event(float(time[member]), "impact", self.box.bodies[member].name))
        self.has_struck = self.has_struck | struck

    def states(self) -> Array:
        """The states of all bodies as a sample keeps them, (N, 2, 13)."""
        states = self._start.copy()
        states[np.arange(len(states)), self.box.place] = self.box.states()
        return states

    def _until_impact(self, motion: Callable[..., tuple[Array, Array]]) -> Array:
        """Time within the step after which the lowest corner of each box is under the plane, (N,), s."""
        low, high = np.zeros(len(self.scenarios)), np.full(len(self.scenarios), self.dt)
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            under = self.lowest_gap(motion, middle) < 0
            low, high = np.where(under, low, middle), np.where(under, middle, high)
        return low

    def _refuse_two_points(self, member: int, arm: Array) -> None:
        """Refuse a face, and an edge that does not move straight across itself: its two ends share no one impulse."""
        corners = geometry.rotate(self.box.orientation[member], self.corners[member])
        heights = corners @ self.normal[member]
        ends = corners[heights < heights.min() + _ROUNDING]
        velocities = self.box.velocity[member] + np.cross(self.box.spin[member], ends)
        uneven = np.ptp(velocities, axis=0).max() > _ROUNDING
        along = len(ends) == 2 and abs(velocities[0] @ (ends[1] - ends[0])) > _ROUNDING
        if len(ends) > 2 or uneven or along:
            raise NeedsFunction(NEEDS_A_WORLD)
