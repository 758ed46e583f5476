"""Right answers, one contact after another, number by number."""

import math

import numpy as np


def vector(signature):
    """One contact's function for many."""
    return lambda function: np.vectorize(function, signature=signature)


def dot(a, b):
    total = 0.0
    for x, y in zip(a, b, strict=True):
        total += x * y
    return total


def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def times(matrix, v):
    return np.array([dot(row, v) for row in matrix])


@vector("(n),(n),()->()")
def signed_distance(point, normal, offset):
    return (dot(point, normal) + offset) / math.sqrt(dot(normal, normal))


@np.vectorize
def side_of_plane(separation, tolerance=0.0):
    if abs(separation) <= tolerance:
        return 0
    return 1 if separation > 0 else -1


@vector("(),(),(),()->()")
def time_of_impact_interpolated(separation_0, separation_1, t, dt):
    if separation_0 < 0 or separation_1 >= 0:
        return math.inf
    before, behind = abs(separation_0), abs(separation_1)
    return t + dt * before / (before + behind)


@vector("(),(),(),(),()->(),()")
def count_impacts(position, velocity, length, dt, duration):
    left, count = round(duration / dt) * dt, 0  # one step is as good as many
    while velocity:
        ahead = length - position if velocity > 0 else position
        if ahead > abs(velocity) * left:
            break
        left = left - ahead / abs(velocity)
        position, velocity, count = length if velocity > 0 else 0.0, -velocity, count + 1
    return count, position + velocity * left


@vector("(),(),()->()")
def time_of_impact_exact(separation, normal_velocity, normal_acceleration):
    s, u, a = max(separation, 0.0), normal_velocity, normal_acceleration
    if a == 0:
        return s / -u if u < 0 else math.inf
    inside = u * u - 2 * a * s
    if inside < 0:
        return math.inf
    if u < 0:
        return 2 * s / (math.sqrt(inside) - u)
    return (-u - math.sqrt(inside)) / a if a < 0 else math.inf


def kinematic_response(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    return _off_a_plane(velocity, normal, restitution, plane_velocity)


@vector("(n),(n),(),(n)->(n)")
def _off_a_plane(velocity, normal, restitution, plane_velocity):
    speed = dot(velocity, normal) - dot(plane_velocity, normal)
    if speed >= 0:
        return velocity
    return np.array([v - (1 + restitution) * speed * n for v, n in zip(velocity, normal, strict=True)])


@vector("(n),(n),(),(),()->(n)")
def friction_force(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    speed, size = math.hypot(*tangent_velocity), math.hypot(*push)
    if speed > 0:
        return np.array([-kinetic_friction * normal_force * v / speed for v in tangent_velocity])
    if size <= static_friction * normal_force:
        return -push
    return np.array([-kinetic_friction * normal_force * f / size for f in push])


@vector("(n),()->(n)")
def clamp_to_circle(tangent_force, limit):
    size = math.hypot(*tangent_force)
    return tangent_force * (limit / size) if size > limit else tangent_force * 1.0


@vector("(n),(n),(n),(n)->(n)")
def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    across = cross(edge_a, edge_b)
    across = across / math.hypot(*across)
    return across if dot(across, centre_a) >= dot(across, centre_b) else -across


def _each(function, bodies, *more):
    signature = ",".join(["(n),(n),(n),(),(n,n)"] * len(bodies) + ["(n)", "()", "()"][: len(more)])
    flat = [part for body in bodies for part in body]
    return np.vectorize(function, signature=f"{signature}->(),(n),(n),(n),(n)")(*flat, *more)


def _impact(v_a, w_a, r_a, s_a, k_a, v_b, w_b, r_b, s_b, k_b, n, e=0.0, threshold=0.0):
    """Magnitude of the impulse and the four velocities after it."""
    a, b = cross(r_a, n), cross(r_b, n)
    below = s_a + s_b + dot(a, times(k_a, a)) + dot(b, times(k_b, b))  # n·((I⁻¹a) × r) = a·I⁻¹a
    u = dot(n, v_a + cross(w_a, r_a) - v_b - cross(w_b, r_b))
    j = -(1 + e) * u / below if below > 0 else 0.0
    used = j if u < -threshold else 0.0
    after = v_a + used * s_a * n, w_a + used * times(k_a, a), v_b - used * s_b * n, w_b - used * times(k_b, b)
    return (j, *after)


def impulse_magnitude(body_a, body_b, normal, restitution):
    return _each(_impact, (body_a, body_b), normal, restitution)[0]


def collide(body_a, body_b, normal, restitution, threshold=0.0):
    return _each(_impact, (body_a, body_b), normal, restitution, threshold)[1:]


def normal_velocity(body_a, body_b, normal):
    flat, signature = [*body_a[:3], *body_b[:3], normal], ",".join(["(n)"] * 7)
    one = lambda v_a, w_a, r_a, v_b, w_b, r_b, n: dot(v_a + cross(w_a, r_a), n) - dot(v_b + cross(w_b, r_b), n)  # noqa: E731
    return np.vectorize(one, signature=f"{signature}->()")(*flat)
