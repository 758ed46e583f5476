"""Step loops for balls without friction over a single plane, on which they bounce and come to rest, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.handwritten.points import PointsAndPlanes
from reference.engines.handwritten.stepping import checked_impact_times, policy_of, record
from reference.engines.implementation import Implementation
from reference.engines.pybullet_spring import MOST_DAMPING_RATIO
from reference.errors import RunFailed
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

_MOST_IMPACTS = 20_000  # of one ball within one step; at e = 0.999 it comes to rest within half as many


def bounce(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Balls without friction that fall on one plane each, bounce and come to rest."""
    balls = _Balls(scenarios, settings, implementation)
    policies = {
        "exact_root": balls.step_to_exact_roots,
        "interpolated": balls.step_to_slides_times,
        "at_step": balls.respond_then_step,
        "penalty": balls.push_then_step,
    }
    return record(engine, scenarios, settings, steps, balls.states, policy_of(policies, settings), balls.events)


class _Balls(PointsAndPlanes):
    """N balls, each over a plane of its own: the ways to step them, and what these share.

    `respond_at_impact` and `respond_at_step` know one impact, and a ball comes to rest by infinitely many. So the loop
    itself takes the normal velocity from a ball that leaves its plane too slowly. From then on the plane carries it.
    """

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        self._signed_distance = self.function("signed_distance")
        self.normal = self.normals[:, 0]
        radius = np.array([body.shape.radius for body in self.bodies])  # type: ignore[union-attr]
        self.offset = self.offsets[:, 0] - radius
        self.restitution = np.array([scenario.pairs[0].restitution for scenario in scenarios])
        self.acceleration = self.function("uniform_gravity")(self.mass, self.gravity) / self.mass[:, None]
        self.normal_acceleration = np.vecdot(self.acceleration, self.normal)
        self.along_plane = self.acceleration - self.normal_acceleration[:, None] * self.normal
        # A ball that leaves the plane at w is back after 2 w/g: below this w the flight is too short to be followed.
        self.rest_speed = np.zeros(len(scenarios))
        if "shortest_flight" in settings.options:
            self.rest_speed = settings.number("shortest_flight") * self.dt * -self.normal_acceleration / 2
        if "stiffness" in settings.options:
            self.spring = self._spring(settings.number("stiffness"))
        self.resting = np.zeros(len(scenarios), dtype=bool)

    def _spring(self, stiffness: float) -> tuple[Array, Array]:
        """Stiffness, N/m, and damping, N s/m, of each contact, (N,), from a stiffness per unit mass, 1/s²."""
        each = stiffness * self.mass
        damping = self.function("penalty_damping")(self.restitution, self.mass, each)
        return each, np.minimum(damping, 2 * MOST_DAMPING_RATIO * np.sqrt(each * self.mass))

    # The policies

    def step_to_exact_roots(self, time: float) -> None:
        """Let each ball respond at the first root of its parabola."""
        self.bounce_through_step(time, self.exact_roots)

    def step_to_slides_times(self, time: float) -> None:
        """Let each ball respond at the slide's T."""
        self.bounce_through_step(time, self.slides_times)

    def respond_then_step(self, time: float) -> None:
        """Let every ball bounce that is behind its plane and approaches, and take a semi-implicit step."""
        behind = (self.function("side_of_plane")(self.separation(self.position)) < 0) & ~self.resting
        struck = behind & (self.normal_velocity() < 0)
        before = self.position, self.velocity
        respond, e = self.function("respond_at_step"), self.restitution
        after = respond(*before, self.acceleration, self.normal, behind, e, self.whole_step)
        self.position, self.velocity = map(np.asarray, after)
        self.report(struck, now := np.full(len(struck), time), "impact")
        to_rest = struck & (self.normal_velocity() <= self.rest_speed)
        self.report(to_rest, now, "rest")
        self.resting |= to_rest
        if self.resting.any():
            into = np.where(to_rest, np.vecdot(before[1], self.normal), 0.0)
            start = before[0], before[1] - into[:, None] * self.normal
            carried = self.function("semi_implicit_euler")(*start, self.along_plane, self.whole_step)
            self.position, self.velocity = self.chosen(self.resting, carried, (self.position, self.velocity))

    def push_then_step(self, time: float) -> None:
        """Let the penalty springs push, and take a semi-implicit step."""
        stiffness, damping = self.spring
        gap, rate = self.separation(self.position), self.normal_velocity()
        force = self.function("penalty_force")(gap, rate, self.normal, stiffness, damping)
        moved = self.function("semi_implicit_euler")
        pull = self.acceleration + force / self.mass[:, None]
        self.position, self.velocity = map(np.asarray, moved(self.position, self.velocity, pull, self.whole_step))

    # The instants of impact

    def exact_roots(self, remaining: Array) -> Array:
        """Time until each ball meets its plane, (N,), s."""
        roots = self.function("time_of_impact_exact")(
            self.separation(self.position), self.normal_velocity(), self.normal_acceleration
        )
        return np.where(self.resting, np.inf, checked_impact_times("time_of_impact_exact", roots))

    def slides_times(self, remaining: Array) -> Array:
        """The slide's T: where the chord between the separations now and after the rest of the step is 0.

        A ball that leaves the plane and is back within the step starts and ends on it; a chord cannot see that flight.
        """
        before = np.maximum(self.separation(self.position), 0.0)  # left on the plane, it may be behind it by rounding
        after = self.separation(self.flown(remaining)[0])
        chords = self.function("time_of_impact_interpolated")(before, after, 0.0, remaining)
        impact = checked_impact_times("time_of_impact_interpolated", chords)
        leaves = (before == 0) & (self.normal_velocity() > 0)
        return np.where(self.resting | leaves, np.inf, impact)

    # What they share

    def bounce_through_step(self, time: float, until_impact: Callable[[Array], Array]) -> None:
        """Let each ball respond at its impacts, and fly on until the step is over.

        `respond_at_impact` goes from the start of the step to its end and does not see a second impact on the way. So
        the loop also asks it for the state just after the impact, and looks from there. Only if the ball meets the
        plane again within the rest of the step, or comes to rest, does the loop replace the end of the step.
        """
        remaining = self.whole_step
        impact = until_impact(remaining)
        end = self.after_impact(impact, remaining)
        for _ in range(_MOST_IMPACTS):
            struck = impact <= remaining
            if not struck.any():
                self.position, self.velocity = end
                return
            passed = np.minimum(impact, remaining)
            place, _ = self.flown(passed)
            _, self.velocity = self.after_impact(impact, passed)
            self.position = place  # of the flight alone: in single precision, ever smaller bounces would never end
            remaining = remaining - passed
            to_rest = self.bring_to_rest(struck, time + self.dt - remaining)
            impact = until_impact(remaining)
            again = to_rest | (impact <= remaining)
            if again.any():
                end = self.chosen(again, self.after_impact(impact, remaining), end)
        raise RunFailed(f"more than {_MOST_IMPACTS} impacts in one step: the ball does not get away from its plane")

    def after_impact(self, impact: Array, duration: Array) -> tuple[Array, Array]:
        """Positions and velocities after a while in which each ball responds at the time of its impact, (N,), s."""
        respond, e = self.function("respond_at_impact"), self.restitution
        after = respond(self.position, self.velocity, self.acceleration, self.normal, e, impact, duration)
        return self.chosen(self.resting, self.flown(duration), after) if self.resting.any() else after

    def bring_to_rest(self, struck: Mask, time: Array) -> Mask:
        """Take the normal velocity from each ball that leaves its plane too slowly; return which these are."""
        leaving = self.normal_velocity()
        to_rest = struck & (leaving <= self.rest_speed)
        self.velocity = np.where(to_rest[:, None], self.velocity - leaving[:, None] * self.normal, self.velocity)
        self.resting |= to_rest
        self.report(struck, time, "impact")
        self.report(to_rest, time, "rest")
        return np.asarray(to_rest)

    def flown(self, duration: Array) -> tuple[Array, Array]:
        """Positions and velocities after a flight; to a ball that rests, its weight along the plane is left."""
        acceleration = np.where(self.resting[:, None], self.along_plane, self.acceleration)
        moved: tuple[Array, Array] = self.function("ballistic_motion")(
            self.position, self.velocity, acceleration, duration
        )
        return moved

    def separation(self, position: Array) -> Array:
        """Gap between each plane and its ball at a position (N, 3): (N,), m; negative behind the plane."""
        return np.asarray(self._signed_distance(position, self.normal, self.offset))

    def normal_velocity(self) -> Array:
        """Velocity along the plane's normal, (N,), m/s; negative when approaching."""
        return np.asarray(np.vecdot(self.velocity, self.normal))

    @staticmethod
    def chosen(mask: Mask, one: tuple[Array, Array], other: tuple[Array, Array]) -> tuple[Array, Array]:
        """Positions and velocities, for the balls in the mask (N,) the first ones, for the others the second ones."""
        (position, velocity), (other_position, other_velocity) = one, other
        chosen = mask[:, None]
        return np.where(chosen, position, other_position), np.where(chosen, velocity, other_velocity)
