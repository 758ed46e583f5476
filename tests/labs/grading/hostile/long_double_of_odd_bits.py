"""A wide float made of bits that mean no number."""
# says: gave

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.frombuffer(b"\xff\x00" * 8, np.longdouble)[0]
