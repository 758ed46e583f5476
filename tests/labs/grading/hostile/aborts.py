"""The call that ends a program in an error, and what stops it from outside."""
# says: aborted|crashed|PermissionError|illegal

import os
import signal


def rebound_velocity(velocity, restitution):
    try:
        os.kill(os.getpid(), signal.SIGKILL)
    except OSError:
        os.abort()
