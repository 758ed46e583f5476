"""A name without end, for which a similar one is looked up."""
# says: no answer within|raised NameError


def rebound_velocity(velocity, restitution):
    raise NameError("no such name", name="restitutio" * 10**6)
