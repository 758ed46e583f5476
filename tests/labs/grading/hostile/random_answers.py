"""A guess, another in every process, which is right once in a while."""
# says: gave

import numpy as np


def rebound_velocity(velocity, restitution):
    return float(np.random.default_rng().choice([0.25, 0.5, 1.0, 2.0]) / 3)
