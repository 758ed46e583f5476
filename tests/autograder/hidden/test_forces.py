"""Gravity, springs, viscosity, wind, and their sum: drawn examples, limits, all sizes, many at once."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers, plainly, refuse_changes
from labs.grading.judging.markers import asks

REST = [0.0, 0.0, 0.0]
HERE, THERE = [0.5, 2.0, -1.0], [2.5, 1.0, 1.0]
G = 6.67430e-11
"""The lab's constant of gravity, N m²/kg²."""


def length(v):
    """‖v‖."""
    return math.sqrt(v @ v)


def of_all_sizes(function, formula, case, *groups):
    """Require the right answer with some of the arguments, by place, a million times as small or as large."""
    for places in groups:
        for size in (1e-6, 1e6):
            given = tuple(size * each if at in places else each for at, each in enumerate(plainly(*case)))
            expect(function, given, formula(*given))


@asks("explicit_euler", 4, "p + v dt and v + a dt, with v and a of the start.")
def test_explicit_euler_takes_everything_from_the_start(submission, part, examples):
    def step(p, v, a, dt):
        return p + v * dt, v + a * dt

    def bodies(draw):
        return draw.vector(), draw.vector(), draw.vector(9), draw.number(0.1, 2)

    with part(1, "any body"):
        examples.agree(submission.explicit_euler, step, bodies)
    with part(1, "at rest, nothing pushes, no time passes, time runs back; slow and fast, short and long"):
        for case in ((REST, [1, 2, 3], REST, 0.5), ([1, 2, 3], REST, [0, 0, -8], 0.5), (HERE, THERE, THERE, 0.0),
                     (HERE, [1, 2, 3], [0, 0, -8], -0.5)):  # fmt: skip
            expect(submission.explicit_euler, case, step(*plainly(*case)))
        slow = (REST, [1, -2, 3], REST, 0.5), (0,), (0, 1), (3,)
        of_all_sizes(submission.explicit_euler, step, *slow)
        of_all_sizes(submission.explicit_euler, step, (HERE, [1, -2, 3], [0, 4, -8], 0.5), (0, 1, 2))
        of_all_sizes(submission.explicit_euler, step, (HERE, REST, [0, 4, -8], 0.5), (3,), (0, 2))
    with part(1, "the energy of an undamped spring grows by ω² dt² in a step"):

        def grows(place, velocity, frequency, dt):
            p, v = numbers(submission.explicit_euler, (place, velocity, -(frequency**2) * place, dt), 2)
            energies = (
                frequency**2 * np.sum(np.square(x)) + np.sum(np.square(u)) for x, u in ((place, velocity), (p, v))
            )
            before, after = map(float, energies)
            np.testing.assert_allclose(after / before, 1 + (frequency * dt) ** 2, rtol=1e-4)  # single precision

        examples.every(lambda draw: (draw.vector(), draw.vector(), draw.number(0.5, 3), draw.number(0.1, 1)), grows)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.explicit_euler, step, bodies)


def pull(m_1, m_2, x_1, x_2, softening=0.0):
    """Newton's gravity, softened."""
    d = x_2 - x_1
    r = math.hypot(length(d), softening)
    return G * m_1 * m_2 * d / r**3 if r else np.zeros(3)


@asks("universal_gravity", 4, "G m1 m2 (x2 − x1)/r³ with r² = ‖x2 − x1‖² + ε².")
def test_gravity_pulls_with_the_square_of_the_distance(submission, part, examples):
    def pairs(draw):
        heavy = 1e10 * draw.number(0.5, 3)
        return draw.number(0.5, 4), heavy, draw.vector(), draw.vector(), draw.number(0.1, 3)

    with part(1, "any pair"):
        examples.agree(submission.universal_gravity, pull, pairs, far=2)
    with part(2, "points; softened; without mass; at the same place; of all sizes"):
        for case in ((2.0, 3e10, HERE, THERE), (2.0, 3e10, THERE, HERE, 0.0), (0.0, 3e10, HERE, THERE),
                     (2.0, 0.0, HERE, THERE, 0.5), (3e10, 2e10, HERE, THERE, 0.5), (2.0, 3e10, HERE, HERE),
                     (2.0, 3e10, HERE, HERE, 0.5), (2.0, 3e10, REST, [0, 0, -4], 3.0)):  # fmt: skip
            expect(submission.universal_gravity, case, pull(*plainly(*case)))
        of_all_sizes(submission.universal_gravity, pull, (2.0, 3e10, HERE, THERE, 0.5), (0,), (2, 3, 4))
        of_all_sizes(submission.universal_gravity, pull, (3e10, 2.0, HERE, THERE, 0.5), (1,))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.universal_gravity, pull, pairs)


def spring(x_1, x_2, v_1, v_2, stiffness, rest_length, damping):
    """A spring with a damper beside it, on its end 1."""
    d = x_1 - x_2
    long = length(d)
    u = d / long if long else d
    return -(stiffness * (long - rest_length) + damping * ((v_1 - v_2) @ u)) * u


@asks("spring_damper_force", 5, "−k (L − L0) u − c ((v1 − v2)·u) u with u from end 2 to end 1.")
def test_springs_and_dampers_act_along_their_line(submission, part, examples):
    def springs(draw):
        ends = (draw.vector() for _ in range(4))
        return *ends, draw.number(1, 9), draw.number(0.5, 6), draw.number(0.2, 4)

    with part(2, "any spring"):
        examples.agree(submission.spring_damper_force, spring, springs, far=2)
    with part(1, "at rest length, of no length, without rest length, one part alone, across and along, of all sizes"):
        moving = [1, 3, -2], [0, 1, 2]
        for case in ((HERE, THERE, REST, REST, 6.0, 3.0, 0.5), (HERE, HERE, *moving, 6.0, 3.0, 0.5),
                     (HERE, THERE, *moving, 6.0, 0.0, 0.5), (HERE, THERE, *moving, 0.0, 2.0, 0.5),
                     (HERE, THERE, *moving, 6.0, 2.0, 0.0), (HERE, THERE, [1, 2, 0], REST, 0.0, 2.0, 0.5),
                     (HERE, HERE, *moving, 6.0, 0.0, 0.5), (HERE, THERE, [4, 4, 4], [4, 4, 4], 6.0, 9.0, 0.5),
                     (HERE, THERE, [4, -2, 4], REST, 6.0, 3.0, 0.5)):  # fmt: skip
            expect(submission.spring_damper_force, case, spring(*plainly(*case)))
        still = HERE, THERE, REST, REST, 6.0, 2.0, 0.5
        of_all_sizes(submission.spring_damper_force, spring, still, (0, 1, 5), (4,))
        slack = HERE, THERE, *moving, 0.0, 2.0, 0.5
        of_all_sizes(submission.spring_damper_force, spring, slack, (2, 3), (6,))
    with part(1, "no force on a spring that flies and turns as a whole"):

        def rigid(x, arm, velocity, spin):
            ends = x + arm, x - arm
            moving = velocity + np.cross(spin, arm), velocity - np.cross(spin, arm)
            size = 2 * length(arm)
            force = numbers(submission.spring_damper_force, (*ends, *moving, 5.0, size, 2.0))
            assert np.max(np.abs(force)) <= 1e-4 * (size + length(moving[0])), f"it feels {force.round(4)}"

        examples.every(lambda draw: tuple(draw.vector() for _ in range(4)), rigid, count=4)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.spring_damper_force, spring, springs)


@asks("spring_step_limit", 4, "The step at which one of the two factors of a step has the size 1.")
def test_at_the_limit_a_step_neither_grows_nor_dies(submission, part, examples):
    def limits(k, m, c):
        """Each limit is where the largest eigenvalue of one step has the size 1."""
        if c * c <= 4 * k * m:
            return c / k, (math.sqrt(c * c + 4 * k * m) - c) / k
        return 4 * m / (c + math.sqrt(c * c - 4 * k * m)), 4 * m / (c + math.sqrt(c * c + 4 * k * m))

    def springs(draw):
        return draw.number(0.5, 9), draw.number(0.5, 9), draw.number(0.1, 20)

    with part(2, "any spring, with any damper"):
        examples.agree(submission.spring_step_limit, limits, springs, count=20)
    with part(1, "no damper, critical, just below and above, one part of each, of all sizes"):
        for case in (
            *((8.0, 2.0, damping) for damping in (0.0, 0.01, 7.9, 8.0, 8.1, 40.0)),
            *((1.0, 1.0, damping) for damping in (1.0, 3.0)), (0.5, 8.0, 3.0), (16.0, 1.0, 9.0),
        ):  # fmt: skip
            expect(submission.spring_step_limit, case, limits(*case))
        for damping in (0.3, 12.0):
            of_all_sizes(submission.spring_step_limit, limits, (8.0, 2.0, damping), (0, 1, 2))
        expect(submission.spring_step_limit, (8e6, 2e-6, 3.0), limits(8e6, 2e-6, 3.0))
        expect(submission.spring_step_limit, (8e-6, 2e6, 3.0), limits(8e-6, 2e6, 3.0))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.spring_step_limit, limits, springs)


@asks("stokes_drag", 3, "−6π η r (v − u).")
def test_stokes_drag_is_proportional_to_the_relative_velocity(submission, part, examples):
    def drag(v, u, eta, r):
        return -6 * math.pi * eta * r * (v - u)

    def balls(draw):
        return draw.vector(), draw.vector(), draw.number(0.1, 3), draw.number(0.1, 2)

    with part(1, "any ball"):
        examples.agree(submission.stokes_drag, drag, balls)
    with part(1, "drifting along, at rest, without a fluid or a ball, of all sizes"):
        for case in ((HERE, HERE, 0.5, 0.1), (REST, THERE, 0.5, 0.1), (HERE, THERE, 0.0, 0.1), (HERE, THERE, 0.5, 0.0)):
            expect(submission.stokes_drag, case, drag(*plainly(*case)))
        of_all_sizes(submission.stokes_drag, drag, (HERE, THERE, 0.5, 0.1), (0, 1), (2,), (3,))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.stokes_drag, drag, balls)


@asks("terminal_velocity", 4, "2 (ρ_s − ρ_f) r² g/(9 η).")
def test_the_steady_fall_counts_what_the_ball_displaces(submission, part, examples):
    def fall(r, dense, fluid, eta, g):
        return 2 * (dense - fluid) * r**2 * g / (9 * eta)

    def balls(draw):
        # slow enough for Stokes' drag: the Reynolds number is below 0.1
        return draw.number(0.1, 0.9), draw.number(1, 9), draw.number(0.5, 4), draw.number(40, 90), draw.vector()

    with part(2, "any ball"):
        examples.agree(submission.terminal_velocity, fall, balls)
    with part(1, "a bubble, one that floats, no fluid to speak of, no gravity, of all sizes"):
        down = np.array([1.0, 2.0, -8.0])
        for case in ((0.5, 0.0, 2.0, 30.0, down), (0.5, 2.0, 2.0, 30.0, down), (0.5, 2.0, 0.0, 3.0, down),
                     (0.5, 2.0, 1.0, 3.0, 0 * down), (5e-7, 5.0, 2.0, 3.0, down), (5e5, 5e-6, 2e-6, 3e6, down),
                     (5e-7, 5e6, 2e6, 3.0, down), (5e-4, 5.0, 2.0, 3e-6, 1e-6 * down),
                     (5e-4, 5.0, 2.0, 300.0, 1e6 * down)):  # fmt: skip
            expect(submission.terminal_velocity, case, fall(*case))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.terminal_velocity, fall, balls)


@asks("wind_force", 3, "−½ ρ C A ‖v − w‖ (v − w).")
def test_wind_acts_through_the_relative_velocity(submission, part, examples):
    def wind_on(v, w, area, coefficient, density):
        return -0.5 * density * coefficient * area * length(v - w) * (v - w)

    def bodies(draw):
        return draw.vector(), draw.vector(), draw.number(0.2, 3), draw.number(0.2, 2), draw.number(0.3, 2)

    with part(1, "any body"):
        examples.agree(submission.wind_force, wind_on, bodies, far=2)
    with part(1, "drifting along, in still air, no air, no area, of all sizes"):
        for case in ((HERE, HERE, 0.5, 0.4, 1.2), (HERE, REST, 0.5, 0.4, 1.2), (REST, THERE, 0.5, 0.4, 1.2),
                     (HERE, THERE, 0.0, 0.4, 1.2), (HERE, THERE, 0.5, 0.4, 0.0)):  # fmt: skip
            expect(submission.wind_force, case, wind_on(*plainly(*case)))
        of_all_sizes(submission.wind_force, wind_on, (HERE, THERE, 0.5, 0.4, 1.2), (0, 1), (2,), (4,))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.wind_force, wind_on, bodies)


def total(position, velocity, mass, radius, gravity, viscosity, stream, ends, stiffness, rest_length, damping):
    """Ball after ball: its weight, its drag, and all springs at one of whose ends it is."""
    count = len(position)
    weights = np.reshape(mass, (count, 1)) * gravity
    drags = 6 * math.pi * viscosity * np.reshape(radius, (count, 1)) * (stream - velocity)
    pulls = np.zeros((count, 3))
    for at, (first, second) in enumerate(ends):
        numbers = stiffness[at], rest_length[at], damping[at]
        for one, other in ((first, second), (second, first)):
            pulls[one] += spring(position[one], position[other], velocity[one], velocity[other], *numbers)
    return weights + drags + pulls


CORNERS = np.array([[0.0, 0, 0], [1, 2, 2], [3, 0, 1], [-1, 1, 4]])
SPEEDS = np.array([[1.0, 0, 0], [0, -1, 2], [3, 1, 0], [0, 0, 2]])
BALLS = CORNERS, SPEEDS, np.array([2.0, 1, 0.5, 3]), np.array([0.5, 0.2, 0.1, 0.4])
STAR = np.array([[0, 1], [0, 2], [3, 0]]), np.array([4.0, 6, 9]), np.array([2.0, 2, 3]), np.array([0.5, 1, 2])
NONE = np.zeros((0, 2), dtype=int), np.zeros(0), np.zeros(0), np.zeros(0)


@asks("total_force", 5, "Weight, drag, and the pull of every spring at both of its ends.")
def test_every_force_is_counted_once_at_each_body(submission, part, examples):
    def scenes(draw):
        rows = (np.array([draw.vector() for _ in range(5)]) for _ in range(3))
        position, velocity, stream = rows
        balls = (np.array([draw.number(0.3, 3) for _ in range(5)]) for _ in range(2))
        ends = np.array([draw.rng.permutation(5)[:2] for _ in range(6)])
        springs = (np.array([draw.number(0.5, 6) for _ in range(6)]) for _ in range(3))
        return position, velocity, *balls, draw.vector(9), draw.number(0.05, 0.4), stream, ends, *springs

    with part(2, "any scene"):
        examples.agree(submission.total_force, total, scenes, count=6)
    with part(2, "no springs, one ball, one spring twice, a star, a stream everywhere, of all sizes"):
        down, stream = np.array([1.0, 0, -8]), np.array([1.0, -2, 0.5])
        twice = tuple(np.repeat(each[:1], 2, axis=0) for each in STAR)
        for case in ((*BALLS, down, 0.3, stream, *NONE), (*(each[:1] for each in BALLS), down, 0.3, stream, *NONE),
                     (*BALLS, 0 * down, 0.0, stream, *twice), (*BALLS, 0 * down, 0.0, stream, *STAR),
                     (*BALLS, down, 0.3, stream, *STAR)):  # fmt: skip
            expect(submission.total_force, case, total(*case))
        weights = (CORNERS, 0 * SPEEDS, *BALLS[2:], down, 0.0, 0 * stream, *NONE)
        of_all_sizes(submission.total_force, total, weights, (2,), (4,))
        drags = (*BALLS, 0 * down, 0.3, stream, *NONE)
        of_all_sizes(submission.total_force, total, drags, (1, 6), (3,), (5,))
        ends, stiffness, rest, damping = STAR
        springs = (CORNERS, 0 * SPEEDS, *BALLS[2:], 0 * down, 0.0, 0 * stream, ends, stiffness, rest, damping)
        of_all_sizes(submission.total_force, total, springs, (0, 9), (8,))
        dampers = (*BALLS, 0 * down, 0.0, 0 * stream, ends, 0 * stiffness, rest, damping)
        of_all_sizes(submission.total_force, total, dampers, (1,), (10,))
    with part(1, "a scene gains momentum only by weights and drags, and its arrays are left as they were"):

        def outside(*given):
            _, velocity, mass, radius, gravity, viscosity, stream, *_ = given
            force = numbers(submission.total_force, given)
            pushed = mass[:, None] * gravity + 6 * math.pi * viscosity * radius[:, None] * (stream - velocity)
            size = np.max(np.abs(force)) + np.max(np.abs(pushed))
            assert np.max(np.abs(np.sum(force - pushed, axis=0))) <= 1e-4 * size
            refuse_changes(submission.total_force)

        examples.every(scenes, outside, count=3)
