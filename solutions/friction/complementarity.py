"""Linear complementarity problems, A f + b ≥ 0, f ≥ 0, f·(A f + b) = 0: two ways to solve one (slide 22)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative

Array = NDArray[np.float64]
ROUNDING = 1e-10
"""Below this share of the largest number a number of Lemke's table counts as zero: rounding grows in the exchanges."""


def complementarity_residual(matrix: ArrayLike, offset: ArrayLike, force: ArrayLike) -> Array:
    """How far forces are from a solution: the largest |min(A_ii f_i, (A f + b)_i)|, (...), m/s². Zero solves it.

    Of the two numbers, in the same unit, the smaller one has to be zero: negative it breaks an inequality, positive the
    product. Of a contact that moves nothing, A_ii = 0, the first one is f_i itself.

    Parameters
    ----------
    matrix : (..., m, m), A
    offset : (..., m), b
    force : (..., m), f

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, or an A_ii is negative.
    """
    a, b = _checked(matrix, offset)
    f, own = finite("force", force), np.diagonal(a, axis1=-2, axis2=-1)
    pressed = np.where(own > 0, own, 1.0) * f
    return np.asarray(np.max(np.abs(np.minimum(pressed, np.matvec(a, f) + b)), axis=-1, initial=0.0))


def solve_by_sweeps(matrix: ArrayLike, offset: ArrayLike, sweeps: int, start: ArrayLike = 0.0) -> Array:
    """Forces by projected Gauss–Seidel, (..., m): f_i ← max(0, f_i − (A f + b)_i/A_ii), contact after contact.

    Simple and never wrong by much, for a symmetric A without negative eigenvalues; how fast it converges depends on
    A, and a tall stack is slow. Where forces are not unique it ends at one of the solutions, which depends on start
    and order.

    Parameters
    ----------
    matrix : (..., m, m), A
    offset : (..., m), b
    sweeps : how often to go through all contacts
    start : (..., m), forces to begin with, such as those of the last step

    Returns
    -------
    (..., m); a contact that moves nothing, A_ii = 0, gets no force

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, or an A_ii is negative.
    """
    a, b = _checked(matrix, offset)
    start = finite("start", start)
    f = np.array(np.broadcast_to(start, np.broadcast_shapes(a.shape[:-1], b.shape, start.shape)))
    own = np.diagonal(a, axis1=-2, axis2=-1)
    divisor = np.where(own > 0, own, 1.0)
    for _ in range(sweeps):
        for i in range(f.shape[-1]):
            gap = np.vecdot(a[..., i, :], f) + b[..., i]
            f[..., i] = np.where(own[..., i] > 0, np.maximum(0.0, f[..., i] - gap / divisor[..., i]), 0.0)
    return f


def solve_by_pivots(matrix: ArrayLike, offset: ArrayLike) -> Array:
    """Forces by Lemke's method, (..., m): exact but for rounding, after finitely many exchanges.

    An artificial force z on all rows, w = A f + b + z ≥ 0, makes f = 0 a solution. Then f_i and w_i take turns: what
    left last lets its partner in, until z itself leaves. Ties are broken by the columns of w in their order
    (lexicographically), so that redundant contacts do not make it go round in circles.

    Parameters
    ----------
    matrix : (..., m, m), A; without negative eigenvalues for the method to be sure of its answer
    offset : (..., m), b

    Returns
    -------
    (..., m); one of the solutions where they are not unique

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, or an A_ii is negative; or if there are no such forces, as for
        contacts that are forced into one another. Rounding hides them as well where one body is some 1e9 times as
        heavy as another: A is taken over its largest number.
    """
    a, b = _checked(matrix, offset)
    return np.asarray(np.vectorize(_lemke, otypes=[float], signature="(m,m),(m)->(m)")(a, b))


def _lemke(a: Array, b: Array) -> Array:
    """One problem. Columns of the table: w, f, z, and what they come to."""
    count, scale = len(b), np.max(np.abs(a), initial=0.0) or 1.0
    size = np.max(np.abs(b), initial=0.0) or 1.0
    if np.all(b >= 0):
        return np.zeros(count)
    start = np.hstack([np.eye(count), -a / scale, -np.ones((count, 1)), b[:, None] / size])
    table, basis = start.copy(), np.arange(count)
    row, entering = int(np.argmin(b)), 2 * count
    for _ in range(2 ** min(count + 4, 16)):
        _exchange(table, row, entering)
        leaving, basis[row] = basis[row], entering
        if not np.any(table[basis == 2 * count, -1] > ROUNDING):  # z has left, or it stays at zero
            forces = np.zeros(2 * count + 1)
            forces[basis] = np.linalg.solve(start[:, basis], start[:, -1])  # the table has gathered rounding
            return np.maximum(0.0, forces[count:-1]) * size / scale
        entering = leaving + count if leaving < count else leaving - count
        row = _leaving_row(table, entering)
    raise ValueError("matrix: Lemke's method found no end; are its eigenvalues negative?")


def _exchange(table: Array, row: int, column: int) -> None:
    """Take a column into the basis in place of a row's own."""
    table[row] /= table[row, column]
    others = np.arange(len(table)) != row
    table[others] -= np.outer(table[others, column], table[row])


def _leaving_row(table: Array, entering: int) -> int:
    """The row that reaches zero first as a column enters; of several the first in the order of the columns of w."""
    rows = np.flatnonzero(table[:, entering] > ROUNDING)
    if len(rows) == 0:
        raise ValueError("offset: no forces solve this problem")
    for column in (-1, *range(len(table))):
        ratios = table[rows, column] / table[rows, entering]
        rows = rows[ratios <= np.min(ratios) + ROUNDING]
    return int(rows[0])


def _checked(matrix: ArrayLike, offset: ArrayLike) -> tuple[Array, Array]:
    a, b = np.asarray(matrix, dtype=float), np.asarray(offset, dtype=float)
    if a.ndim < 2 or b.ndim < 1 or a.shape[-2:] != (b.shape[-1], b.shape[-1]):
        raise ValueError(f"matrix must be (..., m, m) for an offset (..., m), not {a.shape} for {b.shape}")
    least = ROUNDING * np.max(np.abs(finite("matrix", a)), axis=(-2, -1), initial=0.0)[..., None]
    not_negative("diagonal of matrix", np.diagonal(a, axis1=-2, axis2=-1) + least)  # of no matter, but for rounding
    return a, finite("offset", b)
