"""Ten gigabytes of numbers."""
# says: MemoryError

import numpy as np


def rebound_velocity(velocity, restitution):
    return float(np.ones(10**10 // 8).sum())
