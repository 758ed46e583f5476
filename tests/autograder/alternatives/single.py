"""Right answers for one contact alone, in plain Python, and as lists."""

from math import sqrt


def signed_distance(point, normal, offset):
    (x, y, z), (a, b, c) = point, normal
    return float((a * x + b * y + c * z + offset) / sqrt(a * a + b * b + c * c))


def side_of_plane(separation, tolerance=0.0):
    return int(separation > tolerance) - int(separation + tolerance < 0)


def count_impacts(position, velocity, length, dt, duration):
    count, right = 0, velocity > 0
    for _ in range(round(duration / dt)):
        position += abs(velocity) * dt if right else -abs(velocity) * dt
        while position >= length if right else velocity and position <= 0:
            position = 2 * length - position if right else -position
            right, count = not right, count + 1
    return [count, position]


def kinematic_response(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    seen = [float(v) - float(w) for v, w in zip(velocity, plane_velocity, strict=True)]
    speed = sum(u * float(n) for u, n in zip(seen, normal, strict=True))
    if speed > 0:
        return [float(v) for v in velocity]
    tangent = [u - speed * n for u, n in zip(seen, normal, strict=True)]
    turned = [t - restitution * speed * n for t, n in zip(tangent, normal, strict=True)]
    return [float(u + w) for u, w in zip(turned, plane_velocity, strict=True)]


def penalty_step_limit(mass, stiffness, damping=0.0):
    return 4 * mass / (sqrt(damping * damping + 4 * mass * stiffness) + damping)


def support_force(mass, gravity, push, frame_acceleration, normal):
    every = [mass * g + f - mass * a for g, f, a in zip(gravity, push, frame_acceleration, strict=True)]
    out = sum(f * n for f, n in zip(every, normal, strict=True))
    return float(max(-out, 0)), [float(f - out * n) for f, n in zip(every, normal, strict=True)]


def clamp_to_circle(tangent_force, limit):
    size = sqrt(sum(float(f) ** 2 for f in tangent_force))
    return [float(f) if size <= limit else float(f) / size * limit for f in tangent_force]


def normal_velocity(body_a, body_b, normal):
    total = 0.0
    for sign, (v, w, r, *_) in ((1, body_a), (-1, body_b)):
        turning = (w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0])
        total += sign * sum(float((a + b) * n) for a, b, n in zip(v, turning, normal, strict=True))
    return total


def apply_impulse(body_a, body_b, impulse):
    after = []
    for sign, (v, w, r, share, turning) in ((1, body_a), (-1, body_b)):
        (x, y, z), (a, b, c) = r, impulse
        moment = (y * c - z * b, z * a - x * c, x * b - y * a)
        after.append([float(old + sign * share * j) for old, j in zip(v, impulse, strict=True)])
        changes = [sum(float(k * m) for k, m in zip(row, moment, strict=True)) for row in turning]
        after.append([float(old) + sign * change for old, change in zip(w, changes, strict=True)])
    return after


def propagate_impacts(velocity, mass, restitution, most=10_000):
    v = [float(each) for each in velocity]
    count = len(v)
    m = [float(mass)] * count if getattr(mass, "ndim", 0) == 0 else [float(each) for each in mass]
    e = [float(restitution)] * count if getattr(restitution, "ndim", 0) == 0 else [float(each) for each in restitution]
    for _ in range(most):
        struck = False
        for i in range(count - 1):
            closing = v[i] - v[i + 1]
            if closing > 1e-13:
                struck = True
                share = 1 / (1 + m[i] / m[i + 1])  # of the change, what the left one takes
                v[i], v[i + 1] = v[i] - (1 + e[i]) * closing * share, v[i + 1] + (1 + e[i]) * closing * (1 - share)
        if not struck:
            break
    return v
