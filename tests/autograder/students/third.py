"""A third lot of wrong answers: loose readings of the slides, and things that are commonly left out.

Each is written for one contact, with plain numbers and loops, as by somebody who has just read the slide. The first 25
were written before the bank had entries for such readings, and 6 of them were named. The other 20 were written when it
had the entries for the first 25: 15 of them were named, 3 of them also before, and the bank got entries for the rest.
"""

import math

import numpy as np


def cross(a, b):
    """As the lab of another course hands it out."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def inner(a, b):
    """The sum of three products."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def turned(matrix, x):
    """Matrix times vector, row by row."""
    return [inner(row, x) for row in matrix]


def velocity_at(body, arm):
    """Velocity of the end of an arm."""
    w = cross(body[1], arm)
    return [body[0][i] + w[i] for i in range(3)]


def friction_force_6(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """F_s = μ_s N on everything that does not move yet; what gives way slides with μ_k."""
    speed = math.sqrt(inner(tangent_velocity, tangent_velocity))
    pushing = math.sqrt(inner(push, push))
    if speed > 0:
        return [-kinetic_friction * normal_force * c / speed for c in tangent_velocity]
    if pushing == 0:
        return [0.0, 0.0, 0.0]
    mu = static_friction if pushing <= static_friction * normal_force else kinetic_friction
    return [-mu * normal_force * c / pushing for c in push]


def sliding_motion_2(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """At rest the friction is μ_s N, so that a box that nobody moves starts backwards."""
    speed, pushing = math.sqrt(inner(tangent_velocity, tangent_velocity)), math.sqrt(inner(push, push))
    x, v, left, stopped = list(position), list(tangent_velocity), dt, math.inf

    def friction(moving):
        if moving:
            return [-kinetic_friction * normal_force * c / speed for c in tangent_velocity]
        return [-static_friction * normal_force * c / pushing for c in push] if pushing else [0, 0, 0]

    acc = [(push[i] + friction(speed > 0)[i]) / mass for i in range(3)]
    braking = -inner(v, acc)
    if speed > 0 and speed**2 <= braking * dt:
        stopped = speed**2 / braking
        x = [x[i] + v[i] * stopped / 2 for i in range(3)]
        v, left = [0, 0, 0], dt - stopped
        acc = [(push[i] + friction(False)[i]) / mass for i in range(3)]
    x = [x[i] + v[i] * left + acc[i] * left**2 / 2 for i in range(3)]
    return x, [v[i] + acc[i] * left for i in range(3)], stopped


def inverse_effective_mass_4(body_a, body_b, normal):
    """There is one point of contact, so there is one r."""
    r = body_a[2]
    total = body_a[3] + body_b[3]
    for body in (body_a, body_b):
        total += inner(normal, cross(turned(body[4], cross(r, normal)), r))
    return total


def impulse_magnitude_6(body_a, body_b, normal, restitution):
    """One r for both bodies, in the velocities and below the line."""
    r = body_a[2]
    p_a, p_b = velocity_at(body_a, r), velocity_at(body_b, r)
    v_rel = inner(normal, [p_a[i] - p_b[i] for i in range(3)])
    below = body_a[3] + body_b[3]
    below += inner(normal, cross(turned(body_a[4], cross(r, normal)), r))
    below += inner(normal, cross(turned(body_b[4], cross(r, normal)), r))
    return -(1 + restitution) * v_rel / below if below else 0.0


def impulse_magnitude_7(body_a, body_b, normal, restitution):
    """B's term with the inertia is forgotten."""
    p_a, p_b = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    v_rel = inner(normal, p_a) - inner(normal, p_b)
    spin = inner(cross(turned(body_a[4], cross(body_a[2], normal)), body_a[2]), normal)
    below = body_a[3] + body_b[3] + spin
    return -(1 + restitution) * v_rel / below if below else 0.0


def apply_impulse_5(body_a, body_b, impulse):
    """B's spin was never written down."""
    v_a, v_b, w_a = list(body_a[0]), list(body_b[0]), list(body_a[1])
    torque = turned(body_a[4], cross(body_a[2], impulse))
    for i in range(3):
        v_a[i] += body_a[3] * impulse[i]
        w_a[i] += torque[i]
        v_b[i] -= body_b[3] * impulse[i]
    return v_a, w_a, v_b, list(body_b[1])


def apply_impulse_6(body_a, body_b, impulse):
    """The cross product of A the wrong way round, that of B the right way."""
    torque_a, torque_b = cross(impulse, body_a[2]), cross(body_b[2], impulse)
    dw_a, dw_b = turned(body_a[4], torque_a), turned(body_b[4], torque_b)
    return (
        [body_a[0][i] + impulse[i] * body_a[3] for i in range(3)],
        [body_a[1][i] + dw_a[i] for i in range(3)],
        [body_b[0][i] - impulse[i] * body_b[3] for i in range(3)],
        [body_b[1][i] - dw_b[i] for i in range(3)],
    )


def apply_impulse_7(body_a, body_b, impulse):
    """R is B's for both, because the loop came after it."""
    result, sign = [], 1
    r = body_b[2]
    for v, w, _, share, inertia in (body_a, body_b):
        dw = turned(inertia, cross(r, impulse))
        result.append([v[i] + sign * share * impulse[i] for i in range(3)])
        result.append([w[i] + sign * dw[i] for i in range(3)])
        sign = -sign
    return tuple(result)


def struck(body_a, body_b, normal, j):
    """What the right impulse does to both: J on A, −J on B."""
    found = []
    for sign, (v, w, r, share, inertia) in ((1, body_a), (-1, body_b)):
        dw = turned(inertia, cross(r, normal))
        found.append([v[i] + sign * j * share * normal[i] for i in range(3)])
        found.append([w[i] + sign * j * dw[i] for i in range(3)])
    return found


def below_the_line(body_a, body_b, normal):
    """The right denominator."""
    total = 0.0
    for _, _, r, share, inertia in (body_a, body_b):
        total += share + inner(normal, cross(turned(inertia, cross(r, normal)), r))
    return total


def collide_7(body_a, body_b, normal, restitution, threshold=0.0):
    """Only A turns: B's inertia comes in nowhere, neither below the line nor afterwards."""
    p_a, p_b = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    closing = inner(normal, p_a) - inner(normal, p_b)
    spin = turned(body_a[4], cross(body_a[2], normal))
    below = body_a[3] + body_b[3] + inner(normal, cross(spin, body_a[2]))
    j = 0.0 if closing >= -threshold or below == 0 else -(1 + restitution) * closing / below
    return (
        [body_a[0][i] + j * body_a[3] * normal[i] for i in range(3)],
        [body_a[1][i] + j * spin[i] for i in range(3)],
        [body_b[0][i] - j * body_b[3] * normal[i] for i in range(3)],
        body_b[1],
    )


def collide_8(body_a, body_b, normal, restitution, threshold=0.0):
    """V_rel above the threshold is separating, and everything else collides."""
    p_a, p_b = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    v_rel = inner(normal, p_a) - inner(normal, p_b)
    below = below_the_line(body_a, body_b, normal)
    if v_rel > threshold or below == 0:
        return body_a[0], body_a[1], body_b[0], body_b[1]
    return struck(body_a, body_b, normal, -(1 + restitution) * v_rel / below)


def collide_9(body_a, body_b, normal, restitution, threshold=0.0):
    """The slide's update of B as it is printed for the spin: plus."""
    p_a, p_b = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    v_rel = inner(normal, p_a) - inner(normal, p_b)
    below = below_the_line(body_a, body_b, normal)
    if v_rel >= -threshold or below == 0:
        return body_a[0], body_a[1], body_b[0], body_b[1]
    v_a, w_a, v_b, w_b = struck(body_a, body_b, normal, -(1 + restitution) * v_rel / below)
    return v_a, w_a, v_b, [2 * body_b[1][i] - w_b[i] for i in range(3)]


def collide_10(body_a, body_b, normal, restitution, threshold=0.0):
    """The impulse is added to the velocities: no mass."""
    p_a, p_b = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    v_rel = inner(normal, p_a) - inner(normal, p_b)
    below = below_the_line(body_a, body_b, normal)
    if v_rel >= -threshold or below == 0:
        return body_a[0], body_a[1], body_b[0], body_b[1]
    j = -(1 + restitution) * v_rel / below
    _, w_a, _, w_b = struck(body_a, body_b, normal, j)
    return (
        [body_a[0][i] + j * normal[i] for i in range(3)], w_a,
        [body_b[0][i] - j * normal[i] for i in range(3)], w_b,
    )  # fmt: skip


def side_of_plane_3(separation, tolerance=0.0):
    """The tolerance's minus is forgotten behind the plane."""
    if separation > tolerance:
        return 1
    if separation < tolerance:
        return -1
    return 0


def time_of_impact_interpolated_5(separation_0, separation_1, t, dt):
    """The slide's formula with t where Δt stands."""
    if separation_0 < 0 or separation_1 >= 0:
        return math.inf
    return t + t * separation_0 / (separation_0 - separation_1)


def time_of_impact_interpolated_6(separation_0, separation_1, t, dt):
    """Half way through the step is near enough."""
    if separation_0 >= 0 > separation_1:
        return t + 0.5 * dt
    return math.inf


def off_a_moving_plane(response):
    """The same as somebody sees it who sits on the plane."""

    def seen(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
        plane_velocity = np.asarray(plane_velocity)
        return np.asarray(response(velocity - plane_velocity, normal, restitution)) + plane_velocity

    return seen


@off_a_moving_plane
def kinematic_response_9(velocity, normal, restitution):
    """The velocity is reversed, all of it, whichever way it goes."""
    return [-restitution * c for c in velocity]


@off_a_moving_plane
def kinematic_response_10(velocity, normal, restitution):
    """It bounces back with the speed that it had."""
    if inner(velocity, normal) >= 0:
        return velocity
    return [-c for c in velocity]


def kinematic_response_14(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    """The relative velocity is reversed and scaled, and stays relative."""
    u = [velocity[i] - plane_velocity[i] for i in range(3)]
    if inner(u, normal) >= 0:
        return velocity
    return [-restitution * c for c in u]


def respond_at_impact_3(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Without the test whether T lies in the step, half the step before and half of it after the bounce."""
    half = dt / 2 if time_of_impact <= dt else dt
    x = [position[i] + velocity[i] * half + acceleration[i] * half**2 / 2 for i in range(3)]
    v = [velocity[i] + acceleration[i] * half for i in range(3)]
    v_n = inner(v, normal)
    if time_of_impact <= dt and v_n < 0:
        v = [v[i] - (1 + restitution) * v_n * normal[i] for i in range(3)]
    left = dt - half
    x = [x[i] + v[i] * left + acceleration[i] * left**2 / 2 for i in range(3)]
    return x, [v[i] + acceleration[i] * left for i in range(3)]


def propagate_impacts_3(velocity, mass, restitution, most=10000):
    """The impulse is taken off the velocities: no mass."""
    v = list(velocity)
    m = [mass] * len(v) if np.ndim(mass) == 0 else list(mass)
    e = [restitution] * (len(v) - 1) if np.ndim(restitution) == 0 else list(restitution)
    for _ in range(min(most, 100)):
        calm = True
        for i in range(len(v) - 1):
            if v[i] > v[i + 1]:
                calm = False
                j = (1 + e[i]) * (v[i] - v[i + 1]) / (1 / m[i] + 1 / m[i + 1])
                v[i], v[i + 1] = v[i] - j, v[i + 1] + j
        if calm:
            break
    return v


def friction_force_7(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """One formula, F_s = μ_s N, whether or not it moves."""
    way = tangent_velocity if any(tangent_velocity) else push
    length = math.sqrt(inner(way, way)) or 1.0
    return [-static_friction * normal_force * c / length for c in way]


def inverse_effective_mass_5(body_a, body_b, normal):
    """The inertia of A alone."""
    lever = cross(body_a[2], normal)
    spin = turned(body_a[4], lever)
    return body_a[3] + body_b[3] + inner(spin, lever)


def impulse_magnitude_8(body_a, body_b, normal, restitution):
    """ω × r for A, r × ω for B."""
    first = velocity_at(body_a, body_a[2])
    back = cross(body_b[2], body_b[1])
    gap = [first[i] - body_b[0][i] - back[i] for i in range(3)]
    below = below_the_line(body_a, body_b, normal)
    return -(1 + restitution) * inner(gap, normal) / below if below else 0.0


def collide_11(body_a, body_b, normal, restitution, threshold=0.0):
    """The inverse inertia is forgotten throughout."""
    (va, wa, ra, ma, _), (vb, wb, rb, mb, _) = body_a, body_b
    pa, pb = velocity_at(body_a, ra), velocity_at(body_b, rb)
    vn = inner(pa, normal) - inner(pb, normal)
    ta, tb = cross(ra, normal), cross(rb, normal)
    below = ma + mb + inner(ta, ta) + inner(tb, tb)
    j = -(1 + restitution) * vn / below if vn < -threshold and below else 0
    return (
        [va[i] + j * ma * normal[i] for i in range(3)], [wa[i] + j * ta[i] for i in range(3)],
        [vb[i] - j * mb * normal[i] for i in range(3)], [wb[i] - j * tb[i] for i in range(3)],
    )  # fmt: skip


def collide_12(body_a, body_b, normal, restitution, threshold=0.0):
    """The points' whole relative velocity is thrown back, not only its part along the normal."""
    pa, pb = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    u = [pa[i] - pb[i] for i in range(3)]
    below = below_the_line(body_a, body_b, normal)
    if inner(u, normal) >= -threshold or not below:
        return body_a[0], body_a[1], body_b[0], body_b[1]
    return struck(body_a, body_b, [-(1 + restitution) * c / below for c in u], 1)


def collide_13(body_a, body_b, normal, restitution, threshold=0.0):
    """No test whether they approach: only the size of V is looked at."""
    pa, pb = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    vn = inner(pa, normal) - inner(pb, normal)
    below = below_the_line(body_a, body_b, normal)
    j = -(1 + restitution) * vn / below if abs(vn) > threshold and below else 0
    return struck(body_a, body_b, normal, j)


def collide_14(body_a, body_b, normal, restitution, threshold=0.0):
    """The contact point is one, and r is A's, but only for the update of the spins."""
    pa, pb = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    vn = inner(pa, normal) - inner(pb, normal)
    below = below_the_line(body_a, body_b, normal)
    j = -(1 + restitution) * vn / below if vn < -threshold and below else 0
    return struck(body_a, (body_b[0], body_b[1], body_a[2], body_b[3], body_b[4]), normal, j)


def collide_15(body_a, body_b, normal, restitution, threshold=0.0):
    """All bodies of one kilogram, though their inertia is right."""
    a = (*body_a[:3], 1.0, body_a[4])
    b = (*body_b[:3], 1.0, body_b[4])
    pa, pb = velocity_at(a, a[2]), velocity_at(b, b[2])
    vn = inner(pa, normal) - inner(pb, normal)
    j = -(1 + restitution) * vn / below_the_line(a, b, normal) if vn < -threshold else 0
    return struck(a, b, normal, j)


def collide_16(body_a, body_b, normal, restitution, threshold=0.0):
    """Both bodies simply go back with e."""
    pa, pb = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    if inner(pa, normal) - inner(pb, normal) >= -threshold:
        return body_a[0], body_a[1], body_b[0], body_b[1]
    return [-restitution * c for c in body_a[0]], body_a[1], [-restitution * c for c in body_b[0]], body_b[1]


def collide_17(body_a, body_b, normal, restitution, threshold=0.0):
    """I⁻¹ r first, and then × J, below the line as well as in the update."""
    pa, pb = velocity_at(body_a, body_a[2]), velocity_at(body_b, body_b[2])
    vn = inner(pa, normal) - inner(pb, normal)
    below, spins = 0.0, []
    for _, _, r, share, inertia in (body_a, body_b):
        spins.append(cross(turned(inertia, r), normal))
        below += share + inner(normal, cross(spins[-1], r))
    j = -(1 + restitution) * vn / below if vn < -threshold and below else 0
    return (
        [body_a[0][i] + j * body_a[3] * normal[i] for i in range(3)],
        [body_a[1][i] + j * spins[0][i] for i in range(3)],
        [body_b[0][i] - j * body_b[3] * normal[i] for i in range(3)],
        [body_b[1][i] - j * spins[1][i] for i in range(3)],
    )


def time_of_impact_interpolated_7(separation_0, separation_1, t, dt):
    """The middle between t and Δt."""
    if separation_0 >= 0 > separation_1:
        return (t + dt) / 2
    return math.inf


def time_of_impact_interpolated_8(separation_0, separation_1, t, dt):
    """The slide with t for Δt, with the slide's magnitudes and no test."""
    d1, d2 = abs(separation_0), abs(separation_1)
    return t + t * d1 / (d1 + d2)


def respond_at_step_3(position, velocity, acceleration, normal, behind, restitution, dt):
    """Behind the plane the velocity is reversed, whole."""
    v, a = list(velocity), list(acceleration)
    if behind:
        v = [-restitution * c for c in v]
        pressing = min(inner(acceleration, normal), 0)
        a = [a[i] - pressing * normal[i] for i in range(3)]
    v = [v[i] + a[i] * dt for i in range(3)]
    return [position[i] + v[i] * dt for i in range(3)], v


def respond_at_impact_4(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Moves by Δt, responds, and moves on by what is left after T."""
    x, v, left = list(position), list(velocity), dt
    if time_of_impact <= dt:
        for i in range(3):
            x[i] += v[i] * dt + acceleration[i] * dt**2 / 2
            v[i] += acceleration[i] * dt
        vn = inner(v, normal)
        if vn < 0:
            v = [v[i] - (1 + restitution) * vn * normal[i] for i in range(3)]
        left = dt - time_of_impact
    for i in range(3):
        x[i] += v[i] * left + acceleration[i] * left**2 / 2
        v[i] += acceleration[i] * left
    return x, v


def side_of_plane_4(separation, tolerance=0.0):
    """The minus in the wrong one of the two tests."""
    if separation < -tolerance:
        return -1
    if separation > -tolerance:
        return 1
    return 0


def resting_problem_2(jacobian, inverse_mass, force):
    """Loops, without the masses."""
    g = np.asarray(jacobian)
    a = [[float(sum(g[i][k] * g[j][k] for k in range(len(g[0])))) for j in range(len(g))] for i in range(len(g))]
    return a, [float(sum(g[i][k] * force[k] for k in range(len(force)))) for i in range(len(g))]
