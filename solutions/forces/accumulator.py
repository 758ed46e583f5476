"""Forces of any kind, by name, and the energy they bring in (slide 30).

The sum of the lab's own forces is in `total`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import of_shape, real
from solutions.domain import Number, Positive, domain, require

Tag = Literal["position", "velocity", "interaction"]
"""What a force depends on.

Springs and gravity depend on the position. Viscosity, wind and dampers depend
on the velocity. Friction and contacts depend on the interaction of bodies.
Slide 30 sorts the forces so, except that it counts wind under position (see
`wind_force`).
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
    potential : function of the position, (..., N, 3), m, if it is conservative
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
        tags = get_args(Tag)
        words = f"tag must be one of {', '.join(tags)}, not {self.tag!r}"
        require(self.tag in tags, words)


@domain
def evaluate_forces(
    forces: Sequence[Force], position: Number, velocity: Number
) -> dict[str, Array]:
    """Every force on each body, by the force's name (slide 30).

    Parameters
    ----------
    forces : a sequence of `Force`, each with a name of its own
    position, velocity : (..., N, 3), m, m/s

    Returns
    -------
    (..., N, 3) for each name, N

    Raises
    ------
    ValueError
        If two forces have the same name.
    """
    names = [force.name for force in forces]
    words = f"forces must have names of their own, not {', '.join(names)}"
    require(len(set(names)) == len(names), words)
    shape = np.broadcast_shapes(position.shape, velocity.shape)
    return {
        force.name: of_shape(
            force.name, force.force(position, velocity), shape
        )
        for force in forces
    }


@domain
def acceleration_of(
    forces: Sequence[Force], mass: Positive
) -> Callable[[Array, Array], Array]:
    """Acceleration by the forces, as a function for integrators (slide 30).

    Parameters
    ----------
    forces : a sequence of `Force`, each with a name of its own
    mass : (N,), kg, above zero; an infinite mass is not accelerated

    Returns
    -------
    function of position and velocity, each (..., N, 3), m, m/s
        It returns the accelerations, (..., N, 3), m/s².

    Raises
    ------
    ValueError
        The function returned raises it if two forces have the same name.

    Notes
    -----
    By Newton's second law each body has the acceleration

        a = F/m

    where F is the sum of all forces on the body. It is zero if there are no
    forces.
    """

    def acceleration(position: Array, velocity: Array) -> Array:
        total = np.zeros(
            np.broadcast_shapes(np.shape(position), np.shape(velocity))
        )
        for force in evaluate_forces(forces, position, velocity).values():
            total = total + force
        return total / mass[..., None]

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
        return self.kinetic - self.kinetic[0] - sum(self.work.values())

    def mechanical(self) -> Array:
        """Kinetic and potential energy together, (T,), J.

        It is constant if all forces are conservative.
        """
        return self.kinetic + sum(self.potential.values())


@domain
def audit_energy(
    forces: Sequence[Force],
    mass: Positive,
    position: Number,
    velocity: Number,
    dt: Number,
) -> EnergyAudit:
    """Account for the energy of a run (slide 30).

    Parameters
    ----------
    forces : a sequence of `Force`, each with a name of its own
    mass : (N,), kg, above zero
    position, velocity : (T, N, 3), m, m/s, at equal or unequal intervals
    dt : (T − 1,) or one number, s, between the states

    Returns
    -------
    EnergyAudit
        The work of each force is wrong by an error of the order of dt². What
        an impulse brings in is not the work of any force, and it appears in
        the residual.

    Raises
    ------
    ValueError
        If position and velocity do not have the same shape (T, N, 3), or two
        forces have the same name.

    Notes
    -----
    The work of a force is the integral of its power over time. The power F·v
    is known at the T states. The trapezoidal rule takes it as linear between
    two states, so that an interval of length dt adds the mean of its two
    powers times dt.
    """
    p, v = position.shape, velocity.shape
    words = "position and velocity must have the same shape (T, N, 3), not"
    require(len(p) == 3 and p == v, f"{words} {p} and {v}")
    movable = np.where(np.isfinite(mass), mass, 0.0)
    kinetic = np.sum(movable[:, None] * velocity**2, axis=(1, 2)) / 2
    work = {
        name: _integral(np.sum(force * velocity, axis=(-2, -1)), dt)
        for name, force in evaluate_forces(forces, position, velocity).items()
    }
    potential = {
        force.name: real(force.name, force.potential(position))
        for force in forces
        if force.potential is not None
    }
    return EnergyAudit(kinetic, work, potential)


def _integral(rate: Array, dt: Array) -> Array:
    """Integral of a rate (T,) up to each instant, by trapezoids."""
    return np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2 * dt)])
