"""All forces on all bodies, summed, and an audit of the energy that each brings in (slides 23 and 30)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import positive

Array = NDArray[np.float64]
Tag = Literal["position", "velocity", "interaction"]
"""What a force hangs on, as slide 30 sorts them: springs, gravity; viscosity, wind, dampers; friction, contacts."""


@dataclass(frozen=True)
class Force:
    """One kind of force on all N bodies at once.

    name: unique among the forces of a world. tag: what it hangs on. force: a function of position and velocity, each
    (..., N, 3), that returns (..., N, 3), N. potential: for a conservative force, a function of the position that
    returns the energy of the whole system (...), J.
    """

    name: str
    tag: Tag
    force: Callable[[Array, Array], ArrayLike]
    potential: Callable[[Array], ArrayLike] | None = None

    def __post_init__(self) -> None:
        if self.tag not in get_args(Tag):
            raise ValueError(f"tag must be one of {', '.join(get_args(Tag))}, not {self.tag!r}")


def evaluate_forces(forces: Sequence[Force], position: ArrayLike, velocity: ArrayLike) -> dict[str, Array]:
    """Every force by its name (slide 30).

    Parameters
    ----------
    forces : with names of their own
    position, velocity : (..., N, 3), m, m/s

    Returns
    -------
    (..., N, 3) for each name, N
    """
    if len({each.name for each in forces}) < len(forces):
        raise ValueError(f"forces must have names of their own, not {', '.join(each.name for each in forces)}")
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    shape = np.broadcast_shapes(p.shape, v.shape)
    return {each.name: np.broadcast_to(np.asarray(each.force(p, v), dtype=float), shape) for each in forces}


def total_force(forces: Sequence[Force], position: ArrayLike, velocity: ArrayLike) -> Array:
    """Sum of all forces on each body; zero if there are none (slide 30).

    Parameters
    ----------
    forces : with names of their own
    position, velocity : (..., N, 3), m, m/s

    Returns
    -------
    (..., N, 3), N
    """
    zero = np.zeros(np.broadcast_shapes(np.shape(position), np.shape(velocity)))
    return np.asarray(sum(evaluate_forces(forces, position, velocity).values(), start=zero))


def acceleration_of(forces: Sequence[Force], mass: ArrayLike) -> Callable[[Array, Array], Array]:
    """What the forces give rise to, a = F/m, as the function that the integrators take (slide 30).

    Parameters
    ----------
    forces : with names of their own
    mass : (N,), kg, above zero; an infinite mass is not accelerated

    Returns
    -------
    function of position and velocity, each (..., N, 3), that returns (..., N, 3), m/s²
    """
    m = positive("mass", mass)[..., None]
    return lambda position, velocity: np.asarray(total_force(forces, position, velocity) / m)


def power_by_tag(forces: Sequence[Force], position: ArrayLike, velocity: ArrayLike) -> dict[str, Array]:
    """Power Σ F·v that the forces of each tag bring in, over all bodies.

    Parameters
    ----------
    forces : with names of their own
    position, velocity : (..., N, 3), m, m/s

    Returns
    -------
    (...) for each of the three tags, W
    """
    found = evaluate_forces(forces, position, velocity)
    powers = {each.name: _power(found[each.name], np.asarray(velocity, dtype=float)) for each in forces}
    zero = np.zeros(np.broadcast_shapes(np.shape(position), np.shape(velocity))[:-2])
    return {
        tag: np.asarray(sum((powers[each.name] for each in forces if each.tag == tag), start=zero))
        for tag in get_args(Tag)
    }


@dataclass(frozen=True)
class EnergyAudit:
    """Where the energy of a run of T states went, J, each (T,).

    kinetic: Σ m v²/2; bodies with infinite mass are left out. work: by the name of the force, since the start.
    potential: by name, of the forces that have one.
    """

    kinetic: Array
    work: Mapping[str, Array]
    potential: Mapping[str, Array]

    def residual(self) -> Array:
        """Kinetic energy gained that no force's work accounts for, (T,), J: the error of integrator and audit."""
        return np.asarray(self.kinetic - self.kinetic[0] - sum(self.work.values()))

    def mechanical(self) -> Array:
        """Kinetic and potential energy together, (T,), J: constant if all forces are conservative."""
        return np.asarray(self.kinetic + sum(self.potential.values()))


def audit_energy(
    forces: Sequence[Force], mass: ArrayLike, position: ArrayLike, velocity: ArrayLike, dt: ArrayLike
) -> EnergyAudit:
    """Account for the energy of a run (slide 30).

    The work of each force is its power, integrated by the trapezoidal rule: out by some dt². What an impulse brings in
    is no force's work, and stands in the residual.

    Parameters
    ----------
    forces : with names of their own
    mass : (N,), kg
    position, velocity : (T, N, 3), m, m/s, at equal or unequal intervals
    dt : (T − 1,) or one number, s, between the states

    Returns
    -------
    EnergyAudit
    """
    p, v, m = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float), positive("mass", mass)
    if p.ndim != 3 or p.shape != v.shape:
        raise ValueError(f"position and velocity must have the same shape (T, N, 3), not {p.shape} and {v.shape}")
    kinetic = np.sum(np.where(np.isfinite(m), m, 0.0)[:, None] * v**2, axis=(1, 2)) / 2
    found = evaluate_forces(forces, p, v)
    work = {name: _integral(_power(force, v), np.asarray(dt, dtype=float)) for name, force in found.items()}
    potential = {each.name: np.asarray(each.potential(p), dtype=float) for each in forces if each.potential is not None}
    return EnergyAudit(kinetic, work, potential)


def _power(force: Array, velocity: Array) -> Array:
    return np.asarray(np.sum(force * velocity, axis=(-2, -1)))


def _integral(rate: Array, dt: Array) -> Array:
    """Integral of a rate (T,) from the start to each instant by the trapezoidal rule."""
    return np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2 * dt)])
