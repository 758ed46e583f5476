"""A loop without end while it is loaded."""
# says: on loading, gave no answer within

while True:
    pass


def rebound_velocity(velocity, restitution):
    return -restitution * velocity
