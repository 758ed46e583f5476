"""All descriptors closed, and on it goes."""
# says: no answer

import os
import time


def rebound_velocity(velocity, restitution):
    os.closerange(0, 256)
    time.sleep(60)
