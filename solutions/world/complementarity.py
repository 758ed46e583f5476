"""Linear complementarity problems and two ways to solve one (slide 22).

The problem is to find f with A f + b ≥ 0, f ≥ 0 and f·(A f + b) = 0.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import finite, not_negative

NEGLIGIBLE = 1e-10
"""Share of the largest number below which one of Lemke's table counts as 0.

Rounding grows in the exchanges.
"""
PULLED = 1e-7
"""Share of the largest number by which rounding may leave A f + b below zero."""
LEAST_PIVOT = 1e-8
"""The smallest pivot of a careful attempt. A smaller one multiplies rounding."""
EXCHANGES = 20
"""How many exchanges for each row an attempt may take. It usually takes about one."""


def complementarity_residual(
    matrix: ArrayLike,
    offset: ArrayLike,
    force: ArrayLike,
) -> Array:
    """How far forces are from a solution of the problem; zero for a solution.

    Parameters
    ----------
    matrix : (..., m, m), A, 1/kg
    offset : (..., m), b, m/s²
    force : (..., m), f, N

    Returns
    -------
    (...), m/s²
        The largest |min(A_ii f_i, (A f + b)_i)| of all contacts i. For a
        contact that moves nothing, A_ii = 0, the first number is f_i itself. 0
        without any contact.

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, or an A_ii is
        negative.

    Notes
    -----
    A solution needs f_i ≥ 0 and (A f + b)_i ≥ 0, and one of the two must be
    zero. In other words, the smaller of the two numbers must be zero. If it is
    negative, it breaks an inequality; if it is positive, the product is not
    zero. The factor A_ii gives both numbers the same unit, so that they can be
    compared.
    """
    a, b = _checked(matrix, offset)
    f, own = finite("force", force), np.diagonal(a, axis1=-2, axis2=-1)
    pressed = np.where(own > 0, own, 1.0) * f
    return np.asarray(
        np.max(
            np.abs(np.minimum(pressed, np.matvec(a, f) + b)),
            axis=-1,
            initial=0.0,
        )
    )


def solve_by_sweeps(
    matrix: ArrayLike,
    offset: ArrayLike,
    sweeps: int,
    start: ArrayLike = 0.0,
) -> Array:
    """Forces that solve the problem, by projected Gauss–Seidel sweeps.

    Parameters
    ----------
    matrix : (..., m, m), A, 1/kg
    offset : (..., m), b, m/s²
    sweeps : how often to go through all contacts
    start : (..., m), forces to begin with, such as those of the last step, N

    Returns
    -------
    (..., m), N
        A contact that moves nothing, A_ii = 0, gets no force. Where the forces
        are not unique, the sweeps end at one of the solutions, which depends
        on the start and on the order of the contacts.

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, or an A_ii is
        negative.

    Notes
    -----
    The sweep takes one contact after another and holds all other forces fixed.
    It changes f_i so that (A f + b)_i becomes zero, or sets f_i to zero where
    that would be negative:

        f_i ← max(0, f_i − (A f + b)_i/A_ii)

    For a symmetric A without negative eigenvalues, this is simple and never
    wrong by much. How fast it converges depends on A; for a tall stack it is
    slow.
    """
    a, b = _checked(matrix, offset)
    start = finite("start", start)
    f = np.array(
        np.broadcast_to(
            start, np.broadcast_shapes(a.shape[:-1], b.shape, start.shape)
        )
    )
    own = np.diagonal(a, axis1=-2, axis2=-1)
    f *= own > 0
    divisor = np.where(own > 0, own, np.inf)
    for _ in range(sweeps):
        for i in range(f.shape[-1]):
            gap = np.vecdot(a[..., i, :], f) + b[..., i]
            f[..., i] = np.maximum(0.0, f[..., i] - gap / divisor[..., i])
    return f


def solve_by_pivots(matrix: ArrayLike, offset: ArrayLike) -> Array:
    """Forces that solve the problem, by Lemke's method; exact except for rounding.

    Parameters
    ----------
    matrix : (..., m, m), A, 1/kg
        The method is sure to find a solution, if there is one, only for an A
        without negative eigenvalues.
    offset : (..., m), b, m/s²

    Returns
    -------
    (..., m), N
        One of the solutions where they are not unique.

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, or an A_ii is
        negative. If there are no such forces, as for contacts that are forced
        into one another. Rounding hides the forces as well where one body is
        some 1e9 times as heavy as another, because the method divides A by its
        largest number. Where bodies press on each other, 1e6 times is too
        much.

    Notes
    -----
    An artificial force z that acts on all rows, w = A f + b + z ≥ 0, makes f =
    0 a solution. Then the pairs f_i and w_i take turns. Whenever one of a pair
    leaves the basis, its partner enters next, until z itself leaves; this
    takes finitely many exchanges. Ties are broken by the columns of w in their
    order (lexicographically), so that redundant contacts do not make the
    method go round in circles.

    Rounding gathers in the table. Where two contacts are nearly the same, an
    exchange may then divide by what is rounding alone, and the result is no
    solution. So the result is checked. If it fails, a second attempt
    calculates the table from the first one after every exchange, and breaks
    ties by the largest pivot.
    """
    a, b = _checked(matrix, offset)
    return np.asarray(
        np.vectorize(_lemke, otypes=[float], signature="(m,m),(m)->(m)")(a, b)
    )


def _lemke(a: Array, b: Array) -> Array:
    """Solve one problem; with more care if rounding has spoiled the first attempt."""
    if np.all(b >= 0):
        return np.zeros(len(b))
    scale, size = np.max(np.abs(a), initial=0.0) or 1.0, np.max(np.abs(b))
    try:
        forces = _exchanged(a / scale, b / size, careful=False)
        solved = _solves(forces, a / scale, b / size)
    except ValueError:
        solved = False
    if not solved:
        forces = _exchanged(a / scale, b / size, careful=True)
        if not _solves(forces, a / scale, b / size):
            raise ValueError(
                "matrix: rounding hides the forces, because its numbers"
                " differ too much in size"
            )
    return np.asarray(forces * size / scale)


def _solves(forces: Array, a: Array, b: Array) -> bool:
    """Whether A f + b ≥ 0, as it should be; f ≥ 0 holds, and one of each pair is 0."""
    return bool(
        np.all(a @ forces + b >= -PULLED * np.max(forces, initial=1.0))
    )


def _exchanged(a: Array, b: Array, careful: bool) -> Array:
    """Forces from exchanges in a table of the columns w, f, z and the right-hand side.

    A careful attempt takes longer; see `solve_by_pivots`.
    """
    count = len(b)
    start = np.hstack([np.eye(count), -a, -np.ones((count, 1)), b[:, None]])
    table, basis = start.copy(), np.arange(count)
    row, entering = int(np.argmin(b)), 2 * count
    for _ in range(EXCHANGES * (count + 1)):
        _exchange(table, row, entering)
        leaving, basis[row] = basis[row], entering
        if careful:
            table = np.linalg.solve(start[:, basis], start)
        # Either z has left the basis, or it stays there at zero.
        if not np.any(table[basis == 2 * count, -1] > NEGLIGIBLE):
            forces = np.zeros(2 * count + 1)
            # Solved again from the start, because the table has gathered
            # rounding.
            forces[basis] = np.linalg.solve(start[:, basis], start[:, -1])
            return np.maximum(0.0, forces[count:-1])
        entering = leaving + count if leaving < count else leaving - count
        row = (
            _largest_pivot(table, entering, basis == 2 * count)
            if careful
            else _leaving_row(table, entering)
        )
    raise ValueError(
        "matrix: Lemke's method found no end; are its eigenvalues negative?"
    )


def _exchange(table: Array, row: int, column: int) -> None:
    """Take a column into the basis in place of a row's own."""
    table[row] /= table[row, column]
    others = np.arange(len(table)) != row
    table[others] -= np.outer(table[others, column], table[row])


def _leaving_row(table: Array, entering: int) -> int:
    """The row that reaches zero first as a column enters the basis.

    Of several such rows it is the first in the order of the columns of w.
    """
    rows = _falling_rows(table, entering, NEGLIGIBLE)
    for column in (-1, *range(len(table))):
        ratios = table[rows, column] / table[rows, entering]
        rows = rows[ratios <= np.min(ratios) + NEGLIGIBLE]
    return int(rows[0])


def _largest_pivot(table: Array, entering: int, is_z: Booleans) -> int:
    """Of the rows that reach zero first, to rounding, that with the largest pivot.

    The row of z goes before all others, because it ends the search (Harris
    1973).
    """
    rows = _falling_rows(table, entering, LEAST_PIVOT)
    pivots, left = table[rows, entering], np.maximum(table[rows, -1], 0.0)
    first = left / pivots <= np.min((left + NEGLIGIBLE) / pivots)
    return int(
        rows[
            np.argmax(
                np.where(first, np.where(is_z[rows], np.inf, pivots), 0.0)
            )
        ]
    )


def _falling_rows(table: Array, entering: int, least: float) -> Integers:
    """The rows that fall towards zero, faster than `least`, as a column enters."""
    rows = np.flatnonzero(table[:, entering] > least)
    if len(rows) == 0:
        raise ValueError("offset: no forces solve this problem")
    return rows


def _checked(matrix: ArrayLike, offset: ArrayLike) -> tuple[Array, Array]:
    a, b = np.asarray(matrix, dtype=float), np.asarray(offset, dtype=float)
    if a.ndim < 2 or b.ndim < 1 or a.shape[-2:] != (b.shape[-1], b.shape[-1]):
        raise ValueError(
            "matrix must be (..., m, m) for an offset (..., m), not"
            f" {a.shape} for {b.shape}"
        )
    least = (
        NEGLIGIBLE
        * np.max(np.abs(finite("matrix", a)), axis=(-2, -1), initial=0.0)[
            ..., None
        ]
    )
    # A diagonal below zero by no more than rounding does no harm.
    not_negative(
        "diagonal of matrix", np.diagonal(a, axis1=-2, axis2=-1) + least
    )
    return a, finite("offset", b)
