"""Bouncing off a plane (slides 6, 7 and 8): examples that a student sees."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.calling.scenario_runs import compared_with_theory, with_solutions
from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

UP, REST = [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]
FALL = [0.0, 0.0, -8.0]
SLANTED = [-1 / 3, 2 / 3, 2 / 3]
"""The unit normal of a plane that lies along no axis: n·(−1, −4, −1) = −3."""
PRESSED = [1.0, -4.0, 0.0]
"""An acceleration of 3 m/s² onto that plane, and some along it."""
INFINITY = math.inf


@asks(
    "kinematic_response", 6,
    "A bounce turns the normal part of the velocity round and leaves e of it, as seen from the plane.",
    "Slide 7 is the bounce with e = 1, off a plane at rest. What should become of a body that moves away already? And"
    " when the plane moves: sit on it. Which velocity do you see before the bounce, and which after it?",
)  # fmt: skip
def test_a_bounce_turns_the_normal_part_and_leaves_the_other(submission, part, examples):
    with part(1, "down on a floor, and against a plane along no axis"):
        expect(submission.kinematic_response, ([3, 0, -4], UP, 0.5), [3.0, 0.0, 2.0])
        expect(submission.kinematic_response, ([3, 0, -4], UP, 1.0), [3.0, 0.0, 4.0])
        expect(submission.kinematic_response, ([-1, -4, -1], SLANTED, 0.5), [-2.5, -1.0, 2.0])  # + 1.5 · 3 n
    with part(1, "already on its way out"):
        expect(submission.kinematic_response, ([3, 0, 4], UP, 0.5), [3.0, 0.0, 4.0])
    with part(1, "off a plane at rest, no bounce makes a body faster"):

        def no_faster(velocity, normal, restitution):
            after = numbers(submission.kinematic_response, (velocity, normal, restitution))
            assert np.linalg.norm(after) <= np.linalg.norm(velocity) * 1.00001, f"{after} is faster than {velocity}"

        examples.every(lambda draw: (draw.vector(), draw.unit(), draw.number(0, 1)), no_faster)
    with part(1, "a racket that comes to meet the ball"):
        expect(submission.kinematic_response, ([0, 0, -2], UP, 0.5, [0, 0, 2]), [0.0, 0.0, 4.0])
        expect(submission.kinematic_response, ([-1, -4, -1], SLANTED, 0.5, [1, 1, 1]), [-3.0, 0.0, 3.0])
    with part(1, "a plane that draws back, and one that catches up"):
        expect(submission.kinematic_response, ([1, 0, -1], UP, 0.5, [0, 0, -3]), [1.0, 0.0, -1.0])
        expect(submission.kinematic_response, ([1, 0, 1], UP, 1.0, [0, 0, 3]), [1.0, 0.0, 5.0])
    with part(1, "several bodies in one call"):
        expect(submission.kinematic_response, ([[0, 0, -2], [1, 0, 2]], UP, 0.5), [[0, 0, 1], [1, 0, 2]])
        expect(
            submission.kinematic_response, ([[0, 0, -2], [0, 0, 3]], UP, [0.5, 1.0], [[0, 0, 2], [4, 0, 4]]),
            [[0, 0, 4], [0, 0, 5]]
        )  # fmt: skip


@asks(
    "respond_at_step", 3,
    "A body that starts the step behind the plane and moves in turns round; for this step the plane carries it.",
    "Slide 6, at time steps: which velocity moves the body in this step, and what can gravity do to it meanwhile?",
)  # fmt: skip
def test_a_body_behind_the_plane_at_the_start_of_the_step_turns_round(submission, part):
    with part(1, "behind the floor or behind a plane along no axis, and moving in"):
        expect(
            submission.respond_at_step, ([0, 0, -0.25], [1, 0, -3], FALL, UP, True, 0.5, 0.5),
            ([0.5, 0, 0.5], [1, 0, 1.5])
        )  # fmt: skip
        expect(
            submission.respond_at_step, ([1, 2, 3], [-1, -4, -1], PRESSED, SLANTED, True, 0.5, 0.5),
            ([-0.25, 1, 4.5], [-2.5, -2, 3])
        )  # fmt: skip
    with part(1, "in front of the plane; on its way out of it, or along it; pulled away from the floor"):
        for velocity, acceleration, normal, behind, after in (
            ([1, 0, -1], FALL, UP, False, ([1.5, 2, 0.5], [1, 0, -5])),
            ([1, 0, 2], FALL, UP, True, ([1.5, 2, 2], [1, 0, -2])),
            ([-9, -3, 0], PRESSED, SLANTED, True, ([-3.25, -0.5, 3], [-8.5, -5, 0])),
            ([0, 3, -2], PRESSED, SLANTED, True, ([1.25, 2.5, 2], [0.5, 1, -2])),
            ([2, 4, 0], FALL, UP, True, ([2, 4, 1], [2, 4, -4])),
            ([0, 0, -4], [0, 0, 2], UP, True, ([1, 2, 4.5], [0, 0, 3])),
        ):
            expect(submission.respond_at_step, ([1, 2, 3], velocity, acceleration, normal, behind, 0.5, 0.5), after)
    with part(1, "both in one call"):
        expect(
            submission.respond_at_step,
            ([[0, 0, -0.25], [0, 0, 9]], [[1, 0, -3], [1, 0, -1]], FALL, UP, [True, False], 0.5, 0.5),
            ([[0.5, 0, 0.5], [0.5, 0, 6.5]], [[1, 0, 1.5], [1, 0, -5]]),
        )


@asks(
    "bounce", 5, "Each step looks first, responds where the ball is behind the plane, and moves.",
    "What has to be known before respond_at_step can be called? And which state does the next step start from?",
)  # fmt: skip
def test_each_step_looks_responds_and_moves(submission, part):
    with part(1, "a floor: a fall, a bounce, a step behind the floor on its way out, and a second bounce"):
        expect(
            submission.bounce, ([1, 2, 1], [2, 0, -2], FALL, UP, 0.0, 0.5, 0.5, 4),
            (
                [[1, 2, 1], [2, 2, -2], [3, 2, -0.5], [4, 2, -1], [5, 2, -0.75]],
                [[2, 0, -2], [2, 0, -6], [2, 0, 3], [2, 0, -1], [2, 0, 0.5]],
            ),
        )  # fmt: skip
    with part(1, "a plane along no axis that does not go through the origin"):
        expect(
            submission.bounce, ([3, 3, 0], [-1, -4, -1], PRESSED, SLANTED, 0.5, 0.5, 0.5, 4),
            (
                [[3, 3, 0], [2.75, 0, -0.5], [1.375, -1.25, 1.75], [0.25, -3.5, 4], [-0.625, -6.75, 6.25]],
                [[-1, -4, -1], [-0.5, -6, -1], [-2.75, -2.5, 4.5], [-2.25, -4.5, 4.5], [-1.75, -6.5, 4.5]],
            ),
        )  # fmt: skip
    with part(1, "a step that ends exactly on the plane: touching is not behind it"):
        expect(
            submission.bounce, ([0, 0, 2.5], [1, 0, -1], REST, UP, -2.0, 0.5, 0.5, 3),
            (
                [[0, 0, 2.5], [0.5, 0, 2], [1, 0, 1.5], [1.5, 0, 1.75]],
                [[1, 0, -1], [1, 0, -1], [1, 0, -1], [1, 0, 0.5]],
            ),
        )  # fmt: skip
    with part(1, "behind the plane at the start: on its way in, on its way out, along it, pulled off it; and no steps"):
        for position, velocity, acceleration, normal, offset, place, after in (
            ([0, 0, -1], [1, 0, -4], FALL, UP, 0.0, [0.5, 0, 0], [1, 0, 2]),
            ([0, 0, -1], [1, 0, 4], FALL, UP, 0.0, [0.5, 0, -1], [1, 0, 0]),
            ([0, 0, -1], [2, 4, 0], FALL, UP, 0.0, [1, 2, -3], [2, 4, -4]),
            ([0, 0, -1], [0, 0, -4], [0, 0, 2], UP, 0.0, [0, 0, 0.5], [0, 0, 3]),
            (REST, [-9, -3, 0], PRESSED, SLANTED, -1.0, [-4.25, -2.5, 0], [-8.5, -5, 0]),
            (REST, [0, 3, -2], PRESSED, SLANTED, -1.0, [0.25, 0.5, -1], [0.5, 1, -2]),
        ):
            given = (position, velocity, acceleration, normal, offset, 0.5, 0.5)
            expect(submission.bounce, (*given, 1), ([position, place], [velocity, after]))
            expect(submission.bounce, (*given, 0), ([position], [velocity]))
    with part(1, "several balls in one call: one in front of the plane and two behind it"):
        expect(
            submission.bounce,
            ([[0, 0, 9], [0, 0, -1], [0, 0, -1]], [1, 0, -4], FALL, UP, 0.0, [0.5, 0.5, 1.0], 0.5, 1),
            (
                [[[0, 0, 9], [0, 0, -1], [0, 0, -1]], [[0.5, 0, 5], [0.5, 0, 0], [0.5, 0, 1]]],
                [[[1, 0, -4]] * 3, [[1, 0, -8], [1, 0, 2], [1, 0, 4]]],
            ),
        )


@asks(
    "respond_at_impact", 3, "Fly to the impact, respond, and fly on for the rest of the step.",
    "Slide 6, backing up: how much of the step is left after the impact?",
)  # fmt: skip
def test_the_step_goes_on_after_the_impact(submission, part):
    with part(1, "half way through the step, also on a plane along no axis, at its very end and at its very start"):
        expect(submission.respond_at_impact, (REST, [1, 0, -4], REST, UP, 0.5, 0.0, 0.5), ([0.5, 0, 1], [1, 0, 2]))
        expect(
            submission.respond_at_impact, ([0, 0, 2], [1, 0, -4], REST, UP, 0.5, 0.5, 1.0), ([1, 0, 1], [1, 0, 2])
        )  # fmt: skip
        expect(
            submission.respond_at_impact, ([-1, 2, 3], [-2, -5, 0], [2, 2, -2], SLANTED, 0.5, 0.5, 1.0),
            ([-2.75, -0.5, 3.5], [-1.5, 0, 1])
        )  # fmt: skip
        expect(
            submission.respond_at_impact, ([0, 0, 2], [1, 0, -4], REST, UP, 0.5, 0.5, 0.5), ([0.5, 0, 0], [1, 0, 2])
        )  # fmt: skip
    with part(1, "no impact in this step, or on its way out already"):
        expect(
            submission.respond_at_impact, (REST, [1, 0, 2], REST, UP, 0.5, 0.25, 0.5), ([0.5, 0, 1], [1, 0, 2])
        )  # fmt: skip
        expect(
            submission.respond_at_impact, ([0, 0, 9], [1, 0, 0], FALL, UP, 0.5, INFINITY, 0.5),
            ([0.5, 0, 8], [1, 0, -4])
        )  # fmt: skip
    with part(1, "both in one call"):
        expect(
            submission.respond_at_impact,
            ([0, 0, 2], [1, 0, -4], REST, UP, 0.5, [0.5, INFINITY], 1.0),
            ([[1, 0, 1], [1, 0, -2]], [[1, 0, 2], [1, 0, -4]]),
        )


@asks(
    "penalty_force", 5, "The contact is a spring with a dashpot: it pushes while they overlap, and never pulls.",
    "Slide 8. Which sign has the depth, and what should happen when the dashpot is stronger than the spring?",
)  # fmt: skip
def test_the_contact_pushes_while_they_overlap_and_never_pulls(submission, part):
    with part(1, "pressed in, moving in, moving out"):
        expect(submission.penalty_force, (-0.125, 0.0, UP, 800.0, 10.0), [0.0, 0.0, 100.0])
        expect(submission.penalty_force, (-0.125, -2.0, UP, 800.0, 10.0), [0.0, 0.0, 120.0])
        expect(submission.penalty_force, (-0.125, -2.0, SLANTED, 800.0, 10.0), [-40.0, 80.0, 80.0])
        expect(submission.penalty_force, (-0.125, 2.0, UP, 800.0, 10.0), [0.0, 0.0, 80.0])
    with part(1, "in front of the plane, or touching it"):
        expect(submission.penalty_force, (0.5, -2.0, UP, 800.0, 10.0), REST)
        expect(submission.penalty_force, (0.5, -50.0, UP, 800.0, 10.0), REST)
        expect(submission.penalty_force, (0.5, 2.0, UP, 800.0, 10.0, True), REST)
        expect(submission.penalty_force, (0.0, -2.0, UP, 800.0, 10.0), REST)  # touching
    with part(1, "moving out fast"):
        expect(submission.penalty_force, (-0.125, 20.0, UP, 800.0, 10.0), REST)
    with part(1, "moving out fast, with adhesion"):
        expect(submission.penalty_force, (-0.125, 20.0, UP, 800.0, 10.0, True), [0.0, 0.0, -100.0])
    with part(1, "two contacts in one call"):
        expect(submission.penalty_force, ([-0.125, 0.5], 0.0, UP, 800.0, 10.0), [[0, 0, 100], REST])


@asks(
    "penalty_step_limit", 2, "Too long a step shakes the contact: with ω = √(k/m) no more than 2/ω, less with damping.",
    "Write one step of semi-implicit Euler as a matrix. When has it the eigenvalue −1?",
)  # fmt: skip
def test_a_stiff_contact_needs_a_short_step(submission, part):
    with part(1, "without damping, with it, and with very much of it"):
        expect(submission.penalty_step_limit, (1.0, 100.0), 0.2)
        expect(submission.penalty_step_limit, (1.0, 100.0, 15.0), 0.1)  # ζ = 3/4
        expect(submission.penalty_step_limit, (2.0, 200.0, 30.0), 0.1)  # twice as much of everything
        for damping in (1e7, 3e8, 1e10):  # 2 m/c, with all its digits
            expect(submission.penalty_step_limit, (1.0, 100.0, damping), 2 / damping)
    with part(1, "several in one call"):
        expect(submission.penalty_step_limit, (1.0, 100.0, [0.0, 15.0]), [0.2, 0.1])


@asks(
    "design_contact", 4, "All the energy is in the spring at the permitted depth, and the contact lasts half a swing.",
    "How much energy has the body at the first touch, and how much has a spring that is pressed in by d? And how"
    " long is half a period of a body on that spring?",
)  # fmt: skip
def test_a_contact_does_what_it_was_made_for(submission, part):
    with part(1, "without loss, 2 kg at 3 m/s and half a metre deep: 72 N/m, and half a period of π/6 s"):
        expect(submission.design_contact, (2.0, 3.0, 0.5, 1.0, 10.0), (72.0, 0.0, math.pi / 60))
    with part(1, "the damping gives the restitution: critical at e = exp(−2), half of that at exp(−2π/√27)"):
        expect(submission.design_contact, (0.5, 4.0, 0.25, math.exp(-2), 8.0), (128.0, 16.0, math.pi / 128))
        half = math.exp(-2 * math.pi / math.sqrt(27))
        expect(submission.design_contact, (3.0, 0.5, 0.25, half, 4.0), (12.0, 6.0, math.pi / 8))
    with part(1, "4.4 m/s, and a millimetre deep"):
        expect(submission.design_contact, (0.25, 4.4, 1e-3, 1.0, 30.0), (4.84e6, 0.0, math.pi / 132000))
    with part(1, "several in one call"):
        expect(
            submission.design_contact, ([2.0, 0.5], [3.0, 4.0], [0.5, 0.25], [1.0, math.exp(-2)], [10.0, 8.0]),
            ([72.0, 128.0], [0.0, 16.0], [math.pi / 60, math.pi / 128]),
        )  # fmt: skip


@asks(
    "respond_at_impact", 2, "A ball that is let fall rises to e² of its height, and comes to rest, as in every engine."
)
def test_a_ball_rises_to_e_squared_of_its_height_and_comes_to_rest(submission, part):
    code = with_solutions(submission, "response")
    with part(1, "how high it rises"):
        compared_with_theory(code, "dropped-ball", ("e=0.5", "e=0.8"), ("rebound",))
    with part(1, "when it comes to rest, and where"):
        compared_with_theory(code, "ball-to-rest", ("e=0.5",), ("rest_time", "rest_height"))
