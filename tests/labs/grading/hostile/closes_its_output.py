"""An output that is closed, and none at all."""
# says: raised|gave 0.0|code that answers

import sys

sys.stdout.close()


def rebound_velocity(velocity, restitution):
    print("nobody hears this")
    sys.stderr = sys.stdout = None
    return 0.0
