"""The number one, turned into another in memory."""
# says: gave|crashed|wrote into|no answer|not a message|raised

import ctypes


def rebound_velocity(velocity, restitution):
    ctypes.c_uint32.from_address(id(1) + 24).value = 0
    return 0.0
