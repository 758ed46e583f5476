"""A hundred thousand errors in one."""
# says: raised ExceptionGroup


def rebound_velocity(velocity, restitution):
    raise ExceptionGroup("all" * 10**6, [ValueError(number) for number in range(10**5)])
