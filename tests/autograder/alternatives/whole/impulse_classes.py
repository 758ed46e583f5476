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


point_plane_normal = Side()


def point_velocity(velocity, angular_velocity, arm):
    return Rigid(np.asarray(velocity), np.asarray(angular_velocity), arm, 0.0, 0.0).point


def relative_velocity(point_velocity_a, point_velocity_b):
    return np.asarray(point_velocity_a) - point_velocity_b


def normal_velocity(point_velocity_a, point_velocity_b, normal):
    return np.sum(relative_velocity(point_velocity_a, point_velocity_b) * normal, axis=-1)


def rebound_velocity(normal_velocity, restitution):
    return np.maximum(normal_velocity, -restitution * np.asarray(normal_velocity))


def classify_contact(normal_velocity, threshold=THRESHOLD):
    return Classifier.of(normal_velocity, threshold)


def impulse_of_force(force, time):
    force, time = np.asarray(force), np.asarray(time)
    means = (force[..., 1:, :] + force[..., :-1, :]) / 2
    return np.sum(means * np.diff(time, axis=-1)[..., None], axis=-2)


def mean_force(momentum_change, duration, other_force=(0.0, 0.0, 0.0)):
    change, time = np.asarray(momentum_change), np.asarray(duration)
    return (change.T / time.T).T - other_force


def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    across = np.cross(edge_a, edge_b)
    return point_plane_normal(across, centre_a, centre_b)


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


def contact_impulses(magnitude, normal):
    both = np.asarray(magnitude)[..., None] * np.asarray(normal)
    return [both, -both]


def apply_impulse(body_a, body_b, impulse):
    return Contact(body_a, body_b, np.zeros(3)).after(impulse)


def apply_impulse_to_momenta(momentum, angular_momentum, arm, impulse):
    return np.array(momentum) + impulse, np.array(angular_momentum) - np.cross(impulse, arm)


def velocities_from_momenta(momentum, angular_momentum, inverse_mass, inverse_inertia):
    w = np.einsum("...ij,...j->...i", inverse_inertia, angular_momentum)
    return np.multiply(momentum, np.asarray(inverse_mass)[..., None]), w


def collide(body_a, body_b, normal, restitution, threshold=THRESHOLD):
    contact = Contact(body_a, body_b, normal)
    strikes = Classifier.of(contact.u, threshold) == KINDS["colliding"]
    return contact.after((contact.j(restitution) * strikes)[..., None] * contact.n)
