"""Right answers for one case alone: a row of balls, and contacts as they come."""

import numpy as np


def propagate_impacts(velocity, mass, restitution, most=10_000):
    v = [float(each) for each in velocity]
    m = np.broadcast_to(mass, len(v))
    e = np.broadcast_to(restitution, max(len(v) - 1, 0))
    for _ in range(most):
        struck = False
        for i in range(len(v) - 1):
            closing = v[i] - v[i + 1]
            if closing > 1e-13:
                struck = True
                j = (1 + e[i]) * closing / (1 / m[i] + 1 / m[i + 1])
                v[i], v[i + 1] = v[i] - j / m[i], v[i + 1] + j / m[i + 1]
        if not struck:
            break
    return np.array(v)


def resting_problem(jacobian, inverse_mass, force):
    return jacobian @ inverse_mass @ jacobian.T, jacobian @ inverse_mass @ force


def complementarity_residual(matrix, offset, force):
    worst = 0.0
    for i in range(len(offset)):
        own = matrix[i][i] if matrix[i][i] > 0 else 1.0
        worst = max(worst, abs(min(own * force[i], matrix[i] @ force + offset[i])))
    return worst


def solve_by_sweeps(matrix, offset, sweeps, start=0.0):
    f = np.zeros(len(offset)) + start
    for _ in range(sweeps):
        for i in range(len(f)):
            gap = matrix[i] @ f + offset[i]
            f[i] = max(0.0, f[i] - gap / matrix[i][i]) if matrix[i][i] > 0 else 0.0
    return f
