"""Springs and dampers between two points (slides 27 and 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import not_negative, vector

Array = NDArray[np.float64]


def spring_force(
    position_1: ArrayLike, position_2: ArrayLike, stiffness: ArrayLike, rest_length: ArrayLike = 0.0
) -> Array:
    """Force of a spring on its end 1; end 2 gets the opposite, or is an anchor in the wall (slide 27).

        F = −k (L − L0) u,    u = (x1 − x2)/L,    L = ‖x1 − x2‖

    The slide's k (x − x_rest) is what stretches the spring: taken as the force on the mass, it pushes the mass away.
    At its rest length a spring exerts no force. A spring of length zero has no direction, so that it exerts none
    either, however much it is compressed; a force there would have to choose a side.

    Parameters
    ----------
    position_1, position_2 : (..., 3), m
    stiffness : (...), k, N/m, not negative
    rest_length : (...), L0, m, not negative; 0 for a spring whose ends attract each other from any distance

    Returns
    -------
    (..., 3), on end 1, N
    """
    length, direction = _line(position_1, position_2)
    stretch = length - not_negative("rest_length", rest_length)
    return np.asarray(-(not_negative("stiffness", stiffness) * stretch)[..., None] * direction)


def spring_energy(
    position_1: ArrayLike, position_2: ArrayLike, stiffness: ArrayLike, rest_length: ArrayLike = 0.0
) -> Array:
    """Energy stored in a spring: k (L − L0)²/2.

    Parameters
    ----------
    position_1, position_2 : (..., 3), m
    stiffness : (...), N/m, not negative
    rest_length : (...), m, not negative

    Returns
    -------
    (...), J
    """
    length, _ = _line(position_1, position_2)
    stretch = length - not_negative("rest_length", rest_length)
    return np.asarray(not_negative("stiffness", stiffness) * stretch**2 / 2)


def damper_force(
    position_1: ArrayLike, position_2: ArrayLike, velocity_1: ArrayLike, velocity_2: ArrayLike, damping: ArrayLike
) -> Array:
    """Force of a damper on its end 1; end 2 gets the opposite (slide 29).

        F = −k_d ((v1 − v2)·u) u,    u = (x1 − x2)/L

    The slide's −k_d v brakes all motion, of a spring that flies freely too. This one knows only how fast the length
    changes: it leaves momentum, angular momentum and any rigid motion alone. A damper of length zero has no direction
    and exerts no force.

    Parameters
    ----------
    position_1, position_2 : (..., 3), m
    velocity_1, velocity_2 : (..., 3), m/s
    damping : (...), k_d, N s/m, not negative

    Returns
    -------
    (..., 3), on end 1, N
    """
    _, direction = _line(position_1, position_2)
    relative = vector("velocity_1", velocity_1) - vector("velocity_2", velocity_2)
    lengthening = np.sum(relative * direction, axis=-1)
    return np.asarray(-(not_negative("damping", damping) * lengthening)[..., None] * direction)


def spring_damper_force(
    position_1: ArrayLike,
    position_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    stiffness: ArrayLike,
    rest_length: ArrayLike,
    damping: ArrayLike,
) -> Array:
    """Force of a spring with a damper beside it on their end 1; end 2 gets the opposite (slide 29).

        F = −k (L − L0) u − k_d ((v1 − v2)·u) u

    The slide writes (x' − x_rest) k − v k_d with the current position x'. Its spring has the wrong sign, and the motion
    runs away whatever the damping.

    Parameters
    ----------
    position_1, position_2 : (..., 3), m
    velocity_1, velocity_2 : (..., 3), m/s
    stiffness : (...), k, N/m
    rest_length : (...), L0, m
    damping : (...), k_d, N s/m

    Returns
    -------
    (..., 3), on end 1, N
    """
    spring = spring_force(position_1, position_2, stiffness, rest_length)
    return np.asarray(spring + damper_force(position_1, position_2, velocity_1, velocity_2, damping))


def _line(position_1: ArrayLike, position_2: ArrayLike) -> tuple[Array, Array]:
    """Length of a spring, and the unit vector from its end 2 to its end 1: zero where the ends coincide."""
    d = vector("position_1", position_1) - vector("position_2", position_2)
    length = np.asarray(np.linalg.norm(d, axis=-1))
    return length, np.asarray(d / np.where(length == 0, 1.0, length)[..., None])
