"""A text of a gigabyte."""
# says: a text of 1000000000 characters|MemoryError|no answer within


def rebound_velocity(velocity, restitution):
    return "x" * 10**9
