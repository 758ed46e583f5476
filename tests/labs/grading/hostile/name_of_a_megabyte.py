"""An error whose type has a name of a megabyte."""
# says: raised E

Long = type("E" * 2**20, (Exception,), {})


def rebound_velocity(velocity, restitution):
    raise Long("m" * 2**20)
