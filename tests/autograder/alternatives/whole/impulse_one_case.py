"""Right answers for one contact alone, in plain Python with NumPy here and there."""

import numpy as np


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def point_velocity(v, w, r):
    return v + np.array([w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0]])


def normal_velocity(A, B, n):
    return np.dot(point_velocity(*A[:3]) - point_velocity(*B[:3]), n)


def classify_contact(u, threshold=0.0):
    if u < -threshold:
        return -1
    if u > threshold:
        return 1
    return 0


def face_normal(n, a, b):
    n = n / np.linalg.norm(n)
    if np.dot(n, a - b) < 0:
        n = -n
    return n


def edge_edge_normal(ea, eb, a, b):
    return face_normal(np.cross(ea, eb), a, b)


def world_inverse_inertia(inertia, q):
    w, x, y, z = q
    R = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    inv = np.diag([1 / i if i > 0 else 0.0 for i in inertia])
    return R @ inv @ R.T


def inverse_effective_mass(A, B, n):
    k = 0.0
    for v, w, r, m, I in (A, B):
        k += m + np.dot(n, np.cross(I @ np.cross(r, n), r))
    return k


def impulse_magnitude(A, B, n, e):
    k = inverse_effective_mass(A, B, n)
    if k == 0:
        return 0.0
    u = normal_velocity(A, B, n)
    return -(1 + e) * u / k


def apply_impulse(A, B, J):
    va, wa, ra, ma, Ia = A
    vb, wb, rb, mb, Ib = B
    return va + ma * J, wa + Ia @ np.cross(ra, J), vb - mb * J, wb - Ib @ np.cross(rb, J)


def collide(A, B, n, e, threshold=0.0):
    J = 0 * n
    if classify_contact(normal_velocity(A, B, n), threshold) == -1:
        J = impulse_magnitude(A, B, n, e) * n
    return apply_impulse(A, B, J)


def audit(A, B, after):
    P, L, E = np.zeros(3), np.zeros(3), 0.0
    for (v, w, r, m, I), v2, w2 in ((A, after[0], after[1]), (B, after[2], after[3])):
        if m > 0:
            P = P + (v2 - v) / m
            L = L - np.cross(r, (v2 - v) / m)
            E = E + (v2 @ v2 - v @ v) / (2 * m)
        inertia = np.linalg.pinv(I)
        L = L + inertia @ (w2 - w)
        E = E + (w2 @ inertia @ w2 - w @ inertia @ w) / 2
    return P, L, E
