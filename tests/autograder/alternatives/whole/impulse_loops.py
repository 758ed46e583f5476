"""Right answers by loops: functions of one contact in np.vectorize, rows by comprehension, while, recursion."""

import math

import numpy as np


def dot(a, b):
    return a[0] * b[0] + dot(a[1:], b[1:]) if len(a) else 0.0


def cross(a, b):
    return np.array([a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)])


def matrix_times(m, a):
    return np.array([dot(row, a) for row in m])


def many(signature):
    def wrapped(function):
        return np.vectorize(function, signature=signature)

    return wrapped


@many("(n),(n),(n)->(n)")
def point_velocity(v, w, r):
    return v + cross(w, r)


def relative_velocity(a, b):
    a, b = np.broadcast_arrays(a, b)
    result = np.empty(a.shape)
    for place in np.ndindex(a.shape):
        result[place] = a[place] - b[place]
    return result


@many("(n),(n),(n)->()")
def normal_velocity(a, b, n):
    return math.fsum((x - y) * z for x, y, z in zip(a, b, n, strict=True))


def rebound_velocity(u, e):
    if np.ndim(u) or np.ndim(e):
        u, e = np.broadcast_arrays(u, e)
        return np.array([rebound_velocity(one, share) for one, share in zip(u, e, strict=True)])
    return -e * float(u) if u < 0 else float(u)


@np.vectorize
def classify_contact(u, threshold=0.0):
    match (bool(u < -threshold), bool(u > threshold)):
        case (True, _):
            return -1
        case (_, True):
            return 1
    return 0


@many("(k,n),(k)->(n)")
def impulse_of_force(force, time):
    total, i = np.zeros(3), 0
    while i + 1 < len(time):
        total = total + (time[i + 1] - time[i]) * (force[i] + force[i + 1]) * 0.5
        i += 1
    return total


@many("(n),(),(n)->(n)")
def _mean(change, duration, other):
    return np.array([p / duration - f for p, f in zip(change, other, strict=True)])


def mean_force(momentum_change, duration, other_force=None):
    return _mean(momentum_change, duration, np.zeros(3) if other_force is None else other_force)


@many("(n),(n),(n)->(n)")
def point_plane_normal(n, a, b):
    length = math.hypot(*n)
    sign = 1 if dot(n, a) >= dot(n, b) else -1
    return np.array([sign * part / length for part in n])


@many("(n),(n),(n),(n)->(n)")
def edge_edge_normal(edge_a, edge_b, a, b):
    return point_plane_normal(cross(edge_a, edge_b), a, b)


@many("(n),(q)->(n,n)")
def world_inverse_inertia(inertia, orientation):
    w, q = orientation[0], orientation[1:]
    total = np.zeros((3, 3))
    for axis, moment in zip(np.eye(3), inertia, strict=True):
        if moment > 0:
            lies = axis + 2 * w * cross(q, axis) + 2 * cross(q, cross(q, axis))
            total += np.outer(lies, lies) / moment
    return total


def each_contact(function):
    """The bodies taken apart, and put together for each contact."""
    body = "(n),(n),(n),(),(n,n)"
    sizes = {1: "(n)", 2: "(n),()", 3: "(n),(),()"}

    def called(a, b, *more, gives):
        def one(*parts):
            return function(parts[:5], parts[5:10], *parts[10:])

        return np.vectorize(one, signature=f"{body},{body},{sizes[len(more)]}->{gives}")(*a, *b, *more)

    return called


def _softness(a, b, n):
    k = 0.0
    for _, _, r, share, turning in (a, b):
        lever = cross(r, n)
        k += share + dot(lever, matrix_times(turning, lever))
    return k


def _closing(a, b, n):
    (va, wa, ra, *_), (vb, wb, rb, *_) = a, b
    return dot(n, va + cross(wa, ra)) - dot(n, vb + cross(wb, rb))


def _size(a, b, n, e):
    try:
        k = _softness(a, b, n)
        return 0.0 if k < 1e-12 else -(1 + e) * _closing(a, b, n) / k
    except ZeroDivisionError:
        return 0.0


def _after(a, b, impulse):
    answer = []
    for sign, (v, w, r, share, turning) in zip((1, -1), (a, b), strict=True):
        answer += [v + sign * share * impulse, w + sign * matrix_times(turning, cross(r, impulse))]
    return tuple(answer)


def _collision(a, b, n, e, threshold):
    j = _size(a, b, n, e) if _closing(a, b, n) < -threshold else 0.0
    return _after(a, b, j * n)


def inverse_effective_mass(a, b, n):
    return each_contact(_softness)(a, b, n, gives="()")


def impulse_magnitude(a, b, n, e):
    return each_contact(_size)(a, b, n, e, gives="()")


def contact_impulses(j, n):
    if np.ndim(j) == 0 and np.ndim(n) == 1:
        return [j * part for part in n], [-j * part for part in n]
    on_a = np.multiply.outer(j, np.ones(3)) * n
    return on_a, -on_a


def apply_impulse(a, b, impulse):
    return each_contact(_after)(a, b, impulse, gives="(n),(n),(n),(n)")


def apply_impulse_to_momenta(p, angular, r, j):
    p, angular, r, j = (np.array(each, dtype=float) for each in (p, angular, r, j))
    turned = np.stack(
        [
            r[..., 1] * j[..., 2] - r[..., 2] * j[..., 1],
            r[..., 2] * j[..., 0] - r[..., 0] * j[..., 2],
            r[..., 0] * j[..., 1] - r[..., 1] * j[..., 0],
        ],
        axis=-1,
    )
    return p + j, angular + turned


@many("(n),(n),(),(n,n)->(n),(n)")
def velocities_from_momenta(p, angular, share, turning):
    return share * p, matrix_times(turning, angular)


def collide(a, b, n, e, threshold=0.0):
    return each_contact(_collision)(a, b, n, e, threshold, gives="(n),(n),(n),(n)")
