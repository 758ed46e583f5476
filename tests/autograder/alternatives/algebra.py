"""Right answers by other formulas."""

import numpy as np


def col(value):
    return np.expand_dims(np.asarray(value), -1)


def signed_distance(point, normal, offset):
    length = np.sqrt(np.einsum("...i,...i", normal, normal))
    return np.einsum("...i,...i", point, normal / length[..., None]) + offset / length


def time_of_impact_interpolated(separation_0, separation_1, t, dt):
    s0, s1 = np.broadcast_arrays(separation_0, separation_1)
    with np.errstate(all="ignore"):
        end = t + dt + dt * s1 / (s0 - s1)  # from the end backwards
    return np.where((s0 >= 0) & (s1 < 0), end, np.inf)


def count_impacts(position, velocity, length, dt, duration):
    way = velocity * (round(duration / dt) * dt)  # straight on, through mirror images of the strip
    ahead = length - position if velocity > 0 else position
    passed = np.floor((abs(way) - ahead) / length) + 1 if way else 0
    end = (position + way) % (2 * length)
    return max(int(passed), 0), min(end, 2 * length - end)


def overlap_interval(distance, normal_velocity, radius, thickness, dt):
    middle, half = -thickness / 2, thickness / 2 + radius
    distance, u = np.asarray(distance), np.asarray(normal_velocity)
    front, back = np.asarray(radius), -(thickness + radius)
    with np.errstate(all="ignore"):
        times = np.sort(np.stack(np.broadcast_arrays((front - distance) / u, (back - distance) / u)), axis=0)
    inside = (distance <= front) & (distance >= back) if np.all(np.isinf(half)) else np.abs(distance - middle) <= half
    start = np.where(u == 0, np.where(inside, 0, np.inf), np.clip(times[0], 0, None))
    end = np.where(u == 0, np.where(inside, dt, -np.inf), np.minimum(times[1], dt))
    return np.where(start <= end, start, np.inf), np.where(start <= end, end, -np.inf)


def missing_probability(speed, thickness, radius, dt):
    way = np.asarray(speed * dt, dtype=float)
    gap = way - thickness - 2 * radius
    return np.where(gap > 0, gap / np.where(gap > 0, way, 1), 0.0)


def kinematic_response(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    across = np.asarray(normal)[..., :, None] * np.asarray(normal)[..., None, :]
    mirror = np.eye(3) - (1 + np.asarray(restitution))[..., None, None] * across
    closing = velocity - np.asarray(plane_velocity)
    bounced = np.matvec(mirror, closing) + plane_velocity
    return np.where(np.sum(closing * normal, axis=-1, keepdims=True) < 0, bounced, velocity)


def bounce(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    """Height over the plane and the motion along it, each by itself."""
    n, e, dt = np.asarray(normal), np.asarray(restitution), np.asarray(dt)
    place, speed, pull = (np.einsum("...i,...i", each, n) for each in (position, velocity, acceleration))
    height, down = place + offset, np.minimum(pull, 0.0)
    states = [np.broadcast_arrays(height, speed, dt, e)[:2]]
    for _ in range(steps):
        height, speed = states[-1]
        struck = (height < 0) & (speed < 0)
        speed = np.where(struck, -e * speed + (pull - down) * dt, speed + pull * dt)
        states.append([height + speed * dt, speed])
    heights, speeds = (np.stack(column) for column in zip(*states, strict=True))
    count = np.arange(steps + 1).reshape(-1, *(1,) * (heights.ndim - 1))
    time, half = col(count * dt), col(count * (count + 1) / 2 * dt * dt)
    start, way, along = (a - col(b) * n for a, b in ((position, place), (velocity, np.einsum("...i,...i", velocity, n)),
                                                    (acceleration, pull)))  # fmt: skip
    return start + way * time + along * half + col(heights - offset) * n, way + along * time + col(speeds) * n


def respond_at_impact(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    struck = col(np.asarray(time_of_impact) <= dt)
    t = col(np.where(np.isfinite(time_of_impact), time_of_impact, 0.0))
    dt = col(dt)
    at = position + t * (velocity + t / 2 * acceleration)
    bounced = kinematic_response(velocity + t * acceleration, normal, restitution)
    left = dt - t
    hit = at + left * (bounced + left / 2 * acceleration), bounced + left * acceleration
    free = position + dt * (velocity + dt / 2 * acceleration), velocity + dt * acceleration
    return tuple(np.where(struck, one, other) for one, other in zip(hit, free, strict=True))


def penalty_force(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    push = -(stiffness * np.asarray(separation) + damping * np.asarray(normal_velocity))
    touches = np.asarray(separation) < 0
    if not adhesive:
        touches = touches & (push > 0)
    return col(touches * push) * normal


def penalty_step_limit(mass, stiffness, damping=0.0):
    damping = np.asarray(damping)
    return 4 * mass / (np.sqrt(damping**2 + 4 * mass * stiffness) + damping)


def design_contact(mass, speed, depth, restitution, steps_per_contact):
    """From the frequency; and ζ by halving an interval, from the logarithm of e."""
    loss = -np.log(restitution)
    mass, speed, depth, loss, steps = np.broadcast_arrays(mass, speed, depth, loss, steps_per_contact)
    omega = speed / depth
    low, high = np.zeros(np.shape(loss)), np.full(np.shape(loss), 1e6)
    for _ in range(200):
        zeta = (low + high) / 2
        root = np.sqrt(np.asarray(1 - zeta * zeta, dtype=complex))
        lost = 2 * zeta * np.abs(np.arccos(np.asarray(zeta, dtype=complex)) / np.where(root == 0, 1, root))
        low, high = np.where(lost < loss, zeta, low), np.where(lost < loss, high, zeta)
    return mass * omega**2, 2 * low * mass * omega, np.pi / omega / steps


def clamp_to_circle(tangent_force, limit):
    size, limit = np.linalg.norm(tangent_force, axis=-1), np.asarray(limit)
    largest = np.maximum(size, limit)
    return tangent_force * col(limit / np.where(largest > 0, largest, 1.0))


def _point(velocity, angular_velocity, arm, *_):
    x, y, z = np.moveaxis(np.asarray(angular_velocity), -1, 0)
    zero = np.zeros_like(x)
    spin = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*x.shape, 3, 3)
    return velocity + np.matvec(spin, arm)


def normal_velocity(body_a, body_b, normal):
    return np.einsum("...i,...i", _point(*body_a), normal) - np.einsum("...i,...i", _point(*body_b), normal)


def world_inverse_inertia(inertia, orientation):
    w, x, y, z = np.moveaxis(np.asarray(orientation), -1, 0)
    rows = (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )
    turn = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    share = np.array(inertia, dtype=float)
    np.reciprocal(share, out=share, where=share > 0)
    return np.einsum("...ik,...k,...jk->...ij", turn, share, turn)


def _cross_matrix(arm):
    return np.swapaxes(np.cross(np.asarray(arm)[..., None, :], np.eye(3)), -1, -2)


def _give(body):
    """K of one body: what a unit impulse does to its point."""
    _, _, arm, share, turning = body
    across = _cross_matrix(arm)
    return np.asarray(share)[..., None, None] * np.eye(3) - across @ turning @ across


def inverse_effective_mass(body_a, body_b, normal):
    return np.einsum("...i,...ij,...j", normal, _give(body_a) + _give(body_b), normal)


def impulse_magnitude(body_a, body_b, normal, restitution):
    give = inverse_effective_mass(body_a, body_b, normal)
    change = -(np.asarray(restitution) + 1) * normal_velocity(body_a, body_b, normal)
    return np.divide(change, give, out=np.zeros(np.broadcast(change, give).shape), where=give > 0)


def apply_impulse(body_a, body_b, impulse):
    after = []
    for sign, (velocity, spin, arm, share, turning) in ((1, body_a), (-1, body_b)):
        after += [velocity + sign * col(share) * impulse]
        after += [spin - sign * np.matvec(turning, np.cross(impulse, arm))]
    return tuple(after)


def collide(body_a, body_b, normal, restitution, threshold=0.0):
    approach = -normal_velocity(body_a, body_b, normal)
    j = impulse_magnitude(body_a, body_b, normal, restitution) * (approach > threshold)
    return apply_impulse(body_a, body_b, col(j) * normal)


def _still(per):
    """The pseudo-inverse of a matrix, or of a number as a matrix of one row."""
    return np.linalg.pinv(np.asarray(per, dtype=float), hermitian=True)


def audit(body_a, body_b, after):
    """As six numbers for each body: m v and I ω, with the inertia of all six as one matrix."""
    gained = []
    for (velocity, spin, arm, share, turning), v, w in ((body_a, *after[:2]), (body_b, *after[2:])):
        old, new = (np.concatenate(np.broadcast_arrays(*pair), axis=-1) for pair in ((velocity, spin), (v, w)))
        per = np.zeros((*np.broadcast_shapes(np.shape(share), np.shape(turning)[:-2]), 6, 6))
        per[..., :3, :3], per[..., 3:, 3:] = np.asarray(share)[..., None, None] * np.eye(3), turning
        momenta = np.matvec(_still(per), new - old)
        linear = momenta[..., :3]
        angular = momenta[..., 3:] - np.matvec(_cross_matrix(arm), linear)
        gained.append((linear, angular, np.einsum("...i,...i", momenta, new + old) / 2))
    return tuple(a + b for a, b in zip(*gained, strict=True))


def solve_by_sweeps(matrix, offset, sweeps, start=0.0):
    a, b = np.asarray(matrix), np.asarray(offset)
    f = np.zeros(np.broadcast_shapes(a.shape[:-1], b.shape, np.shape(start))) + start
    for _ in range(sweeps):
        for i in range(b.shape[-1]):
            others = np.sum(np.delete(a[..., i, :] * f, i, axis=-1), axis=-1)
            own = a[..., i, i]
            f[..., i] = np.where(own > 0, np.clip(-(others + b[..., i]) / np.where(own > 0, own, 1), 0, None), 0)
    return f
