"""What several files of wrong answers write in short."""

from __future__ import annotations

import numpy as np


def arr(*values):
    """Each as an array of floats."""
    return [np.asarray(value, dtype=float) for value in values]


def col(value):
    """One number for each vector, to multiply the vectors by."""
    return np.asarray(value, dtype=float)[..., None]
