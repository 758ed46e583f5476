"""Bouncing off a plane: drawn examples against closed forms, limiting cases, many at once, and whole bounces."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

UP, LEANS, REST = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
FALL = [0.0, 0.0, -8.0]
INFINITY = math.inf


OTHER_UNITS = ((1e-6, 1.0), (1e6, 1.0), (1.0, 1e-6), (1.0, 1e6))
"""A metre and a second: everything small, large, quick or slow. Formulas are the same in all of them."""


def in_units(metre, second, position, velocity, acceleration):
    """A state of motion in other units."""
    given = zip((position, velocity, acceleration), range(3), strict=True)
    return tuple(metre / second**power * np.array(each, dtype=float) for each, power in given)


def bounced(velocity, normal, e):
    """Normal and tangential part taken apart, and put together again."""
    normal_part = (velocity @ normal) * normal
    return velocity if velocity @ normal >= 0 else velocity - normal_part - e * normal_part


def fly(x, v, a, t):
    """Position and velocity after a time with a constant acceleration."""
    return x + v * t + a * t**2 / 2, v + a * t


def euler_step(x, v, a, normal, behind, e, dt):
    """A step of the loop: respond behind the plane, and move with the new velocity."""
    if behind and v @ normal < 0:
        v, a = bounced(v, normal, e), a - min(a @ normal, 0) * normal
    v = v + a * dt
    return x + v * dt, v


@asks(
    "kinematic_response", 5, "The normal part turns round and shrinks to e, the other stays, also on planes that lean."
)
def test_any_plane_turns_the_normal_part_round(submission, part, examples):
    def flights(draw):
        return draw.vector(), draw.unit(), draw.number(0.1, 0.9)

    with part(2, "any velocity and plane"):
        examples.agree(submission.kinematic_response, bounced, flights)
    with part(1, "along the plane, at rest, no bounce, perfect bounce, very slow"):
        for velocity, normal, e in (
            ([3e-6, 0, -4e-6], UP, 0.5), ([3, 0, -4e-6], UP, 0.0), ([0, 0, 4e-6], UP, 0.5), ([0, 0, -4e6], UP, 0.5),
            ([3, 1, 0], UP, 0.5), (REST, UP, 0.5), ([2, -1, 0], LEANS, 0.5), ([1, 0, -4], UP, 0.0),
            ([1, 0, -4], UP, 1.0), ([0, 0, -4], UP, 1.0), ([3, 1, 5], UP, 0.0), ([3, 1, 5], UP, 1.0),
        ):  # fmt: skip
            right = bounced(np.array(velocity, dtype=float), np.array(normal), e)
            expect(submission.kinematic_response, (velocity, normal, e), right)
    with part(1, "a second bounce off the same plane changes nothing"):

        def settled(velocity, normal, e):
            after = numbers(submission.kinematic_response, (velocity, normal, e))
            again = numbers(submission.kinematic_response, (after + 0.01 * normal, normal, e))
            np.testing.assert_allclose(again, after + 0.01 * normal, atol=3e-4)  # single precision of numbers up to 9

        examples.every(flights, settled)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.kinematic_response, bounced, flights)


@asks("kinematic_response", 3, "Every observer who moves steadily sees the same bounce.")
def test_every_steady_observer_sees_the_same_bounce(submission, part, examples):
    def seen_from_the_plane(velocity, normal, e, plane):
        return plane + bounced(velocity - plane, normal, e)

    def flights(draw):
        return draw.vector(), draw.unit(), draw.number(0.1, 0.9), draw.vector(3)

    with part(1, "any body and any plane"):
        examples.agree(submission.kinematic_response, seen_from_the_plane, flights, count=20)
    with part(1, "side by side, along the plane, no bounce, perfect bounce, very slow and very fast"):
        for velocity, plane, e, after in (
            ([1, 0, -2], [0, 1, -2], 0.5, [1, 0, -2]), (REST, REST, 0.5, REST), ([1, 0, -2], [5, 3, 0], 0.5, [1, 0, 1]),
            ([1, 0, -2], [2, 0, 1], 0.0, [1, 0, 1]), ([0, 0, -2], [0, 0, 2], 1.0, [0, 0, 6]),
            ([0, 1, 3], [0, 0, 1], 0.5, [0, 1, 3]), (REST, [0, 0, 2], 0.5, [0, 0, 3]),
            ([0, 0, -2e-6], [0, 0, 2e-6], 0.5, [0, 0, 4e-6]), ([0, 0, -2e6], [0, 0, 2e6], 0.5, [0, 0, 4e6]),
        ):  # fmt: skip
            expect(submission.kinematic_response, (velocity, UP, e, plane), after)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.kinematic_response, seen_from_the_plane, flights)


@asks("respond_at_step", 4, "The start of the step decides: who turns round, and whose weight the plane carries.")
def test_the_start_of_the_step_decides(submission, part, examples):
    def steps(draw):
        normal = draw.unit()
        velocity = draw.tangent(normal, 3) + draw.number(1, 6) * draw.sign() * normal
        return (
            draw.vector(2), velocity, draw.vector(4), normal, draw.sign() > 0, draw.number(0.1, 0.9),
            draw.number(0.2, 0.6),
        )  # fmt: skip

    with part(2, "any step"):
        examples.agree(submission.respond_at_step, euler_step, steps, count=30)
    with part(1, "at rest on the floor, along the floor, no bounce, perfect bounce, slow, short and no steps"):
        for v, a, behind, e, dt in (
            ([1e-6, 0, -2e-6], REST, True, 0.5, 0.25), (REST, [0, 0, -2e-6], False, 0.5, 0.25),
            ([0, 0, -2e-6], [1e-6, 0, -8e-6], True, 0.5, 0.5),
            (REST, FALL, True, 0.5, 0.25), ([3, 1, 0], FALL, True, 0.5, 0.25), ([1, 0, -4], FALL, True, 0.0, 0.25),
            ([1, 0, -4], FALL, True, 1.0, 0.25), ([1, 0, -4], [0, 0, 8], True, 1.0, 0.25),
            ([1, 0, -4], FALL, True, 0.5, 0.0), ([1, 0, -4], FALL, False, 0.5, 0.0),
        ):  # fmt: skip
            right = euler_step(
                np.array([0, 0, -1.0]), np.array(v, dtype=float), np.array(a), np.array(UP), behind, e, dt
            )
            expect(submission.respond_at_step, ([0, 0, -1], v, a, UP, behind, e, dt), right)
        for metre, second in OTHER_UNITS:
            state = in_units(metre, second, [0, 0, -1], [1, 0, -4], [1, 0, -8])
            right = euler_step(*state, np.array(UP), True, 0.5, 0.5 * second)
            expect(submission.respond_at_step, (*state, UP, True, 0.5, 0.5 * second), right)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.respond_at_step, euler_step, steps)


@asks("bounce", 6, "A run is one step after another, each from where the last one ended.")
def test_a_run_is_one_step_after_another(submission, part, examples):
    def run(x, v, a, normal, offset, e, dt, steps):
        places, velocities = [x], [v]
        for _ in range(steps):
            x, v = euler_step(x, v, a, normal, x @ normal + offset < 0, e, dt)
            places.append(x)
            velocities.append(v)
        return np.array(places), np.array(velocities)

    def runs(draw):
        normal, offset = draw.unit(), draw.number(-2, 2)
        position = draw.tangent(normal, 3) + (draw.number(0.1, 1) - offset) * normal
        velocity = draw.tangent(normal, 3) - draw.number(3, 6) * normal
        pull = draw.vector(2) - draw.number(4, 9) * normal
        return position, velocity, pull, normal, offset, draw.number(0.1, 0.9), draw.number(0.1, 0.3), 7

    with part(2, "any run"):
        examples.agree(submission.bounce, run, runs)
    with part(1, "no steps, steps of no length, at rest, no bounce, perfect bounce, on the plane, other units"):
        for x, v, a, offset, e, dt, steps in (
            ([0, 0, 1], [1, 0, -4], FALL, 0.0, 0.5, 0.25, 0), ([0, 0, -1], [1, 0, -4], FALL, 0.0, 0.5, 0.0, 3),
            (REST, REST, FALL, 0.0, 0.5, 0.25, 5), ([0, 0, 1], [1, 0, -4], FALL, 0.0, 0.0, 0.25, 6),
            ([0, 0, 1], [1, 0, -4], FALL, 0.0, 1.0, 0.25, 6), ([1, 0, 3.5], [1, 0, -1], REST, -3.0, 1.0, 0.5, 4),
        ):  # fmt: skip
            right = run(*(np.array(each, dtype=float) for each in (x, v, a, UP)), offset, e, dt, steps)
            expect(submission.bounce, (x, v, a, UP, offset, e, dt, steps), right)
        for metre, second in OTHER_UNITS:
            state = in_units(metre, second, [0, 0, 4.5], [1, 0, -4], [1, 0, -8])
            right = run(*state, np.array(UP), -metre, 0.5, 0.5 * second, 4)
            expect(submission.bounce, (*state, UP, -metre, 0.5, 0.5 * second, 4), right)
    with part(2, "the apex differs from e² h by −(1 − e) v Δt/2 on average over the phases of the steps"):
        e, dt, g, drops = 0.5, 0.01, 8.0, 20
        phases = (np.arange(drops) + 0.5) / drops - 0.5
        heights = g * (0.5 + phases * dt) ** 2 / 2  # a fall of half a second from about a metre
        apexes = []
        for height in heights:  # one ball at a time: a function for one ball alone has lost its point for that already
            start = np.array([0.0, 0.0, height])
            places, velocities = numbers(
                submission.bounce, (start, np.zeros(3), np.array(FALL), np.array(UP), 0.0, e, dt, 90), 2
            )
            assert places.shape == velocities.shape == (91, 3), f"the shapes are {places.shape}, {velocities.shape}"
            apexes.append(places[60:, 2].max())
        low = np.mean(apexes - e**2 * heights)
        # Up to g Δt² / 4 more: the highest place of the steps, and terms of the next order.
        assert abs(low + (1 - e) * 4.0 * dt / 2) < g * dt**2 / 2, f"the apex is off by {1000 * low:.1f} mm on average"
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.bounce, run, runs, single=(7,))


@asks("respond_at_impact", 4, "The parts of the step before and after the impact are flights of their own.")
def test_two_flights_and_a_bounce_between_them(submission, part, examples):
    def step(x, v, a, normal, e, time, dt):
        if time > dt:
            return fly(x, v, a, dt)
        x, v = fly(x, v, a, time)
        return fly(x, bounced(v, normal, e), a, dt - time)

    def steps(draw):
        normal, dt = draw.unit(), draw.number(0.2, 0.9)
        velocity = draw.vector() - draw.number(12, 15) * normal
        time = dt * draw.number(0.1, 1.3)
        return draw.vector(), velocity, draw.vector(6), normal, draw.number(0.1, 0.9), time, dt

    with part(2, "any step"):
        examples.agree(submission.respond_at_impact, step, steps)
    with part(1, "at the first and the last instant, later, never, on its way out, slow, a short step"):
        for v, e, time, dt in (
            ([1e-6, 0, -2e-6], 0.5, 1e-6, 4e-6), ([1, 0, -4], 0.5, 1e-6, 0.5), ([1, 0, -4], 0.5, 1e-6, 1e-5),
            ([1, 0, -4], 0.5, 200.0, 500.0), ([1, 0, -4], 0.5, 0.250001, 0.25),
            ([1, 0, -4], 0.5, 0.0, 0.25), ([1, 0, -4], 0.5, 0.25, 0.25), ([1, 0, -4], 0.5, 0.5, 0.25),
            ([1, 0, -4], 0.5, INFINITY, 0.25), ([0, 0, 16], 0.5, 0.5, 1.0), ([1, 0, -4], 0.0, 0.25, 0.5),
            ([1, 0, -4], 1.0, 0.25, 0.5), ([1, 0, -4], 0.5, INFINITY, 0.0),
        ):  # fmt: skip
            right = step(np.array([0, 0, 2.0]), np.array(v, dtype=float), np.array(FALL), np.array(UP), e, time, dt)
            expect(submission.respond_at_impact, ([0, 0, 2], v, FALL, UP, e, time, dt), right)
            right = step(np.zeros(3), np.array(v, dtype=float), np.zeros(3), np.array(UP), e, time, dt)
            expect(submission.respond_at_impact, (REST, v, REST, UP, e, time, dt), right)
        for metre, second in OTHER_UNITS:
            state = in_units(metre, second, [0, 0, 2], [1, 0, -4], [1, 0, -8])
            right = step(*state, np.array(UP), 0.5, 0.25 * second, 0.75 * second)
            expect(submission.respond_at_impact, (*state, UP, 0.5, 0.25 * second, 0.75 * second), right)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.respond_at_impact, step, steps)


@asks("penalty_force", 4, "Spring and dashpot along the normal, within the plane alone.")
def test_spring_and_dashpot_push_along_the_normal(submission, part, examples):
    def push(s, u, normal, k, c, adhesive=False):
        force = -k * s - c * u if s < 0 else 0.0
        return (force if adhesive else max(0.0, force)) * normal

    def contacts(draw):
        return (
            draw.number(-0.5, 0.1), draw.number(-9, 9), draw.unit(), draw.number(50, 900), draw.number(1, 60), False,
        )  # fmt: skip

    with part(2, "any contact"):
        examples.agree(submission.penalty_force, push, contacts, count=20)
        expect(submission.penalty_force, (-0.5, -3.0, LEANS, 300.0), [50.0, 100.0, 100.0])
    with part(1, "just touching, no stiffness, with adhesion, micrometres deep, very slow"):
        for s, u, k, c, adhesive in (
            (-1e-6, 0.0, 800.0, 10.0, False), (-1e-6, -2e-6, 8e8, 10.0, False), (-1e-9, 2e-9, 8e8, 2e8, True),
            (1e-6, 0.0, 8e8, 0.0, True), (-0.5, -2.0, 8e-6, 1e-6, False), (-1e6, -2e6, 800.0, 10.0, False),
            (0.0, 0.0, 800.0, 10.0, False), (0.0, -2.0, 800.0, 10.0, False), (0.0, -2.0, 800.0, 10.0, True),
            (0.25, 3.0, 800.0, 10.0, True), (0.25, -3.0, 800.0, 10.0, True), (-0.5, -2.0, 0.0, 10.0, False),
            (-0.125, 20.0, 800.0, 10.0, True), (-0.125, 4.0, 800.0, 10.0, True), (-0.125, 20.0, 800.0, 10.0, False),
        ):  # fmt: skip
            right = push(s, u, np.array(UP), k, c, adhesive)
            expect(submission.penalty_force, (s, u, UP, k, c, adhesive), right)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.penalty_force, push, contacts, single=(5,))


@asks("penalty_step_limit", 4, "At the limit the matrix of one step has the eigenvalue −1.")
def test_at_the_limit_a_step_has_the_eigenvalue_minus_one(submission, part, examples):
    def limit(m, k, c=0.0):
        # 1 + trace + determinant = 0 of [[1 − ω²Δt², Δt(1 − 2ζωΔt)], [−ω²Δt, 1 − 2ζωΔt]], with 2ζω = c/m
        return float(max(np.roots([-k / m, -2 * c / m, 4.0]).real))

    def contacts(draw):
        return draw.number(0.2, 5), draw.number(50, 900), draw.number(1, 60)

    with part(2, "any contact"):
        examples.agree(submission.penalty_step_limit, limit, contacts)
    with part(1, "no damping, critical, far more than that; light and hard"):
        expect(submission.penalty_step_limit, (4.0, 100.0), 0.4)
        for c in (0.0, 20.0, 200.0):
            expect(submission.penalty_step_limit, (1.0, 100.0, c), limit(1.0, 100.0, c))
        expect(submission.penalty_step_limit, (1.0, 1.0, 1e6), 2e-6)
        expect(submission.penalty_step_limit, (1e-3, 1e6, 1e9), 2e-12)
        for given in ((1e-6, 1e8, 0.0), (1e-6, 1e8, 15.0), (1e6, 1e-2, 75.0), (1e-6, 1e-6, 1e-6)):
            expect(submission.penalty_step_limit, given, limit(*given))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.penalty_step_limit, limit, contacts)


@asks("design_contact", 5, "The energy gives the stiffness, the restitution the damping, and half a period the step.")
def test_a_contact_made_to_measure_keeps_to_its_measures(submission, part, examples):
    def made(mass, speed, depth, e, steps):
        low, high = 0.0, 20.0  # of the damping ratio; the impact is over where its force is zero

        def kept(zeta):
            if zeta == 1:
                return math.exp(-2)
            apart = math.sqrt(abs(1 - zeta**2))
            return math.exp(-2 * zeta * (math.acos(zeta) if zeta < 1 else math.acosh(zeta)) / apart)

        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if kept(middle) > e else (low, middle)
        k = mass * speed**2 / depth**2
        return k, 2 * low * math.sqrt(k * mass), math.pi * math.sqrt(mass / k) / steps

    def contacts(draw):
        return (
            draw.number(0.2, 5), draw.number(0.5, 6), draw.number(0.05, 0.5), draw.number(0.1, 0.95),
            draw.number(3, 40),
        )  # fmt: skip

    with part(2, "any contact"):
        examples.agree(submission.design_contact, made, contacts)
    with part(1, "perfect bounce, hardly any bounce, less than one step per contact, a grain and a ship"):
        expect(submission.design_contact, (2.0, 3.0, 0.5, 1.0, 10.0), (72.0, 0.0, math.pi / 60))
        for given in (
            (1.0, 2.0, 0.125, 0.02, 10.0), (1.0, 2.0, 0.125, 0.5, 0.5), (1e-9, 1e-6, 1e-9, 0.5, 10.0),
            (1e6, 1e6, 1e5, 0.8, 1e4),
        ):  # fmt: skip
            expect(submission.design_contact, given, made(*given))
    with part(1, "in many small steps the body goes no deeper than permitted, and leaves with e times its speed"):

        def keeps(mass, speed, depth, e):
            k, c, dt = (float(value) for value in numbers(submission.design_contact, (mass, speed, depth, e, 500.0), 3))
            assert k > 0, f"the stiffness is {k:.3g} N/m"
            assert 0 < dt < 2 / (math.sqrt(k / mass) + c / mass), f"the contact is not stable with {dt:.3g} s"
            x, v, deepest = 0.0, -speed, 0.0
            for _ in range(5000):
                v += max(0.0, -k * x - c * v) / mass * dt if x <= 0 else 0.0
                x += v * dt
                deepest = max(deepest, -x)
                if x > 0:
                    break
            assert deepest < 1.01 * depth, f"the body goes {deepest:.3g} m deep"
            assert abs(v - e * speed) < 0.02 * speed, f"the body leaves with {v / speed:.3g} of its speed"

        small = lambda draw: (draw.number(0.2, 5), draw.number(0.5, 6), draw.number(0.05, 0.5), draw.number(0.1, 1))  # noqa: E731
        examples.every(small, keeps, count=4)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.design_contact, made, contacts)
