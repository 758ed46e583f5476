"""Numbers of any size, although their squares would leave the range of the floats.

The square of 1e200 is too large for a float, and that of 1e-200 is too small.
One remedy serves both: divide by a power of two near the largest number,
calculate, and multiply by it again. Dividing by a power of two changes no
digit, so the result is the same, to the last digit, as that of the plain
formula where the plain formula works.

The functions look first whether there is such a number, because there hardly
ever is.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans

SMALL, LARGE = 2.0**-200, 2.0**200
"""A product of four lengths between these two is an ordinary float."""
NEAR_ONE = 1 / 4
"""The power of `SMALL` and `LARGE` between which a normal needs no other length.

These are some 1e-15 and 1e15.
"""


def length_of(vector: ArrayLike) -> Array:
    """Length of vectors (..., d), as precise for 1e-300 and 1e300 as for 1."""
    v = np.asarray(vector, dtype=float)
    with np.errstate(over="ignore"):
        length = np.asarray(np.linalg.norm(v, axis=-1))
    if not moderate(length):
        extreme = _extreme(length, v)
        unit = power_of_two(_largest(v[extreme]))
        scaled = v[extreme] / unit[:, None]
        length[extreme] = unit * np.linalg.norm(scaled, axis=-1)
    return length


def in_moderate_units(vector: Array) -> tuple[Array, Array, Array]:
    """Vectors (..., d) in a unit in which they are not very long or short.

    Returns
    -------
    vector : (..., d), in the new unit
    length : (...), in the new unit
    unit : (...), a power of two
        It is 1 where a vector needs no other unit. If no vector needs one, it
        is a single 1 without axes.
    """
    with np.errstate(over="ignore"):
        length = np.asarray(np.sqrt(np.vecdot(vector, vector)))
    if moderate(length):
        return vector, length, np.ones(())
    scale = power_of_two(_largest(vector))
    unit = np.where(_extreme(length, vector), scale, 1.0)
    vector = vector / unit[..., None]
    return vector, np.asarray(np.sqrt(np.vecdot(vector, vector))), unit


def in_unit(value: Array, unit: Array, axes: int = 1) -> Array:
    """Arrays over a unit (...) of `in_moderate_units`, with more axes."""
    if not unit.ndim and unit == 1:
        return value
    with np.errstate(over="ignore"):
        return value / unit[(..., *axes * [None])]


def cross_product(first: Array, second: Array) -> tuple[Array, Array]:
    """The cross product of vectors (..., 3), in a unit of its own, and its length.

    It is zero only where the vectors are parallel, or one is zero.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        product = np.cross(first, second)
        length = np.asarray(np.linalg.norm(product, axis=-1))
    if not moderate(length):
        (first, *_), (second, *_) = in_moderate_units(first), in_moderate_units(second)
        product = np.cross(first, second)
        length = np.asarray(np.linalg.norm(product, axis=-1))
    return product, length


def moderate_plane(normal: Array, offset: ArrayLike) -> tuple[Array, Array, Array]:
    """The same plane n·p + d = 0, with a normal that leaves most of the range to p.

    Returns
    -------
    normal, offset : (..., 3) and (...), n and d
        Both are divided by the same power of two, where a normal is so long or
        so short that n·p might leave the range of the floats although the
        distance does not. The coordinates of p may be from 1e-290 to 1e290.
    length : (...), ‖n‖; 0 for a normal that is zero
    """
    offset = np.asarray(offset, dtype=float)
    with np.errstate(over="ignore"):
        length = np.asarray(np.linalg.norm(normal, axis=-1))
    if moderate(length, NEAR_ONE):
        return normal, offset, length
    unit = power_of_two(_largest(normal))
    normal = normal / unit[..., None]
    return normal, offset / unit, np.asarray(np.linalg.norm(normal, axis=-1))


def moderate_equations(
    matrix: Array,
    right: Array,
) -> tuple[Array, Array, Array]:
    """The equations M x = b in units without very large or small numbers.

    Returns
    -------
    matrix, right : (..., d, d) and (..., d), M and b in the new units
    smaller : (...), a power of two
        Divide x by it (`in_unit`) to have it in the old unit.
    """
    right, _, of_right = in_moderate_units(right)
    flat = matrix.reshape(*matrix.shape[:-2], matrix.shape[-1] ** 2)
    *_, of_matrix = in_moderate_units(flat)
    smaller = np.asarray(of_matrix / of_right)
    return in_unit(matrix, of_matrix, 2), right, smaller


def root_of_difference(u: Array, p: Array, q: Array) -> Array:
    """√(u² − p q), as precise for 1e-300 and 1e300 as for 1.

    It is NaN where u² < p q.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        difference = np.asarray(u * u - p * q)
        root = np.asarray(np.sqrt(difference))
    size = np.abs(difference)
    if not moderate(size, 4):
        # Without these, whose root is 0:
        size = size + ((u == 0) & ((p == 0) | (q == 0)))
        if not moderate(size, 4):
            extreme = ~((size > SMALL**4) & (size < LARGE**4))
            three = (np.broadcast_to(each, root.shape) for each in (u, p, q))
            root[extreme] = _root_in_units(*(each[extreme] for each in three))
    return root


def root_of_product(p: Array, q: Array) -> Array:
    """√(p q) of two numbers that are not negative, however large or small."""
    return root_of_difference(np.zeros(()), -p, q)


def power_of_two(size: ArrayLike) -> Array:
    """The power of two next below a positive number; 1 for zero."""
    number = np.asarray(size, dtype=float)
    return np.where(number > 0, np.ldexp(1.0, np.frexp(number)[1] - 1), 1.0)


def moderate(size: Array, power: float = 1) -> bool:
    """Whether all sizes are between `SMALL` and `LARGE`, each to a power."""
    low: float = SMALL**power
    high: float = LARGE**power
    if not size.ndim:
        return low < float(size) < high
    if not size.size:
        return True
    least, most = float(size.min()), float(size.max())
    return least > low and most < high


def _largest(vector: Array) -> Array:
    """The largest component of vectors (..., d), all signs apart."""
    return np.asarray(np.max(np.abs(vector), axis=-1, initial=0.0))


def _root_in_units(u: Array, p: Array, q: Array) -> Array:
    """√(u² − p q), calculated with u over 2ᵏ and with p q over 4ᵏ."""
    (u, of_u), (p, of_p), (q, of_q) = np.frexp(u), np.frexp(p), np.frexp(q)
    half = (of_p + of_q) // 2
    k = np.where(u == 0, half, np.maximum(of_u, half))
    k = np.where(p * q == 0, of_u, k)
    u, product = np.ldexp(u, of_u - k), np.ldexp(p * q, of_p + of_q - 2 * k)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.ldexp(np.sqrt(u * u - product), k))


def _extreme(length: Array, vector: Array) -> Booleans:
    """Which vectors are too long or short to be squared, by their lengths.

    A length of zero may be that of a short vector. A vector that is zero is
    none.
    """
    size = np.asarray(length, dtype=float)
    ordinary = (size > SMALL) & (size < LARGE)
    return np.asarray(~ordinary & np.any(vector != 0, axis=-1))
