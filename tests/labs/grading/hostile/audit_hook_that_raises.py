"""A hook of the interpreter that refuses whatever happens after it."""
# says: raised|gave|code that answers|no answer

import sys


def refuse(event, arguments):
    raise RuntimeError("refused")


def rebound_velocity(velocity, restitution):
    sys.addaudithook(refuse)
    return 0.0
