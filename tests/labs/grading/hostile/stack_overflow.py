"""A recursion in C until the stack is used up."""
# says: crashed|no answer within


def rebound_velocity(velocity, restitution):
    nested = ()
    for _ in range(150_000):
        nested = (nested,)
    return float(hash(nested))
