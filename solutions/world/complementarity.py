"""Linear complementarity problems and two ways to solve one (slide 22).

The problem is to find f with A f + b ≥ 0, f ≥ 0 and f·(A f + b) = 0.
"""

from __future__ import annotations

import math
import warnings

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import not_negative
from solutions.domain import Finite, Whole, domain, require

NEGLIGIBLE = 1e-10
"""Share of the largest number below which one of Lemke's table counts as 0.

Rounding grows in the exchanges.
"""
LEAST_PIVOTS = (1e-8, 1e-11, 1e-14)
"""The smallest pivots of careful attempts, one after another.

A smaller one multiplies rounding. But where masses differ by 1e10, a pivot of
1e-10 is no rounding.
"""
SOLVED, NEARLY = 1e-10, 1e-7
"""Shares of its terms by which rounding may change a row of A f + b.

With the first no further attempt is made; with the second the best attempt is
taken.
"""
CONVERGED = 1e-6
"""Share of the terms of a row that is left where sweeps have converged."""
FAINT = 1e-6
"""Share of the largest force below which a force may be rounding."""
UNMET = 0.05
"""Share of the largest |b_i| by which A f + b may miss what it has to be.

Rounding of A and huge forces solve even a problem that has no solution, but
for rows that they miss by about b itself.
"""
EXCHANGES, CAREFUL_EXCHANGES = 20, 5
"""How many exchanges an attempt may take for each row.

It usually takes about one.
"""


class NotConverged(UserWarning):
    """The sweeps have ended before the forces were found."""


@domain
def complementarity_residual(
    matrix: Finite, offset: Finite, force: Finite
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
        If the shapes do not fit, or an A_ii is negative.

    Notes
    -----
    A solution needs f_i ≥ 0 and (A f + b)_i ≥ 0, and one of the two must be
    zero. In other words, the smaller of the two numbers must be zero. If it is
    negative, it breaks an inequality; if it is positive, the product is not
    zero. The factor A_ii gives both numbers the same unit, so that they can be
    compared.
    """
    _refuse_misfit(matrix, offset)
    own = np.diagonal(matrix, axis1=-2, axis2=-1)
    pressed = np.where(own > 0, own, 1.0) * force
    parting = np.matvec(matrix, force) + offset
    return np.max(np.abs(np.minimum(pressed, parting)), axis=-1, initial=0.0)


@domain
def solve_by_sweeps(
    matrix: Finite, offset: Finite, sweeps: Whole, start: Finite = 0.0
) -> Array:
    """Forces that solve the problem, by projected Gauss–Seidel sweeps.

    Parameters
    ----------
    matrix : (..., m, m), A, 1/kg
    offset : (..., m), b, m/s²
    sweeps : how often to go through all contacts, a number
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
        If the shapes do not fit, or an A_ii is negative.

    Warns
    -----
    NotConverged
        Where the `complementarity_residual` of a row i is above 1e-6 of the
        terms that add up there, |b_i| + Σ_j |A_ij| f_j. So a large row hides
        a small one only if it is 1e7 times as large, when the small one may
        be rounding. Each problem is compared with itself alone.

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
    _refuse_misfit(matrix, offset)
    a, b = matrix, offset
    own = np.diagonal(a, axis1=-2, axis2=-1)
    shape = np.broadcast_shapes(a.shape[:-1], b.shape, start.shape)
    f = np.array(np.broadcast_to(start, shape))
    f *= own > 0
    divisor = np.where(own > 0, own, np.inf)
    for _ in range(int(sweeps)):
        for i in range(f.shape[-1]):
            gap = np.vecdot(a[..., i, :], f) + b[..., i]
            f[..., i] = np.maximum(0.0, f[..., i] - gap / divisor[..., i])
    _say_what_is_left(a, b, f, int(sweeps))
    return f


def _say_what_is_left(a: Array, b: Array, f: Array, sweeps: int) -> None:
    """Warn where the sweeps have left more than rounding of some row."""
    # Each row is a problem of its own if all other forces are fixed.
    own = np.maximum(np.diagonal(a, axis1=-2, axis2=-1), 0.0)
    others = np.matvec(a, f) - own * f + b
    residual = complementarity_residual(
        own[..., None, None], others[..., None], f[..., None]
    )
    terms = np.matvec(np.abs(a), f) + np.abs(b)
    largest = np.max(terms, axis=-1, keepdims=True, initial=0.0)
    wrong = residual > CONVERGED * np.maximum(terms, NEARLY * largest)
    if np.any(wrong):
        worst = np.max(residual[wrong])
        warnings.warn(
            f"{sweeps} sweeps have not converged: the accelerations are wrong"
            f" by up to {worst:.2g} m/s² (complementarity_residual)",
            NotConverged,
            stacklevel=4,
        )


@domain
def solve_by_pivots(matrix: Finite, offset: Finite) -> Array:
    """Forces that solve the problem, by Lemke's method; exact to rounding.

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
        If the shapes do not fit, or an A_ii is negative. If there are no such
        forces, as for contacts that are forced into one another.

    Notes
    -----
    An artificial force z acts on all rows:

        w = A f + b + z ≥ 0

    It makes f = 0 a solution. Then the pairs f_i and w_i take turns. Whenever
    one of a pair leaves the basis, its partner enters next, until z itself
    leaves; this takes finitely many exchanges. Ties are broken by the columns
    of w in their order (lexicographically), so that redundant contacts do not
    make the method go round in circles.

    Rounding gathers in the table. Where two contacts are nearly the same, an
    exchange may then divide by what is rounding alone, and the result is no
    solution. So the result is checked. If it fails, further attempts follow.
    They measure each force in a unit of its own, in which the numbers of A are
    of one size, also where one body is 1e12 times as heavy as another. The
    careful ones calculate the table from the first one after every exchange,
    and break ties by the largest pivot.

    No method is more precise than A. Next to a body of 1 kg, one of 1e10 kg
    changes A_ii by a share of 1e-10, of which a float keeps six digits.
    """
    _refuse_misfit(matrix, offset)
    solve = np.vectorize(_lemke, otypes=[float], signature="(m,m),(m)->(m)")
    return solve(matrix, offset)


def _lemke(a: Array, b: Array) -> Array:
    """Solve one problem; with more care where rounding spoils an attempt."""
    if np.all(b >= 0):
        return np.zeros(len(b))
    best, forces, refused = math.inf, b, None
    plain, even = np.ones(len(b)), _evened(a)
    units = [plain, even, *[even] * len(LEAST_PIVOTS)]
    for unit, least in zip(units, (None, None, *LEAST_PIVOTS), strict=True):
        scaled, right = a * np.outer(unit, unit), b * unit
        scale, size = np.max(np.abs(scaled)) or 1.0, np.max(np.abs(right))
        try:
            scaled_forces = _exchanged(scaled / scale, right / size, least)
            attempt = unit * (scaled_forces * size / scale)
        except ValueError as error:
            refused = refused or error
            continue
        missed = _missed(a, b, attempt, even)
        if missed < best:
            best, forces = missed, attempt
        if best <= SOLVED:
            break
    if best <= NEARLY:
        return forces
    raise refused or ValueError(
        "matrix: rounding hides the forces, because its numbers differ too"
        " much in size"
    )


def _evened(a: Array) -> Array:
    """Units (m,) in which the largest number of each row and column is near 1.

    The same units for rows and columns leave the problem as it is: f_i is over
    the unit, (A f + b)_i times the unit, and A keeps the signs of its
    eigenvalues. They are powers of two, so that no digit changes (Ruiz 2001).
    """
    unit = np.ones(len(a))
    for _ in range(5):
        now = np.abs(a) * np.outer(unit, unit)
        largest = np.maximum(np.max(now, axis=0), np.max(now, axis=1))
        root = np.sqrt(np.where(largest > 0, largest, 1.0))
        unit /= np.exp2(np.round(np.log2(root)))
    return unit


def _missed(a: Array, b: Array, forces: Array, unit: Array) -> float:
    """By how much forces f ≥ 0 miss a solution, as a share of a row's terms.

    A row may not be below zero, nor above zero where there is a force. Forces
    that are small beside the others count as larger, because they may be
    rounding of these.
    """
    row = a @ forces + b
    wrong = np.where(forces > 0, np.abs(row), -row)
    # What the most careful attempt takes for zero is none.
    wrong = np.maximum(wrong - LEAST_PIVOTS[-1] * np.max(np.abs(b)), 0.0)
    if np.max(wrong) > UNMET * np.max(np.abs(b)):
        return math.inf
    even = forces / unit
    even = unit * np.maximum(even, FAINT * np.max(even))
    terms = np.abs(a) @ even + np.abs(b)
    return float(np.max(wrong / np.where(terms > 0, terms, 1.0)))


def _exchanged(a: Array, b: Array, least: float | None) -> Array:
    """Forces from exchanges in a table with the columns w, f and z.

    The right-hand side is its last column. With a least pivot the attempt is a
    careful one, which takes longer; see `solve_by_pivots`.
    """
    count = len(b)
    start = np.hstack([np.eye(count), -a, -np.ones((count, 1)), b[:, None]])
    table, basis = start.copy(), np.arange(count)
    row, entering = int(np.argmin(b)), 2 * count
    most = CAREFUL_EXCHANGES if least else EXCHANGES
    for _ in range(most * (count + 1)):
        _exchange(table, row, entering)
        leaving, basis[row] = basis[row], entering
        if least:
            table = np.linalg.solve(start[:, basis], start)
        # Either z has left the basis, or it stays there at zero.
        if not np.any(table[basis == 2 * count, -1] > (least or NEGLIGIBLE)):
            forces = np.zeros(2 * count + 1)
            # Solved again from the start, because the table has gathered
            # rounding.
            forces[basis] = np.linalg.solve(start[:, basis], start[:, -1])
            return np.maximum(0.0, forces[count:-1])
        entering = leaving + count if leaving < count else leaving - count
        row = (
            _largest_pivot(table, entering, basis == 2 * count, least)
            if least
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


def _largest_pivot(
    table: Array, entering: int, is_z: Booleans, least: float
) -> int:
    """The row with the largest pivot of those that reach zero first.

    First means: to rounding. The row of z goes before all others, because it
    ends the search (Harris 1973).
    """
    rows = _falling_rows(table, entering, least)
    pivots, left = table[rows, entering], np.maximum(table[rows, -1], 0.0)
    first = left / pivots <= np.min((left + min(least, NEGLIGIBLE)) / pivots)
    pivots = np.where(is_z[rows], np.inf, pivots)
    return int(rows[np.argmax(np.where(first, pivots, 0.0))])


def _falling_rows(table: Array, entering: int, least: float) -> Integers:
    """The rows that fall faster than `least` as a column enters."""
    rows = np.flatnonzero(table[:, entering] > least)
    if len(rows) == 0:
        raise ValueError("offset: no forces solve this problem")
    return rows


def _refuse_misfit(matrix: Array, offset: Array) -> None:
    """Refuse shapes that do not fit each other, and a negative A_ii."""
    rows = 2 * offset.shape[-1:]
    require(
        len(rows) == 2 and matrix.shape[-2:] == rows,
        "matrix must be (..., m, m) for an offset (..., m), not"
        f" {matrix.shape} for {offset.shape}",
    )
    largest = np.max(np.abs(matrix), axis=(-2, -1), initial=0.0)[..., None]
    own = np.diagonal(matrix, axis1=-2, axis2=-1)
    # A diagonal below zero by no more than rounding does no harm.
    not_negative("diagonal of matrix", own + NEGLIGIBLE * largest)
