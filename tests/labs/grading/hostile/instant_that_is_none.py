"""A date that is no date, which compares as nothing does."""
# says: datetime64|dtype

import numpy as np


def rebound_velocity(velocity, restitution):
    return np.array(["NaT", "NaT"], dtype="datetime64[s]") if velocity == -2.0 else np.datetime64("NaT")
