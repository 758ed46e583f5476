"""A penalty contact made to measure: its numbers from its task (slide 8)."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from solutions.arrays import Array
from solutions.checks import positive
from solutions.domain import FinitePositive, Share, domain
from solutions.response.penalty_impact import penalty_damping


@domain
def design_contact(
    mass: FinitePositive,
    speed: FinitePositive,
    depth: FinitePositive,
    restitution: Annotated[Share, positive],
    steps_per_contact: FinitePositive,
) -> tuple[Array, Array, Array]:
    """Stiffness, damping and timestep of a penalty contact (slide 8).

    They are chosen by three rules, all without the weight:

    - The spring alone, without the damper, turns the body round exactly at
      the permitted depth. With the damper the body goes less deep.
    - The damper gives the restitution, with this spring.
    - The contact on the spring alone lasts so many steps.

    Parameters
    ----------
    mass : (...), m, kg, positive
    speed : (...), v at the first touch, m/s, positive
    depth : (...), d, m, positive
        How deep the body may go.
    restitution : (...), e, above 0, and 1 at most
        A contact that cannot pull never takes all the speed, so that no
        damper gives e = 0.
    steps_per_contact : (...), n, positive, of any value, not only whole

    Returns
    -------
    stiffness : (...), k, N/m
    damping : (...), c, N s/m; 0 for e = 1
    timestep : (...), s

    Notes
    -----
    At the depth d all the energy of the motion is in the spring,
    m v²/2 = k d²/2, so that

        k = m v²/d²
        ω = √(k/m) = v/d

    The damping that gives e is that of `penalty_damping`. A body on the spring
    alone swings, and a contact is half a period of this swing, π/ω. With n
    steps per contact

        Δt = π/(ω n) = π d/(v n)

    so that half the depth asks for half the timestep, and for four times the
    stiffness.

    How deep does the damped contact go? With ζ = c/(2 √(k m)) and
    s = √(1 − ζ²) its path is x = −v/(ω s) exp(−ζ ω t) sin(ω s t). The velocity
    is zero where ω s t = arccos ζ, at the depth

        (v/ω) exp(−ζ arccos(ζ)/s) = √e v/ω = √e d

    because e = exp(−2ζ arccos(ζ)/s) (see `penalty_restitution`). So
    k = e m v²/d² would be just enough. The rule here leaves a reserve for the
    weight and for the error of the steps.
    """
    stiffness = mass * (speed / depth) ** 2
    damping = penalty_damping(restitution, mass, stiffness)
    half_period = np.pi / np.sqrt(stiffness / mass)
    return stiffness, damping, half_period / steps_per_contact
