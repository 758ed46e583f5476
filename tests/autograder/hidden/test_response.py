"""Bouncing off a plane: drawn examples against closed forms, limiting cases, many at once, and whole bounces."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

UP, LEANS, REST = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
FALL = [0.0, 0.0, -8.0]
INFINITY = math.inf


def bounced(velocity, normal, e):
    """Normal and tangential part taken apart, and put together again."""
    normal_part = (velocity @ normal) * normal
    return velocity if velocity @ normal >= 0 else velocity - normal_part - e * normal_part


def fly(x, v, a, t):
    """Position and velocity after a time with a constant acceleration."""
    return x + v * t + a * t**2 / 2, v + a * t


@asks(
    "kinematic_response", 5, "The normal part turns round and shrinks to e, the other stays, also on planes that lean."
)
def test_any_plane_turns_the_normal_part_round(submission, part, examples):
    def flights(draw):
        return draw.vector(), draw.unit(), draw.number(0.1, 0.9)

    with part(2, "any velocity and plane"):
        examples.agree(submission.kinematic_response, bounced, flights)
    with part(1, "along the plane, at rest, no bounce, perfect bounce"):
        for velocity, normal, e in (
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


@asks("moving_plane_response", 4, "Every observer who moves steadily sees the same bounce.")
def test_every_steady_observer_sees_the_same_bounce(submission, part, examples):
    def seen_from_the_plane(velocity, plane, normal, e):
        return plane + bounced(velocity - plane, normal, e)

    def flights(draw):
        return draw.vector(), draw.vector(3), draw.unit(), draw.number(0.1, 0.9)

    with part(2, "any body and any plane"):
        examples.agree(submission.moving_plane_response, seen_from_the_plane, flights, count=20)
    with part(1, "side by side, along the plane, no bounce, perfect bounce"):
        for velocity, plane, e, after in (
            ([1, 0, -2], [0, 1, -2], 0.5, [1, 0, -2]), (REST, REST, 0.5, REST), ([1, 0, -2], [5, 3, 0], 0.5, [1, 0, 1]),
            ([1, 0, -2], [2, 0, 1], 0.0, [1, 0, 1]), ([0, 0, -2], [0, 0, 2], 1.0, [0, 0, 6]),
            ([0, 1, 3], [0, 0, 1], 0.5, [0, 1, 3]), (REST, [0, 0, 2], 0.5, [0, 0, 3]),
        ):  # fmt: skip
            expect(submission.moving_plane_response, (velocity, plane, UP, e), after)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.moving_plane_response, seen_from_the_plane, flights)


@asks("respond_at_step", 4, "The start of the step decides: who turns round, and whose weight the plane carries.")
def test_the_start_of_the_step_decides(submission, part, examples):
    def step(x, v, a, normal, behind, e, dt):
        if behind and v @ normal < 0:
            v, a = bounced(v, normal, e), a - min(a @ normal, 0) * normal
        v = v + a * dt
        return x + v * dt, v

    def steps(draw):
        normal = draw.unit()
        velocity = draw.tangent(normal, 3) + draw.number(1, 6) * draw.sign() * normal
        return (
            draw.vector(2), velocity, draw.vector(4), normal, draw.sign() > 0, draw.number(0.1, 0.9),
            draw.number(0.2, 0.6),
        )  # fmt: skip

    with part(2, "any step"):
        examples.agree(submission.respond_at_step, step, steps, count=30)
    with part(1, "at rest on the floor, along the floor, no bounce, perfect bounce, a step of no length"):
        for v, a, behind, e, dt in (
            (REST, FALL, True, 0.5, 0.25), ([3, 1, 0], FALL, True, 0.5, 0.25), ([1, 0, -4], FALL, True, 0.0, 0.25),
            ([1, 0, -4], FALL, True, 1.0, 0.25), ([1, 0, -4], [0, 0, 8], True, 1.0, 0.25),
            ([1, 0, -4], FALL, True, 0.5, 0.0), ([1, 0, -4], FALL, False, 0.5, 0.0),
        ):  # fmt: skip
            right = step(np.array([0, 0, -1.0]), np.array(v, dtype=float), np.array(a), np.array(UP), behind, e, dt)
            expect(submission.respond_at_step, ([0, 0, -1], v, a, UP, behind, e, dt), right)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.respond_at_step, step, steps)


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
    with part(1, "at the first and the last instant, later, never, on its way out"):
        for v, e, time, dt in (
            ([1, 0, -4], 0.5, 0.0, 0.25), ([1, 0, -4], 0.5, 0.25, 0.25), ([1, 0, -4], 0.5, 0.5, 0.25),
            ([1, 0, -4], 0.5, INFINITY, 0.25), ([0, 0, 16], 0.5, 0.5, 1.0), ([1, 0, -4], 0.0, 0.25, 0.5),
            ([1, 0, -4], 1.0, 0.25, 0.5), ([1, 0, -4], 0.5, INFINITY, 0.0),
        ):  # fmt: skip
            right = step(np.array([0, 0, 2.0]), np.array(v, dtype=float), np.array(FALL), np.array(UP), e, time, dt)
            expect(submission.respond_at_impact, ([0, 0, 2], v, FALL, UP, e, time, dt), right)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.respond_at_impact, step, steps)


@asks("time_until_rest", 5, "The flights, added up one by one, come to rest at that time.")
def test_the_flights_add_up_to_the_time_until_rest(submission, part, examples):
    def added_up(s, u, a, e):
        speed, g = math.sqrt(u * u - 2 * a * s), -a
        time = (u + speed) / g
        while (speed := e * speed) > 1e-12:
            time += 2 * speed / g
        return time

    def throws(draw):
        return draw.number(0.2, 3), draw.number(-4, 4), -draw.number(1, 12), draw.number(0.1, 0.95)

    with part(2, "any throw"):
        examples.agree(submission.time_until_rest, added_up, throws)
    with part(1, "lying there, on the plane and just behind it, no bounce"):
        for motion, time in (
            ((0.0, 0.0, -8.0, 0.5), 0.0), ((0.0, 0.0, 0.0, 0.5), 0.0), ((0.0, 0.0, -8.0, 1.0), 0.0),
            ((-0.5, 0.0, -8.0, 0.5), 0.0), ((0.0, 4.0, -8.0, 0.5), 2.0), ((0.0, -4.0, -8.0, 0.5), 1.0),
            ((-0.5, 4.0, -8.0, 0.5), 2.0), ((4.0, 0.0, -8.0, 0.0), 1.0), ((3.0, -1.5, 0.0, 0.0), 2.0),
        ):  # fmt: skip
            expect(submission.time_until_rest, motion, time)
    with part(1, "bouncing for ever, or never coming back"):
        for motion in (
            (4.0, 0.0, -8.0, 1.0), (3.0, -1.5, 0.0, 0.5), (3.0, -1.0, 2.0, 0.5), (1.0, -4.0, 2.0, 0.5),
            (0.0, 0.0, 2.0, 0.5), (1.0, 0.0, 0.0, 0.5), (3.0, 1.0, 0.0, 0.5), (1.0, -4.0, 2.0, 0.0),
            (3.0, 1.0, 0.0, 0.0),
        ):  # fmt: skip
            expect(submission.time_until_rest, motion, INFINITY)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.time_until_rest, added_up, throws)


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
    with part(1, "just touching, no stiffness, with adhesion"):
        for s, u, k, c, adhesive in (
            (0.0, 0.0, 800.0, 10.0, False), (0.0, -2.0, 800.0, 10.0, False), (0.0, -2.0, 800.0, 10.0, True),
            (0.25, 3.0, 800.0, 10.0, True), (0.25, -3.0, 800.0, 10.0, True), (-0.5, -2.0, 0.0, 10.0, False),
            (-0.125, 20.0, 800.0, 10.0, True), (-0.125, 4.0, 800.0, 10.0, True), (-0.125, 20.0, 800.0, 10.0, False),
        ):  # fmt: skip
            right = push(s, u, np.array(UP), k, c, adhesive)
            expect(submission.penalty_force, (s, u, UP, k, c, adhesive), right)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.penalty_force, push, contacts, single=(5,))


@asks("penalty_rest_depth", 3, "There the spring's force is the weight.")
def test_there_the_spring_carries_the_weight(submission, part, examples):
    def floors(draw):
        return draw.number(0.2, 5), draw.number(1, 12), draw.number(50, 900)

    def depth(m, g, k):
        return m * g / k

    with part(1, "any floor"):
        examples.agree(submission.penalty_rest_depth, depth, floors)
    with part(1, "no gravity, no mass"):
        expect(submission.penalty_rest_depth, (2.0, 0.0, 500.0), 0.0)
        expect(submission.penalty_rest_depth, (0.0, 8.0, 500.0), 0.0)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.penalty_rest_depth, depth, floors)


@asks("penalty_step_limit", 4, "At the limit the matrix of one step has the eigenvalue −1.")
def test_at_the_limit_a_step_has_the_eigenvalue_minus_one(submission, part, examples):
    def limit(m, k, c=0.0):
        # 1 + trace + determinant = 0 of [[1 − ω²Δt², Δt(1 − 2ζωΔt)], [−ω²Δt, 1 − 2ζωΔt]], with 2ζω = c/m
        return float(max(np.roots([-k / m, -2 * c / m, 4.0]).real))

    def contacts(draw):
        return draw.number(0.2, 5), draw.number(50, 900), draw.number(1, 60)

    with part(2, "any contact"):
        examples.agree(submission.penalty_step_limit, limit, contacts)
    with part(1, "no damping, critical, far more than that"):
        expect(submission.penalty_step_limit, (4.0, 100.0), 0.4)
        for c in (0.0, 20.0, 200.0):
            expect(submission.penalty_step_limit, (1.0, 100.0, c), limit(1.0, 100.0, c))
        expect(submission.penalty_step_limit, (1.0, 1.0, 1e6), 2e-6)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.penalty_step_limit, limit, contacts)
