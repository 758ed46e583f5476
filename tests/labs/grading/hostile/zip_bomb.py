"""A megabyte that unpacks to gigabytes."""
# says: MemoryError|no answer within

import zlib


def rebound_velocity(velocity, restitution):
    packed = zlib.compress(bytes(2**24))
    return float(len(zlib.decompress(packed) * 2**7))
