"""NumPy's own value that is neither right nor wrong."""
# says: an object of type numpy.ma|gave masked

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.ma.masked
