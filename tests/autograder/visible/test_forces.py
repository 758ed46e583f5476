"""Gravity, springs, viscosity, wind, and their sum (slides 23 and 25 to 30): examples that a student sees."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.calling.scenario_runs import compared_with_theory, with_solutions
from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

REST = [0.0, 0.0, 0.0]
HERE, THERE = [1.0, -2.0, 3.0], [3.0, 1.0, 9.0]
"""Two places that are 7 m apart: from the first to the second it is (2, 3, 6) m."""
G = 6.67430e-11
HEAVY = 1 / G
"""A mass, kg, that pulls 1 kg from 1 m away with 1 N."""
THICK = 1 / (6 * math.pi)
"""A viscosity, Pa s, in which a ball of radius 1 m feels 1 N at 1 m/s."""


@asks(
    "explicit_euler",
    3,
    "Position and velocity change with the velocity and the acceleration that there were at the start of the step.",
    "Which velocity moves the body during the step: the one at its start or the one at its end?",
)
def test_a_step_uses_what_there_was_at_its_start(submission, part):
    with part(2, "thrown; along no axis; at rest; a step of no length; a long step, tiny and huge things"):
        expect(submission.explicit_euler, (REST, [3, 0, 4], [0, 0, -10], 0.5), ([1.5, 0, 2], [3, 0, -1]))
        expect(submission.explicit_euler, (HERE, [2, 1, -4], [6, -8, 2], 0.25), ([1.5, -1.75, 2], [3.5, -1, -3.5]))
        expect(submission.explicit_euler, (HERE, REST, [6, -8, 2], 0.5), (HERE, [3, -4, 1]))
        expect(submission.explicit_euler, (HERE, [2, 1, -4], [6, -8, 2], 0.0), (HERE, [2, 1, -4]))
        expect(submission.explicit_euler, (HERE, [-2, 1, 4], [1, -3, 2], 2.0), ([-3, 0, 11], [0, -5, 8]))
        expect(submission.explicit_euler, (REST, [4, -2, 1], [2, 2, -6], 5e-6), ([2e-5, -1e-5, 5e-6], [4, -2, 1]))
        found = ([2.5e5, -1e5, 1e5], [5e5, -1.2e6, 8e5])
        expect(submission.explicit_euler, ([0, 1e5, -1e5], [5e5, -4e5, 4e5], [0, -1.6e6, 8e5], 0.5), found)
    with part(1, "two bodies in one call"):
        found = ([[1.5, 0, 2], [1.5, -1.75, 2]], [[3, 0, -1], [3.5, -1, -3.5]])
        given = ([REST, HERE], [[3, 0, 4], [2, 1, -4]], [[0, 0, -10], [6, -8, 2]], [0.5, 0.25])
        expect(submission.explicit_euler, given, found)


@asks(
    "universal_gravity",
    4,
    "Body 2 pulls body 1 towards itself, less and less with the square of the distance.",
    "Slide 25 gives the size. Which vector points from body 1 to body 2, and how long is it?",
)
def test_the_pull_points_to_the_other_body(submission, part):
    with part(2, "along an axis, along none, in the other direction; the Earth; tiny and huge distances"):
        expect(submission.universal_gravity, (2.0, 3 * HEAVY, REST, [0, 2, 0]), [0, 1.5, 0])
        expect(submission.universal_gravity, (2.0, 3 * HEAVY, HERE, THERE), [12 / 343, 18 / 343, 36 / 343])
        expect(submission.universal_gravity, (7 * HEAVY, 0.5, THERE, HERE), [-7 / 343, -10.5 / 343, -21 / 343])
        earth = (70.0, 5.9722e24, [0, 0, 6.371e6], REST)
        expect(submission.universal_gravity, earth, [0, 0, -687.4211605])  # 9.820 m/s² times 70 kg
        expect(
            submission.universal_gravity, (2.0, HEAVY, REST, [2e-6, 3e-6, 6e-6]), [4e12 / 343, 6e12 / 343, 12e12 / 343]
        )
        expect(submission.universal_gravity, (2e-6, 1e12 * HEAVY, REST, [0, 0, -1e6]), [0, 0, -2e-6])
    with part(1, "softened; at the same place"):
        expect(submission.universal_gravity, (2.0, 3 * HEAVY, HERE, THERE, 24.0), [12 / 15625, 18 / 15625, 36 / 15625])
        expect(submission.universal_gravity, (2.0, HEAVY, [0, 3, 0], REST, 4.0), [0, -6 / 125, 0])
        expect(submission.universal_gravity, (2.0, HEAVY, [0, 3e-6, 0], REST, 4e-6), [0, -6e12 / 125, 0])
        expect(submission.universal_gravity, (2.0, HEAVY, HERE, HERE, 0.5), REST)
        expect(submission.universal_gravity, (2.0, HEAVY, HERE, HERE), REST)
    with part(1, "two pairs in one call"):
        given = ([2.0, 3.0], HEAVY, [REST, HERE], [[0, 2, 0], THERE])
        expect(submission.universal_gravity, given, [[0, 0.5, 0], [6 / 343, 9 / 343, 18 / 343]])


@asks(
    "spring_damper_force",
    5,
    "A stretched spring pulls its ends together; a damper opposes the change of its length, and nothing else.",
    "Slides 27 and 29. Pull a ball away from the wall. Which way does the spring pull it? When does the length change?",
)
def test_spring_and_damper_pull_along_the_line_between_their_ends(submission, part, examples):
    still = (REST, REST)
    with part(2, "the spring: stretched, compressed, at its rest length, without one, of no length; small and large"):
        expect(submission.spring_damper_force, ([3, 0, 0], REST, *still, 4.0, 1.0, 0.0), [-8, 0, 0])
        expect(submission.spring_damper_force, ([0, 0, 2], [0, 0, 5], *still, 2.0, 4.0, 0.0), [0, 0, -2])
        expect(submission.spring_damper_force, (HERE, THERE, *still, 14.0, 5.0, 0.5), [8, 12, 24])
        expect(submission.spring_damper_force, (HERE, THERE, *still, 14.0, 8.0, 0.5), [-4, -6, -12])
        expect(submission.spring_damper_force, (HERE, THERE, *still, 14.0, 7.0, 0.5), REST)
        expect(submission.spring_damper_force, (HERE, THERE, *still, 3.0, 0.0, 0.0), [6, 9, 18])
        expect(submission.spring_damper_force, (HERE, HERE, [1, 2, 3], REST, 14.0, 5.0, 0.5), REST)
        expect(submission.spring_damper_force, ([3e-6, 0, 4e-6], REST, *still, 10.0, 4e-6, 0.0), [-6e-6, 0, -8e-6])
        expect(submission.spring_damper_force, ([3e6, 0, 4e6], REST, *still, 10.0, 4e6, 0.0), [-6e6, 0, -8e6])
    with part(1, "the damper: it is lengthened and shortened, by either end; it flies and turns as a whole"):
        slack = (0.0, 5.0, 2.0)
        expect(submission.spring_damper_force, ([2, 0, 0], REST, [3, 0, 0], REST, *slack), [-6, 0, 0])
        expect(submission.spring_damper_force, ([2, 0, 0], REST, REST, [3, 0, 0], *slack), [6, 0, 0])
        expect(submission.spring_damper_force, (HERE, THERE, [5, 1, 1], [-2, 1, 1], *slack), [-8 / 7, -12 / 7, -24 / 7])
        expect(submission.spring_damper_force, (HERE, THERE, [0, 1, 0], [0, 1, 3.5], *slack), [12 / 7, 18 / 7, 36 / 7])
        expect(submission.spring_damper_force, (HERE, THERE, [4, 2, -9], [4, 2, -9], *slack), REST)
        expect(submission.spring_damper_force, (HERE, THERE, [3, 1, 0], [0, 3, 0], *slack), REST)  # across it
        expect(submission.spring_damper_force, ([0, 2, 0], REST, [0, 3e-6, 0], REST, *slack), [0, -6e-6, 0])
        expect(submission.spring_damper_force, ([0, 2, 0], REST, [0, 3e6, 0], REST, *slack), [0, -6e6, 0])
    with part(1, "both together; exchange the ends, and the force is the opposite"):
        expect(submission.spring_damper_force, (HERE, THERE, [5, 1, 1], [-2, 1, 1], 14.0, 5.0, 3.5), [6, 9, 18])
        expect(submission.spring_damper_force, (HERE, THERE, [-2, 1, 4], [5, 1, 4], 14.0, 8.0, 7.0), REST)

        def opposite(one, other, moving, still, stiffness, rest, damping):
            here = numbers(submission.spring_damper_force, (one, other, moving, still, stiffness, rest, damping))
            there = numbers(submission.spring_damper_force, (other, one, still, moving, stiffness, rest, damping))
            off = np.max(np.abs(here + there))
            assert off <= 1e-4 * np.max(np.abs(here), initial=1e-9), f"{here.round(4)} here, {there.round(4)} there"

        def springs(draw):
            return *(draw.vector() for _ in range(4)), draw.number(1, 9), draw.number(0, 4), draw.number(0.1, 3)

        examples.every(springs, opposite)
    with part(1, "two springs in one call"):
        given = ([[3, 0, 0], HERE], [REST, THERE], REST, REST, [4.0, 14.0], [1.0, 5.0], 0.0)
        expect(submission.spring_damper_force, given, [[-8, 0, 0], [8, 12, 24]])


@asks(
    "spring_step_limit",
    4,
    "Beyond the limit the size of the motion grows with every step.",
    "Put one step of each method into a spring with a damper. By which factor does the motion grow?",
)
def test_beyond_the_limit_a_swing_grows(submission, part):
    with part(2, "a weak damper, a strong one, none, and one that just ends the swinging"):
        expect(submission.spring_step_limit, (2.0, 3.0, 1.0), (0.5, 2.0))
        expect(submission.spring_step_limit, (2.0, 3.0, 5.0), (2.0, 1.0))
        expect(submission.spring_step_limit, (9.0, 4.0, 0.0), (0.0, 4 / 3))
        expect(submission.spring_step_limit, (4.0, 1.0, 4.0), (1.0, math.sqrt(2) - 1))
        expect(submission.spring_step_limit, (5.0, 2.0, 3.0), (0.6, 0.8))
    with part(1, "heavy or light, stiff or soft"):
        expect(submission.spring_step_limit, (8.0, 0.75, 2.0), (0.25, 3 / 7.29150262))
        expect(submission.spring_step_limit, (2e-6, 3e-6, 5e-6), (2.0, 1.0))
        expect(submission.spring_step_limit, (2e6, 3e6, 1e6), (0.5, 2.0))
        expect(submission.spring_step_limit, (2e6, 3e-6, 1.0), (5e-7, 2e-6))
    with part(1, "two springs in one call"):
        expect(submission.spring_step_limit, ([2.0, 9.0], [3.0, 4.0], [5.0, 0.0]), ([2.0, 0.0], [1.0, 4 / 3]))


@asks(
    "stokes_drag",
    3,
    "A thick fluid drags a ball against its motion through the fluid, in proportion to speed, viscosity and radius.",
    "Slide 26. A leaf drifts along with a river. What drags it?",
)
def test_a_thick_fluid_drags_a_ball_along(submission, part):
    with part(2, "in still honey; drifting along; in a stream; small and large"):
        expect(submission.stokes_drag, ([3, -1, 2], REST, THICK, 1.0), [-3, 1, -2])
        expect(submission.stokes_drag, ([3, -1, 2], [3, -1, 2], THICK, 1.0), REST)
        expect(submission.stokes_drag, ([3, -1, 2], [1, 1, 6], 4 * THICK, 0.5), [-4, 4, 8])
        expect(submission.stokes_drag, (REST, [1, -2, 3], 2 * THICK, 3.0), [6, -12, 18])
        expect(submission.stokes_drag, ([0, 0, 2], REST, 1.0, 0.1), [0, 0, -3.769911184])
        expect(submission.stokes_drag, ([3e-6, 0, 1e-6], [1e-6, 0, 0], THICK, 2.0), [-4e-6, 0, -2e-6])
        expect(submission.stokes_drag, ([3e6, 0, 1e6], [1e6, 0, 0], THICK, 2.0), [-4e6, 0, -2e6])
        expect(submission.stokes_drag, ([0, 3, 0], REST, 1e6 * THICK, 2e-6), [0, -6, 0])
        expect(submission.stokes_drag, ([0, 3, 0], REST, 1e-6 * THICK, 2e6), [0, -6, 0])
    with part(1, "two balls in one call"):
        given = ([[3, -1, 2], REST], [REST, [1, -2, 3]], THICK, [1.0, 6.0])
        expect(submission.stokes_drag, given, [[-3, 1, -2], [6, -12, 18]])


@asks(
    "terminal_velocity",
    3,
    "In a steady fall the drag balances the weight of the ball less that of the fluid that it displaces.",
    "Slide 26 forgets one force. Which one makes a bubble rise?",
)
def test_a_steady_fall_balances_all_three_forces(submission, part):
    down = [0.0, 0.0, -10.0]
    with part(2, "a ball sinks, a bubble rises, a fish floats; where down is elsewhere; small and large"):
        expect(submission.terminal_velocity, (0.3, 5.0, 2.0, 50.0, down), [0, 0, -0.012])
        expect(submission.terminal_velocity, (0.3, 0.0, 2.0, 50.0, down), [0, 0, 0.008])
        expect(submission.terminal_velocity, (0.3, 2.0, 2.0, 50.0, down), REST)
        expect(submission.terminal_velocity, (0.6, 5.0, 0.0, 40.0, [3, -6, 2]), [0.03, -0.06, 0.02])
        expect(submission.terminal_velocity, (0.3, 2.0, 7.0, 10.0, [3, -6, 2]), [-0.03, 0.06, -0.02])
        expect(submission.terminal_velocity, (3e-6, 5e6, 2e6, 0.5, down), [0, 0, -1.2e-4])
        expect(submission.terminal_velocity, (3e5, 5e-6, 2e-6, 5e6, down), [0, 0, -0.12])
        expect(submission.terminal_velocity, (3e-4, 5.0, 2.0, 5e-6, [3e-6, 0, 4e-6]), [3.6e-8, 0, 4.8e-8])
        expect(submission.terminal_velocity, (3e-4, 5.0, 2.0, 500.0, [0, 3e6, 0]), [0, 3.6e-4, 0])
    with part(1, "two balls in one call"):
        found = [[0, 0, -0.012], [0, 0, 0.008]]
        expect(submission.terminal_velocity, (0.3, [5.0, 0.0], 2.0, 50.0, down), found)


@asks(
    "wind_force",
    3,
    "The wind pushes along its velocity relative to the body, with the square of the relative speed.",
    "Slide 30. You cycle as fast as the wind blows, in its direction. What do you feel?",
)
def test_wind_pushes_with_the_square_of_the_relative_speed(submission, part):
    with part(2, "against the wind, with it, across it; faster, larger, denser; small and large"):
        expect(submission.wind_force, (REST, [2, 0, 0], 1.0, 0.5, 1.0), [1, 0, 0])
        expect(submission.wind_force, ([2, 0, 0], REST, 1.0, 0.5, 1.0), [-1, 0, 0])
        expect(submission.wind_force, ([3, -4, 1], [3, -4, 1], 1.0, 0.5, 1.0), REST)
        expect(submission.wind_force, ([1, -2, 3], [3, 1, 9], 2.0, 0.25, 1.2), [4.2, 6.3, 12.6])
        expect(submission.wind_force, ([5, 1, 3], [3, 4, -3], 0.5, 2.0, 3.0), [-21, 31.5, -63])
        expect(submission.wind_force, (REST, [4, 6, 12], 1.0, 1.0, 1.0), [28, 42, 84])
        expect(submission.wind_force, ([0, 1e-6, 0], [0, 3e-6, 4e-6], 2.0, 2.0, 5e9), [0, 0.0894427191, 0.178885438])
        expect(submission.wind_force, ([0, 1e6, 0], [0, 4e6, 4e6], 2e-6, 2.0, 1e-6), [0, 30, 40])
        expect(submission.wind_force, (REST, [0, 2, 0], 1e6, 0.5, 1e-6), [0, 1, 0])
    with part(1, "two bodies in one call"):
        given = ([[2, 0, 0], [1, -2, 3]], [REST, [3, 1, 9]], [1.0, 2.0], [0.5, 0.25], [1.0, 1.2])
        expect(submission.wind_force, given, [[-1, 0, 0], [4.2, 6.3, 12.6]])


PLACES = [[1.0, -2.0, 3.0], [3.0, 1.0, 9.0], [3.0, 1.0, 13.0], [0.0, -4.0, 1.0]]
SPEEDS = [[5.0, 1.0, 1.0], [-2.0, 1.0, 1.0], [-2.0, 1.0, 4.0], [0.0, 0.0, 2.0]]
MASSES, RADII = [2.0, 1.0, 0.5, 3.0], [0.5, 1.0, 2.0, 0.25]
DOWN = [1.0, -2.0, -10.0]


@asks(
    "total_force",
    5,
    "Forces add up: a ball has its weight, its drag, and the pull of each of its springs; both ends are pulled.",
    "Slide 30. Make a list of everything that acts on the second ball. What does Newton's third law say of a spring?",
)
def test_all_forces_on_a_ball_add_up(submission, part, examples):
    none = (np.zeros((0, 2), dtype=int), np.zeros(0), np.zeros(0), np.zeros(0))
    springs = (np.array([[0, 1], [1, 2], [3, 0]]), [14.0, 3.0, 6.0], [5.0, 6.0, 2.0], [7.0, 0.5, 1.8])
    with part(1, "weights and drags, without a spring"):
        stream = [[6.0, 2.0, 0.0], [2.0, 0.0, -1.0], [1.0, 11.0, -5.0], [0.0, 0.0, 0.0]]
        weights = [[2, -4, -20], [1, -2, -10], [0.5, -1, -5], [3, -6, -30]]
        expect(submission.total_force, (PLACES, SPEEDS, MASSES, RADII, DOWN, 0.0, REST, *none), weights)
        found = [[3, -3, -21], [9, -4, -14], [12.5, 39, -41], [3, -6, -31]]
        expect(submission.total_force, (PLACES, SPEEDS, MASSES, RADII, DOWN, 2 * THICK, stream, *none), found)
    with part(2, "springs alone: both ends are pulled, and a ball has all of its springs"):
        free = (PLACES, SPEEDS, MASSES, RADII, REST, 0.0, REST)
        one = (np.array([[0, 1]]), [14.0], [5.0], [3.5])
        expect(submission.total_force, (*free, *one), [[6, 9, 18], [-6, -9, -18], REST, REST])
        other_way = (np.array([[1, 0]]), [14.0], [5.0], [3.5])
        expect(submission.total_force, (*free, *other_way), [[6, 9, 18], [-6, -9, -18], REST, REST])
        found = [[1, 0, 6], [-4, -6, -16.5], [0, 0, 4.5], [3, 6, 6]]
        expect(submission.total_force, (*free, *springs), found)
        twice = tuple(np.concatenate([each, each]) for each in springs)
        expect(submission.total_force, (*free, *twice), 2 * np.array(found))
        together = ([HERE, HERE], [REST, [1, 2, 3]], [2.0, 1.0], [0.5, 1.0], REST, 0.0, REST)
        expect(submission.total_force, (*together, *one), [REST, REST])
    with part(1, "everything together"):
        given = (PLACES, SPEEDS, MASSES, RADII, DOWN, 2 * THICK, [1.0, 1.0, 3.0], *springs)
        expect(submission.total_force, given, [[-1, -4, -12], [3, -8, -22.5], [12.5, -1, -4.5], [6.5, 0.5, -23.5]])
    with part(1, "springs push and pull no scene as a whole"):

        def balanced(position, velocity, stiffness, rest, damping):
            ends = np.array([[0, 1], [2, 1], [1, 3], [3, 0]])
            still = (np.ones(4), np.ones(4), np.zeros(3), 0.0, np.zeros(3))
            force = numbers(submission.total_force, (position, velocity, *still, ends, stiffness, rest, damping))
            gained = np.sum(force, axis=0)
            assert np.max(np.abs(gained)) <= 1e-4 * np.max(np.abs(force)), f"all together get {gained.round(4)} N"

        def scenes(draw):
            rows = (np.array([draw.vector() for _ in range(4)]) for _ in range(2))
            return *rows, *(np.array([draw.number(0.5, 4) for _ in range(4)]) for _ in range(3))

        examples.every(scenes, balanced)


@asks("terminal_velocity", 1, "Balls in a thick fluid sink as in every engine.")
def test_balls_sink_as_fast_as_theory_says(submission, part):
    code = with_solutions(submission, "forces")
    with part(1, "two balls in syrup"):
        compared_with_theory(code, "sinking-ball", ("m=4.3,η=200", "m=2,η=200"), ("speed", "height"))
