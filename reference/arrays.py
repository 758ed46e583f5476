"""The kinds of array that annotations name. Shape and unit are said where a quantity is defined."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Numbers; the last axis is a vector's where there is one."""
Mask = NDArray[np.bool_]
"""Yes or no for each member."""
Integers = NDArray[np.int64]
"""Places in another array."""
