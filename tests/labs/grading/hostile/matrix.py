"""A matrix, whose product is not the product of arrays."""
# says: an object of type numpy.*matrix

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.asmatrix([[0.0]])
