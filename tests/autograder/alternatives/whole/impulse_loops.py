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
def towards_a(n, a, b):
    length = math.hypot(*n)
    sign = 1 if dot(n, a) >= dot(n, b) else -1
    return np.array([sign * part / length for part in n])


@many("(n),(n),(n),(n)->(n)")
def edge_edge_normal(edge_a, edge_b, a, b):
    return towards_a(cross(edge_a, edge_b), a, b)


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
    sizes = {1: "(n)", 2: "(n),()", 3: "(n),(),()", 4: "(n),(n),(n),(n)"}

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
    p_a, p_b = va + cross(wa, ra), vb + cross(wb, rb)
    return math.fsum((x - y) * z for x, y, z in zip(p_a, p_b, n, strict=True))


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


def _account(a, b, *after):
    momentum, angular, energy = np.zeros(3), np.zeros(3), 0.0
    for sign, velocities in ((-1, (*a[:2], *b[:2])), (1, after)):
        for at, (_, _, r, share, turning) in enumerate((a, b)):
            v, w = velocities[2 * at], velocities[2 * at + 1]
            if share > 0:
                momentum = momentum + sign * v / share
                angular = angular + sign * cross(v / share, r)
                energy += sign * dot(v, v) / share / 2
            moments, axes = np.linalg.eigh(turning)
            for moment, axis in zip(moments, axes.T, strict=True):
                if moment > 1e-12 * moments[-1]:
                    angular = angular + sign * dot(axis, w) / moment * axis
                    energy += sign * dot(axis, w) ** 2 / moment / 2
    return momentum, angular, energy


def normal_velocity(a, b, n):
    return each_contact(_closing)(a, b, n, gives="()")


def inverse_effective_mass(a, b, n):
    return each_contact(_softness)(a, b, n, gives="()")


def impulse_magnitude(a, b, n, e):
    return each_contact(_size)(a, b, n, e, gives="()")


def apply_impulse(a, b, impulse):
    return each_contact(_after)(a, b, impulse, gives="(n),(n),(n),(n)")


def collide(a, b, n, e, threshold=0.0):
    return each_contact(_collision)(a, b, n, e, threshold, gives="(n),(n),(n),(n)")


def audit(a, b, after):
    return each_contact(_account)(a, b, *after, gives="(n),(n),()")
