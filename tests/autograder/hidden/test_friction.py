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


@asks("support_force", 4, "N = max(0, −F·n) of all the forces that the support sees; the rest lies along it.")
def test_the_two_parts_make_up_all_the_forces(submission, part, examples):
    def support(m, g, push, a, normal):
        force = push - m * (a - g)
        return max(0.0, -(force @ normal)), np.cross(normal, np.cross(force, normal))

    def loads(draw):
        return draw.number(0.3, 5), draw.vector(10), draw.vector(20), draw.vector(4), draw.unit()

    with part(1, "any load on any slope"):
        examples.agree(submission.support_force, support, loads, count=20)
    with part(1, "free fall, far from everything, against a wall, a grain of dust"):
        down = [0, 0, -8]
        expect(submission.support_force, (2.0, down, REST, down, LEANS), (0.0, REST))
        expect(submission.support_force, (2.0, REST, X, REST, UP), (0.0, X))
        expect(submission.support_force, (2.0, down, [-9, 0, 0], REST, X), (9.0, [0.0, 0.0, -16.0]))
        expect(submission.support_force, (2e-9, down, [3e-9, 0, 4e-9], REST, UP), (1.2e-8, [3e-9, 0.0, 0.0]))
        for size in (1e-6, 1e6):  # 2 m (g − a) + F, all small or all large
            g, push, a = (size * np.array(each) for each in ([0, 0, -8.0], [3.0, 0, 4], [1.0, 0, 1]))
            expect(submission.support_force, (2.0, g, push, a, UP), (14 * size, [size, 0.0, 0.0]))
        expect(submission.support_force, (2e6, down, REST, REST, UP), (1.6e7, REST))
    with part(1, "lifted off, and just not"):
        along = [-2 / 9, -22 / 9, 23 / 9]
        expect(submission.support_force, (1.0, [0, 0, -8], [2, 2, 15], REST, LEANS), (0.0, along))
        expect(submission.support_force, (2.0, [0, 0, -8], [5, 2, 16], REST, UP), (0.0, [5.0, 2.0, 0.0]))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.support_force, support, loads)


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
    with part(2, "just held, no push, lifted off, no friction, between the two coefficients, small and slow"):
        for case in (
            (X, [1e-6, -2e-6, 2e-6], 10.0, 0.5, 0.25), ([6, 8, 0], [0, 0, 1e-4], 10.0, 0.5, 0.25),
            ([3e-7, 4e-7, 0], REST, 8e-7, 0.5, 0.25), ([3e-7, 4e-7, 0], REST, 2e-6, 0.5, 0.25),
            ([3e-7, 0, 0], [1e-7, 0, 2e-7], 8e-7, 0.5, 0.25), (X, [1e-14, -2e-14, 2e-14], 10.0, 0.5, 0.25),
            ([3.9, 3.9, 0], REST, 10.0, 0.5, 0.25),
            ([3e6, 0, 4e6], REST, 2e7, 0.5, 0.25), ([3e6, 0, 4e6], REST, 8e6, 0.5, 0.25),
            (X, [3e6, 0, 40], 8e6, 0.5, 0.2),
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
    with part(2, "held, pushed away, it stops near the very end, no friction, no time, slow"):
        for v, push, static, kinetic, m, dt in (
            ([1e-6, 0, 0], REST, 0.5, 0.25, 2.0, 1.0), ([3e-6, 0, 0], [-6, 0, 0], 0.5, 0.25, 2.0, 1e-3),
            ([1e-3, 0, 0], [2, 0, 0], 0.5, 0.25, 1.0, 1e-4), ([3e-3, 0, 0], [8, 0, 0], 0.5, 0.25, 1.0, 1e-4),
            (X, REST, 1e-6, 1e-6, 2.0, 5.0), ([1.26, 0, 0], REST, 0.5, 0.25, 1.0, 0.5),
            (REST, [2, 0, 0], 0.5, 0.25, 2.0, 1.0), (REST, [8, 0, 0], 0.5, 0.25, 2.0, 1.0),
            (REST, REST, 0.5, 0.25, 2.0, 1.0),
            ([1.25, 0, 0], REST, 0.5, 0.25, 1.0, 0.5), ([1, 2, 0], REST, 0.0, 0.0, 2.0, 0.5),
            (X, REST, 0.5, 0.25, 2.0, 0.0),
            ([3, -4, 0], REST, 0.5, 0.25, 1.0, 8.0), ([2, 0, 0], [-9, 0, 0], 0.5, 0.25, 2.0, 1.0),
            ([2, 0, 0], [-2, 0, 0], 0.5, 0.25, 2.0, 4.0), ([2, 0, 0], [-4, 0, 0], 0.5, 0.25, 2.0, 4.0),
            (X, [4, 0, 0], 0.5, 0.25, 2.0, 0.5), (X, [2, 0, 0], 0.5, 0.25, 1.0, 3.0),  # pushed on, and it stops
        ):  # fmt: skip
            case = plainly(X, v, push, 10.0, static, kinetic, m, dt)
            expect(submission.sliding_motion, case, motion(*case))
            case = (np.zeros(3), *case[1:])  # so that short ways count
            expect(submission.sliding_motion, case, motion(*case))
        for metre, second, kilogram in (
            (1e-6, 1, 1), (1e6, 1, 1), (1, 1e-6, 1), (1, 1e6, 1), (1, 1, 1e-6), (1, 1, 1e6),
        ):  # fmt: skip
            newton = kilogram * metre / second**2
            for push in ([-2.0, 0, 0], [-9.0, 0, 0]):
                motions = (metre * np.array(X), metre / second * np.array([2.0, 0, 0]), newton * np.array(push))
                case = (*motions, 10.0 * newton, 0.5, 0.25, 2.0 * kilogram, 4.0 * second)
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
    with part(1, "just at the limit, no force, no friction, very small and very large"):
        for force, limit in (
            ([3, 4, 0], 5.0),
            (REST, 5.0),
            ([3, 4, 0], 0.0),
            (REST, 0.0),
            ([4, 4, 0], 5.0),
            ([-6, 0, 0], 2.0),
            ([1, -9, 0], 5.0),
            ([6e-9, -8e-9, 0], 5e-9),
            ([6e-9, -8e-9, 0], 2e-8),
            ([6e9, -8e9, 0], 5e9),
        ):
            expect(submission.clamp_to_circle, (force, limit), clamped(np.array(force, dtype=float), limit))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.clamp_to_circle, clamped, loads)


@asks("roll_step", 5, "The slip shrinks by 7/2 μ g Δt until the ball rolls, and spin follows.")
def test_the_ball_slips_until_it_rolls(submission, part, examples):
    def rolls(v, spin, radius, mu, g, dt):
        over_floor = v + radius * np.cross(UP, spin)
        slip = length(over_floor)
        if slip == 0:
            return v, spin
        braked = -over_floor / slip * min(2 * slip / 7, mu * g * dt)
        return v + braked, spin - 2.5 * np.cross(UP, braked) / radius

    def balls(draw):
        v = draw.vector(5) * [1, 1, 0]
        radius, mu, dt = draw.number(0.05, 0.5), draw.number(0.05, 0.6), draw.number(0.02, 0.3)
        return v, draw.vector(20), radius, mu, draw.number(2, 12), dt

    with part(2, "any ball"):
        examples.agree(submission.roll_step, rolls, balls, count=20)
    with part(1, "at rest, rolling, spinning like a top, on ice, no step and a long one, small and slow"):
        for v, spin, radius, mu, dt in (
            ([4e-6, 3e-6, 0], REST, 0.5, 0.2, 0.05), ([2.000001, 0, 0], [0, 20, 0], 0.1, 0.2, 0.05),
            ([4e-6, 0, 0], REST, 0.5, 0.2, 2.5e-7), (REST, [4, -2, 1], 1e-6, 0.2, 1e-7),
            (REST, [4e-6, 1e-6, 0], 1, 0.2, 1),
            ([3, 1, 0], [1, 0, 0], 1e6, 0.2, 1.0), ([3e6, 1e6, 0], [4e6, 0, 0], 0.5, 0.2, 1.0),
            ([3e7, 0, 0], X, 1, 0.2, 1e6),
            (REST, REST, 0.1, 0.2, 0.05), ([2, 0, 0], [0, 20, 0], 0.1, 0.2, 0.05), (REST, [0, 0, 30], 0.1, 0.2, 0.05),
            ([3, 1, 0], [2, 4, 1], 0.1, 0.0, 0.05), ([3, 1, 0], [2, 4, 1], 0.1, 0.2, 0.0),
            ([3, 1, 0], [2, 4, 1], 0.3, 0.4, 5.0),
        ):  # fmt: skip
            case = plainly(v, spin, radius, mu, 10.0, dt)
            expect(submission.roll_step, case, rolls(*case))
        for gravity in (1e-6, 1e6):
            case = plainly(gravity * np.array(X), [gravity, 0, 0], 1.0, 0.2, gravity, 0.5)
            expect(submission.roll_step, case, rolls(*case))
    with part(1, "thrown without spin, it rolls with five sevenths, whatever μ is"):

        def slows(velocity, radius, mu):
            v, _ = numbers(submission.roll_step, (velocity, np.zeros(3), radius, mu, 9.8, 1000.0), 2)
            np.testing.assert_allclose(v, 5 / 7 * velocity, atol=1e-6)

        examples.every(lambda draw: (draw.vector(5) * [1, 1, 0], draw.number(0.1, 1), draw.number(0.1, 1)), slows)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.roll_step, rolls, balls)


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
    with part(1, "just held, not held, lifted off, held for ever; small and slow"):
        for force, rate, mu, time in (
            ([0, 0, -8], [2e-6, 0, 0], 0.5, 2e6), ([0, 0, -8], [0, 0, 2e-6], 0.5, 4e6), ([0, 0, -8e-9], X, 0.5, 4e-9),
            ([0, 0, -8], [2e6, 0, 0], 0.5, 2e-6), ([3e-7, 0, -1e-6], [0, 2e-7, 0], 0.5, 2.0),
            ([3e6, 0, -1e7], [0, 2e6, 0], 0.5, 2.0),
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
