import numpy as np
from solutions.world.shapes import *


def ss(a, b, m):
    d = a.position - b.position
    L = np.linalg.norm(d, axis=-1)
    n = d / L[:, None]
    s = L - a.size[:, 0] - b.size[:, 0]
    k = np.flatnonzero(s <= m)
    return Found(k, (a.position - n * (a.size[:, :1] + s[:, None] / 2))[k], n[k], s[k], 0 * k)


def sh(a, b, m):
    n = b.rotation[:, :, 2]
    s = np.vecdot(a.position - b.position, n) - a.size[:, 0]
    k = np.flatnonzero(s <= m)
    return Found(k, (a.position - n * (a.size[:, :1] + s[:, None] / 2))[k], n[k], s[k], 0 * k)


def hh(a, b, m):
    n = b.rotation[:, :, 2]
    s = np.vecdot(a.vertices - b.position[:, None], n[:, None])
    k, v = np.nonzero(s <= m)
    return Found(k, a.vertices[k, v] - n[k] * s[k, v][:, None] / 2, n[k], s[k, v], v)


PAIRS = {(SPHERE, SPHERE): ss, (SPHERE, HALF_SPACE): sh, (BOX, HALF_SPACE): hh, (POLYHEDRON, HALF_SPACE): hh}
