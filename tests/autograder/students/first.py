"""Wrong answers as people write them, by whom the bank was not made: written after it, in the manner of public code.

Each is a function with its mistake in its docstring. They measure how many mistakes are named, and that none is given
a wrong name; the bank is not made larger by them. For these the rules of naming still changed afterwards.
"""

import math

import numpy as np


def signed_distance_1(point, normal, offset):
    """The distance without its sign, as the formula stands in most textbooks."""
    return abs(normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2] + offset) / math.sqrt(
        normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2
    )


def signed_distance_2(point, normal, offset):
    """The plane as n·p = d."""
    n = normal / np.linalg.norm(normal)
    d = offset / np.linalg.norm(normal)
    return np.dot(point, n) - d


def signed_distance_3(point, normal, offset):
    """The plane's own constant forgotten."""
    return np.dot(point, normal) / np.sqrt(np.dot(normal, normal))


def signed_distance_4(point, normal, offset):
    """The point of the plane taken at offset times the normal, for a normal of any length."""
    unit_normal = normal / np.linalg.norm(normal)
    point_on_plane = -offset * unit_normal
    return np.dot(point - point_on_plane, unit_normal)


def time_of_impact_interpolated_1(separation_0, separation_1, t, dt):
    """The slide, typed in."""
    return t + dt * separation_0 / (separation_0 + separation_1)


def time_of_impact_interpolated_2(separation_0, separation_1, t, dt):
    """Linear interpolation whenever the two have different signs."""
    if separation_0 * separation_1 >= 0:
        return float("inf")
    alpha = separation_0 / (separation_0 - separation_1)
    return (1 - alpha) * t + alpha * (t + dt)


def time_of_impact_interpolated_3(separation_0, separation_1, t, dt):
    """The share taken from the wrong end."""
    if separation_0 < 0 or separation_1 >= 0:
        return np.inf
    d1, d2 = abs(separation_0), abs(separation_1)
    return t + dt * d2 / (d1 + d2)


def time_of_impact_exact_1(separation, normal_velocity, normal_acceleration):
    """The quadratic formula, smaller root, with the parabola upside down."""
    a, b, c = normal_acceleration / 2, normal_velocity, separation
    if a == 0:
        return -c / b if b < 0 else np.inf
    discriminant = b**2 - 4 * a * c
    if discriminant < 0:
        return np.inf
    return (-b + math.sqrt(discriminant)) / (2 * a)


def time_of_impact_exact_2(separation, normal_velocity, normal_acceleration):
    """The quadratic formula with the acceleration not halved."""
    a, b, c = normal_acceleration, normal_velocity, separation
    if a == 0:
        return -c / b if b < 0 else np.inf
    discriminant = b**2 - 4 * a * c
    if discriminant < 0:
        return np.inf
    return max((-b - math.sqrt(discriminant)) / (2 * a), 0.0)


def side_of_plane_1(separation, tolerance=0.0):
    """Three cases, the limits to the sides."""
    if separation >= tolerance:
        return 1
    if separation <= -tolerance:
        return -1
    return 0


def side_of_plane_2(separation, tolerance=0.0):
    """The sign, with the tolerance forgotten."""
    return int(np.sign(separation))


def side_of_plane_5(separation, tolerance=0.0):
    """Touching is colliding, whatever the tolerance."""
    if separation <= tolerance:
        return -1
    return 1


def count_impacts_1(position, velocity, length, dt, duration):
    """Moves a step, and puts back what is beyond a wall."""
    bounces = 0
    for _ in range(round(duration / dt)):
        position += velocity * dt
        if position <= 0 and velocity < 0:
            position, velocity, bounces = 0.0, -velocity, bounces + 1
        if position >= length and velocity > 0:
            position, velocity, bounces = length, -velocity, bounces + 1
    return bounces, position


def count_impacts_2(position, velocity, length, dt, duration):
    """The whole way over the length."""
    distance = abs(velocity) * duration
    folded = (position + velocity * duration) % (2 * length)
    if folded > length:
        folded = 2 * length - folded
    return math.floor(distance / length), folded


def count_impacts_3(position, velocity, length, dt, duration):
    """Mirrors at either wall, once a step."""
    count = 0
    for _ in range(round(duration / dt)):
        position = position + velocity * dt
        if position >= length and velocity > 0:
            position, velocity, count = 2 * length - position, -velocity, count + 1
        elif position <= 0 and velocity < 0:
            position, velocity, count = -position, -velocity, count + 1
    return count, position


def missing_probability_1(speed, thickness, radius, dt):
    """Without the radius on the far side."""
    if speed == 0 or dt == 0:
        return 0.0
    return max(0.0, 1 - (thickness + radius) / (speed * dt))


def missing_probability_2(speed, thickness, radius, dt):
    """Not limited from below."""
    if speed * dt == 0:
        return 0.0
    return 1 - (thickness + 2 * radius) / (speed * dt)


def overlap_interval_1(distance, normal_velocity, radius, thickness, dt):
    """A slab of no thickness."""
    if normal_velocity == 0:
        return (0.0, dt) if abs(distance) <= radius else (np.inf, -np.inf)
    t1, t2 = sorted([(radius - distance) / normal_velocity, (-radius - distance) / normal_velocity])
    start, end = max(t1, 0.0), min(t2, dt)
    return (start, end) if start <= end else (np.inf, -np.inf)


def off_a_moving_plane(response):
    """The same as somebody sees it who sits on the plane."""

    def seen(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
        plane_velocity = np.asarray(plane_velocity)
        return np.asarray(response(velocity - plane_velocity, normal, restitution)) + plane_velocity

    return seen


@off_a_moving_plane
def kinematic_response_1(velocity, normal, restitution):
    """The whole reflected velocity is scaled, as in many a game."""
    if np.dot(velocity, normal) >= 0:
        return velocity
    reflected = velocity - 2 * np.dot(velocity, normal) * normal
    return restitution * reflected


@off_a_moving_plane
def kinematic_response_2(velocity, normal, restitution):
    """Split into two components, and both turned round."""
    vn = np.dot(velocity, normal) * normal
    vt = velocity - vn
    return -vt - restitution * vn


@off_a_moving_plane
def kinematic_response_3(velocity, normal, restitution):
    """Split into two components, without asking whether it approaches."""
    vn = np.dot(velocity, normal) * normal
    vt = velocity - vn
    return vt - restitution * vn


@off_a_moving_plane
def kinematic_response_4(velocity, normal, restitution):
    """The y component, as on a screen."""
    v = velocity.copy()
    if v[1] < 0:
        v[1] = -restitution * v[1]
    return v


@off_a_moving_plane
def kinematic_response_5(velocity, normal, restitution):
    """Kept as a share of the energy."""
    vn = np.dot(velocity, normal)
    if vn > 0:
        return velocity
    return velocity - (1 + math.sqrt(restitution)) * vn * normal


def kinematic_response_11(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    """In the plane's frame, and not back again."""
    rel = velocity - plane_velocity
    vn = np.dot(rel, normal)
    if vn < 0:
        rel = rel - (1 + restitution) * vn * normal
    return rel


def kinematic_response_12(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    """Bounces, then gets the plane's normal velocity once."""
    v = velocity.copy()
    vn = np.dot(v - plane_velocity, normal)
    if vn < 0:
        v = v - (1 + restitution) * np.dot(v, normal) * normal + np.dot(plane_velocity, normal) * normal
    return v


def respond_at_step_1(position, velocity, acceleration, normal, behind, restitution, dt):
    """It turns round in the middle of the step."""
    velocity = velocity + acceleration * dt
    position = position + velocity * dt / 2
    if behind and np.dot(velocity, normal) < 0:
        velocity = velocity - (1 + restitution) * np.dot(velocity, normal) * normal
    return position + velocity * dt / 2, velocity


def respond_at_step_2(position, velocity, acceleration, normal, behind, restitution, dt):
    """Explicit Euler."""
    if behind and np.dot(velocity, normal) < 0:
        velocity = velocity - (1 + restitution) * np.dot(velocity, normal) * normal
        acceleration = acceleration - min(np.dot(acceleration, normal), 0) * normal
    return position + velocity * dt, velocity + acceleration * dt


def respond_at_impact_1(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """The rest of the step is lost."""
    t = min(time_of_impact, dt)
    position = position + velocity * t + 0.5 * acceleration * t**2
    velocity = velocity + acceleration * t
    vn = np.dot(velocity, normal)
    if time_of_impact <= dt and vn < 0:
        velocity = velocity - (1 + restitution) * vn * normal
    return position, velocity


def penalty_force_1(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """The damping with the sign of the spring, in a contact that may pull."""
    if separation >= 0:
        return np.zeros(3)
    return (-stiffness * separation - damping * normal_velocity) * normal


def penalty_force_2(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """The damping pushes along the motion."""
    if separation >= 0:
        return np.zeros(3)
    f = stiffness * abs(separation) + damping * normal_velocity
    if not adhesive:
        f = max(f, 0.0)
    return f * normal


def penalty_step_limit_1(mass, stiffness, damping=0.0):
    """The undamped one."""
    return 2 * np.sqrt(mass / stiffness)


def friction_force_1(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """By the sign of each component."""
    if np.linalg.norm(tangent_velocity) > 0:
        return -np.sign(tangent_velocity) * kinetic_friction * normal_force
    if np.linalg.norm(push) <= static_friction * normal_force:
        return -push
    return -kinetic_friction * normal_force * push / np.linalg.norm(push)


def friction_force_2(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """At rest always the largest static friction."""
    if np.linalg.norm(tangent_velocity) > 0:
        return -kinetic_friction * normal_force * tangent_velocity / np.linalg.norm(tangent_velocity)
    if np.linalg.norm(push) == 0:
        return np.zeros(3)
    return -static_friction * normal_force * push / np.linalg.norm(push)


def friction_force_3(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """At rest nothing, as in a game."""
    speed = np.linalg.norm(tangent_velocity)
    if speed < 1e-3:
        return np.zeros(3)
    return -kinetic_friction * normal_force * tangent_velocity / speed


def clamp_to_circle_1(tangent_force, limit):
    """np.clip, component by component."""
    return np.clip(tangent_force, -limit, limit)


def clamp_to_circle_2(tangent_force, limit):
    """Scaled always."""
    size = np.linalg.norm(tangent_force)
    if size == 0:
        return tangent_force
    return tangent_force / size * limit


def propagate_impacts_1(velocity, mass, restitution, most=10000):
    """One pass from left to right."""
    v = velocity.copy()
    m = np.broadcast_to(mass, v.shape)
    e = np.broadcast_to(restitution, max(len(v) - 1, 0))
    for i in range(len(v) - 1):
        if v[i] > v[i + 1]:
            j = (1 + e[i]) * (v[i] - v[i + 1]) / (1 / m[i] + 1 / m[i + 1])
            v[i] -= j / m[i]
            v[i + 1] += j / m[i + 1]
    return v


def solve_by_sweeps_1(matrix, offset, sweeps, start=0.0):
    """Clamps what is added, not the sum."""
    f = np.zeros(len(offset)) + start
    for _ in range(sweeps):
        for i in range(len(f)):
            if matrix[i, i] > 0:
                delta = -(matrix[i] @ f + offset[i]) / matrix[i, i]
                f[i] += max(delta, 0)
            else:
                f[i] = 0
    return f


def solve_by_sweeps_2(matrix, offset, sweeps, start=0.0):
    """All of a sweep from the old forces."""
    f = np.zeros(len(offset)) + start
    d = np.diag(matrix)
    for _ in range(sweeps):
        f = np.maximum(0, f - (matrix @ f + offset) / np.where(d > 0, d, np.inf))
        f = np.where(d > 0, f, 0)
    return f


def normal_velocity_1(body_a, body_b, normal):
    """The arm first."""
    va = body_a[0] + np.cross(body_a[2], body_a[1])
    vb = body_b[0] + np.cross(body_b[2], body_b[1])
    return np.dot(va - vb, normal)


def normal_velocity_2(body_a, body_b, normal):
    """B seen from A."""
    va = body_a[0] + np.cross(body_a[1], body_a[2])
    rv = body_b[0] + np.cross(body_b[1], body_b[2]) - va
    return rv[0] * normal[0] + rv[1] * normal[1] + rv[2] * normal[2]


def edge_edge_normal_1(edge_a, edge_b, centre_a, centre_b):
    """From A to B."""
    n = np.cross(edge_a, edge_b)
    n = n / np.linalg.norm(n)
    if np.dot(n, centre_b - centre_a) < 0:
        n = -n
    return n


def world_inverse_inertia_1(inertia, orientation):
    """Scale times rotation, as in a forum's question."""
    w, x, y, z = orientation
    r = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return np.diag(1 / inertia) @ r


def inverse_effective_mass_1(body_a, body_b, normal):
    """(r × n)² without the inertia's direction: its trace."""
    total = 0
    for _, _, r, im, ii in (body_a, body_b):
        rn = np.cross(r, normal)
        total += im + np.dot(rn, rn) * np.trace(ii) / 3
    return total


def impulse_magnitude_1(body_a, body_b, normal, restitution):
    """(1 − e), as in someone's notes."""
    va = body_a[0] + np.cross(body_a[1], body_a[2])
    vb = body_b[0] + np.cross(body_b[1], body_b[2])
    k = 0
    for _, _, r, im, ii in (body_a, body_b):
        k += im + np.dot(np.cross(ii @ np.cross(r, normal), r), normal)
    return (1 - restitution) * np.dot(va - vb, normal) / k if k > 0 else 0.0


def impulse_magnitude_2(body_a, body_b, normal, restitution):
    """Over the sum of the masses, without the turning."""
    rel = body_a[0] - body_b[0]
    ma = 1 / body_a[3] if body_a[3] > 0 else 0
    mb = 1 / body_b[3] if body_b[3] > 0 else 0
    if ma + mb == 0:
        return 0.0
    return -(1 + restitution) * np.dot(rel, normal) / (ma + mb)


def impulse_magnitude_3(body_a, body_b, normal, restitution):
    """As if no body could turn, with the velocities of the points."""
    va = body_a[0] + np.cross(body_a[1], body_a[2])
    vb = body_b[0] + np.cross(body_b[1], body_b[2])
    k = body_a[3] + body_b[3]
    return -(1 + restitution) * np.dot(va - vb, normal) / k if k > 0 else 0.0


def apply_impulse_1(body_a, body_b, impulse):
    """The spin without the inertia, as in a well-known tutorial."""
    va, wa, ra, ima, _ = body_a
    vb, wb, rb, imb, _ = body_b
    return (
        va + impulse * ima,
        wa + np.cross(ra, impulse),
        vb - impulse * imb,
        wb - np.cross(rb, impulse),
    )


def apply_impulse_2(body_a, body_b, impulse):
    """A minus lost in the last line."""
    va, wa, ra, ima, iia = body_a
    vb, wb, rb, imb, iib = body_b
    va = va + ima * impulse
    vb = vb - imb * impulse
    wa = wa + iia @ np.cross(ra, impulse)
    wb = wb + iib @ np.cross(rb, impulse)
    return va, wa, vb, wb


def apply_impulse_3(body_a, body_b, impulse):
    """The spin over the mass."""
    out = []
    for sign, (v, w, r, im, _) in ((1, body_a), (-1, body_b)):
        out += [v + sign * im * impulse, w + sign * im * np.cross(r, impulse)]
    return tuple(out)


def collide_1(body_a, body_b, normal, restitution, threshold=0.0):
    """Two impulses, one from each body's own velocity, as in a forum's question."""
    out = []
    for sign, (v, w, r, im, ii) in ((1, body_a), (-1, body_b)):
        vp = v + np.cross(w, r)
        k = im + np.dot(np.cross(ii @ np.cross(r, normal), r), normal)
        j = -(1 + restitution) * np.dot(vp, normal) / (k if k != 0 else 1)
        out += [v + sign * j * im * normal, w + sign * j * ii @ np.cross(r, normal)]
    return tuple(out)


def collide_2(body_a, body_b, normal, restitution, threshold=0.0):
    """Answers where they part, as in a forum's question."""
    (va, wa, ra, ima, iia), (vb, wb, rb, imb, iib) = body_a, body_b
    vn = np.dot(va + np.cross(wa, ra) - vb - np.cross(wb, rb), normal)
    if vn <= threshold:
        return va, wa, vb, wb
    k = ima + imb
    k += np.dot(np.cross(iia @ np.cross(ra, normal), ra), normal)
    k += np.dot(np.cross(iib @ np.cross(rb, normal), rb), normal)
    j = -(1 + restitution) * vn / k
    return (
        va + j * ima * normal,
        wa + j * iia @ np.cross(ra, normal),
        vb - j * imb * normal,
        wb - j * iib @ np.cross(rb, normal),
    )


def collide_3(body_a, body_b, normal, restitution, threshold=0.0):
    """Both velocities turned round."""
    (va, wa, ra, _, _), (vb, wb, rb, _, _) = body_a, body_b
    vn = np.dot(va + np.cross(wa, ra) - vb - np.cross(wb, rb), normal)
    if vn < -threshold:
        return -va, -wa, -vb, -wb
    return va, wa, vb, wb


def collide_4(body_a, body_b, normal, restitution, threshold=0.0):
    """Without restitution, as in a forum's question."""
    (va, wa, ra, ima, iia), (vb, wb, rb, imb, iib) = body_a, body_b
    vn = np.dot(va + np.cross(wa, ra) - vb - np.cross(wb, rb), normal)
    k = ima + imb
    k += np.dot(np.cross(iia @ np.cross(ra, normal), ra), normal)
    k += np.dot(np.cross(iib @ np.cross(rb, normal), rb), normal)
    if vn >= -threshold or k == 0:
        return va, wa, vb, wb
    j = -vn / k
    return (
        va + j * ima * normal,
        wa + j * iia @ np.cross(ra, normal),
        vb - j * imb * normal,
        wb - j * iib @ np.cross(rb, normal),
    )


def resting_problem_1(jacobian, inverse_mass, force):
    """The forces not made accelerations."""
    return jacobian @ inverse_mass @ jacobian.T, jacobian @ force


def sliding_motion_1(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """A step of semi-implicit Euler, stopped where the velocity would turn round."""
    speed = np.linalg.norm(tangent_velocity)
    if speed == 0:
        if np.linalg.norm(push) <= static_friction * normal_force:
            return position, tangent_velocity, np.inf
        friction = -kinetic_friction * normal_force * push / np.linalg.norm(push)
    else:
        friction = -kinetic_friction * normal_force * tangent_velocity / speed
    a = (push + friction) / mass
    v = tangent_velocity + a * dt
    if speed > 0 and np.dot(v, tangent_velocity) <= 0:
        return position, np.zeros(3), speed / np.linalg.norm(a)
    return position + v * dt, v, np.inf


def break_away_time_1(force, force_rate, normal, static_friction):
    """The push's size over time, with the normal force as it is at the start."""
    n0 = -np.dot(force, normal)
    t0 = np.linalg.norm(force - np.dot(force, normal) * normal)
    rate = np.linalg.norm(force_rate - np.dot(force_rate, normal) * normal)
    if n0 < 0 or t0 > static_friction * n0:
        return 0.0
    return (static_friction * n0 - t0) / rate if rate > 0 else np.inf
