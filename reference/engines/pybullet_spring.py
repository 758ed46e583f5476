"""A contact of PyBullet's that is a spring with a dashpot, resolved over many steps.

Bullet solves a contact for the impulse λ ≥ 0 of a step, with the gap x ≤ 0 from before the step, the speeds v before and
v⁺ after the impulse, both with the step's gravity, and the effective mass m = 1/(1/m_A + 1/m_B):

    λ (1/m + cfm/dt) = −x erp/dt − v,     and since v⁺ = v + λ/m,     λ = −(x erp + v⁺ dt)/cfm.

Two numbers, an error reduction `erp` and a softness `cfm`, say what a spring says with k and c. There are two places to
put them, and they make two different steps:

`world`: Bullet's `contactERP` = k dt/c and `globalCFM` = 1/c give λ = dt (−k x − c v⁺). The spring acts with its length
from before the step, as in semi-implicit Euler, and so does not damp by itself. All contacts share these numbers.

`bodies`: each body has a `contactStiffness` and a `contactDamping`. Bullet puts the two springs of a contact in series
and adds the dashpots, and derives erp = k dt/(k dt + c) and cfm = 1/(k dt + c). With the gap x⁺ = x + v⁺ dt after the
step that gives λ = dt (−k x⁺ − c v⁺), implicit Euler, which damps by itself as a dashpot of k dt would.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from reference import truth
from reference.scene.scenario import Scenario, Sphere
from reference.scene.settings import Settings

LEAST_DAMPING = 1e-9
"""The least damping of `world` as a share of k dt, for its inverse must be finite; the speed loses some 10⁻⁹ of itself."""
MOST_DAMPING_RATIO = 5.0
"""ζ where e = 0, which no finite one gives; 5 rebounds with 1 % of the speed."""


def spring_of(scenario: Scenario, stiffness: float) -> tuple[float, float] | None:
    """Stiffness, N/m, and damping, N s/m, of the contact in every pair, from a stiffness per unit mass, 1/s².

    The effective mass must be known beforehand, and be the same in all pairs, as must the restitution. It is 1/(1/m_A +
    1/m_B) for balls alone: what is struck off its centre turns as well, and its mass counts for less. None otherwise.
    """
    if not all(isinstance(body.shape, Sphere) for body in scenario.bodies if not body.immovable):
        return None
    masses = {body.name: body.mass for body in scenario.bodies}
    alike = {(1 / (1 / masses[pair.body_a] + 1 / masses[pair.body_b]), pair.restitution) for pair in scenario.pairs}
    if len(alike) != 1:
        return None
    ((mass, restitution),) = alike
    ratio = min(truth.damping_ratio(restitution), MOST_DAMPING_RATIO)
    return stiffness * mass, 2 * ratio * math.sqrt(stiffness) * mass


def set_spring(
    bullet: Any, numbers: Sequence[int], spring: tuple[float, float], settings: Settings, here: dict[str, int]
) -> None:
    """Give the spring to the world, or half of it to each body: twice the stiffness, and half the damping."""
    stiffness, damping = spring
    if settings["spring_of"] == "bodies":
        for number in numbers:
            bullet.changeDynamics(number, -1, contactStiffness=2 * stiffness, contactDamping=damping / 2, **here)
        return
    firmness = stiffness * settings.timestep
    damping = max(damping, LEAST_DAMPING * firmness)
    bullet.setPhysicsEngineParameter(contactERP=firmness / damping, globalCFM=1 / damping, **here)
