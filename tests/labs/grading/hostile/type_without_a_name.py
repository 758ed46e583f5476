"""An error of a class that says its name is a number."""
# says: raised|code that answers


class Meta(type):
    __name__ = property(lambda cls: 1.0)
    __module__ = property(lambda cls: 1.0)
    __qualname__ = "q"


class Odd(Exception, metaclass=Meta):
    pass


def rebound_velocity(velocity, restitution):
    raise Odd("odd")
