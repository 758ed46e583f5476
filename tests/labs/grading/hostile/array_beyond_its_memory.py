"""An array that reaches into whatever lies behind its own memory."""
# says: gave|crashed|a message of

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.lib.stride_tricks.as_strided(np.zeros(1), (2**16,), (8,))
