"""A loop without end while it is loaded."""
# says: on loading

while True:
    pass


def rebound_velocity(velocity, restitution):
    return -restitution * velocity
