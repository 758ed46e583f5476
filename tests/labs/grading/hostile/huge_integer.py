"""An integer that takes hours to write in decimals."""
# says: an integer of [0-9]+ bits


def rebound_velocity(velocity, restitution):
    return 1 << 10**8
