from __future__ import annotations
import numpy as np
from solutions.impulse import rotation_matrix


def mul(p, q):
    a, b = p[..., :1], q[..., :1]
    return np.concatenate(
        [
            a * b - np.vecdot(p[..., 1:], q[..., 1:])[..., None],
            a * q[..., 1:] + b * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:]),
        ],
        axis=-1,
    )


def turned(q, w):
    angle = np.linalg.norm(w, axis=-1, keepdims=True) / 2
    p = np.concatenate([np.cos(angle), np.sinc(angle / np.pi) * w / 2], axis=-1)
    r = mul(p, q)
    return r / np.linalg.norm(r, axis=-1, keepdims=True)


def rotate_by_momentum(q, w, I, dt):
    if np.all(I == I[..., :1]):
        return turned(q, w * dt), w
    R = rotation_matrix(q)
    J = np.where(np.isinf(I), 1.0, I)
    fixed = np.isinf(I[..., :1])
    L = np.matvec(R, J * np.vecmat(w, R))

    def om(q):
        R = rotation_matrix(q)
        return np.matvec(R, np.vecmat(L, R) / J)

    mid = turned(q, om(q) * dt / 2)
    new = turned(q, om(mid) * dt)
    new = np.where(fixed, turned(q, w * dt), new)
    return new, np.where(fixed, w, om(new))
