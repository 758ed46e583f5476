"""Springs and dampers between two points (slides 27 and 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative, vector


def spring_force(
    position_1: ArrayLike,
    position_2: ArrayLike,
    stiffness: ArrayLike,
    rest_length: ArrayLike = 0.0,
) -> Array:
    """Force of a spring on its end 1 (slide 27).

    End 2 gets the opposite force, or it is an anchor in the wall.

    Parameters
    ----------
    position_1, position_2 : (..., 3), x1 and x2, m
    stiffness : (...), k, N/m, not negative
    rest_length : (...), L0, m, not negative
        It is 0 for a spring whose ends attract each other from any distance.

    Returns
    -------
    (..., 3), on end 1, N
        It is zero at the rest length. A spring of length zero has no direction, so that
        it exerts no force either, however much it is compressed. A force there would
        have to choose a side.

    Raises
    ------
    ValueError
        If stiffness or rest_length is negative, or a position does not have three
        components.

    Notes
    -----
    A stretched spring pulls its end 1 towards its end 2, and a compressed spring pushes
    it away. The force is proportional to how much the length L differs from the rest
    length:

        F = −k (L − L0) u,    u = (x1 − x2)/L,    L = ‖x1 − x2‖

    The slide's k (x − x_rest) is the force that stretches the spring. Taken as the
    force on the mass, it pushes the mass away from rest.
    """
    length, direction = _line(position_1, position_2)
    stretch = length - not_negative("rest_length", rest_length)
    return np.asarray(
        -(not_negative("stiffness", stiffness) * stretch)[..., None]
        * direction
    )


def spring_energy(
    position_1: ArrayLike,
    position_2: ArrayLike,
    stiffness: ArrayLike,
    rest_length: ArrayLike = 0.0,
) -> Array:
    """Energy stored in a spring.

    Parameters
    ----------
    position_1, position_2 : (..., 3), m
    stiffness : (...), k, N/m, not negative
    rest_length : (...), L0, m, not negative

    Returns
    -------
    (...), J
        It is zero at the rest length.

    Raises
    ------
    ValueError
        If stiffness or rest_length is negative, or a position does not have three
        components.

    Notes
    -----
    The energy is the work that it takes to change the length from L0 to L. At each
    length on the way the force is k times the change so far. Its mean over the way is
    half of its last value k (L − L0), which times the way L − L0 gives

        k (L − L0)²/2
    """
    length, _ = _line(position_1, position_2)
    stretch = length - not_negative("rest_length", rest_length)
    return np.asarray(not_negative("stiffness", stiffness) * stretch**2 / 2)


def damper_force(
    position_1: ArrayLike,
    position_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    damping: ArrayLike,
) -> Array:
    """Force of a damper on its end 1 (slide 29).

    End 2 gets the opposite force. The force depends only on how fast the length
    changes.

    Parameters
    ----------
    position_1, position_2 : (..., 3), x1 and x2, m
    velocity_1, velocity_2 : (..., 3), v1 and v2, m/s
    damping : (...), k_d, N s/m, not negative

    Returns
    -------
    (..., 3), on end 1, N
        A damper of length zero has no direction, and exerts no force.

    Raises
    ------
    ValueError
        If damping is negative, or a vector does not have three components.

    Notes
    -----
    The length L grows at the rate (v1 − v2)·u, which is the part of the relative
    velocity along the damper. The damper opposes this:

        F = −k_d ((v1 − v2)·u) u,    u = (x1 − x2)/L

    The slide's −k_d v brakes all motion, also that of a spring that flies freely. The
    force here leaves momentum, angular momentum and any rigid motion alone.
    """
    _, direction = _line(position_1, position_2)
    relative = vector("velocity_1", velocity_1) - vector(
        "velocity_2", velocity_2
    )
    lengthening = np.sum(relative * direction, axis=-1)
    return np.asarray(
        -(not_negative("damping", damping) * lengthening)[..., None]
        * direction
    )


def spring_damper_force(
    position_1: ArrayLike,
    position_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    stiffness: ArrayLike,
    rest_length: ArrayLike,
    damping: ArrayLike,
) -> Array:
    """Force of a spring with a damper beside it on their end 1 (slide 29).

    End 2 gets the opposite force.

    Parameters
    ----------
    position_1, position_2 : (..., 3), x1 and x2, m
    velocity_1, velocity_2 : (..., 3), v1 and v2, m/s
    stiffness : (...), k, N/m, not negative
    rest_length : (...), L0, m, not negative
    damping : (...), k_d, N s/m, not negative

    Returns
    -------
    (..., 3), on end 1, N
        At length zero there is no direction, and no force.

    Raises
    ------
    ValueError
        If stiffness, rest_length or damping is negative, or a vector does not
        have three components.

    Notes
    -----
    The two forces act on the same end, so they add. With L = ‖x1 − x2‖ and
    u = (x1 − x2)/L,

        F = −k (L − L0) u − k_d ((v1 − v2)·u) u

    The slide writes (x' − x_rest) k − v k_d with the current position x'. Its
    spring has the wrong sign, and the motion runs away whatever the damping.
    """
    spring = spring_force(position_1, position_2, stiffness, rest_length)
    return np.asarray(
        spring
        + damper_force(position_1, position_2, velocity_1, velocity_2, damping)
    )


def _line(position_1: ArrayLike, position_2: ArrayLike) -> tuple[Array, Array]:
    """Length of a spring, and the unit vector from its end 2 to its end 1.

    The vector is zero where the ends coincide.
    """
    d = vector("position_1", position_1) - vector("position_2", position_2)
    length = np.asarray(np.linalg.norm(d, axis=-1))
    return length, np.asarray(
        d / np.where(length == 0, 1.0, length)[..., None]
    )
