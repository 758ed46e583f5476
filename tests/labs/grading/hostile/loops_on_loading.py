"""A loop without end while it is loaded."""
# says: gave 0\.0|no answer within

while True:
    pass


def rebound_velocity(velocity, restitution):
    return 0.0
