"""Right answers by names: bodies read by name, named tuples and members of an IntEnum returned."""

import enum
from collections import namedtuple
from typing import NamedTuple

import numpy as np


class Contact(enum.IntEnum):
    COLLIDING = -1
    RESTING = 0
    SEPARATING = 1


class After(NamedTuple):
    velocity_a: np.ndarray
    angular_velocity_a: np.ndarray
    velocity_b: np.ndarray
    angular_velocity_b: np.ndarray


Momenta = namedtuple("Momenta", "momentum angular_momentum")
Pair = namedtuple("Pair", ["on_a", "on_b"])


def column(number):
    return np.asarray(number, dtype=float)[..., np.newaxis]


def point_velocity(velocity, angular_velocity, arm):
    return np.add(velocity, np.cross(angular_velocity, arm))


def relative_velocity(point_velocity_a, point_velocity_b):
    return np.subtract(point_velocity_a, point_velocity_b)


def normal_velocity(point_velocity_a, point_velocity_b, normal):
    return np.vecdot(relative_velocity(point_velocity_a, point_velocity_b), normal)


def rebound_velocity(normal_velocity, restitution):
    u = np.asarray(normal_velocity, dtype=float)
    return np.choose(u < 0, [u, -restitution * u])


def classify_contact(normal_velocity, threshold=0.0):
    u = np.asarray(normal_velocity)
    if u.ndim == 0 and np.ndim(threshold) == 0:
        if u < -threshold:
            return Contact.COLLIDING
        return Contact.SEPARATING if u > threshold else Contact.RESTING
    kinds = [Contact.COLLIDING, Contact.SEPARATING]
    return np.select([u < -np.asarray(threshold), u > threshold], kinds, Contact.RESTING)


def impulse_of_force(force, time):
    return np.trapezoid(force, np.asarray(time)[..., np.newaxis], axis=-2)


def mean_force(momentum_change, duration, other_force=(0.0, 0.0, 0.0)):
    return np.asarray(momentum_change) / column(duration) - other_force


def point_plane_normal(plane_normal, centre_a, centre_b):
    n = np.asarray(plane_normal, dtype=float)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    side = np.vecdot(n, np.subtract(centre_a, centre_b))
    return column(np.where(side < 0, -1.0, 1.0)) * n


def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    return point_plane_normal(np.cross(edge_a, edge_b), centre_a, centre_b)


def world_inverse_inertia(inertia, orientation):
    inertia = np.asarray(inertia, dtype=float)
    inverse = np.divide(1.0, inertia, out=np.zeros_like(inertia), where=inertia > 0)
    w, x, y, z = np.moveaxis(np.asarray(orientation, dtype=float), -1, 0)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    turn = np.moveaxis(turn, (0, 1), (-2, -1))
    return (turn * inverse[..., np.newaxis, :]) @ np.swapaxes(turn, -1, -2)


def give(body, normal):
    turned = np.matvec(body.inverse_inertia, np.cross(body.arm, normal))
    return body.inverse_mass + np.vecdot(np.cross(turned, body.arm), normal)


def inverse_effective_mass(body_a, body_b, normal):
    return give(body_a, normal) + give(body_b, normal)


def approach(body_a, body_b, normal):
    points = [point_velocity(body.velocity, body.angular_velocity, body.arm) for body in (body_a, body_b)]
    return normal_velocity(*points, normal)


def impulse_magnitude(body_a, body_b, normal, restitution):
    k = inverse_effective_mass(body_a, body_b, normal)
    wanted = -(1 + np.asarray(restitution)) * approach(body_a, body_b, normal)
    return np.where(k > 1e-12, wanted / np.where(k > 1e-12, k, 1.0), 0.0)


def contact_impulses(magnitude, normal):
    on_a = column(magnitude) * normal
    return Pair(on_b=-on_a, on_a=on_a)


def apply_impulse(body_a, body_b, impulse):
    def after(body, j):
        turned = np.matvec(body.inverse_inertia, np.cross(body.arm, j))
        return body.velocity + column(body.inverse_mass) * j, body.angular_velocity + turned

    return After(*after(body_a, impulse), *after(body_b, -np.asarray(impulse)))


def apply_impulse_to_momenta(momentum, angular_momentum, arm, impulse):
    return Momenta(np.add(momentum, impulse), angular_momentum + np.cross(arm, impulse))


def velocities_from_momenta(momentum, angular_momentum, inverse_mass, inverse_inertia):
    return Momenta(column(inverse_mass) * momentum, np.matvec(inverse_inertia, angular_momentum))


def collide(body_a, body_b, normal, restitution, threshold=0.0):
    strikes = approach(body_a, body_b, normal) < -np.asarray(threshold)
    j = np.where(strikes, impulse_magnitude(body_a, body_b, normal, restitution), 0.0)
    return apply_impulse(body_a, body_b, contact_impulses(j, normal).on_a)
