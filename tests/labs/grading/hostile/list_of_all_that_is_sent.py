"""A list of as many numbers as are sent."""
# says: gave \[0


def rebound_velocity(velocity, restitution):
    return [0] * 190_000
