"""A loop that swallows every interrupt and signal."""
# says: no answer within

import signal
import time

for number in range(1, 64):
    try:
        signal.signal(number, signal.SIG_IGN)
    except (OSError, ValueError):
        continue


def rebound_velocity(velocity, restitution):
    while True:
        try:
            time.sleep(1)
        except BaseException:
            continue
