"""An array whose type carries an object along."""
# says: gave array

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.zeros(1, np.dtype(float, metadata={"answer": print}))
