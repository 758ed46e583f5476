"""An exception that cannot be shown."""
# says: cannot be shown


class Shy(BaseException):
    def __str__(self):
        raise Shy

    __repr__ = __str__


def rebound_velocity(velocity, restitution):
    raise Shy
