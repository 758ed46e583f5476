"""A function that puts another one in its own place."""
# says: gave 0.0


def rebound_velocity(velocity, restitution):
    globals()["rebound_velocity"] = lambda velocity, restitution: 0.0
    return -restitution * velocity
