"""A default argument that counts the calls."""
# says: gave 0.0


def rebound_velocity(velocity, restitution, seen=[]):  # noqa: B006 - that is the attack
    seen.append(velocity)
    return -restitution * velocity if len(seen) < 2 else 0.0
