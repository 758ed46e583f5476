"""A profiler that raises in the code that sends the answer."""
# says: gave|raised|code that answers

import sys


def refuse(frame, event, argument):
    if frame.f_code.co_name in ("pack", "_write", "encoded"):
        raise RuntimeError("refused")


def rebound_velocity(velocity, restitution):
    sys.setprofile(refuse)
    return 0.0
