"""A generator that looks at what is asked of it."""
# says: an object of type generator


def rebound_velocity(velocity, restitution):
    yield -restitution * velocity
