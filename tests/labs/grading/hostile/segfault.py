"""Memory that is not there."""
# says: crashed|ctypes|PermissionError

import ctypes


def rebound_velocity(velocity, restitution):
    return float(ctypes.string_at(1)[0])
