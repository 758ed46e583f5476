"""How fast this machine is: a small fixed workload of Python and NumPy, timed.

What tests and runs may cost is written down in the seconds of one machine. On another one the same work takes longer or
shorter, by about the factor that the workload does: it consists, like the lab's code, of loops with small arrays.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable

import numpy as np

ROUND = 0.0183
"""Processor time, s, that a round takes on the machine in whose seconds allowances are given.

It was derived: a round took 42 ms on another machine, on which the whole of `make test`, and its tests of the solutions
alone, took 2.3 times as long.
"""
ROUNDS = 7
_STEPS = 1500


def slowness(clock: Callable[[], float] = time.process_time) -> float:
    """How many times as long this machine takes as the one of the allowances: the median of some rounds.

    clock: gives seconds, by default the processor time of this process.
    """
    times = []
    for _ in range(ROUNDS):
        begin = clock()
        workload()
        times.append(clock() - begin)
    return statistics.median(times) / ROUND


def workload() -> float:
    """One round: a damped orbit step by step, and the sum of its distances, m, which is the same everywhere."""
    place, velocity, turn = np.array([0.3, -0.2, 1.0]), np.zeros(3), np.eye(3)
    kept = {}
    for number in range(_STEPS):
        force = np.cross(place, velocity) - 0.1 * velocity - place
        velocity = velocity + 1e-3 * force
        place = place + 1e-3 * (turn @ velocity)
        kept[f"step {number}"] = float(np.linalg.norm(place)), math.sqrt(abs(float(place @ velocity)))
    return sum(distance for distance, _ in sorted(kept.values()))
