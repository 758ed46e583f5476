"""Springs and dampers between two points (slides 27 and 29)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Triple, domain
from solutions.vectors import direction


@domain
def spring_force(
    position_1: Triple,
    position_2: Triple,
    stiffness: NotNegative,
    rest_length: NotNegative = 0.0,
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
        It is zero at the rest length. A spring of length zero has no
        direction, so that it exerts no force either, however much it is
        compressed. A force there would have to choose a side.

    Notes
    -----
    A stretched spring pulls its end 1 towards its end 2, and a compressed
    spring pushes it away. The force is proportional to how much the length L
    differs from the rest length:

        L = ‖x1 − x2‖
        u = (x1 − x2)/L
        F = −k (L − L0) u

    The slide's k (x − x_rest) is the force that stretches the spring. Taken as
    the force on the mass, it pushes the mass away from rest.
    """
    d = position_1 - position_2
    u = direction(d)
    length = np.linalg.norm(d, axis=-1)
    stretch = length - rest_length
    return -(stiffness * stretch)[..., None] * u


@domain
def damper_force(
    position_1: Triple,
    position_2: Triple,
    velocity_1: Triple,
    velocity_2: Triple,
    damping: NotNegative,
) -> Array:
    """Force of a damper on its end 1 (slide 29).

    End 2 gets the opposite force. The force depends only on how fast the
    length changes.

    Parameters
    ----------
    position_1, position_2 : (..., 3), x1 and x2, m
    velocity_1, velocity_2 : (..., 3), v1 and v2, m/s
    damping : (...), k_d, N s/m, not negative

    Returns
    -------
    (..., 3), on end 1, N
        A damper of length zero has no direction, and exerts no force.

    Notes
    -----
    The length L grows at the rate (v1 − v2)·u, which is the part of the
    relative velocity along the damper. The damper opposes this:

        u = (x1 − x2)/L
        F = −k_d ((v1 − v2)·u) u

    The slide's −k_d v brakes all motion, also that of a spring that flies
    freely. The force here leaves momentum, angular momentum and any rigid
    motion alone.
    """
    u = direction(position_1 - position_2)
    lengthening = np.sum((velocity_1 - velocity_2) * u, axis=-1)  # (v1 − v2)·u
    return -(damping * lengthening)[..., None] * u


@domain
def spring_damper_force(
    position_1: Triple,
    position_2: Triple,
    velocity_1: Triple,
    velocity_2: Triple,
    stiffness: NotNegative,
    rest_length: NotNegative,
    damping: NotNegative,
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

    Notes
    -----
    The two forces act on the same end, so they add:

        L = ‖x1 − x2‖
        u = (x1 − x2)/L
        F = −k (L − L0) u − k_d ((v1 − v2)·u) u

    The slide writes (x' − x_rest) k − v k_d with the current position x'. Its
    spring has the wrong sign, and the motion runs away whatever the damping.
    """
    d = position_1 - position_2
    u = direction(d)
    length = np.linalg.norm(d, axis=-1)
    stretch = length - rest_length
    lengthening = np.sum((velocity_1 - velocity_2) * u, axis=-1)  # (v1 − v2)·u
    spring = -(stiffness * stretch)[..., None] * u
    damper = -(damping * lengthening)[..., None] * u
    return spring + damper


@domain
def spring_energy(
    position_1: Triple,
    position_2: Triple,
    stiffness: NotNegative,
    rest_length: NotNegative = 0.0,
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

    Notes
    -----
    The energy is the work that it takes to change the length from L0 to L. At
    each length in between the force is k times the change so far. Its mean is
    half of its last value k (L − L0), and this times the whole change L − L0
    is

        E = k (L − L0)²/2
    """
    length = np.linalg.norm(position_1 - position_2, axis=-1)
    return stiffness * (length - rest_length) ** 2 / 2
