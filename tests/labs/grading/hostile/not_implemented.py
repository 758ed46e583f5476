"""The value with which Python asks the other operand to decide."""
# says: NotImplemented


def rebound_velocity(velocity, restitution):
    return NotImplemented
