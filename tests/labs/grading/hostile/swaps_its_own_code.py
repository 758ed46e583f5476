"""A function whose code is replaced after its first answer."""
# says: gave 0.0


def wrong(velocity, restitution):
    return 0.0


def rebound_velocity(velocity, restitution):
    rebound_velocity.__code__ = wrong.__code__
    return -restitution * velocity
