"""A text that reads like the line of a right answer."""
# says: gave '.*100 of 100


def rebound_velocity(velocity, restitution):
    return "✓ rebound_velocity  100 of 100"
