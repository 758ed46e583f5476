"""A contact of PyBullet's that is a spring with a dashpot, resolved over many steps.

In each step Bullet solves a contact for an impulse λ ≥ 0. Let x ≤ 0 be the gap before the step, v the normal velocity
with the step's gravity in it, v⁺ the velocity that the impulse leaves, and m = 1/(1/m_A + 1/m_B) the effective mass:

    λ (1/m + cfm/dt) = −x erp/dt − v,     and with v⁺ = v + λ/m this is     λ = −(x erp + v⁺ dt)/cfm.

So the two numbers of a contact, an error reduction `erp` and a softness `cfm`, can say what a spring says with its
stiffness k and its damping c. Bullet takes them in two places, and each makes a step of its own:

`world`: the parameters `contactERP` = k dt/c and `globalCFM` = 1/c give λ = dt (−k x − c v⁺). The spring acts with the
length that it has before the step, as in semi-implicit Euler, and does not damp by itself. All contacts share it.

`bodies`: each body has a `contactStiffness` and a `contactDamping`. Bullet puts the two springs of a contact in series,
adds the two dashpots, and derives erp = k dt/(k dt + c) and cfm = 1/(k dt + c). With the gap x⁺ = x + v⁺ dt after the
step this gives λ = dt (−k x⁺ − c v⁺). That is implicit Euler, which damps by itself as a dashpot of k dt would.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from reference import truth
from reference.scene.scenario import Scenario, Sphere
from reference.scene.settings import Settings

LEAST_DAMPING = 1e-9
"""The least damping in `world`, as a share of k dt: its inverse must be finite. It takes some 10⁻⁹ of the speed."""
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
