"""A pause in every process, before anything is asked."""
# says: gave 0.0

import time

time.sleep(0.1)


def rebound_velocity(velocity, restitution):
    return 0.0
