"""Friction, sticking and sliding: drawn examples against closed forms, limiting cases, and many at once."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers, plainly
from labs.grading.judging.markers import asks

X, Y, UP, LEANS, REST = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
INFINITY = math.inf


def length(v):
    """‖v‖."""
    return math.sqrt(v @ v)


@asks("apparent_force", 3, "m (g − a) + F.")
def test_the_supports_acceleration_counts_against_gravity(submission, part, examples):
    def force(m, g, push, a):
        return push - m * (a - g)

    def loads(draw):
        return draw.number(0.3, 5), draw.vector(10), draw.vector(10), draw.vector(4)

    with part(1, "any load"):
        examples.agree(submission.apparent_force, force, loads)
    with part(1, "free fall, far from everything"):
        expect(submission.apparent_force, (2.0, [0, 0, -8], REST, [0, 0, -8]), REST)
        expect(submission.apparent_force, (2.0, REST, X, REST), X)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.apparent_force, force, loads)


def forces(draw):
    """A force and a normal."""
    return draw.vector(20), draw.unit()


@asks("normal_force", 3, "What presses, on planes that lean as well.")
def test_only_what_presses_is_answered(submission, part, examples):
    def press(force, normal):
        return max(0.0, -(force @ normal))

    with part(1, "any force"):
        examples.agree(submission.normal_force, press, forces, count=20)
    with part(1, "along the plane, lifted off, nothing"):
        for force, normal in (([5, 2, 0], UP), ([2, 2, 5], LEANS), (REST, UP), ([0, 0, -9], LEANS), ([-9, 0, -20], X)):
            expect(submission.normal_force, (force, normal), press(np.array(force, dtype=float), np.array(normal)))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.normal_force, press, forces)


@asks("along_surface", 3, "At right angles to the normal, and with the normal part the whole force.")
def test_the_two_parts_make_up_the_force(submission, part, examples):
    def along(force, normal):
        return np.cross(normal, np.cross(force, normal))

    with part(1, "any force"):
        examples.agree(submission.along_surface, along, forces)
    with part(1, "straight on, along the plane, nothing"):
        expect(submission.along_surface, ([-3, -6, -6], LEANS), REST)
        expect(submission.along_surface, ([3, -4, 0], UP), [3.0, -4.0, 0.0])
        expect(submission.along_surface, (REST, UP), REST)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.along_surface, along, forces)


@asks("holds", 3, "The length of the push, up to and with μ_s N.")
def test_the_length_of_the_push_decides(submission, part, examples):
    def held(push, normal_force, friction):
        return length(push) <= friction * normal_force

    def pushes(draw):
        return draw.vector(7), draw.number(4, 20), draw.number(0.2, 1.2)

    with part(1, "any push"):
        examples.agree(submission.holds, held, pushes, count=40)
    with part(1, "just at the limit, no push, nothing to hold with"):
        for push, normal_force, friction, answer in (
            ([3, 4, 0], 10.0, 0.5, True), (REST, 10.0, 0.5, True), (REST, 0.0, 0.5, True), (X, 0.0, 0.5, False),
            (X, 10.0, 0.0, False), ([0, -4, 4], 10.0, 0.5, False), ([-9, 0, 0], 10.0, 0.5, False),
            ([8, 6, 0], 10.0, 1.25, True),
        ):  # fmt: skip
            expect(submission.holds, (push, normal_force, friction), answer)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.holds, held, pushes)


@asks("friction_angle", 3, "Where m g sin θ = μ_s m g cos θ.")
def test_on_that_slope_the_pull_is_just_held(submission, part, examples):
    def slopes(draw):
        return (draw.number(0.05, 2),)

    with part(1, "any friction"):
        examples.agree(submission.friction_angle, math.atan, slopes)
    with part(1, "much friction, no friction"):
        expect(submission.friction_angle, (1e6,), math.pi / 2 - 1e-6)
        expect(submission.friction_angle, (0.0,), 0.0)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.friction_angle, math.atan, slopes)


def friction(push, velocity, normal_force, static, kinetic):
    """On a body that slides, is held, or gives way."""
    if velocity @ velocity > 0:
        return -kinetic * normal_force * velocity / length(velocity)
    if length(push) <= static * normal_force:
        return -push
    return -kinetic * normal_force * push / length(push)


@asks("friction_force", 5, "Sliding, held, or giving way.")
def test_friction_in_each_of_the_three_cases(submission, part, examples):
    def bodies(draw):
        velocity = draw.vector(4) if draw.number(0, 1) < 0.5 else np.zeros(3)
        return draw.vector(9), velocity, draw.number(4, 20), draw.number(0.45, 0.9), draw.number(0.1, 0.4)

    with part(2, "any body"):
        examples.agree(submission.friction_force, friction, bodies, count=40)
    with part(2, "just held, no push, lifted off, no friction, between the two coefficients"):
        for case in (
            (REST, REST, 10.0, 0.5, 0.25), ([3, 4, 0], REST, 10.0, 0.5, 0.25), (X, [2, 0, 0], 0.0, 0.5, 0.25),
            (X, [2, 0, 0], 10.0, 0.0, 0.0), ([4, 0, 0], REST, 10.0, 0.25, 0.25), ([4, 0, 0], REST, 10.0, 0.5, 0.25),
            (X, [0, 3, 0], 10.0, 0.75, 0.5), ([6, 8, 0], REST, 10.0, 0.5, 0.25), (REST, [-9, 12, 0], 10.0, 0.5, 0.25),
            ([0.25, 0, 0], REST, 10.0, 0.5, 0.25), ([0, 3, 0], [2, 0, 0], 10.0, 0.5, 0.25),
        ):  # fmt: skip
            expect(submission.friction_force, case, friction(*plainly(*case)))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.friction_force, friction, bodies)


@asks("sliding_motion", 5, "Steady braking, a stop, and rest or a new start.")
def test_a_body_brakes_stops_and_rests_or_starts_again(submission, part, examples):
    def motion(x, v, push, normal_force, static, kinetic, m, dt):
        a = (push + friction(push, v, normal_force, static, kinetic)) / m
        closing = -(v @ a)
        stop = v @ v / closing if closing > 0 and v @ v > 0 else INFINITY
        if stop > dt:
            return x + v * dt + a * dt**2 / 2, v + a * dt, INFINITY
        rest = dt - stop
        again = (push + friction(push, 0 * v, normal_force, static, kinetic)) / m
        return x + v * stop / 2 + again * rest**2 / 2, again * rest, stop

    def slides(draw):
        way = draw.unit()
        return (
            draw.vector(), draw.number(0.5, 4) * way, draw.number(-9, 4) * way, draw.number(4, 12),
            draw.number(0.45, 0.9), draw.number(0.1, 0.4), draw.number(0.5, 3), draw.number(0.3, 2),
        )  # fmt: skip

    with part(2, "any slide"):
        examples.agree(submission.sliding_motion, motion, slides, count=30)
    with part(2, "held, pushed away, it stops at the very end, no friction, no time"):
        for v, push, static, kinetic, m, dt in (
            (REST, [2, 0, 0], 0.5, 0.25, 2.0, 1.0), (REST, [8, 0, 0], 0.5, 0.25, 2.0, 1.0),
            (REST, REST, 0.5, 0.25, 2.0, 1.0),
            ([1.25, 0, 0], REST, 0.5, 0.25, 1.0, 0.5), ([1, 2, 0], REST, 0.0, 0.0, 2.0, 0.5),
            (X, REST, 0.5, 0.25, 2.0, 0.0),
            ([3, -4, 0], REST, 0.5, 0.25, 1.0, 8.0), ([2, 0, 0], [-9, 0, 0], 0.5, 0.25, 2.0, 1.0),
            ([2, 0, 0], [-2, 0, 0], 0.5, 0.25, 2.0, 4.0), ([2, 0, 0], [-4, 0, 0], 0.5, 0.25, 2.0, 4.0),
            (X, [4, 0, 0], 0.5, 0.25, 2.0, 0.5),
        ):  # fmt: skip
            case = plainly(X, v, push, 10.0, static, kinetic, m, dt)
            expect(submission.sliding_motion, case, motion(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.sliding_motion, motion, slides)


@asks("clamp_to_circle", 3, "The direction stays, the length is at most the limit.")
def test_the_length_is_at_most_the_limit(submission, part, examples):
    def clamped(force, limit):
        return force * min(1.0, limit / length(force)) if force @ force > 0 else force

    def loads(draw):
        return draw.vector(6), draw.number(1, 9)

    with part(1, "any force"):
        examples.agree(submission.clamp_to_circle, clamped, loads, count=20)
    with part(1, "just at the limit, no force, no friction"):
        for force, limit in (
            ([3, 4, 0], 5.0),
            (REST, 5.0),
            ([3, 4, 0], 0.0),
            (REST, 0.0),
            ([4, 4, 0], 5.0),
            ([-6, 0, 0], 2.0),
            ([1, -9, 0], 5.0),
        ):
            expect(submission.clamp_to_circle, (force, limit), clamped(np.array(force, dtype=float), limit))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.clamp_to_circle, clamped, loads)


@asks("clamp_to_square", 3, "Along each axis at most the limit, either way.")
def test_along_each_axis_it_is_at_most_the_limit(submission, part, examples):
    def clamped(force, limit, x, y):
        return sum(min(max(force @ axis, -limit), limit) * axis for axis in (x, y))

    def loads(draw):
        turn = draw.turn()
        return draw.vector(6), draw.number(1, 6), turn[0], turn[1]

    with part(1, "any force and axes"):
        examples.agree(submission.clamp_to_square, clamped, loads, count=20)
    with part(1, "just at the limit, no force, no friction, a part across the surface"):
        for force, limit in (
            ([5, -5, 0], 5.0),
            (REST, 5.0),
            ([3, 4, 0], 0.0),
            ([1, 2, 9], 5.0),
            ([-6, -7, 0], 2.0),
            ([4, -4, 0], 5.0),
        ):
            expect(submission.clamp_to_square, (force, limit, X, Y), np.clip([*force[:2], 0.0], -limit, limit))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.clamp_to_square, clamped, loads, single=(2, 3))


@asks("break_away_time", 4, "The first instant at which the push is more than μ_s N, or N ends.")
def test_the_push_leaves_the_cone_at_that_instant(submission, part, examples):
    def leaves(force, rate, normal, mu):
        press, press_rate = -(force @ normal), -(rate @ normal)
        f, growth = force + press * normal, rate + press_rate * normal
        if length(f) > mu * max(press, 0.0) or press < 0:
            return 0.0
        squares = np.roots([
            growth @ growth - (mu * press_rate) ** 2, 2 * (f @ growth - mu**2 * press * press_rate),
            f @ f - (mu * press) ** 2,
        ])  # fmt: skip
        at_the_edge = [float(t.real) for t in squares if not t.imag and t.real > 0 and press + press_rate * t.real > 0]
        lifts = -press / press_rate if press_rate < 0 else INFINITY
        return min(at_the_edge, default=INFINITY) if at_the_edge else lifts

    def loads(draw):
        normal = draw.unit()
        force = draw.tangent(normal, 2) - draw.number(12, 20) * normal
        rate = draw.tangent(normal, 4) + draw.number(-1, 3) * normal
        return force, rate, normal, draw.number(0.3, 0.9)

    with part(2, "any load"):
        examples.agree(submission.break_away_time, leaves, loads)
    with part(1, "just held, not held, lifted off, held for ever"):
        for force, rate, mu, time in (
            ([0, 0, -8], [2, 0, 0], 0.5, 2.0), ([3, 0, -8], [-2, 0, 0], 0.5, 3.5), ([0, 0, -8],
            [1, 0, -4], 0.5, INFINITY),
            ([0, 0, -8], [0, 0, 2], 0.5, 4.0), ([8, 0, -8], X, 0.5, 0.0), ([0, 0, 2], X, 0.5, 0.0),
            ([1, 0, -8], REST, 0.5, INFINITY),
            ([4, 0, -8], X, 0.5, 0.0), ([0, 0, -8], [2, 0, 0], 0.0, 0.0), ([3, 0, -10], [0, 2, 0], 0.5, 2.0),
            (REST, REST, 0.5, INFINITY), ([0, 0, -8], [1, 0, 2], 0.5, 2.0), ([3, 0, -10], [3, 0, -4], 0.5, 2.0),
        ):  # fmt: skip
            expect(submission.break_away_time, (force, rate, UP, mu), time)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.break_away_time, leaves, loads)


@asks("sphere_grips", 3, "Way and spin together give way 7/2 times as easily as way alone.")
def test_a_sphere_grips_up_to_seven_halves_of_the_friction(submission, part, examples):
    def grips(slip, speed, e, mu):
        return slip * 2 / 7 <= mu * (1 + e) * speed

    def impacts(draw):
        speed, e, mu = draw.number(0.5, 4), draw.number(0.1, 0.9), draw.number(0.1, 0.8)
        share = draw.number(0.02, 0.95) if draw.number(0, 1) < 0.6 else draw.number(1.05, 1.6)  # rounding decides at 1
        return 3.5 * mu * speed * (1 + e) * share, speed, e, mu

    with part(1, "any impact"):
        examples.agree(submission.sphere_grips, grips, impacts, count=60)
    with part(1, "just gripping, no slip, no friction, no approach"):
        for impact, answer in (
            ((5.25, 2.0, 0.5, 0.5), True), ((0.0, 2.0, 0.5, 0.5), True), ((0.0, 2.0, 0.5, 0.0), True),
            ((1.0, 0.0, 0.5, 0.5), False),
            ((6.5, 2.0, 1.0, 0.5), True), ((4.0, 2.0, 0.0, 0.5), False), ((1.0, 2.0, 0.5, 0.0), False),
            ((3.0, 2.0, 0.0, 0.5), True),
        ):  # fmt: skip
            expect(submission.sphere_grips, impact, answer)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.sphere_grips, grips, impacts)


def struck(u, n, k, e, mu):
    """Grip where the cone allows it, else along the cone's edge."""
    if u @ n >= 0:
        return np.zeros(3)
    grip = np.linalg.inv(k) @ (-u - e * (u @ n) * n)
    across = grip - (grip @ n) * n
    if length(across) <= mu * (grip @ n):
        return grip
    edge = n + mu * across / length(across)
    return -(1 + e) * (u @ n) / (n @ k @ edge) * edge


@asks("friction_impulse", 5, "Newton's rule along the normal, Coulomb's along the surface.")
def test_the_impulse_obeys_newton_and_coulomb(submission, part, examples):
    def impacts(draw):
        normal, k = draw.unit(), np.zeros((3, 3))
        for _ in range(2):
            arm = draw.vector(0.6)
            across = np.cross(arm, np.eye(3))
            k = k + draw.number(0.3, 2) * np.eye(3) + across @ draw.inverse_inertia() @ across.T
        velocity = draw.tangent(normal, 4) - draw.number(1, 5) * normal
        return velocity, normal, (k + k.T) / 2, draw.number(0.1, 0.9), draw.number(0.1, 0.9)

    with part(2, "any impact"):
        examples.agree(submission.friction_impulse, struck, impacts, count=20)
    with part(1, "grazing, just gripping, no friction, no bounce, perfect bounce, parting"):
        ball = np.diag([3.5, 3.5, 1.0])
        for u, normal, k, e, mu in (
            ([3, 0, 0], UP, ball, 0.5, 0.5), (REST, UP, ball, 0.5, 0.5), ([1.5, 0, -2], UP, np.eye(3), 0.5, 0.5),
            ([3, 1, -2], UP, np.eye(3), 0.5, 0.0), ([6, 0, -2], UP, np.eye(3), 0.0, 0.25),
            ([6, 0, -2], UP, ball, 1.0, 0.25),
            ([3, 0, 2], UP, ball, 0.5, 0.5), ([9, -12, -2], UP, ball, 0.5, 0.25),
            ([1, 0, -4], LEANS, np.eye(3), 0.5, 0.25),
            ([3, 1, -2], UP, ball, 0.5, 0.5),
        ):  # fmt: skip
            case = plainly(u, normal, k, e, mu)
            expect(submission.friction_impulse, case, struck(*case))
    with part(1, "within the cone, and it turns the approach round"):

        def lawful(u, n, k, e, mu):
            j = numbers(submission.friction_impulse, (u, n, k, e, mu))
            assert length(j - (j @ n) * n) <= mu * (j @ n) * 1.001 + 1e-4
            np.testing.assert_allclose(n @ (u + k @ j), -e * (u @ n), atol=1e-3)

        examples.every(impacts, lawful)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.friction_impulse, struck, impacts)


@asks("sphere_impact", 5, "Friction at the end of the arm −R n changes way and spin together.")
def test_way_and_spin_change_together(submission, part, examples):
    def impact(v, spin, n, radius, e, mu, share=0.4):
        approach = -(v @ n)
        if approach <= 0:
            return v, spin
        slip = v + approach * n - radius * np.cross(spin, n)
        most, grip = mu * (1 + e) * approach, length(slip) / (1 + 1 / share)
        j = -slip / length(slip) * min(most, grip) if slip @ slip > 0 else slip
        return v + (1 + e) * approach * n + j, spin - np.cross(n, j) / (share * radius)

    def impacts(draw):
        normal = draw.unit()
        velocity = draw.tangent(normal, 4) - draw.number(1, 5) * normal
        return velocity, draw.vector(9), normal, draw.number(0.1, 0.9), draw.number(0.1, 0.9), draw.number(0.05, 0.6)

    with part(2, "any impact"):
        examples.agree(submission.sphere_impact, impact, impacts, count=20)
    with part(2, "rolling already, grazing, away, hollow, no friction, no bounce, spin about the normal"):
        for v, spin, n, e, mu, share in (
            ([2, 0, -3], [0, 4, 0], UP, 0.5, 0.5, 0.4), ([2, 0, 0], [0, -8, 0], UP, 0.5, 0.5, 0.4),
            ([2, 1, 3], [3, -8, 1], UP, 0.5, 0.5, 0.4), ([2, 0, -3], [0, -8, 0], UP, 0.5, 0.5, 2 / 3),
            ([2, 1, -3], [3, -8, 1], UP, 0.5, 0.0, 0.4), ([2, 0, -3], REST, UP, 0.0, 0.25, 0.4),
            ([0, 0, -3], [0, 0, 5], UP, 0.5, 0.5, 0.4), ([0, 0, -3], X, LEANS, 0.5, 0.25, 0.4),
            ([9, 0, -2], REST, UP, 0.5, 0.25, 0.4), ([1, 0, -3], [0, 30, 0], UP, 0.5, 0.25, 0.4),
            ([2, 0, -3], REST, UP, 1.0, 0.25, 0.4),
        ):  # fmt: skip
            case = plainly(v, spin, n, 0.5, e, mu, share)
            expect(submission.sphere_impact, case, impact(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.sphere_impact, impact, impacts)


def row(velocity, mass, e):
    """Pair after pair from the left, and again, until no ball is faster than the next."""
    v, m = [float(each) for each in velocity], np.broadcast_to(mass, len(velocity))
    e = np.broadcast_to(e, max(len(v) - 1, 0))
    for _ in range(2000):
        for i in range(len(v) - 1):
            closing = v[i] - v[i + 1]
            if closing > 0 and m[i + 1] == INFINITY:
                v[i] = v[i + 1] - e[i] * closing
            elif closing > 0:
                centre = (m[i] * v[i] + m[i + 1] * v[i + 1]) / (m[i] + m[i + 1])
                v[i] = centre - e[i] * closing * m[i + 1] / (m[i] + m[i + 1])
                v[i + 1] = centre + e[i] * closing * m[i] / (m[i] + m[i + 1])
    return np.array(v)


@asks("propagate_impacts", 5, "Each impact of two keeps their momentum and leaves e of their closing speed.")
def test_each_impact_of_two_in_the_row(submission, part, examples):
    masses = [2.0, 1.0, 0.5]

    def rows(draw):
        return draw.vector(3), np.array(masses), 0.75

    with part(2, "any three balls"):
        examples.agree(submission.propagate_impacts, row, rows, count=6)
    with part(2, "a wall, one ball, parting, from the right, restitutions that differ"):
        for case in (
            ([1, 0, 0], [1, 1, INFINITY], 1.0), ([3], 1.0, 0.5), ([-1, 0, 2], 1.0, 0.5), ([0, 0, -1], 1.0, 1.0),
            ([2, 0, 0], 1.0, [0.5, 1.0]), ([2, 2, 2], 1.0, 0.5), ([1, 0, 0], [3, 1, 1], 1.0), ([1, 0], [1, 4], 1.0),
            ([2, -1], [1, 3], 0.0), ([2, -1], [2, 1], 0.5), ([1, 0, 0], 1.0, 0.5), ([1, 1, 0, 0, 0], 1.0, 1.0),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.propagate_impacts, case, row(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.propagate_impacts, row, rows, single=(1, 2))


@asks("resting_problem", 3, "A force at one contact accelerates all contacts of the body.")
def test_a_force_at_one_contact_is_felt_at_the_others(submission, part, examples):
    def problem(g, w, force):
        rows = range(len(g))
        return np.array([[g[i] @ (w @ g[j]) for j in rows] for i in rows]), np.array([g[i] @ (w @ force) for i in rows])

    def bodies(draw):
        half = np.array([draw.vector(1) for _ in range(3)])
        return np.array([draw.vector(2) for _ in range(2)]), half @ half.T + np.eye(3), draw.vector(9)

    with part(1, "any two contacts"):
        examples.agree(submission.resting_problem, problem, bodies)
    with part(1, "no force, an immovable body"):
        for case in (
            ([UP], np.eye(3) / 2, REST),
            ([UP], np.zeros((3, 3)), [0, 0, -20]),
            ([[1, 0], [0, 1]], [[2, 0.5], [0.5, 1]], [-4, 2]),
        ):
            case = plainly(*case)
            expect(submission.resting_problem, case, problem(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.resting_problem, problem, bodies)


def contacts(draw):
    """A and b of three contacts."""
    half = np.array([draw.vector(1.5) for _ in range(3)])
    return half @ half.T + np.eye(3), draw.vector(5)


@asks("complementarity_residual", 3, "The largest of |min(A_ii f_i, (A f + b)_i)|.")
def test_the_worst_contact_counts(submission, part, examples):
    def residual(a, b, f):
        own = np.diag(a)
        return max(abs(min((own[i] or 1.0) * f[i], a[i] @ f + b[i])) for i in range(len(b)))

    with part(1, "any guess"):
        examples.agree(submission.complementarity_residual, residual, lambda draw: (*contacts(draw), draw.vector(3)))
    with part(1, "lifting off, a contact that pulls, one that moves nothing"):
        for case in (
            ([[2]], [4], [0]), ([[2]], [4], [-2]), ([[0]], [1], [0.5]), ([[2]], [0], [0]), ([[2, 0],
            [0, 1]], [-4, -1], [2, 3]),
            ([[2]], [-4], [3]), ([[2]], [-4], [2]),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.complementarity_residual, case, residual(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(
            submission.complementarity_residual, residual, lambda draw: (*contacts(draw), draw.vector(3))
        )  # fmt: skip


@asks("solve_by_sweeps", 4, "Contact after contact, each with what the others give now.")
def test_each_contact_sees_what_the_others_give_now(submission, part, examples):
    def sweep(a, b, sweeps, start=0.0):
        f = np.array(np.broadcast_to(start, b.shape), dtype=float)
        for _ in range(int(sweeps)):
            for i in range(len(b)):
                f[i] = max(0.0, f[i] - (a[i] @ f + b[i]) / a[i, i]) if a[i, i] > 0 else 0.0
        return f

    def problems(draw):
        return (*contacts(draw), 2, np.abs(draw.vector(2)))

    with part(2, "any three contacts, two sweeps"):
        examples.agree(submission.solve_by_sweeps, sweep, problems)
    with part(1, "no sweep, three and many, from a start, a contact that moves nothing"):
        coupled = [[2, 1], [1, 2]]
        for case in (
            (coupled, [-4, -4], 0, [1, 2]), (coupled, [4, 4], 3), (coupled, [-6, 4], 3), (coupled, [-4, -4], 1, [3, 1]),
            (coupled, [-4, 2], 1, [5, 5]), ([[2, 0], [0, 0]], [-4, 1], 2), ([[2, 0], [0, 0]], [-4, -1], 2),
            (coupled, [-4, -4], 100),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.solve_by_sweeps, case, sweep(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.solve_by_sweeps, sweep, problems, single=(2,))
