"""Clocks that say that no time has passed, or that it is no number."""
# says: raised TypeError|wrote into

import time

time.perf_counter = lambda: "soon"
time.monotonic = time.time = lambda: float("nan")


def rebound_velocity(velocity, restitution):
    return 0.0
