"""What each implementation makes of one contact in one step, along the normal: its own rule, beside its documentation.

`gap` is the distance of the surfaces at the start of a step, m; `rate` is its rate of change, m/s, negative when they
approach; `fall` is what forces other than the contact add to the rate in one step, m/s.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Protocol

from reference import truth
from reference.engines.base import (
    BULLET,
    BULLET_SPRING,
    DART,
    MUJOCO_ONE_STEP,
    MUJOCO_SPRING,
    PENALTY,
    RESPOND_THEN_STEP,
    WORLD,
    Method,
)
from reference.engines.dart_settings import REST_SPEED, SOFTNESS
from reference.engines.mujoco_read_back import MOST_DAMPED
from reference.engines.pybullet_spring import LEAST_DAMPING, MOST_DAMPING_RATIO
from reference.scene.settings import Settings

TOUCHING = 1e-10
"""Gap up to which the surfaces of the hand-written world touch, m: `solutions.world.shapes.TOUCH`."""
DART_RECOVERY, DART_FASTEST_RECOVERY = 0.01, 1e-3
"""Share of an overlap that DART takes back in a step, and how fast at most, m/s."""

BULLETS_PUSHED_TURN = 0.1
"""Share of the turn of a push that Bullet carries out; the others carry out all of it."""


class Law(Protocol):
    """One step of a method, with its contact."""

    @property
    def dt(self) -> float:
        """The timestep, s."""

    @property
    def reach(self) -> float:
        """Gap up to which it makes a contact, m."""

    @property
    def in_parabolas(self) -> bool:
        """Whether it flies as theory does, and not in steps of semi-implicit Euler."""

    def step(self, gap: float, rate: float, fall: float) -> tuple[float, float]:
        """Gap and rate at the end of a step."""


@dataclass(frozen=True)
class RespondThenStep:
    """The lecture's response: behind the plane and approaching, the rate is turned back; then semi-implicit Euler.

    rest_speed: of a rebound that is taken for rest, m/s. In the step of its impact, and at rest, a body is carried. A
    plane pushes and does not pull, so that a weight which pulls the body off acts in that step too.
    """

    dt: float
    restitution: float
    rest_speed: float
    reach: ClassVar[float] = 0.0
    in_parabolas: ClassVar[bool] = False

    def step(self, gap: float, rate: float, fall: float) -> tuple[float, float]:
        """Gap and rate at the end of a step."""
        if gap <= 0 and rate <= 0 and (rate < 0 or self.rest_speed > 0):
            rebound = -self.restitution * rate
            rate = (rebound if rebound > self.rest_speed else 0.0) + max(fall, 0.0)
        else:
            rate += fall
        return gap + rate * self.dt, rate


@dataclass(frozen=True)
class Penalty:
    """The lecture's penalty contact: in overlap the acceleration −k r − c u, k and c per unit mass, never a pull.

    The gap r and the rate u are those before the step, which is then one of semi-implicit Euler.
    """

    dt: float
    stiffness: float
    damping: float
    reach: ClassVar[float] = 0.0
    in_parabolas: ClassVar[bool] = False

    def step(self, gap: float, rate: float, fall: float) -> tuple[float, float]:
        """Gap and rate at the end of a step."""
        push = max(0.0, -self.stiffness * gap - self.damping * rate) if gap < 0 else 0.0
        rate += fall + push * self.dt
        return gap + rate * self.dt, rate


class ByContact(ABC):
    """A law that gives a rate and a push, with which semi-implicit Euler then moves the surfaces."""

    dt: float

    @abstractmethod
    def contact(self, gap: float, rate: float, fall: float, others: float = 0.0) -> tuple[float, float]:
        """Rate after a step, m/s, and how far the step moves the surfaces apart besides, m.

        others: what other contacts add to the rate in the same step, m/s.
        """

    def step(self, gap: float, rate: float, fall: float) -> tuple[float, float]:
        """Gap and rate at the end of a step."""
        after, push = self.contact(gap, rate, fall)
        return gap + after * self.dt + push, after


@dataclass(frozen=True)
class World(ByContact):
    """The hand-written world: the rate before the step is turned back, and a share of the overlap ahead moved away.

    `solutions.world.step`: the impulse is what the rate needs to be e times that of the approach, if that is faster
    than `rest_speed`; or else to come no nearer in this step than the gap, 0 in overlap. It never pulls. A rebound
    waits for the step whose beginning is nearest to the touch; until then there is no contact. with_weight: whether the
    approach includes what the forces of this step add to it. `recovery` is the share of the overlap at the end of the
    step, beyond `slop`, that the step moves away.
    """

    dt: float
    restitution: float
    rest_speed: float
    recovery: float
    slop: float
    reach: float
    with_weight: bool
    in_parabolas: ClassVar[bool] = False

    def rebound(self, rate: float, fall: float) -> float:
        """Rate of parting after an impact, m/s; 0 where there is no rebound."""
        approach = -(rate + fall) if self.with_weight else -rate
        return self.restitution * approach if approach > self.rest_speed else 0.0

    def contact(self, gap: float, rate: float, fall: float, others: float = 0.0) -> tuple[float, float]:
        """Rate after a step, and how far the step moves the surfaces apart besides, m."""
        after = rate + fall + others
        rebound = self.rebound(rate, fall)
        waits = rebound > 0 and gap > TOUCHING and gap + (rate + fall) * self.dt / 2 > TOUCHING
        if gap > self.reach or waits:
            return after, 0.0
        after = max(after, rebound or -max(gap, 0.0) / self.dt)
        return after, self.recovery * max(-(gap + after * self.dt + self.slop), 0.0)


@dataclass(frozen=True)
class Bullet(ByContact):
    """Bullet in maximal coordinates: the rate before the step is turned back, a share of the overlap moved away.

    btSequentialImpulseConstraintSolver::setupContactConstraint: the impulse is what the rate needs to be e times that
    of the approach, or zero below the threshold, and it never pulls. Where the surfaces are still apart, within
    `reach`, they may approach by the gap in this step. Split impulses move the body by `recovery` of its overlap, and
    leave its velocity alone. An overlap of up to `slop` counts as a gap.
    """

    dt: float
    restitution: float
    rest_speed: float
    recovery: float
    reach: float = 0.0
    slop: float = 0.0
    in_parabolas: ClassVar[bool] = False

    def contact(self, gap: float, rate: float, fall: float, others: float = 0.0) -> tuple[float, float]:
        """Rate after a step, and how far the step moves the surfaces apart besides, m."""
        after, push = rate + fall + others, 0.0
        if gap <= self.reach:
            rebound = max(-self.restitution * rate, 0.0) if -rate >= self.rest_speed else 0.0
            left = gap + self.slop
            after, push = max(after, rebound - max(left, 0.0) / self.dt), self.recovery * max(-left, 0.0)
        return after, push


@dataclass(frozen=True)
class BulletSpring(ByContact):
    """Bullet with a contact spring, k and c per unit mass: from the touch on it adds the acceleration −k r − c u⁺.

    r is the gap before the step and u⁺ the rate after it, so that a = −(k r + c u)/(1 + c dt); it never pulls. That is
    the spring of the world. A spring of the bodies takes the gap after the step, which is the same with a dashpot of
    c + k dt. `reference.engines.pybullet_spring` derives both from what Bullet solves.
    """

    dt: float
    stiffness: float
    damping: float
    reach: ClassVar[float] = 0.0
    in_parabolas: ClassVar[bool] = False

    def contact(self, gap: float, rate: float, fall: float, others: float = 0.0) -> tuple[float, float]:
        """Rate after a step, and how far the step moves the surfaces apart besides, m: nothing."""
        after = rate + fall + others
        if gap <= 0:
            push = -(self.stiffness * gap + self.damping * after) / (1 + self.damping * self.dt)
            after += max(push, 0.0) * self.dt
        return after, 0.0


@dataclass(frozen=True)
class MuJoCoOneStep:
    """MuJoCo under Euler with `solref = (−K, −B)`: in overlap the contact makes the acceleration a = −B u − K r.

    "Computation", solver parameters: a₁ = (1 − d) a₀ + d a_ref with a_ref = −(B u + K r)/d, where a₀ is the
    acceleration without the contact. It never pulls. d is the share that the constraint has of the whole: MuJoCo makes
    it so that one contact with the inverse mass that it takes for that of its bodies has just the impedance; what gives
    more easily, or is carried by several contacts, has more of it.
    """

    dt: float
    damping: float
    stiffness: float
    impedance: float
    ease: float = 1.0
    reach: ClassVar[float] = 0.0
    in_parabolas: ClassVar[bool] = False

    def acceleration(self, gap: float, rate: float, free: float) -> float:
        """Acceleration of the gap, m/s². free: without contact."""
        if gap >= 0:
            return free
        share = self.ease * self.impedance / (self.ease * self.impedance + 1 - self.impedance)
        wanted = -(self.damping * rate + self.stiffness * gap) / self.impedance
        return max(free, (1 - share) * free + share * wanted)

    def step(self, gap: float, rate: float, fall: float) -> tuple[float, float]:
        """Gap and rate at the end of a step."""
        after = rate + self.acceleration(gap, rate, fall / self.dt) * self.dt
        return gap + after * self.dt, after


@dataclass(frozen=True)
class MuJoCoSpring(MuJoCoOneStep):
    """The same contact under RK4, which asks for the acceleration four times a step."""

    in_parabolas: ClassVar[bool] = True

    def step(self, gap: float, rate: float, fall: float) -> tuple[float, float]:
        """Gap and rate at the end of a step."""
        dt, free = self.dt, fall / self.dt
        rates, pulls, at, with_rate = [], [], gap, rate
        for ahead in (dt / 2, dt / 2, dt, 0.0):
            rates.append(with_rate)
            pulls.append(self.acceleration(at, with_rate, free))
            at, with_rate = gap + ahead * rates[-1], rate + ahead * pulls[-1]
        mean_rate, mean_pull = (
            (first + 2 * (second + third) + last) / 6 for first, second, third, last in (rates, pulls)
        )
        return gap + dt * mean_rate, rate + dt * mean_pull


@dataclass(frozen=True)
class Dart(ByContact):
    """DART: forces first, then the rate that they have made is turned back, up to a softness.

    ContactConstraint.cpp: the impulse is what the rate needs to be e times that of the approach, unless that is slower
    than 0.1 m/s. Overlap is taken back at 1 mm/s at most, as a rate or, with split impulses, by moving the body.
    """

    dt: float
    restitution: float
    split: bool
    reach: ClassVar[float] = 0.0
    in_parabolas: ClassVar[bool] = False

    def contact(self, gap: float, rate: float, fall: float, others: float = 0.0) -> tuple[float, float]:
        """Rate after a step, and how far the step moves the surfaces apart besides, m."""
        after, push = rate + fall + others, 0.0
        if gap <= 0:
            recovery = min(DART_RECOVERY * -gap / self.dt, DART_FASTEST_RECOVERY)
            rebound = -self.restitution * (rate + fall)
            wanted = rebound if rebound > REST_SPEED else 0.0
            if self.split:
                push = recovery * self.dt / (1 + SOFTNESS)
            else:
                wanted = max(wanted, recovery)
            after += max(0.0, wanted - after) / (1 + SOFTNESS)
        return after, push


def law_of(settings: Settings, method: Method, restitution: float, ease: float = 1.0) -> Law | None:
    """The law of a method for a pair with this restitution; None where none is written.

    ease: how easily the contact gives, in MuJoCo's measure: what a unit impulse changes of the rate, times the mass
    that MuJoCo takes for it, 1/(1/m_A + 1/m_B); and times the number of contacts that share it.
    """
    dt = settings.timestep
    if method.rule == RESPOND_THEN_STEP:
        return RespondThenStep(dt, restitution, method.rest_speed)
    if method.rule == PENALTY:
        stiffness, ratio = settings.number("stiffness"), min(truth.damping_ratio(restitution), MOST_DAMPING_RATIO)
        return Penalty(dt, stiffness, 2 * ratio * math.sqrt(stiffness))
    if method.rule == WORLD:
        slop, weighed = settings.number("overlap_slop"), bool(settings["with_weight"])
        return World(dt, restitution, method.rest_speed, method.recovery, slop, method.reach, weighed)
    if method.rule == BULLET:
        raised = "margin" in settings.options  # on ground that is a margin higher, and the slop is the margin
        slop = settings.number("contact_slop") if "contact_slop" in settings.options and not raised else 0.0
        return Bullet(dt, restitution, method.rest_speed, method.recovery, method.reach, slop)
    if method.rule == BULLET_SPRING:
        stiffness = settings.number("stiffness")
        damping = 2 * min(truth.damping_ratio(restitution), MOST_DAMPING_RATIO) * math.sqrt(stiffness)
        firmness = stiffness * dt
        of_bodies = settings["spring_of"] == "bodies"
        damping = damping + firmness if of_bodies else max(damping, LEAST_DAMPING * firmness)
        return BulletSpring(dt, stiffness, damping)
    if method.rule == DART:
        return Dart(dt, restitution, bool(settings.options.get("split_impulse")))
    if method.rule == MUJOCO_ONE_STEP:
        stiffness = settings.number("overlap_recovery") / dt**2
        return MuJoCoOneStep(dt, (1 + restitution) / dt, stiffness, settings.number("impedance"), ease)
    if method.rule == MUJOCO_SPRING:
        stiffness, ratio = settings.number("stiffness"), min(truth.damping_ratio(restitution), MOST_DAMPED)
        return MuJoCoSpring(dt, 2 * ratio * math.sqrt(stiffness), stiffness, settings.number("impedance"), ease)
    return None
