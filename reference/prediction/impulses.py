"""What each implementation makes of one contact with friction in one step: an impulse along and across the surface.

A contact lies in a plane, as in `reference.impact_truth`: t along the slip and n along the normal.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

from reference.engines.base import (
    BULLET,
    BULLET_SPRING,
    DART,
    MUJOCO_ONE_STEP,
    MUJOCO_SPRING,
    RESPOND_THEN_STEP,
    Method,
)
from reference.engines.dart_settings import SOFTNESS
from reference.impact_truth import NEWTON, Contact, dissipated, held, planar_impact, stuck
from reference.prediction.laws import Bullet, BulletSpring, Dart, MuJoCoOneStep, World, law_of
from reference.scene.scenario import Pair
from reference.scene.settings import Settings

LEAST_FRICTION = 1e-5
"""MuJoCo takes this friction for any smaller one."""

SINGULAR = 1e-10
"""`mju_QCQP2` gives no friction where the determinant of μ² A is less; A are the tangents' inverse masses, 1/kg."""


@dataclass(frozen=True)
class Met:
    """A contact at the start of a step.

    contact: its velocities, without what this step adds to them. weight, others: what weight and the other contacts of
    the step add, along t and n, m/s. inverse_mass: the sum of those of the two bodies, 1/kg.
    """

    contact: Contact
    gap: float
    weight: tuple[float, float]
    others: tuple[float, float]
    inverse_mass: float

    @property
    def added(self) -> tuple[float, float]:
        """What the step adds to the velocities without this contact, along t and n, m/s."""
        return self.weight[0] + self.others[0], self.weight[1] + self.others[1]

    def free(self, softness: float = 0.0) -> Contact:
        """The contact with what the step adds to its velocities, and the diagonal of K larger by a share `softness`."""
        own, (along, across) = self.contact, self.added  # told in full: `replace` takes longer than the rest of a rule
        k_tt, k_nn = own.k_tt * (1 + softness), own.k_nn * (1 + softness)
        return Contact(k_tt, own.k_tn, k_nn, own.slip + along, own.normal + across, own.friction)


@dataclass(frozen=True)
class Given:
    """An impulse along t and n, N s, and how far the step moves the surfaces apart without speed, m."""

    along: float = 0.0
    pressed: float = 0.0
    push: float = 0.0


class Rule(Protocol):
    """What a method gives in a step of a contact."""

    @property
    def felt(self) -> float:
        """For how long weight acts before friction looks where the surfaces slip, s."""

    @property
    def least_friction(self) -> float:
        """The friction that there is even where none was asked for."""

    def given(self, met: Met) -> Given:
        """The impulse of the step."""


@dataclass(frozen=True)
class ByHand:
    """Hand-written code: what overlaps and approaches gets Newton's impulse, before weight adds to its velocity."""

    restitution: float
    felt: ClassVar[float] = 0.0
    least_friction: ClassVar[float] = 0.0

    def given(self, met: Met) -> Given:
        """The impulse of the step."""
        if met.gap >= 0 or met.contact.normal >= 0:
            return Given()
        return Given(*planar_impact(met.contact, self.restitution, NEWTON))


@dataclass(frozen=True)
class ByVelocity:
    """Bullet and DART: the law along the normal says the rate after the step; friction is against the slip then left.

    Both go from row to row until nothing changes. softness: DART takes the diagonal of K for larger by this share.
    pivots: DART's stock solver finds the normal impulse without friction first, and limits friction by μ times that;
    what friction then changes of the normal velocity, a new normal impulse takes back.
    """

    law: Bullet | BulletSpring | Dart
    softness: float = 0.0
    pivots: bool = False
    least_friction: ClassVar[float] = 0.0

    @property
    def felt(self) -> float:
        """The whole step, s: forces come first."""
        return self.law.dt

    def given(self, met: Met) -> Given:
        """The impulse of the step."""
        across = met.added[1]
        after, push = self.law.contact(met.gap, met.contact.normal, met.weight[1], met.others[1])
        change = (after - met.contact.normal - across) * (1 + self.softness)
        if change <= 0:
            return Given(push=push)
        contact = met.free(self.softness)
        if not self.pivots:
            return Given(*held(contact, change), push)
        most = contact.friction * change / contact.k_nn
        along, _ = stuck(contact, change)
        along = min(max(along, -most), most)
        return Given(along, (change - contact.k_tn * along) / contact.k_nn, push)


@dataclass(frozen=True)
class InTheWorld:
    """The hand-written world: the law along the normal says the rate after the step; friction takes the most energy."""

    law: World
    static_friction: float
    least_friction: ClassVar[float] = 0.0

    @property
    def felt(self) -> float:
        """The whole step, s: forces come first."""
        return self.law.dt

    def given(self, met: Met) -> Given:
        """The impulse of the step."""
        across = met.added[1]
        after, push = self.law.contact(met.gap, met.contact.normal, met.weight[1], met.others[1])
        change = after - met.contact.normal - across
        if change <= 0:
            return Given(push=push)
        contact = met.free()
        return Given(*dissipated(contact, change, self.static_friction), push)


@dataclass(frozen=True)
class MuJoCos:
    """MuJoCo: the force f in the cone with the least f·(A + R) f/2 + f·(a₀ − a_ref), "Computation", the dual problem.

    A is K, a₀ the acceleration without contact, a_ref = −(B u + k r)/d along the normal and −B_t s/d along the slip,
    and R = (1 − d)/d · (1/m_A + 1/m_B), divided by impratio along the slip. noslip: the passes after that keep the
    normal force and let friction take the whole slip, as far as Coulomb's cone allows.
    """

    law: MuJoCoOneStep
    friction_damping: float
    impratio: float
    noslip: bool
    least_friction: ClassVar[float] = LEAST_FRICTION

    @property
    def felt(self) -> float:
        """As long as weight takes to make what B_t s/d is of a slip s."""
        return self.law.impedance / self.friction_damping if self.friction_damping else 0.0

    def given(self, met: Met) -> Given:
        """The impulse of the step."""
        if met.gap >= 0:
            return Given()
        law, contact, dt = self.law, met.contact, self.law.dt
        friction = max(contact.friction, self.least_friction)
        along, across = met.added
        lean = along / dt + self.friction_damping * contact.slip / law.impedance
        press = across / dt + (law.damping * contact.normal + law.stiffness * met.gap) / law.impedance
        yielding = (1 - law.impedance) / law.impedance * met.inverse_mass
        along, pressed = least_in_cone(
            contact.k_tt + yielding / self.impratio, contact.k_tn, contact.k_nn + yielding, lean, press, friction
        )
        if self.noslip and contact.friction > 0:  # the passes leave so small a matrix, A μ², alone
            most = friction * pressed
            along = min(max(-(lean + contact.k_tn * pressed) / contact.k_tt, -most), most)
        return Given(along * dt, pressed * dt)


def noslip_gives_up(k: float, k_across: float, friction: float) -> bool:
    """Whether MuJoCo's noslip passes make no friction: where it is weak, or the bodies are heavy.

    k, k_across: what a unit impulse changes of the velocity along each of two tangents that do not touch each other,
    1/kg.
    """
    return friction > 0 and k * k_across * friction**4 < SINGULAR


def least_in_cone(
    h_tt: float, h_tn: float, h_nn: float, lean: float, press: float, friction: float
) -> tuple[float, float]:
    """The f_t and f_n ≥ 0, |f_t| ≤ μ f_n, with the least f·H f/2 + (lean, press)·f."""
    determinant = h_tt * h_nn - h_tn**2
    along, pressed = (-lean * h_nn + press * h_tn) / determinant, (-press * h_tt + lean * h_tn) / determinant
    if abs(along) <= friction * pressed:
        return along, pressed
    found = [(0.0, 0.0, 0.0)]
    for edge in (-friction, friction):
        slope, curvature = edge * lean + press, edge**2 * h_tt + 2 * edge * h_tn + h_nn
        pressed = max(0.0, -slope / curvature)
        found.append((slope * pressed + curvature * pressed**2 / 2, edge * pressed, pressed))
    return min(found)[1:]


def rule_of(settings: Settings, method: Method, pair: Pair) -> Rule | None:
    """The rule of a method for a pair; None where none is written."""
    law = law_of(settings, method, pair.restitution)
    if method.rule == RESPOND_THEN_STEP:
        return ByHand(pair.restitution)
    if isinstance(law, World):
        return InTheWorld(law, float(pair.static_friction))  # type: ignore[arg-type]
    if method.rule == BULLET and isinstance(law, Bullet):
        return ByVelocity(law)
    if method.rule == BULLET_SPRING and isinstance(law, BulletSpring):
        return ByVelocity(law)
    if method.rule == DART and isinstance(law, Dart):
        return ByVelocity(law, SOFTNESS, pivots=settings.options.get("solver", "dantzig") == "dantzig")
    if method.rule in (MUJOCO_ONE_STEP, MUJOCO_SPRING) and isinstance(law, MuJoCoOneStep):
        options = settings.options
        impratio = settings.number("impratio") if "impratio" in options else 1.0
        noslip = bool(options.get("noslip_iterations", 0))
        friction_damping = 1 / settings.timestep if method.rule == MUJOCO_ONE_STEP else law.damping
        return MuJoCos(law, friction_damping, impratio, noslip)
    return None
