"""An account of an impact, in which a wrong sign on B shows (slide 21)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import domain
from solutions.impulse.body import AnyBody, Body, Velocities
from solutions.impulse.inertia import mass_and_inertia


@domain
def audit(
    body_a: AnyBody, body_b: AnyBody, after: Velocities
) -> tuple[Array, Array, Array]:
    """Momentum, angular momentum and energy that two bodies gain (slide 21).

    An impact may only take energy. Anything else that it changes is a mistake
    in the program.

    Count what can move and what can turn, each by itself. A centre that
    cannot move, 1/M = 0, adds nothing, but its body may still turn about it,
    as a door does on its hinges: then its spin counts. About an axis where its
    inverse inertia is 0 a body cannot be turned, and a spin about that axis
    adds nothing (see `mass_and_inertia`). The ground, whose inverses are all
    0, adds nothing at all. Beside the ground, ΔP is therefore what the ground
    has given; beside a body on a pivot, ΔP and ΔL are what the pivot has
    given.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
        As they are before the impact.
    after : v_A, ω_A, v_B, ω_B, (..., 3) each, m/s and rad/s
        The velocities after it, as `collide` and `apply_impulse` return them.

    Returns
    -------
    momentum : (..., 3), ΔP, N s
        Of both bodies together; 0 where each takes what the other gives.
    angular_momentum : (..., 3), ΔL, N m s
        Of both bodies together, about the point of contact: that of their
        spins, and that of their centres, which fly past this point.
    energy : (...), ΔE, J
        Kinetic energy of both bodies together, negative where the impact takes
        some.

    Notes
    -----
    One body has the momentum P = M v and the energy (M v·v + ω·I ω)/2. Its
    centre is at −r as seen from the contact, so that about the contact

        L = I ω − r × P

    An impulse J at the contact changes P by J and I ω by r × J. It does not
    change L, not even that of one body, since r × J − r × J = 0. (Where a
    pivot holds the centre, the second term is missing.) Each of the two
    momenta therefore answers a question of its own. ΔP: has B lost what A has
    gained? ΔL: does the spin of each body fit the change of its velocity? With
    the plus signs of slide 18 on both lines of B, ΔP is 2 J and ΔL is 0. With
    a plus on ω_B alone, ΔP is 0 and ΔL is 2 r_B × J.

    About another point, at p as seen from the contact, ΔL is less by p × ΔP.
    Where ΔP is 0 the point makes no difference.

    For the energy, M (v⁺·v⁺ − v⁻·v⁻)/2 = M (v⁺ − v⁻)·(v⁺ + v⁻)/2: the change
    of the momentum times the mean of the two velocities. The same holds for
    the spin. Where both bodies can move, a correct impact takes
    `energy_lost`: ΔE is minus that.
    """
    v_a, omega_a, v_b, omega_b = after
    momentum_a, angular_a, energy_a = _gained(body_a, v_a, omega_a)
    momentum_b, angular_b, energy_b = _gained(body_b, v_b, omega_b)
    return momentum_a + momentum_b, angular_a + angular_b, energy_a + energy_b


def _gained(
    body: Body, v_after: Array, omega_after: Array
) -> tuple[Array, Array, Array]:
    """ΔP, ΔL about the contact, and ΔE of one body with these velocities."""
    v_before, omega_before, r, inverse_mass, inverse_inertia = body
    mass, inertia = mass_and_inertia(inverse_mass, inverse_inertia)
    momentum = mass[..., None] * (v_after - v_before)
    turn = omega_after - omega_before
    spin_momentum = (inertia @ turn[..., None])[..., 0]
    angular_momentum = spin_momentum - np.cross(r, momentum)
    of_flight = np.vecdot(momentum, v_after + v_before)
    of_spin = np.vecdot(spin_momentum, omega_after + omega_before)
    return momentum, angular_momentum, (of_flight + of_spin) / 2
