"""A body that meets PyBullet's contact spring, step by step."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array


def spring_steps(
    gap: float, gravity: float, stiffness: float, damping: float, timestep: float, steps: int, velocity: float = 0.0
) -> Array:
    """Gap, m, and velocity, m/s, before the first step and after each, (steps + 1, 2); k and c are per unit mass.

    From the touch on, the contact gives the acceleration −k x − c v⁺, where x is the gap before the step and v⁺ the
    velocity after it, and it never pulls. With v⁺ = v + a dt that is a = −(k x + c v)/(1 + c dt). Implicit Euler, which
    takes the gap x⁺ = x + v⁺ dt after the step, has −k x⁺ − c v⁺ = −k x − (c + k dt) v⁺: the same with a dashpot of
    c + k dt. `reference.engines.pybullet_spring` derives both from what Bullet solves.
    """
    states = [(gap, velocity)]
    for _ in range(steps):
        velocity -= gravity * timestep
        if gap <= 0:
            push = -(stiffness * gap + damping * velocity) / (1 + damping * timestep)
            velocity += max(push, 0.0) * timestep
        gap += velocity * timestep
        states.append((gap, velocity))
    return np.array(states)
