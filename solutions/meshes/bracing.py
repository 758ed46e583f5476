"""Which springs keep a lattice in shape (slide 28)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.domain import Number, domain
from solutions.meshes.mesh import Edges, lengths, require_nodes
from solutions.vectors import quotient

TINY = 1e-6
"""Share of the largest singular value below which another one counts as zero.

Directions in single precision have errors of some 1e-7.
"""


@domain
def diagonals(position: Number, edges: Edges, candidates: Edges) -> Booleans:
    """Which of the candidates keep the shape of a lattice, as few as possible.

    The candidates are tried one after another, in their order. A candidate is
    needed if it resists a small motion of the nodes that the edges and the
    candidates chosen before it do not resist. Any other candidate is left out.

    Parameters
    ----------
    position : (n, 3), m, the shape at rest
    edges : (m, 2), the nodes at the two ends of the springs that are there
    candidates : (c, 2), the same of springs that might be added
        A spring joins two different nodes.

    Returns
    -------
    (c,), bool
        A candidate of zero length has no direction, and is not needed.

    Raises
    ------
    ValueError
        If an edge or a candidate names a node that does not exist.

    Notes
    -----
    A small motion d of the nodes stretches a spring with the unit vector u
    from end 2 to end 1 by (d1 − d2)·u. This is a row of numbers, u at the
    first end, −u at the second and zero elsewhere, times the 3 n numbers of d.
    The motions that stretch no spring are those that all rows turn into zero,
    and there are 3 n − rank of them. A spring takes one away if its row raises
    the rank, that is, if it is no sum of multiples of the rows before it.

    A free solid keeps six motions, so 3 n − 6 springs must resist one each.
    Whichever springs come first, the same number is needed: as many as raise
    the rank.
    """
    rows = _rows(position, edges)
    rank = _rank(rows)
    needed = []
    for row in _rows(position, candidates):
        more = np.vstack([rows, row])
        raised = _rank(more)
        needed.append(raised > rank)
        if raised > rank:
            rows, rank = more, raised
    return np.array(needed, dtype=bool)


def _rows(position: Array, edges: Integers) -> Array:
    """For each edge the numbers that make its stretch of a motion."""
    require_nodes(edges, len(position))
    first, second = edges.T
    span = position[first] - position[second]
    u = quotient(span, lengths(span)[:, None])
    rows = np.zeros((len(edges), len(position), 3))
    number = np.arange(len(edges))
    rows[number, first] = u
    rows[number, second] = -u
    return rows.reshape(len(edges), position.size)


def _rank(rows: Array) -> int:
    return int(np.linalg.matrix_rank(rows, rtol=TINY)) if rows.size else 0
