"""Cycles that are never collected."""
# says: MemoryError|no answer within

import gc

gc.disable()


def rebound_velocity(velocity, restitution):
    while True:
        cycle = [bytes(10**6)]
        cycle.append(cycle)
