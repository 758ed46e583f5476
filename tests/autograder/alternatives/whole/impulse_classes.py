"""Right answers by objects: a dataclass for a body, methods, properties, an error of one's own, defaults, globals."""

from dataclasses import astuple, dataclass, field, replace

import numpy as np

THRESHOLD: float = 0.0
KINDS = {"colliding": -1, "resting": 0, "separating": 1}


@dataclass(frozen=True)
class Rigid:
    v: np.ndarray
    w: np.ndarray
    r: np.ndarray
    m: float
    i: np.ndarray
    name: str = field(default="a body", compare=False)

    @classmethod
    def of(cls, body):
        return cls(*(np.asarray(part, dtype=float) for part in body))

    @property
    def point(self):
        return self.v + np.cross(self.w, self.r)

    def turned(self, j):
        return (self.i @ np.cross(self.r, j)[..., None])[..., 0]

    def give(self, n):
        return self.m + np.sum(np.cross(self.r, n) * self.turned(n), axis=-1)

    @property
    def mass(self):
        return np.divide(1, self.m, out=np.zeros_like(self.m), where=self.m > 0)

    @property
    def carries(self):
        """P, L about the contact, and energy."""
        momentum = self.mass[..., None] * self.v
        spin = (np.linalg.pinv(self.i) @ self.w[..., None])[..., 0]
        energy = np.sum(momentum * self.v + spin * self.w, axis=-1) / 2
        return momentum, spin + np.cross(momentum, self.r), energy

    def struck(self, j):
        return replace(self, v=self.v + self.m[..., None] * j, w=self.w + self.turned(j))


class Contact:
    """Two bodies and the normal between them."""

    def __init__(self, body_a, body_b, normal):
        self.a, self.b, self.n = Rigid.of(body_a), Rigid.of(body_b), np.asarray(normal, dtype=float)

    @property
    def u(self):
        return np.sum((self.a.point - self.b.point) * self.n, axis=-1)

    @property
    def k(self):
        return self.a.give(self.n) + self.b.give(self.n)

    def j(self, e):
        k, u = np.broadcast_arrays(self.k, self.u)
        found = np.zeros(np.broadcast_shapes(k.shape, np.shape(e)))
        return np.divide(-(1 + np.asarray(e)) * u, k, out=found, where=np.broadcast_to(k > 1e-12, found.shape))

    def after(self, impulse):
        a, b = self.a.struck(impulse), self.b.struck(-np.asarray(impulse))
        return astuple(a)[:2] + astuple(b)[:2]


class Side:
    """Called as a function, which Python allows."""

    def __call__(self, normal, a, b):
        n = normal / np.linalg.norm(normal, axis=-1)[..., None]
        below = np.sum(n * (np.asarray(a) - b), axis=-1)[..., None] < 0
        return np.where(below, -n, n)


class Classifier:
    @staticmethod
    def of(u, threshold):
        u, threshold = np.broadcast_arrays(u, threshold)
        kinds = np.full(u.shape, KINDS["resting"])
        kinds[u > threshold] = KINDS["separating"]
        kinds[u < -threshold] = KINDS["colliding"]
        return kinds


towards_a = Side()


def normal_velocity(body_a, body_b, normal):
    return Contact(body_a, body_b, normal).u


def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    across = np.cross(edge_a, edge_b)
    return towards_a(across, centre_a, centre_b)


def world_inverse_inertia(inertia, orientation):
    inertia, q = np.asarray(inertia, dtype=float), np.asarray(orientation, dtype=float)
    w, v = q[..., :1], q[..., 1:]
    axes = np.eye(3)
    cross = np.cross(v[..., None, :], axes)
    turned = axes + 2 * w[..., None] * cross + 2 * np.cross(v[..., None, :], cross)  # row i: the body's axis i
    with np.errstate(divide="ignore"):
        share = np.where(inertia > 0, 1 / inertia, 0.0)
    return np.einsum("...ki,...k,...kj->...ij", turned, share, turned)


def inverse_effective_mass(body_a, body_b, normal):
    return Contact(body_a, body_b, normal).k


def impulse_magnitude(body_a, body_b, normal, restitution):
    return Contact(body_a, body_b, normal).j(restitution)


def apply_impulse(body_a, body_b, impulse):
    return Contact(body_a, body_b, np.zeros(3)).after(impulse)


def collide(body_a, body_b, normal, restitution, threshold=THRESHOLD):
    contact = Contact(body_a, body_b, normal)
    strikes = Classifier.of(contact.u, threshold) == KINDS["colliding"]
    return contact.after((contact.j(restitution) * strikes)[..., None] * contact.n)


def audit(body_a, body_b, after):
    before = [Rigid.of(body) for body in (body_a, body_b)]
    later = [replace(body, v=v, w=w) for body, v, w in zip(before, after[::2], after[1::2], strict=True)]
    books = [[body.carries for body in bodies] for bodies in (before, later)]
    return tuple(a_new + b_new - a - b for a, b, a_new, b_new in zip(*books[0], *books[1], strict=True))
