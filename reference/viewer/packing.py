"""Numbers that change smoothly, as short text: whole steps, their second differences, bytes, base64.

A body that rests or flies freely has second differences of zero or near it: those take a byte, and a run of zeros takes
two however long it is. The script undoes this in a dozen lines, without a library and without waiting.
"""

from __future__ import annotations

import base64
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from reference.arrays import Array

MOST_STEPS = 1e9
"""What lies beyond is kept as being there, so that sums of differences stay exact in any language."""


def packed(values: Array, step: float) -> str:
    """Text for values (n, …), any unit, kept to `step` of it: column after column, each n numbers."""
    if not values.size:
        return ""
    steps = np.rint(np.clip(values / step, -MOST_STEPS, MOST_STEPS)).astype(np.int64).reshape(len(values), -1)
    content = bytearray()
    for column in second_differences(steps).T:
        content += _bytes(column.tolist())
    return base64.b64encode(content).decode("ascii")


def second_differences(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Second differences of whole steps (n, …), after two zeros, with zigzag: 0, −1, 1, −2 become 0, 1, 2, 3."""
    twice = np.diff(steps, n=2, axis=0, prepend=np.zeros((2, *steps.shape[1:]), dtype=np.int64))
    return np.where(twice < 0, -2 * twice - 1, 2 * twice)


def _bytes(numbers: Iterable[int]) -> bytearray:
    """Seven bits a byte, the lowest first, the eighth where more follow; after a zero, how many more zeros follow."""
    found, zeros = bytearray(), 0
    for number in numbers:
        if number == 0:
            zeros += 1
            continue
        _end_zeros(found, zeros)
        zeros = 0
        _append(found, number)
    _end_zeros(found, zeros)
    return found


def _end_zeros(found: bytearray, zeros: int) -> None:
    if zeros:
        found.append(0)
        _append(found, zeros - 1)


def _append(found: bytearray, number: int) -> None:
    while number > 127:
        found.append(128 | number & 127)
        number >>= 7
    found.append(number)
