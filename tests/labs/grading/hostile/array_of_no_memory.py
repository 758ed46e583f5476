"""An array of a billion rows that takes the memory of one number."""
# says: an array of [0-9]+ bytes

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.broadcast_to(0.0, (10**5, 10**5))
