"""An impact with friction in space, under each law of restitution; `planar_impact` is its counterpart in a plane.

Vectors have two components along the surface and the last one along the normal, out of B. None of the searches here
follows those of the hand-written code: what a law demands is looked for by trying all directions of friction, and an
impact is followed with steps that shrink with its slip.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.impact_truth import APART, DISSIPATIVE, NEWTON, POISSON, STRONGE

ALONG_GRIP, BY_AXES = "along grip", "by axes"
"""Two more of Newton's laws, which in a plane are NEWTON. ALONG_GRIP: friction that cannot hold has the direction of
the impulse that would hold. BY_AXES: friction opposes the slip that is left after each of its two components has been
divided by what a unit impulse along that axis changes of it; so a solver settles one axis after the other."""
LAWS_IN_WORDS: Mapping[str, str] = {
    NEWTON: "Newton's law of restitution",
    ALONG_GRIP: "Newton's law of restitution, with friction along the impulse that would hold",
    BY_AXES: "Newton's law of restitution, with friction settled one axis after the other",
    DISSIPATIVE: "Newton's law of restitution, with the friction that takes the most energy",
    POISSON: "Poisson's law of restitution",
    STRONGE: "Stronge's law of restitution",
    APART: "a normal impulse as without friction, and friction settled after it",
}
"""Each law as a reason names it."""
DIRECTIONS = 720
"""Directions of friction that are tried before the search is refined, one every half degree."""
HALVINGS = 60
"""How often an interval is halved: down to rounding."""
STEP = 0.03
"""A step of an impact changes the velocity by this share of the slip at most."""
STOPPED = 1e-12
"""A slip below this share of the speed of the impact has stopped."""


@dataclass(frozen=True)
class SpatialContact:
    """A contact in space.

    k: (3, 3), what a unit impulse changes of the velocity of A's point relative to B's, 1/kg. before: (3,), that
    velocity before the impact, m/s; its last component is negative. friction: μ.
    """

    k: Array
    before: Array
    friction: float

    def after(self, impulse: Array) -> Array:
        """Velocity of A's point relative to B's after an impulse, (3,), m/s."""
        return np.asarray(self.before + self.k @ impulse)

    def energy_gained(self, impulse: Array) -> float:
        """Work of an impulse, J: the impulse times the mean of the velocities before and after it."""
        return float(impulse @ (self.before + self.after(impulse)) / 2)


def spatial_impact(contact: SpatialContact, restitution: float, law: str) -> Array:
    """Return the impulse of an impact, (3,), N s.

    NEWTON, ALONG_GRIP and BY_AXES. The impulse that stops the slip and leaves u_n⁺ = −e u_n is taken if it lies in the
    cone. Otherwise it lies on the edge, J = p (n + μ d), where p follows from u_n⁺. The law names the direction d.

    DISSIPATIVE. Of all J with that u_n⁺ the one is taken that leaves the least energy: in the cone if it lies there, or
    else on its edge.

    POISSON and STRONGE. The impact is followed in its normal impulse p. At each moment dJ/dp = n − μ u_t/|u_t|; where
    there is no slip, friction holds if it can. The approach ends where u_n = 0, at p_c. Poisson ends at (1 + e) p_c,
    Stronge where the integral of u_n over p has given back e² of what it took.
    """
    if law in (POISSON, STRONGE):
        return _followed(contact, restitution, law)
    if law == DISSIPATIVE:
        return _least_energy(contact, restitution)
    grip = np.linalg.solve(contact.k, np.array([0.0, 0.0, -restitution * contact.before[2]]) - contact.before)
    if math.hypot(grip[0], grip[1]) <= contact.friction * grip[2]:
        return np.asarray(grip)
    if law == ALONG_GRIP:
        return _on_the_edge(contact, restitution, math.atan2(grip[1], grip[0]))
    weights = 1 / np.diagonal(contact.k)[:2] if law == BY_AXES else np.ones(2)

    def opposed(angle: float) -> Array:
        """The slip that friction in this direction leaves, weighted: across friction, and against it."""
        slip = weights * contact.after(_on_the_edge(contact, restitution, angle))[:2]
        return np.array([slip @ (-math.sin(angle), math.cos(angle)), -slip @ (math.cos(angle), math.sin(angle))])

    return _on_the_edge(contact, restitution, root_angle(opposed))


def _on_the_edge(contact: SpatialContact, restitution: float, angle: float) -> Array:
    """Impulse on the edge of the cone, friction in a direction, that leaves −e u_n; infinite where none does."""
    push = np.array([contact.friction * math.cos(angle), contact.friction * math.sin(angle), 1.0])
    gain = contact.k[2] @ push
    return np.asarray(-(1 + restitution) * contact.before[2] / gain * push if gain > 0 else np.full(3, np.inf))


def root_angle(sides: Callable[[float], Array]) -> float:
    """The angle at which the first of two numbers crosses zero while the second is positive."""
    angles = np.linspace(0, 2 * np.pi, DIRECTIONS + 1)
    with np.errstate(invalid="ignore"):
        across = [sides(angle)[0] for angle in angles]
    for low, high, before, after in zip(angles, angles[1:], across, across[1:], strict=False):
        if before * after > 0 or not math.isfinite(before * after):
            continue
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if sides(middle)[0] * before > 0 else (low, middle)
        if sides(low)[1] > 0:
            return float(low)
    raise ArithmeticError("no direction of friction opposes the slip that it leaves")


def _least_energy(contact: SpatialContact, restitution: float) -> Array:
    """Impulse in the cone that leaves −e u_n and the least energy.

    With J_n = c − a·J_t, where c = −(1 + e) u_n/K_nn and a = K_nt/K_nn, the energy is a paraboloid over J_t.
    """
    k, u = contact.k, contact.before
    c, a = -(1 + restitution) * u[2] / k[2, 2], k[2, :2] / k[2, 2]
    lowest = np.linalg.solve(k[:2, :2] - np.outer(a, k[2, :2]), a * u[2] - u[:2])
    inside = np.array([*lowest, c - a @ lowest])
    if math.hypot(*lowest) <= contact.friction * inside[2]:
        return inside

    def energy(angle: float) -> float:
        impulse = _on_the_edge(contact, restitution, angle)
        return contact.energy_gained(impulse) if math.isfinite(impulse[2]) else math.inf

    def slope(angle: float) -> float:
        """How the energy grows with the angle: u⁺·dJ, where dJ is along push' (K push)_n − push (K push')_n."""
        push = np.array([contact.friction * math.cos(angle), contact.friction * math.sin(angle), 1.0])
        across = np.array([-push[1], push[0], 0.0])
        change = across * (k[2] @ push) - push * (k[2] @ across)
        return float(contact.after(_on_the_edge(contact, restitution, angle)) @ change)

    angles = np.linspace(0, 2 * np.pi, DIRECTIONS, endpoint=False)
    best, near = float(min(angles, key=energy)), 2 * np.pi / DIRECTIONS
    low, high = best - near, best + near
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if slope(middle) < 0 else (low, middle)
    return _on_the_edge(contact, restitution, high)


def _followed(contact: SpatialContact, restitution: float, law: str) -> Array:
    """Impulse of an impact that is followed step by step. The state is J and the work of the normal force."""
    turned = _advance(contact, np.zeros(4), lambda state: float(contact.after(state[:3])[2]))
    if law == POISSON or restitution == 0:
        wanted = (1 + restitution) * turned[2]
        return _advance(contact, turned, lambda state: float(state[2] - wanted))[:3]
    left = (1 - restitution**2) * turned[3]
    return _advance(contact, turned, lambda state: float(state[3] - left))[:3]


def _advance(contact: SpatialContact, state: Array, beyond: Callable[[Array], float]) -> Array:
    """Follow an impact until `beyond` is no longer negative.

    The clock τ of a slip that turns runs with dp = |u_t| dτ. So du/dτ = K (|u_t| n − μ u_t) has no division by the
    slip, which dies away as an exponential where it stops.
    """
    rate = (1 + contact.friction) * float(np.linalg.norm(contact.k))
    size = float(np.linalg.norm(contact.before))
    while beyond(state) < 0:
        slip = math.hypot(*contact.after(state[:3])[:2])
        if slip <= STOPPED * size:
            return _straight(contact, state, beyond)
        further = _runge_kutta(contact, state, STEP / rate)
        if beyond(further) >= 0:
            return _halved(functools.partial(_part_of_step, contact, state, STEP / rate), beyond)
        state = further
    return state


def _part_of_step(contact: SpatialContact, state: Array, step: float, share: float) -> Array:
    return _runge_kutta(contact, state, share * step)


def _runge_kutta(contact: SpatialContact, state: Array, step: float) -> Array:
    """The state after a step of τ, by the classical rule."""

    def growth(at: Array) -> Array:
        u = contact.after(at[:3])
        slip = math.hypot(u[0], u[1])
        return np.array([-contact.friction * u[0], -contact.friction * u[1], slip, slip * u[2]])

    first = growth(state)
    second = growth(state + step / 2 * first)
    third = growth(state + step / 2 * second)
    fourth = growth(state + step * third)
    return np.asarray(state + step / 6 * (first + 2 * second + 2 * third + fourth))


def _straight(contact: SpatialContact, state: Array, beyond: Callable[[Array], float]) -> Array:
    """The state at the end of an impact whose slip has stopped: friction holds, or the slip starts in one direction.

    It starts along s, with friction against it, where K_tn − μ K_tt s has the direction of s as well.
    """
    k, mu = contact.k, contact.friction
    rubbed = -np.linalg.solve(k[:2, :2], k[:2, 2])
    if math.hypot(*rubbed) > mu:

        def grown(angle: float) -> Array:
            s = np.array([math.cos(angle), math.sin(angle)])
            growth = k[:2, 2] - mu * k[:2, :2] @ s
            return np.array([growth @ (-s[1], s[0]), growth @ s])

        angle = root_angle(grown)
        rubbed = -mu * np.array([math.cos(angle), math.sin(angle)])
    push = np.array([*rubbed, 1.0])
    speed, gain = contact.after(state[:3])[2], k[2] @ push

    def after(pressed: float) -> Array:
        return np.asarray(state + np.array([*(pressed * push), pressed * (speed + gain * pressed / 2)]))

    most = 1.0
    while beyond(after(most)) < 0:
        most *= 2
    return _halved(lambda share: after(share * most), beyond)


def _halved(at: Callable[[float], Array], beyond: Callable[[Array], float]) -> Array:
    """The state at the share, 0 to 1, at which `beyond` is no longer negative."""
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if beyond(at(middle)) < 0 else (low, middle)
    return at(high)
