"""Right answers for one contact alone, in plain Python with NumPy here and there."""

import numpy as np


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def point_velocity(v, w, r):
    return v + np.array([w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0]])


def relative_velocity(a, b):
    return a - b


def normal_velocity(a, b, n):
    return np.dot(a - b, n)


def rebound_velocity(u, e):
    if u < 0:
        return -e * u
    return u


def classify_contact(u, threshold=0.0):
    if u < -threshold:
        return -1
    if u > threshold:
        return 1
    return 0


def impulse_of_force(force, time):
    total = np.zeros(3)
    for i in range(1, len(time)):
        total += 0.5 * (time[i] - time[i - 1]) * (force[i] + force[i - 1])
    return total


def mean_force(dP, dt, other=(0, 0, 0)):
    return np.array(dP) / dt - np.array(other)


def point_plane_normal(n, a, b):
    n = n / np.linalg.norm(n)
    if np.dot(n, a - b) < 0:
        n = -n
    return n


def edge_edge_normal(ea, eb, a, b):
    return point_plane_normal(np.cross(ea, eb), a, b)


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
    u = normal_velocity(point_velocity(*A[:3]), point_velocity(*B[:3]), n)
    return -(1 + e) * u / k


def contact_impulses(j, n):
    return j * n, -j * n


def apply_impulse(A, B, J):
    va, wa, ra, ma, Ia = A
    vb, wb, rb, mb, Ib = B
    return va + ma * J, wa + Ia @ np.cross(ra, J), vb - mb * J, wb - Ib @ np.cross(rb, J)


def apply_impulse_to_momenta(P, L, r, J):
    return P + J, L + np.cross(r, J)


def velocities_from_momenta(P, L, m, I):
    return P * m, I @ L


def collide(A, B, n, e, threshold=0.0):
    u = normal_velocity(point_velocity(*A[:3]), point_velocity(*B[:3]), n)
    if classify_contact(u, threshold) == -1:
        J, _ = contact_impulses(impulse_magnitude(A, B, n, e), n)
    else:
        J = 0 * n
    return apply_impulse(A, B, J)
