"""An array of no bytes and as many rows as there are addresses, for whoever takes it apart."""
# says: no such shape

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.zeros((2**40, 0))
