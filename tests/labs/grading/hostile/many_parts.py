"""A list of millions of lists, to be a hundred times larger when read."""
# says: a list of 2000000 parts


def rebound_velocity(velocity, restitution):
    return [[]] * 2_000_000
