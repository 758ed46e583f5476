"""Compiled code, as bytes."""
# says: an object of type bytes

import marshal


def rebound_velocity(velocity, restitution):
    return marshal.dumps(compile("print('owned')", "x", "exec"))
