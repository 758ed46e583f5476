"""A recursion in C until the stack is used up."""
# says: crashed|RecursionError|MemoryError|no answer within

import sys


def rebound_velocity(velocity, restitution):
    sys.setrecursionlimit(2**31 - 1)
    nested = []
    for _ in range(2 * 10**5):
        nested = [nested]
    return float(len(repr(nested)))
