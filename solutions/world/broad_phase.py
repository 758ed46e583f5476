import numpy as np


def candidate_pairs(lower, upper, group=None):
    n = len(lower)
    i, j = np.triu_indices(n, 1)
    ok = np.all((lower[i] <= upper[j]) & (lower[j] <= upper[i]), axis=-1)
    if group is not None:
        ok &= group[i] == group[j]
    return np.stack([i[ok], j[ok]], axis=-1)
