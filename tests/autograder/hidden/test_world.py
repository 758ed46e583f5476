"""Impacts in a row and resting contact: drawn examples, limiting cases, and many at once."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect, plainly
from labs.grading.judging.markers import asks

X, Y, UP, LEANS, REST = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
INFINITY = math.inf


def row(velocity, mass, e):
    """Pair after pair from the left, and again, until no ball is faster than the next."""
    v, m = [float(each) for each in velocity], np.broadcast_to(mass, len(velocity))
    e = np.broadcast_to(e, max(len(v) - 1, 0))
    for _ in range(2000):
        for i in range(len(v) - 1):
            closing = v[i] - v[i + 1]
            if closing > 0 and m[i + 1] == INFINITY:
                v[i] = v[i + 1] - e[i] * closing
            elif closing > 0:
                centre = (m[i] * v[i] + m[i + 1] * v[i + 1]) / (m[i] + m[i + 1])
                v[i] = centre - e[i] * closing * m[i + 1] / (m[i] + m[i + 1])
                v[i + 1] = centre + e[i] * closing * m[i] / (m[i] + m[i + 1])
    return np.array(v)


@asks("propagate_impacts", 5, "Each impact of two keeps their momentum and leaves e of their closing speed.")
def test_each_impact_of_two_in_the_row(submission, part, examples):
    masses = [2.0, 1.0, 0.5]

    def rows(draw):
        return draw.vector(3), np.array(masses), 0.75

    with part(2, "any three balls"):
        examples.agree(submission.propagate_impacts, row, rows, count=6)
    with part(2, "a wall, one ball, parting, from the right, restitutions that differ"):
        for case in (
            ([1, 0, 0], [1, 1, INFINITY], 1.0), ([3], 1.0, 0.5), ([-1, 0, 2], 1.0, 0.5), ([0, 0, -1], 1.0, 1.0),
            ([2, 0, 0], 1.0, [0.5, 1.0]), ([2, 2, 2], 1.0, 0.5), ([1, 0, 0], [3, 1, 1], 1.0), ([1, 0], [1, 4], 1.0),
            ([2, -1], [1, 3], 0.0), ([2, -1], [2, 1], 0.5), ([1, 0, 0], 1.0, 0.5), ([1, 1, 0, 0, 0], 1.0, 1.0),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.propagate_impacts, case, row(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.propagate_impacts, row, rows, single=(1, 2))


@asks("resting_problem", 3, "A force at one contact accelerates all contacts of the body.")
def test_a_force_at_one_contact_is_felt_at_the_others(submission, part, examples):
    def problem(g, w, force):
        rows = range(len(g))
        return np.array([[g[i] @ (w @ g[j]) for j in rows] for i in rows]), np.array([g[i] @ (w @ force) for i in rows])

    def bodies(draw):
        half = np.array([draw.vector(1) for _ in range(3)])
        return np.array([draw.vector(2) for _ in range(2)]), half @ half.T + np.eye(3), draw.vector(9)

    with part(1, "any two contacts"):
        examples.agree(submission.resting_problem, problem, bodies)
    with part(1, "no force, an immovable body"):
        for case in (
            ([UP], np.eye(3) / 2, REST),
            ([UP], np.zeros((3, 3)), [0, 0, -20]),
            ([[1, 0], [0, 1]], [[2, 0.5], [0.5, 1]], [-4, 2]),
        ):
            case = plainly(*case)
            expect(submission.resting_problem, case, problem(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.resting_problem, problem, bodies)


def contacts(draw):
    """A and b of three contacts."""
    half = np.array([draw.vector(1.5) for _ in range(3)])
    return half @ half.T + np.eye(3), draw.vector(5)


@asks("complementarity_residual", 3, "The largest of |min(A_ii f_i, (A f + b)_i)|.")
def test_the_worst_contact_counts(submission, part, examples):
    def residual(a, b, f):
        own = np.diag(a)
        return max(abs(min((own[i] or 1.0) * f[i], a[i] @ f + b[i])) for i in range(len(b)))

    with part(1, "any guess"):
        examples.agree(submission.complementarity_residual, residual, lambda draw: (*contacts(draw), draw.vector(3)))
    with part(1, "lifting off, a contact that pulls, one that moves nothing"):
        for case in (
            ([[2]], [4], [0]), ([[2]], [4], [-2]), ([[0]], [1], [0.5]), ([[2]], [0], [0]), ([[2, 0],
            [0, 1]], [-4, -1], [2, 3]),
            ([[2]], [-4], [3]), ([[2]], [-4], [2]),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.complementarity_residual, case, residual(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(
            submission.complementarity_residual, residual, lambda draw: (*contacts(draw), draw.vector(3))
        )  # fmt: skip


@asks("solve_by_sweeps", 4, "Contact after contact, each with what the others give now.")
def test_each_contact_sees_what_the_others_give_now(submission, part, examples):
    def sweep(a, b, sweeps, start=0.0):
        f = np.array(np.broadcast_to(start, b.shape), dtype=float)
        for _ in range(int(sweeps)):
            for i in range(len(b)):
                f[i] = max(0.0, f[i] - (a[i] @ f + b[i]) / a[i, i]) if a[i, i] > 0 else 0.0
        return f

    def problems(draw):
        return (*contacts(draw), 2, np.abs(draw.vector(2)))

    with part(2, "any three contacts, two sweeps"):
        examples.agree(submission.solve_by_sweeps, sweep, problems)
    with part(1, "no sweep, three and many, from a start, a contact that moves nothing"):
        coupled = [[2, 1], [1, 2]]
        for case in (
            (coupled, [-4, -4], 0, [1, 2]), (coupled, [4, 4], 3), (coupled, [-6, 4], 3), (coupled, [-4, -4], 1, [3, 1]),
            (coupled, [-4, 2], 1, [5, 5]), ([[2, 0], [0, 0]], [-4, 1], 2), ([[2, 0], [0, 0]], [-4, -1], 2),
            (coupled, [-4, -4], 100),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.solve_by_sweeps, case, sweep(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.solve_by_sweeps, sweep, problems, single=(2,))
