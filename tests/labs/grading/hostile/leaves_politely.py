"""sys.exit, which is no Exception."""
# says: SystemExit

import sys


def rebound_velocity(velocity, restitution):
    sys.exit(0)
