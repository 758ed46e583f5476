"""A loop without end."""
# says: no answer within


def rebound_velocity(velocity, restitution):
    while True:
        pass
