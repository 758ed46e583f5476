"""An error on loading that says it happened nowhere."""
# says: could not be defined: Nowhere|Nowhere: lost


class Nowhere(BaseException):
    __traceback__ = None


raise Nowhere("lost")


def rebound_velocity(velocity, restitution):
    return 0.0
