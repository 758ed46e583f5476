"""A complex number, whose real part is right."""
# says: complex


def rebound_velocity(velocity, restitution):
    return complex(-restitution * velocity, 1.0)
