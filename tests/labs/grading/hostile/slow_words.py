"""An error whose words take longer than anybody waits."""
# says: no answer within

import time


class Slow(Exception):
    def __str__(self):
        time.sleep(60)
        return "slow"

    __repr__ = __str__


def rebound_velocity(velocity, restitution):
    raise Slow
