"""An array with fields."""
# says: dtype

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.zeros(3, dtype=[("velocity", float), ("answer", "O")])
