"""Closed forms of an impact with friction in a plane, under each law of restitution; see `planar_impact`."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

NEWTON, DISSIPATIVE, POISSON, STRONGE, APART = "newton", "dissipative", "poisson", "stronge", "apart"
"""The laws. NEWTON: u_n⁺ = −e u_n, and friction against the slip that is left. DISSIPATIVE: the same u_n⁺, and the
friction within the cone that takes the most energy. POISSON: e is the ratio of the normal impulses of the two phases.
STRONGE: e² is the ratio of their works. APART: the normal impulse of an impact without friction, and within μ times
that whatever friction stops the slip; no law of mechanics, but what a solver gives that settles one after the other."""


@dataclass(frozen=True)
class Contact:
    """A contact in a plane: t along the surface and n along the normal, out of B.

    k_tt, k_tn, k_nn: what a unit impulse changes of the velocity of A's point relative to B's, 1/kg. slip, normal:
    that velocity before the impact, m/s; `normal` is negative. friction: μ.
    """

    k_tt: float
    k_tn: float
    k_nn: float
    slip: float
    normal: float
    friction: float

    def after(self, along: float, pressed: float) -> tuple[float, float]:
        """Slip and normal velocity after an impulse, m/s."""
        slip = self.slip + self.k_tt * along + self.k_tn * pressed
        return slip, self.normal + self.k_tn * along + self.k_nn * pressed

    def energy_gained(self, along: float, pressed: float) -> float:
        """Work of an impulse, J: the impulse times the mean of the velocities before and after it."""
        slip, normal = self.after(along, pressed)
        return (along * (self.slip + slip) + pressed * (self.normal + normal)) / 2


def planar_impact(contact: Contact, restitution: float, law: str) -> tuple[float, float]:
    """Return the impulse of an impact along the surface and along the normal, N s.

    NEWTON. The normal velocity changes by −(1 + e) u_n, and `held` says what friction does.

    DISSIPATIVE. With J_n = (−(1 + e) u_n − k_tn J_t)/k_nn the energy is a parabola in J_t, least where
    J_t (k_tt − k_tn²/k_nn) = −(u_t − k_tn u_n/k_nn). The cone cuts an interval around J_t = 0 out of it.

    POISSON and STRONGE. While the normal impulse p grows, the slip changes by k_tn + f k_tt for each unit of it, and
    the normal velocity by k_nn + f k_tn, with f = −μ against the slip. If that stops the slip, f is −k_tn/k_tt from
    there on, which holds it, or μ against the slip that the normal impulse then makes. So u_n is linear in p in both
    legs. The approach ends where u_n = 0, at p_c. Poisson ends at (1 + e) p_c, Stronge where the integral of u_n over p
    has given back e² of what it took.
    """
    if law in (POISSON, STRONGE):
        return _followed(contact, restitution, law)
    k, wanted = contact, -(1 + restitution) * contact.normal
    if law == APART:
        pressed = wanted / k.k_nn
        most = k.friction * pressed
        return min(max(-(k.slip + k.k_tn * pressed) / k.k_tt, -most), most), pressed
    return dissipated(contact, wanted) if law == DISSIPATIVE else held(contact, wanted)


def dissipated(contact: Contact, wanted: float, static_friction: float | None = None) -> tuple[float, float]:
    """The impulse that changes the normal velocity by `wanted`, with the friction that leaves the least energy, N s.

    static_friction: μ_s, within which friction holds; μ if it is not given.
    """
    k, static = contact, contact.friction if static_friction is None else static_friction
    tilt = k.k_tn / k.k_nn
    along = -(k.slip - tilt * k.normal) / (k.k_tt - tilt * k.k_tn)
    if abs(along) > static * (wanted - k.k_tn * along) / k.k_nn:
        sign = math.copysign(1.0, along)
        along = sign * k.friction * _edge(k, wanted, sign)
    return along, (wanted - k.k_tn * along) / k.k_nn


def held(contact: Contact, wanted: float) -> tuple[float, float]:
    """The impulse that changes the normal velocity by `wanted`, with friction against the slip that is left, N s.

    Three modes are tried: the slip stops, or slides on one way, or the other. A mode holds if its impulse lies in the
    cone and friction opposes the slip that is left.
    """
    along, pressed = stuck(contact, wanted)
    if abs(along) <= contact.friction * pressed:
        return along, pressed
    pressed = _edge(contact, wanted, math.copysign(1.0, along))
    return math.copysign(contact.friction * pressed, along), pressed


def stuck(contact: Contact, wanted: float) -> tuple[float, float]:
    """The impulse that changes the normal velocity by `wanted` and ends the slip, however much friction that takes."""
    k = contact
    determinant = k.k_tt * k.k_nn - k.k_tn**2
    return (-k.slip * k.k_nn - wanted * k.k_tn) / determinant, (wanted * k.k_tt + k.slip * k.k_tn) / determinant


def _edge(contact: Contact, wanted: float, sign: float) -> float:
    """Normal impulse on one edge of the cone that changes u_n by `wanted`; infinite where none does."""
    gain = contact.k_nn + sign * contact.friction * contact.k_tn
    return wanted / gain if gain > 0 else math.inf


def _followed(contact: Contact, restitution: float, law: str) -> tuple[float, float]:
    """Impulse of an impact that is followed leg by leg."""
    legs = _legs(contact)
    at_turn, taken = _pressed_until(contact, legs, lambda normal, gain, work: -normal / gain if gain > 0 else math.inf)
    if law == POISSON or restitution == 0:
        return _along(legs, (1 + restitution) * at_turn), (1 + restitution) * at_turn
    left = (1 - restitution**2) * taken

    def root(normal: float, gain: float, work: float) -> float:
        """Length of leg after which the work is `left`, on its way up: gain p²/2 + normal p + work − left = 0."""
        under = max(0.0, normal**2 - 2 * gain * (work - left))  # below zero only in a leg that does not reach it
        return (-normal + math.sqrt(under)) / gain if gain > 0 else math.inf

    pressed, _ = _pressed_until(contact, legs, root)
    return _along(legs, pressed), pressed


def _legs(contact: Contact) -> list[tuple[float, float]]:
    """The legs of an impact: how much normal impulse each takes, the last without end, and J_t for each unit of it."""
    k = contact
    hold = -k.k_tn / k.k_tt
    rest = hold if abs(hold) <= k.friction else math.copysign(k.friction, hold)
    if k.slip == 0:
        return [(math.inf, rest)]
    rubbed = -math.copysign(k.friction, k.slip)
    change = k.k_tn + rubbed * k.k_tt
    if change * k.slip >= 0:
        return [(math.inf, rubbed)]
    return [(-k.slip / change, rubbed), (math.inf, rest)]


def _pressed_until(
    contact: Contact, legs: list[tuple[float, float]], length_of: Callable[[float, float, float], float]
) -> tuple[float, float]:
    """Normal impulse at which something happens, and the work of the normal force until then, J.

    length_of: normal velocity, its gain for each unit of impulse, and work so far → how far into this leg it happens.
    """
    pressed, work, normal = 0.0, 0.0, contact.normal
    for length, ratio in legs:
        gain = contact.k_nn + ratio * contact.k_tn
        part = min(length, length_of(normal, gain, work))
        pressed, work, normal = pressed + part, work + part * (normal + gain * part / 2), normal + gain * part
        if part < length:
            break
    return pressed, work


def _along(legs: list[tuple[float, float]], pressed: float) -> float:
    """J_t after so much normal impulse, N s."""
    along = 0.0
    for length, ratio in legs:
        part = min(length, pressed)
        along, pressed = along + ratio * part, pressed - part
    return along
