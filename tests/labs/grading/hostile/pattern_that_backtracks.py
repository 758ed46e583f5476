"""A pattern that no signal interrupts."""
# says: no answer within

import re


def rebound_velocity(velocity, restitution):
    return float(bool(re.fullmatch("(a|aa)+b", "a" * 60)))
