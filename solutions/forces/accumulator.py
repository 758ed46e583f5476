"""Forces of any kind on all bodies by name, and an audit of the energy (slides 23, 30).

The audit says how much energy each force brings in. The sum of the lab's own forces is
in `total`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import positive

Tag = Literal["position", "velocity", "interaction"]
"""What a force depends on, as slide 30 sorts the forces.

Springs and gravity depend on the position. Viscosity, wind and dampers depend on the
velocity. Friction and contacts depend on the interaction of bodies.
"""


@dataclass(frozen=True)
class Force:
    """One kind of force on all N bodies at once.

    Attributes
    ----------
    name : unique among the forces of a world
    tag : what the force depends on
    force : function of position and velocity, each (..., N, 3), m, m/s
        It returns the force on each body, (..., N, 3), N.
    potential : function of the position, (..., N, 3), m, for a conservative force
        It returns the potential energy of the whole system, (...), J.

    Raises
    ------
    ValueError
        If there is no such tag.
    """

    name: str
    tag: Tag
    force: Callable[[Array, Array], ArrayLike]
    potential: Callable[[Array], ArrayLike] | None = None

    def __post_init__(self) -> None:
        if self.tag not in get_args(Tag):
            raise ValueError(
                f"tag must be one of {', '.join(get_args(Tag))}, not {self.tag!r}"
            )


def evaluate_forces(
    forces: Sequence[Force],
    position: ArrayLike,
    velocity: ArrayLike,
) -> dict[str, Array]:
    """Every force on each body, by the force's name (slide 30).

    Parameters
    ----------
    forces : each with a name of its own
    position, velocity : (..., N, 3), m, m/s

    Returns
    -------
    (..., N, 3) for each name, N

    Raises
    ------
    ValueError
        If two forces have the same name.
    """
    if len({each.name for each in forces}) < len(forces):
        raise ValueError(
            f"forces must have names of their own, not {', '.join(each.name for each in forces)}"
        )
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    shape = np.broadcast_shapes(p.shape, v.shape)
    return {
        each.name: np.broadcast_to(
            np.asarray(each.force(p, v), dtype=float), shape
        )
        for each in forces
    }


def acceleration_of(
    forces: Sequence[Force],
    mass: ArrayLike,
) -> Callable[[Array, Array], Array]:
    """Acceleration by the forces, as the function that integrators take (slide 30).

    Parameters
    ----------
    forces : each with a name of its own
    mass : (N,), kg, above zero; an infinite mass is not accelerated

    Returns
    -------
    function of position and velocity, each (..., N, 3), m, m/s
        It returns the accelerations, (..., N, 3), m/s².

    Raises
    ------
    ValueError
        If a mass is not positive. The function returned raises it if two forces have
        the same name.

    Notes
    -----
    By Newton's second law each body has the acceleration

        a = F/m

    where F is the sum of all forces on the body. It is zero if there are no forces.
    """
    m = positive("mass", mass)[..., None]

    def acceleration(position: Array, velocity: Array) -> Array:
        zero = np.zeros(
            np.broadcast_shapes(np.shape(position), np.shape(velocity))
        )
        return np.asarray(
            sum(
                evaluate_forces(forces, position, velocity).values(),
                start=zero,
            )
            / m
        )

    return acceleration


@dataclass(frozen=True)
class EnergyAudit:
    """Where the energy of a run of T states went, J, each (T,).

    Attributes
    ----------
    kinetic : (T,), Σ m v²/2
        Bodies with infinite mass are left out.
    work : by the name of the force, (T,), since the start
    potential : by the name of the force, (T,), of the forces that have one
    """

    kinetic: Array
    work: Mapping[str, Array]
    potential: Mapping[str, Array]

    def residual(self) -> Array:
        """Kinetic energy gained that no force's work accounts for, (T,), J.

        It is the error of the integrator and of the audit.
        """
        return np.asarray(
            self.kinetic - self.kinetic[0] - sum(self.work.values())
        )

    def mechanical(self) -> Array:
        """Kinetic and potential energy together, (T,), J.

        It is constant if all forces are conservative.
        """
        return np.asarray(self.kinetic + sum(self.potential.values()))


def audit_energy(
    forces: Sequence[Force],
    mass: ArrayLike,
    position: ArrayLike,
    velocity: ArrayLike,
    dt: ArrayLike,
) -> EnergyAudit:
    """Account for the energy of a run (slide 30).

    Parameters
    ----------
    forces : each with a name of its own
    mass : (N,), kg
    position, velocity : (T, N, 3), m, m/s, at equal or unequal intervals
    dt : (T − 1,) or one number, s, between the states

    Returns
    -------
    EnergyAudit
        The work of each force is wrong by an error of the order of dt². What an impulse
        brings in is not the work of any force, and it appears in the residual.

    Raises
    ------
    ValueError
        If position and velocity do not have the same shape (T, N, 3), a mass is not
        positive, or two forces have the same name.

    Notes
    -----
    The work of a force is the integral of its power over time. The power F·v is known
    at the T states. The trapezoidal rule takes it as linear between two states, so that
    an interval of length dt adds the mean of its two powers times dt.
    """
    p, v, m = (
        np.asarray(position, dtype=float),
        np.asarray(velocity, dtype=float),
        positive("mass", mass),
    )
    if p.ndim != 3 or p.shape != v.shape:
        raise ValueError(
            f"position and velocity must have the same shape (T, N, 3), not {p.shape} and {v.shape}"
        )
    kinetic = (
        np.sum(np.where(np.isfinite(m), m, 0.0)[:, None] * v**2, axis=(1, 2))
        / 2
    )
    found = evaluate_forces(forces, p, v)
    work = {
        name: _integral(_power(force, v), np.asarray(dt, dtype=float))
        for name, force in found.items()
    }
    potential = {
        each.name: np.asarray(each.potential(p), dtype=float)
        for each in forces
        if each.potential is not None
    }
    return EnergyAudit(kinetic, work, potential)


def _power(force: Array, velocity: Array) -> Array:
    return np.asarray(np.sum(force * velocity, axis=(-2, -1)))


def _integral(rate: Array, dt: Array) -> Array:
    """Integral of a rate (T,) from the start to each instant, by trapezoids."""
    return np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2 * dt)])
