"""Right answers for one case alone, with `if` and the functions of the module math."""

import math


def signed_distance(point, normal, offset):
    (x, y, z), (a, b, c) = point, normal
    return (a * x + b * y + c * z + offset) / math.hypot(a, b, c)


def side_of_plane(separation, tolerance=0.0):
    if separation > tolerance:
        return 1
    if separation < -tolerance:
        return -1
    return 0


def time_of_impact_interpolated(separation_0, separation_1, t, dt):
    if separation_0 >= 0 and separation_1 < 0:
        return t + dt * separation_0 / (separation_0 - separation_1)
    return math.inf


def count_impacts(position, velocity, length, dt, duration):
    count = 0
    for _ in range(round(duration / dt)):
        time_left = dt
        while velocity != 0:
            wall = length if velocity > 0 else 0.0
            time = (wall - position) / velocity
            if time > time_left:
                position += velocity * time_left
                break
            position = wall
            velocity = -velocity
            time_left -= time
            count += 1
    return count, position


def time_of_impact_exact(separation, normal_velocity, normal_acceleration):
    s, u, a = max(separation, 0.0), normal_velocity, normal_acceleration
    if a == 0:
        return -s / u if u < 0 else math.inf
    under = u * u - 2 * a * s
    if under < 0:
        return math.inf
    root = math.sqrt(under)
    if u < 0:
        return 2 * s / (root - u)
    return (u + root) / -a if a < 0 else math.inf


def overlap_interval(distance, normal_velocity, radius, thickness, dt):
    front, back = radius, -(thickness + radius)
    if normal_velocity == 0:
        return (0.0, dt) if back <= distance <= front else (math.inf, -math.inf)
    one, other = sorted([(front - distance) / normal_velocity, (back - distance) / normal_velocity])
    start, end = max(one, 0.0), min(other, dt)
    return (start, end) if start <= end else (math.inf, -math.inf)


def missing_probability(speed, thickness, radius, dt):
    way, caught = speed * dt, thickness + 2 * radius
    if way == 0:
        return 0.0
    return max(0.0, 1 - caught / way)
