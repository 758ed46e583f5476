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


Gained = namedtuple("Gained", "momentum angular_momentum energy")


def column(number):
    return np.asarray(number, dtype=float)[..., np.newaxis]


def point(body):
    return body.velocity + np.cross(body.angular_velocity, body.arm)


def normal_velocity(body_a, body_b, normal):
    return np.vecdot(np.subtract(point(body_a), point(body_b)), normal)


def classify_contact(normal_velocity, threshold=0.0):
    u = np.asarray(normal_velocity)
    if u.ndim == 0 and np.ndim(threshold) == 0:
        if u < -threshold:
            return Contact.COLLIDING
        return Contact.SEPARATING if u > threshold else Contact.RESTING
    kinds = [Contact.COLLIDING, Contact.SEPARATING]
    return np.select([u < -np.asarray(threshold), u > threshold], kinds, Contact.RESTING)


def towards_a(normal, centre_a, centre_b):
    n = np.asarray(normal, dtype=float)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    side = np.vecdot(n, np.subtract(centre_a, centre_b))
    return column(np.where(side < 0, -1.0, 1.0)) * n


def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    return towards_a(np.cross(edge_a, edge_b), centre_a, centre_b)


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


def impulse_magnitude(body_a, body_b, normal, restitution):
    k = inverse_effective_mass(body_a, body_b, normal)
    wanted = -(1 + np.asarray(restitution)) * normal_velocity(body_a, body_b, normal)
    return np.where(k > 1e-12, wanted / np.where(k > 1e-12, k, 1.0), 0.0)


def apply_impulse(body_a, body_b, impulse):
    def after(body, j):
        turned = np.matvec(body.inverse_inertia, np.cross(body.arm, j))
        return body.velocity + column(body.inverse_mass) * j, body.angular_velocity + turned

    return After(*after(body_a, impulse), *after(body_b, -np.asarray(impulse)))


def collide(body_a, body_b, normal, restitution, threshold=0.0):
    strikes = classify_contact(normal_velocity(body_a, body_b, normal), threshold) == Contact.COLLIDING
    j = np.where(strikes, impulse_magnitude(body_a, body_b, normal, restitution), 0.0)
    return apply_impulse(body_a, body_b, column(j) * normal)


def carried(body, velocity, spin):
    per_mass = np.asarray(body.inverse_mass, dtype=float)
    momentum = column(np.divide(1.0, per_mass, out=np.zeros_like(per_mass), where=per_mass > 0)) * velocity
    own = np.matvec(np.linalg.pinv(body.inverse_inertia, hermitian=True), spin)
    centre = np.negative(body.arm)  # as seen from the contact
    return Gained(
        momentum, own + np.cross(centre, momentum), (np.vecdot(momentum, velocity) + np.vecdot(own, spin)) / 2
    )


def audit(body_a, body_b, after):
    after = After(*after)
    before_a, before_b = (carried(body, body.velocity, body.angular_velocity) for body in (body_a, body_b))
    a = carried(body_a, after.velocity_a, after.angular_velocity_a)
    b = carried(body_b, after.velocity_b, after.angular_velocity_b)
    energy = a.energy + b.energy - before_a.energy - before_b.energy
    momentum = a.momentum + b.momentum - before_a.momentum - before_b.momentum
    angular = a.angular_momentum + b.angular_momentum - before_a.angular_momentum - before_b.angular_momentum
    return Gained(energy=energy, momentum=momentum, angular_momentum=angular)
