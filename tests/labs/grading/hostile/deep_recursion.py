"""A recursion for which it has lifted Python's own limit."""
# says: crashed|RecursionError|no answer within|MemoryError

import sys

sys.setrecursionlimit(2**30)


class Deep:
    def __getattr__(self, name):
        return getattr(self, name + "a")


def rebound_velocity(velocity, restitution):
    return Deep().a
