"""The longest text that is sent."""
# says: gave 'x


def rebound_velocity(velocity, restitution):
    return "x" * (8 * 2**20 - 2000)
