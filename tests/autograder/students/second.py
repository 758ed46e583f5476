"""A second lot of wrong answers, like the first, written when the bank and the rules of naming stood."""

import math

import numpy as np


def signed_distance_5(point, normal, offset):
    """From the plane's point (0, 0, −d)."""
    n = normal / np.linalg.norm(normal)
    return np.dot(n, point - np.array([0, 0, -offset]))


def time_of_impact_interpolated_4(separation_0, separation_1, t, dt):
    """Never infinite: limited to the step."""
    if separation_0 == separation_1:
        return t
    return t + dt * min(max(separation_0 / (separation_0 - separation_1), 0.0), 1.0)


def time_of_impact_exact_3(separation, normal_velocity, normal_acceleration):
    """Way over speed."""
    if normal_velocity >= 0:
        return math.inf
    return max(separation, 0) / abs(normal_velocity)


def time_of_impact_exact_4(separation, normal_velocity, normal_acceleration):
    """Height and gravity alone."""
    if normal_acceleration >= 0:
        return math.inf
    return math.sqrt(2 * max(separation, 0) / abs(normal_acceleration))


def count_impacts_4(position, velocity, length, dt, duration):
    """Meets the wall, and lets the clock run on."""
    count = 0
    for _ in range(round(duration / dt)):
        if velocity == 0:
            break
        wall = length if velocity > 0 else 0
        time = (wall - position) / velocity
        position = position + velocity * min(time, dt)
        if time <= dt:
            velocity = -velocity
            count += 1
    return count, position


def count_impacts_5(position, velocity, length, dt, duration):
    """A flag for each step."""
    total = 0
    for _ in range(round(duration / dt)):
        hit, left = False, dt
        while velocity != 0 and left >= (time := (velocity > 0) * length / velocity - position / velocity):
            position, velocity, left, hit = (velocity > 0) * length, -velocity, left - time, True
        position += velocity * left
        total += hit
    return total, position


def missing_probability_3(speed, thickness, radius, dt):
    """The share that is caught."""
    way = speed * dt
    if way == 0:
        return 1.0
    return min(1.0, (thickness + 2 * radius) / way)


def overlap_interval_2(distance, normal_velocity, radius, thickness, dt):
    """The test at the two ends of the step."""
    hits = [t for t in (0.0, dt) if -(thickness + radius) <= distance + normal_velocity * t <= radius]
    return (hits[0], hits[-1]) if hits else (np.inf, -np.inf)


def off_a_moving_plane(response):
    """The same as somebody sees it who sits on the plane."""

    def seen(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
        plane_velocity = np.asarray(plane_velocity)
        return np.asarray(response(velocity - plane_velocity, normal, restitution)) + plane_velocity

    return seen


@off_a_moving_plane
def kinematic_response_6(velocity, normal, restitution):
    """2 e in place of 1 + e."""
    d = float(np.dot(velocity, normal))
    if d >= 0:
        return velocity
    return np.array([velocity[i] - 2 * restitution * d * normal[i] for i in range(3)])


@off_a_moving_plane
def kinematic_response_7(velocity, normal, restitution):
    """The tangential part gets lost."""
    d = np.dot(velocity, normal)
    if d < 0:
        return -restitution * d * normal
    return velocity


@off_a_moving_plane
def kinematic_response_8(velocity, normal, restitution):
    """The restitution as a loss in per cent, taken off the mirrored normal part."""
    d = np.dot(velocity, normal)
    if d < 0:
        return velocity - 2 * d * normal + restitution * d * normal
    return velocity


def kinematic_response_13(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    """Asks whether the ball itself moves in."""
    if np.dot(velocity, normal) >= 0:
        return velocity
    rel = np.dot(velocity - plane_velocity, normal)
    return velocity - (1 + restitution) * rel * normal


def respond_at_impact_2(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """A whole step after the bounce."""
    if time_of_impact > dt:
        return position + velocity * dt + acceleration * dt**2 / 2, velocity + acceleration * dt
    t = time_of_impact
    position = position + velocity * t + acceleration * t**2 / 2
    velocity = velocity + acceleration * t
    vn = np.dot(velocity, normal)
    if vn < 0:
        velocity = velocity - (1 + restitution) * vn * normal
    return position + velocity * dt + acceleration * dt**2 / 2, velocity + acceleration * dt


def penalty_force_3(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """The force of the energy: half of it."""
    if separation >= 0:
        return 0 * normal
    f = 0.5 * stiffness * -separation - damping * normal_velocity
    return (f if adhesive else max(0, f)) * normal


def penalty_step_limit_2(mass, stiffness, damping=0.0):
    """With the damped frequency."""
    w = math.sqrt(stiffness / mass)
    z = damping / (2 * math.sqrt(stiffness * mass))
    return 2 / (w * math.sqrt(abs(1 - z * z))) if z != 1 else math.inf


def friction_force_4(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """One coefficient for the hold and for the slide."""
    speed = np.linalg.norm(tangent_velocity)
    limit = kinetic_friction * normal_force
    if speed > 0:
        return -limit * tangent_velocity / speed
    size = np.linalg.norm(push)
    return -push if size <= limit else -limit * push / size


def friction_force_5(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """Once it breaks away the push wins: no friction."""
    speed = np.linalg.norm(tangent_velocity)
    if speed > 0:
        return -kinetic_friction * normal_force / speed * tangent_velocity
    if np.linalg.norm(push) > static_friction * normal_force:
        return np.zeros(3)
    return -push


def propagate_impacts_2(velocity, mass, restitution, most=10000):
    """Equal balls swap."""
    v = list(velocity)
    changed = True
    while changed:
        changed = False
        for i in range(len(v) - 1):
            if v[i] > v[i + 1]:
                v[i], v[i + 1] = v[i + 1], v[i]
                changed = True
    return np.array(v)


def normal_velocity_3(body_a, body_b, normal):
    """Component by component."""
    (va, wa, ra, *_), (vb, wb, rb, *_) = body_a, body_b
    return np.dot(va + wa * ra - vb - wb * rb, normal)


def normal_velocity_4(body_a, body_b, normal):
    """The second less the first."""
    points = [v + np.cross(w, r) for v, w, r, *_ in (body_a, body_b)]
    return sum((b - a) * n for a, b, n in zip(*points, normal, strict=True))


def edge_edge_normal_2(edge_a, edge_b, centre_a, centre_b):
    """Not of unit length."""
    n = np.cross(edge_a, edge_b)
    return n if np.dot(n, centre_a - centre_b) >= 0 else -n


def world_inverse_inertia_2(inertia, orientation):
    """The quaternion as x, y, z, w."""
    x, y, z, w = orientation
    r = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    inv = np.array([1 / i if i > 0 else 0 for i in inertia])
    return r @ np.diag(inv) @ r.T


def world_inverse_inertia_3(inertia, orientation):
    """Rᵀ on the wrong side."""
    w, x, y, z = orientation
    r = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    inv = np.array([1 / i if i > 0 else 0 for i in inertia])
    return r.T @ np.diag(inv) @ r


def inverse_effective_mass_2(body_a, body_b, normal):
    """The lever squared, without the inertia."""
    total = body_a[3] + body_b[3]
    for body in (body_a, body_b):
        rn = np.cross(body[2], normal)
        total += rn @ rn
    return total


def inverse_effective_mass_3(body_a, body_b, normal):
    """I⁻¹(r × n)·n, without the last × r."""
    total = body_a[3] + body_b[3]
    for body in (body_a, body_b):
        total += np.dot(body[4] @ np.cross(body[2], normal), normal)
    return total


def impulse_magnitude_4(body_a, body_b, normal, restitution):
    """B's terms taken away."""
    rel = body_a[0] + np.cross(body_a[1], body_a[2]) - body_b[0] - np.cross(body_b[1], body_b[2])
    k = 0
    for sign, (_, _, r, im, ii) in ((1, body_a), (-1, body_b)):
        k += im + sign * np.dot(np.cross(ii @ np.cross(r, normal), r), normal)
    return -(1 + restitution) * np.dot(rel, normal) / k if k > 0 else 0.0


def impulse_magnitude_5(body_a, body_b, normal, restitution):
    """The velocities of the centres."""
    k = 0
    for _, _, r, im, ii in (body_a, body_b):
        k += im + np.dot(np.cross(ii @ np.cross(r, normal), r), normal)
    return -(1 + restitution) * np.dot(body_a[0] - body_b[0], normal) / k if k > 0 else 0.0


def apply_impulse_4(body_a, body_b, impulse):
    """The same for both."""
    out = []
    for v, w, r, im, ii in (body_a, body_b):
        out.append(v + impulse * im)
        out.append(w + ii @ np.cross(r, impulse))
    return out


def collide_5(body_a, body_b, normal, restitution, threshold=0.0):
    """The impulse of point masses, and the spins changed by it."""
    (va, wa, ra, ima, iia), (vb, wb, rb, imb, iib) = body_a, body_b
    vn = np.dot(va + np.cross(wa, ra) - vb - np.cross(wb, rb), normal)
    if vn >= -threshold or ima + imb == 0:
        return va, wa, vb, wb
    j = -(1 + restitution) * vn / (ima + imb) * normal
    return va + ima * j, wa + iia @ np.cross(ra, j), vb - imb * j, wb - iib @ np.cross(rb, j)


def collide_6(body_a, body_b, normal, restitution, threshold=0.0):
    """Only the velocities of the centres, and no spin."""
    (va, wa, _, ima, _), (vb, wb, _, imb, _) = body_a, body_b
    vn = np.dot(va - vb, normal)
    if vn >= -threshold or ima + imb == 0:
        return va, wa, vb, wb
    j = -(1 + restitution) * vn / (ima + imb) * normal
    return va + ima * j, wa, vb - imb * j, wb
